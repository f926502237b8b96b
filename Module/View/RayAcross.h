// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayAcross_h
#define tetralux_RayAcross_h

#include "View/RayGrid.h"

#include <array>
#include <cmath>

namespace tetralux
{

/// The direction in the mesh in which pixels of parallel rays go to the right, of length 1; zero in
/// a perspective, where hardly a ray is exactly in a plane.
///
/// Frames of parallel rays begin with it, so that a ray exactly through an edge passes it on the
/// same side in all methods: as if it were to the right of its pixel's centre by a little, and
/// below it by less. So a mesh whose sides are seen as lines through the centres of pixels covers
/// those on its left and upper side, and not those on its right and lower one.
inline std::array<double, 3> FindRayAcross(const RayGrid& grid)
{
  std::array<double, 3> step = { 0, 0, 0 };
  const double* d = grid.DirectionStepX;
  if (d[0] != 0 || d[1] != 0 || d[2] != 0)
  {
    return step;
  }
  double length = 0;
  for (int a = 0; a < 3; ++a)
  {
    for (int k = 0; k < 3; ++k)
    {
      step[a] += grid.MeshFromWorld[a][k] * grid.OriginStepX[k];
    }
    length = std::hypot(length, step[a]);
  }
  for (double& component : step)
  {
    component = length > 0 ? component / length : 0;
  }
  return step;
}

} // namespace tetralux

#endif
