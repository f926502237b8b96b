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
/// points, so that cell (i, j, k) is the unit cube from (i, j, k) on.
struct ImageVolume
{
  int Dimensions[3] = { 0, 0, 0 }; ///< points along each axis, at least 2
  ImageScalar Type = ImageScalar::Float;
  const void* Values = nullptr; ///< x fastest, then y; not owned
  /// The scalar of a value v is Offset + Scale v.
  ///@{
  double Scale = 1; ///< not 0
  double Offset = 0;
  ///@}
};

/// Values of a volume.
inline std::size_t GetNumberOfValues(const ImageVolume& volume)
{
  return static_cast<std::size_t>(volume.Dimensions[0]) * volume.Dimensions[1] *
    volume.Dimensions[2];
}

} // namespace tetralux

#endif
