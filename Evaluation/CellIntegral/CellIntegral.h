// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellIntegral_h
#define tetralux_CellIntegral_h

#include "Scene/VolumeScene.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <vector>

namespace tetralux
{

/// What IntegrateCells is off by in a channel, at most, for colours up to 1: roundings of thousands
/// of segments in double precision, and rays end where less than a tenth of it can be added. Rays
/// along a face of the boundary are off by as much more as rounding moves where they meet it.
constexpr double CellIntegralError = 1e-9;

/// The picture that the ray caster approaches: emission and absorption along each ray through the
/// cells, each segment by RayIntegral.h. All is in double precision: nothing is rounded to the
/// kernels' tables, and no code is shared with them.
///
/// Returns four channels a pixel: premultiplied red, green, blue and opacity, lowest row first. The
/// pixels do not depend on the number of threads; 0: as many as OpenMP offers.
///
/// Throws std::invalid_argument, with one line, for what is not such an integral: other models,
/// several components, cropping and maximum distances.
std::vector<double> IntegrateCells(
  VolumeScene& scene, const RayGrid& grid, const RayLimits& limits, int threads);

} // namespace tetralux

#endif
