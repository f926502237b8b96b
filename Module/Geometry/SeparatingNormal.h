// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SeparatingNormal_h
#define tetralux_SeparatingNormal_h

#include "Geometry/LinearProgram.h"
#include "Geometry/SeparatingPlanes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace tetralux
{

/// Finds the normal of a plane that has all points of one set below and all of another one above,
/// as far from both as one can be. Sets that touch it, and reach over it by SeparationOverlap at
/// most, are parted, too. Returns false if there is none.
inline bool FindSeparatingNormal(const std::vector<std::array<double, 3>>& below,
  const std::vector<std::array<double, 3>>& above, std::array<double, 3>& normal)
{
  // Points are taken to -1 to 1, as the linear program wants it.
  std::array<double, 3> center{};
  double halfSize = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const auto* points : { &below, &above })
    {
      for (const auto& point : *points)
      {
        low = std::min(low, point[axis]);
        high = std::max(high, point[axis]);
      }
    }
    center[axis] = 0.5 * (low + high);
    halfSize = std::max(halfSize, 0.5 * (high - low));
  }
  if (!(halfSize > 0))
  {
    return false;
  }

  // Of a normal's coordinates the largest is 1 or -1, a program for each. Unknown are the other
  // two, the plane's offset, and how far it is from the points.
  double farthest = -SeparationOverlap;
  bool found = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const double sign : { -1., 1. })
    {
      std::vector<HalfSpace<4>> halfSpaces;
      for (int d = 0; d < 4; ++d)
      {
        HalfSpace<4> side{ {}, d < 2 ? 1. : 8. }; // offsets are 3 at most
        side.Normal[d] = 1;
        halfSpaces.push_back(side);
        side.Normal[d] = -1;
        halfSpaces.push_back(side);
      }
      const auto add = [&](const std::vector<std::array<double, 3>>& points, double side)
      {
        for (const auto& point : points)
        {
          const auto at = [&](int a) { return side * (point[a] - center[a]) / halfSize; };
          constexpr double Length = 0.5; // makes normals about that of 1
          halfSpaces.push_back({ { Length * at(u), Length * at(v), -Length * side, Length },
            -Length * sign * at(axis) });
        }
      };
      add(below, 1);
      add(above, -1);
      std::array<double, 4> x;
      if (SolveLinearProgram<4>(halfSpaces, { 0, 0, 0, 1 }, x) && x[3] >= farthest)
      {
        farthest = x[3];
        normal[axis] = sign;
        normal[u] = x[0];
        normal[v] = x[1];
        found = true;
      }
    }
  }
  return found;
}

} // namespace tetralux

#endif
