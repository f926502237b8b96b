// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceGrazing_h
#define tetralux_ReferenceGrazing_h

#include "ReferenceRenderer.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// How ill-conditioned each pixel of image is because its ray grazes a silhouette.
///
/// The picture is rendered four times more, displaced by that many pixels to the left, right,
/// bottom and top. In the larger of both directions, and of the four channels, the measure is the
/// larger of
/// - the bend |left - 2 centre + right|: displacement^2 times the second derivative where the
///   picture is smooth (so around 1e-6), the height of the step or the displacement times the
///   change of slope where a silhouette lies between the three;
/// - the steepness |right - left| / 2 minus the displacement: 0 unless the picture changes by more
///   than its whole range within one pixel, as on a boundary face seen nearly along itself.
/// A pixel counts as grazed where the measure exceeds GrazingThreshold: a line across which the
/// picture steps or kinks by that much is found wherever it passes within 0.7 displacements of the
/// pixel's centre. A spike narrower than the displacement can be missed.
///
/// Costs four pictures; pixels as in RenderReference, for measuring only where a picture is off.
std::vector<double> MeasureGrazing(const ReferenceMesh& mesh, const ReferenceOptics& optics,
  const RayGrid& rays, const RayLimits& limits, const ReferenceImage& image,
  Span<const std::uint8_t> pixels = {}, double displacement = 1e-3);

/// Of a channel, 0..1: twenty times what curvature alone gives at a displacement of 1e-3 pixels
/// where the slope of a picture goes from nothing to the whole range within a pixel.
constexpr double GrazingThreshold = 2e-5;

} // namespace tetralux

#endif
