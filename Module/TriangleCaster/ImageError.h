// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageError_h
#define tetralux_ImageError_h

// How far a picture of slices is from one of infinitely many, estimated from some of its rays.

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "TriangleCaster/ImageCaster.h"

#include <cstdint>

namespace tetralux
{

/// Differences of a channel, absolute.
struct ImageError
{
  double Largest = 0;
  double Mean = 0;       ///< over the channels of rays that meet anything
  std::int64_t Rays = 0; ///< that were compared
};

/// Compares about 1,000 rays of a picture, on a lattice, with the same ones at an eighth of the
/// distance and without early ends. Where the error shrinks with the square of the distance, that
/// misses 1/64 of it; where a surface of the function is sharp, an eighth. What is between the rays
/// may be worse.
///
/// colors: of the picture that was cast with these options. Costs about a thirtieth of a picture of
/// 512 x 512. Throws as ImageCaster::Cast.
TETRALUXCORE_EXPORT ImageError EstimateImageError(ImageCaster& caster, const RayGrid& grid,
  const RayLimits& limits, const ImageCasterOptions& options, Span<const float> colors);

/// The largest distance of slices, out of those from options.SampleDistance on that are shorter by
/// powers of two, at which no channel of about 1,000 rays is farther than maximumError from half
/// that distance, but at most MostHalvings shorter. Throws as ImageCaster::Cast.
TETRALUXCORE_EXPORT double ChooseSampleDistance(ImageCaster& caster, const RayGrid& grid,
  const RayLimits& limits, const ImageCasterOptions& options, double maximumError);
constexpr int MostHalvings = 6;

} // namespace tetralux

#endif
