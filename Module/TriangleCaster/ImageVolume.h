// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageVolume_h
#define tetralux_ImageVolume_h

#include <cstddef>

namespace tetralux
{

/// The types that values are read in. Others are brought to Float first.
enum class ImageScalar
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Float
};

inline std::size_t GetSize(ImageScalar type)
{
  return type == ImageScalar::Float                             ? 4
    : type == ImageScalar::Int16 || type == ImageScalar::UInt16 ? 2
                                                                : 1;
}

/// Values at the points of a regular grid. Between points they are interpolated trilinearly;
/// outside of the outermost points there is nothing. Coordinates of the volume are indices of
/// points, so that cell (i, j, k) is the unit cube from (i, j, k) on. Nothing is owned.
struct ImageVolume
{
  /// The most components of a point, as in VTK.
  static constexpr int MostComponents = 4;

  int Dimensions[3] = { 0, 0, 0 }; ///< points along each axis, at least 2
  ImageScalar Type = ImageScalar::Float;
  int Components = 1;           ///< values of each point, 1 to MostComponents
  const void* Values = nullptr; ///< those of a point together, x fastest, then y
  /// The scalar of a value v is Offset + Scale v.
  ///@{
  double Scale = 1; ///< not 0
  double Offset = 0;
  ///@}

  /// The label of each point, if there are any: which functions of ImageOptics a sample has. A
  /// sample has that of the nearest point.
  const unsigned char* Labels = nullptr;

  /// A number for each point, or none: samples whose nearest point has 0 are empty.
  const unsigned char* Mask = nullptr;

  /// Flags of points and of cells, or none; cell (i, j, k) is the one from point (i, j, k) on.
  /// Cells are empty that have a flag of HidingCellFlags, or a point with one of HidingPointFlags.
  /// As in vtkDataSetAttributes::GhostArrayName() these are HIDDENPOINT and HIDDENCELL.
  ///@{
  const unsigned char* PointFlags = nullptr;
  unsigned char HidingPointFlags = 2;
  const unsigned char* CellFlags = nullptr;
  unsigned char HidingCellFlags = 32;
  ///@}
};

inline std::size_t GetNumberOfPoints(const ImageVolume& volume)
{
  return static_cast<std::size_t>(volume.Dimensions[0]) * volume.Dimensions[1] *
    volume.Dimensions[2];
}

inline std::size_t GetNumberOfValues(const ImageVolume& volume)
{
  return volume.Components * GetNumberOfPoints(volume);
}

} // namespace tetralux

#endif
