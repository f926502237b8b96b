// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PixelSamples_h
#define tetralux_PixelSamples_h

#include "Frame/MemoryPicture.h"
#include "TetraluxRenderingModule.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tetralux
{

/// What samples of some pixels of a picture show, in place of the pixels.
struct PixelSamples
{
  int Samples = 0;                  ///< of each pixel
  std::vector<std::int32_t> Pixels; ///< y Width + x
  std::vector<float> Colors;        ///< of each sample: four for each of Pixels, premultiplied
  std::vector<float> Depths;        ///< of each sample, as MemoryPicture has them; empty: none
};

/// The depth buffer of a multisampled frame buffer, as the rays through its pixels see it.
struct OpaqueSamples
{
  int Width = 0;
  int Height = 0;
  int Samples = 0;           ///< of each pixel
  std::vector<float> Depths; ///< 0..1, of each sample one a pixel; empty if nothing opaque is there

  std::array<double, 2> PixelWidth; ///< CameraRays::GetWidth
  /// Along the ray of a pixel to a depth, in world units.
  std::function<double(int x, int y, double depth)> GetDistance;
};

/// Depths of opaque geometry, 0..1, for the rays through the middles of pixels; empty if there is
/// none at all. Where a pixel has no edge, the mean depth, which is right for planes; else that of
/// the first sample.
TETRALUXRENDERING_EXPORT std::vector<float> FindOpaqueDepths(const OpaqueSamples& opaque);

/// Pixels of which one ray is too few: where colours of a picture do not change evenly, and where
/// opaque geometry ends within a pixel that is not empty. colors: four a pixel, premultiplied.
TETRALUXRENDERING_EXPORT std::vector<std::int32_t> FindEdges(
  const OpaqueSamples& opaque, const float* colors);

} // namespace tetralux

#endif
