// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LightSteps_h
#define tetralux_LightSteps_h

#include "Optics/OpticalModel.h"
#include "TetraluxCoreModule.h"

#include <vector>

namespace tetralux
{

/// How far light may change on a part of a ray that is lit by a parabola; see RayCastLightParts.h.
/// Of a part that adds a share w below SmallLightWeight (SmallLightWeight / w)^(1/3) times that.
struct LightSteps
{
  double Turn = 1;     ///< of a direction, radians, at most 1
  double Approach = 1; ///< of a distance, as a share of it, at most 1
  double Error = 0;    ///< of a channel, that follows from both
};

/// Of parts that add as little as this the light may be off by more, in proportion: some such parts
/// together add as much as one that hides all behind it.
constexpr double SmallLightWeight = 1. / 32;

/// Of a channel: single precision knows no better what lights make of a colour.
constexpr double SmallestLightError = 1e-7;

/// Steps with which the light of each part is off by at most an error, of a channel of what is lit;
/// a smaller one than SmallestLightError counts as that. Where highlights are so narrow, or lights
/// so bright, that a direction would have to be found every 1/256 of a radian, the error is larger.
TETRALUXCORE_EXPORT LightSteps FindLightSteps(
  const std::vector<Light>& lights, const Material& surface, double error);

/// How lights change what rays gather.
enum class Lighting
{
  None,   ///< not at all
  Even,   ///< alike all along a ray's way through a cell: the light anywhere on it is exact
  Varying ///< on the way through a cell, too
};

TETRALUXCORE_EXPORT Lighting FindLighting(
  bool shaded, bool smoothShading, const std::vector<Light>& lights);

/// Where in a part light is found, as shares of it: the Chebyshev points of three.
constexpr double LightSamples[3] = { 0.06698729810778065, 0.5, 0.9330127018922194 };

} // namespace tetralux

#endif
