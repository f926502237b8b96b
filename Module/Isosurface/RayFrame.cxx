// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/RayFrame.h"

#include "View/RayAcross.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

void Cross(const double* a, const double* b, double* result)
{
  result[0] = a[1] * b[2] - a[2] * b[1];
  result[1] = a[2] * b[0] - a[0] * b[2];
  result[2] = a[0] * b[1] - a[1] * b[0];
}

double Dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double GetLength(const double* a) { return std::hypot(a[0], a[1], a[2]); }

/// A direction of the world in a mesh's frame.
void ToMesh(const RayGrid& grid, const MeshFrame& mesh, const double* direction, double* result)
{
  for (int a = 0; a < 3; ++a)
  {
    result[a] = Dot(grid.MeshFromWorld[a], direction) / mesh.Radius;
  }
}

/// Fills Rows from Axes and Origin. False: there is no inverse.
bool Invert(RayFrame& frame)
{
  const double(&columns)[3][3] = frame.Axes;
  double(&rows)[3][4] = frame.Rows;
  // Lengths first, so that no product leaves the range of numbers.
  double unit[3][3], length[3];
  for (int c = 0; c < 3; ++c)
  {
    length[c] = GetLength(columns[c]);
    if (!(length[c] > 0) || !std::isfinite(length[c]))
    {
      return false;
    }
    for (int a = 0; a < 3; ++a)
    {
      unit[c][a] = columns[c][a] / length[c];
    }
  }
  double cross[3];
  Cross(unit[1], unit[2], cross);
  const double determinant = Dot(unit[0], cross);
  if (determinant == 0)
  {
    return false;
  }
  for (int r = 0; r < 3; ++r)
  {
    Cross(unit[(r + 1) % 3], unit[(r + 2) % 3], cross);
    for (int a = 0; a < 3; ++a)
    {
      rows[r][a] = cross[a] / determinant / length[r];
    }
    rows[r][3] = -Dot(rows[r], frame.Origin);
  }
  return true;
}

bool IsZero(const double (&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

} // namespace

RayFrame MakeRayFrame(const RayGrid& grid, const MeshFrame& mesh)
{
  RayFrame frame;
  const bool sameOrigin = IsZero(grid.OriginStepX) && IsZero(grid.OriginStepY);
  frame.Parallel = IsZero(grid.DirectionStepX) && IsZero(grid.DirectionStepY);
  if (sameOrigin == frame.Parallel)
  {
    throw std::invalid_argument("rays must have one origin or one direction in common");
  }
  ToMesh(grid, mesh, frame.Parallel ? grid.OriginStepX : grid.DirectionStepX, frame.Axes[0]);
  ToMesh(grid, mesh, frame.Parallel ? grid.OriginStepY : grid.DirectionStepY, frame.Axes[1]);
  ToMesh(grid, mesh, grid.Direction, frame.Axes[2]);
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    frame.Origin[a] = (Dot(row, grid.Origin) + (row[3] - mesh.Center[a])) / mesh.Radius;
  }
  if (!Invert(frame))
  {
    throw std::invalid_argument("the rays of the picture lie in a plane");
  }
  if (frame.Parallel)
  {
    // Beside the centres of pixels, as RayAcross.h says: farther than rounding takes the sides of a
    // mesh, and far less than a pixel.
    constexpr double ShiftOfRadius = 1. / (1 << 21);
    double pixels = 1; // a radius
    for (int r = 0; r < 2; ++r)
    {
      pixels = std::max(pixels, std::hypot(frame.Rows[r][0], frame.Rows[r][1], frame.Rows[r][2]));
    }
    frame.Shift[0] = ShiftOfRadius * pixels;
    frame.Shift[1] = ShiftSlope * frame.Shift[0];
    for (int r = 0; r < 2; ++r)
    {
      frame.Rows[r][3] -= frame.Shift[r];
    }
  }
  return frame;
}

RayFrame MakeParallelFrame(const double (&direction)[3])
{
  RayFrame frame;
  frame.Parallel = true;
  int smallest = 0;
  for (int a = 1; a < 3; ++a)
  {
    smallest = std::abs(direction[a]) < std::abs(direction[smallest]) ? a : smallest;
  }
  double axis[3] = { 0, 0, 0 };
  axis[smallest] = 1;
  Cross(axis, direction, frame.Axes[0]);
  Cross(direction, frame.Axes[0], frame.Axes[1]);
  std::copy_n(direction, 3, frame.Axes[2]);
  for (int c = 0; c < 2; ++c)
  {
    const double length = GetLength(frame.Axes[c]);
    for (double& component : frame.Axes[c])
    {
      component /= length;
    }
  }
  Invert(frame);
  return frame;
}

RayFrame MakeAxisFrame(const double (&origin)[3], int axis, bool positive)
{
  RayFrame frame;
  for (int r = 0; r < 3; ++r)
  {
    const int a = (axis + 1 + r) % 3; // the last row is the axis
    const double sign = r == 2 && !positive ? -1 : 1;
    std::fill_n(frame.Rows[r], 4, 0.);
    std::fill_n(frame.Axes[r], 3, 0.);
    frame.Rows[r][a] = sign;
    frame.Rows[r][3] = -sign * origin[a];
    frame.Axes[r][a] = sign;
    frame.Origin[a] = origin[a];
  }
  return frame;
}

} // namespace tetralux
