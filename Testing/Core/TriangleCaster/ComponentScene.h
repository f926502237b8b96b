// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComponentScene_h
#define tetralux_ComponentScene_h

// Volumes of several components, labels and masks, and plain loops in double precision that show
// them.

#include "TriangleCaster/ImageCaster.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// A volume, what it is seen by and from where.
struct ComponentScene
{
  std::array<int, 3> Dimensions{ 13, 11, 9 };
  ImageScalar Type = ImageScalar::Float;
  int Components = 1;
  double Scale = 1;
  double Offset = 0;
  std::vector<unsigned char> Values;
  std::vector<double> Numbers; ///< what Values hold
  std::vector<unsigned char> Labels, Mask, PointFlags, CellFlags;

  ImageOptics Optics;
  ImageCasterOptions Options;
  RayGrid Grid;

  /// shares: 0..1 of the range of the type; scalars are 0..1 then.
  void SetValues(ImageScalar type, int components, const std::vector<double>& shares);

  /// A camera that sees the volume obliquely, with different distances of points along each axis.
  void Look(bool parallel, int width, int height);

  ImageVolume GetVolume() const;
  std::size_t GetNumberOfPixels() const
  {
    return static_cast<std::size_t>(this->Grid.Width) * this->Grid.Height;
  }
};

struct ComponentPicture
{
  std::vector<float> Colors, Depths;
  ImageCastStatistics Statistics;
};

ComponentPicture CastScene(const ComponentScene& scene);

bool HasSameBits(const ComponentPicture& a, const ComponentPicture& b);

/// Premultiplied colours and opacity of all pixels.
std::vector<double> ShowByLoops(const ComponentScene& scene);

} // namespace tetralux

#endif
