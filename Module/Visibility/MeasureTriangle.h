// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeasureTriangle_h
#define tetralux_MeasureTriangle_h

#include "Visibility/VisibilityView.h"

#include <array>
#include <cmath>

namespace tetralux
{

/// How large a triangle looks: its solid angle, or its area across the direction of the view.
inline double MeasureTriangle(
  const std::array<const double*, 3>& corners, const VisibilityView& view)
{
  double edges[2][3];
  double rays[3][3];
  for (int axis = 0; axis < 3; ++axis)
  {
    edges[0][axis] = corners[1][axis] - corners[0][axis];
    edges[1][axis] = corners[2][axis] - corners[0][axis];
    for (int corner = 0; corner < 3; ++corner)
    {
      rays[corner][axis] =
        view.Parallel ? view.Direction[axis] : corners[corner][axis] - view.Eye[axis];
    }
  }
  const auto dot = [&](int a, int b)
  { return rays[a][0] * rays[b][0] + rays[a][1] * rays[b][1] + rays[a][2] * rays[b][2]; };
  const double lengths[3] = { std::sqrt(dot(0, 0)), std::sqrt(dot(1, 1)), std::sqrt(dot(2, 2)) };
  // From the edges: from three long rays nothing would be left of a small triangle.
  const double determinant =
    std::abs(rays[0][0] * (edges[0][1] * edges[1][2] - edges[0][2] * edges[1][1]) +
      rays[0][1] * (edges[0][2] * edges[1][0] - edges[0][0] * edges[1][2]) +
      rays[0][2] * (edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]));
  if (view.Parallel)
  {
    return 0.5 * determinant / lengths[0];
  }
  // Van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983.
  return 2 *
    std::atan2(determinant,
      lengths[0] * lengths[1] * lengths[2] + dot(0, 1) * lengths[2] + dot(0, 2) * lengths[1] +
        dot(1, 2) * lengths[0]);
}

} // namespace tetralux

#endif
