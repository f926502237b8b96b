// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayAcross_h
#define tetralux_RayAcross_h

#include "View/RayGrid.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{

/// On which side a ray passes an edge that it meets exactly, in all methods: as if it went beside
/// its pixel's centre, to the right by a little and up by this share of it. So a side of a mesh
/// that is seen as a line through the centres of pixels counts if the mesh is on its right, or
/// above it where the line is less steep than this slope. No line that meshes are aligned with has
/// the slope.
constexpr double ShiftSlope = 3. / 8;

/// Two directions across parallel rays, in the coordinates of the mesh, of length 1. The rays run
/// along First x Second, and are displaced along First - ShiftSlope Second. So First is to the
/// right in the picture and Second down, unless the volume is mirrored or sheared.
struct RayAxes
{
  bool Common = false; ///< whether all rays have the same ones; else the others are not set
  double First[3] = { 0, 0, 0 };
  double Second[3] = { 0, 0, 0 };
};

/// The axes of a picture's rays. Perspective rays have none in common: hardly one is exactly in a
/// plane of the mesh.
inline RayAxes FindRayAxes(const RayGrid& grid)
{
  RayAxes axes;
  const auto isZero = [](const double(&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
  const auto dot = [](const double(&v)[3], const double(&w)[3])
  { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; };
  const auto normalize = [&dot](double(&v)[3])
  {
    // By the largest component first, so that squares stay in the range of numbers.
    const double largest = std::max({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) });
    for (double& x : v)
    {
      x /= largest;
    }
    const double length = std::sqrt(dot(v, v));
    for (double& x : v)
    {
      x /= length;
    }
    return std::isfinite(v[0] + v[1] + v[2]);
  };
  if (!isZero(grid.DirectionStepX) || !isZero(grid.DirectionStepY))
  {
    return axes;
  }
  double along[3] = { 0, 0, 0 };
  double right[3] = { 0, 0, 0 };
  double shift[3] = { 0, 0, 0 };
  for (int a = 0; a < 3; ++a)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double m = grid.MeshFromWorld[a][k];
      along[a] += m * grid.Direction[k];
      right[a] += m * grid.OriginStepX[k];
      shift[a] += m * (grid.OriginStepX[k] + ShiftSlope * grid.OriginStepY[k]);
    }
  }
  if (!normalize(along) || !normalize(right) || !normalize(shift))
  {
    return axes;
  }
  const double slant = dot(along, right);
  for (int a = 0; a < 3; ++a)
  {
    right[a] -= slant * along[a];
  }
  if (!normalize(right))
  {
    return axes;
  }
  double down[3];
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    down[a] = along[b] * right[c] - along[c] * right[b];
  }
  // Turned where the volume is mirrored or sheared. Elsewhere not even by rounding, so that lines
  // of a lattice keep their places.
  constexpr double LargestRounding = 1e-12;
  const double turn = std::atan(ShiftSlope) - std::atan2(-dot(shift, down), dot(shift, right));
  const double cosine = std::abs(turn) < LargestRounding ? 1 : std::cos(turn);
  const double sine = std::abs(turn) < LargestRounding ? 0 : std::sin(turn);
  axes.Common = true;
  for (int a = 0; a < 3; ++a)
  {
    axes.First[a] = cosine * right[a] + sine * down[a];
    axes.Second[a] = cosine * down[a] - sine * right[a];
  }
  return axes;
}

} // namespace tetralux

#endif
