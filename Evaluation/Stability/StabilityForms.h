// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_StabilityForms_h
#define tetralux_StabilityForms_h

#include "Integral/RayIntegral.h"
#include "Stability/ExtendedIntegral.h"
#include "Stability/StabilityCases.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tetralux
{

/// What a form of the integral computed for a segment, and how exact it promises that to be.
struct StabilityResult
{
  SegmentRadiance Radiance;

  /// Largest error that is promised for a channel: RelativeLimit times the exact opacity (where the
  /// integral is emission alone, times the optical depth), plus AbsoluteLimit.
  double RelativeLimit = 0;
  double AbsoluteLimit = 0;
};

/// A way to compute the integral over a segment.
struct StabilityForm
{
  std::string Name;
  std::string Promise; ///< its limits in words
  OpticalModel Model = OpticalModel::EmissionAbsorption;

  /// Nothing where the form refuses the case.
  std::function<std::optional<StabilityResult>(const StabilityCase&)> Integrate;
};

/// All forms that the library has:
///
/// * "double": RayIntegral.h. To RayIntegralError of the opacity.
/// * "single": SegmentIntegral.h, once for each instruction set of this processor. The segment is
///   cut exactly, and the optical depths of its pieces are then rounded: what is measured is the
///   error of the integral, as the kernels compile and sum it up. The opacity is the sum of all
///   weights; where a kernel writes 1 - transmittance instead, its error is 2^-24, however small
///   the opacity. To SingleIntegralError of the opacity.
/// * "ray caster, single" and "ray caster, double": CastRays on three tetrahedra, with the geometry
///   in that precision. Scalars and the nodes of the transfer function are rounded to
///   CasterRounding of the function's range; what changes within that - a step beside the scalar, a
///   needle that is narrower - no integral can tell apart. To the ray caster's own
///   RayCastStatistics::ErrorEstimate (at least SegmentWeightError, for colours are numbers of
///   single precision), plus the most that attenuation and colour change within CasterRounding of a
///   scalar on the segment, over the whole length. With a function that is smooth on that scale it
///   is next to nothing.
/// * "table, ...": a lookup in a pre-integration table (PreIntegrationTable.h) of the segment's
///   scalars and those of all nodes, of StabilityTableSize texels along each axis, in each format,
///   over both scales of the length, and with both axes of scalars. To its own
///   PreIntegrationTable::Bound of a segment, plus the same rounding of scalars. Such tables are
///   coarse, and bounds of 1 are common: what counts are results that are never right. Functions
///   and ranges that a table cannot hold are refused with an error and are not counted.
std::vector<StabilityForm> MakeStabilityForms();

/// How far apart scalars are that the ray caster may take for each other, in parts of half of the
/// range of the transfer function's nodes, or of the distance from its middle if that is larger:
/// four roundings to single precision, of the scalars, of their interpolation, and of the nodes.
constexpr double CasterRounding = 1. / (1 << 22);

constexpr int StabilityTableSize = 12;

/// Largest error of "single", relative to the opacity: SegmentWeightError, and as much again for
/// the sum over pieces and the colours.
constexpr double SingleIntegralError = 1e-6;

} // namespace tetralux

#endif
