// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LightAlongRay_h
#define tetralux_LightAlongRay_h

// The light along a ray's way through a cell, cut into parts on which it is nearly quadratic.
//
// Along the ray the gradient is linear, and so is the vector to a positional light. What lights make
// of a colour depends on the directions of both alone, besides the distance. So a part ends
//
// * where the gradient turns away from the viewer: the normal changes sides there;
// * where it turns away from a light, and where the ray comes into the cone of a spot or out of it:
//   light ends there, highlights at once;
// * where the ray is nearest to a positional light;
// * where a direction has turned by LightSteps::Turn, or the distance to a light that distance
//   weakens has changed by LightSteps::Approach of itself.
//
// All are roots of linear or quadratic functions: nothing is searched for. On such a part light is
// smooth, and the parabola through it at the three Chebyshev points is off by at most 1/192 of its
// third derivative.

#include "Optics/SurfaceShading.h"
#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

class TETRALUXCORE_EXPORT LightAlongRay
{
public:
  LightAlongRay() = default;

  /// From front to back, world coordinates, in a cell. direction: of the ray, of length 1.
  LightAlongRay(const SurfaceShading& shading, std::int32_t cell, const double front[3],
    const double back[3], const double direction[3]);

  /// The light at a share of the way, 0..1.
  LightFactors At(double share) const;

  /// Returns the end of the part that begins at a share: more than that, 1 at most.
  double FindEnd(double begin) const;

private:
  const SurfaceShading* Shading = nullptr;
  double Front[3];
  double Way[3]; ///< to the back
  double Direction[3];
  double Gradient[3]; ///< at the front
  double Change[3];   ///< of the gradient, to the back
};

} // namespace tetralux

#endif
