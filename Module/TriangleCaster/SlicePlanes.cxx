// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/SlicePlanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// More slabs than that have depths that single precision counts no longer.
constexpr double MostSlabs = 1 << 24;

double Dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::array<double, 3> Cross(const double a[3], const double b[3])
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// World coordinates relative to the grid's origin of a point of the volume. rows: of
/// MeshFromWorld, already without the origin's part.
std::array<double, 3> Solve(const double (&rows)[3][3], const double (&right)[3])
{
  const std::array<double, 3> yz = Cross(rows[1], rows[2]);
  const std::array<double, 3> zx = Cross(rows[2], rows[0]);
  const std::array<double, 3> xy = Cross(rows[0], rows[1]);
  const double determinant = Dot(rows[0], yz.data());
  std::array<double, 3> point{};
  for (int a = 0; a < 3; ++a)
  {
    point[a] = (right[0] * yz[a] + right[1] * zx[a] + right[2] * xy[a]) / determinant;
  }
  return point;
}

bool IsParallel(const RayGrid& grid)
{
  const auto isZero = [](const double(&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
  return isZero(grid.DirectionStepX) && isZero(grid.DirectionStepY);
}

/// The normal of the plane that pixels step through, on the side that rays go to.
std::array<double, 3> FindNormal(const RayGrid& grid)
{
  const bool parallel = IsParallel(grid);
  std::array<double, 3> normal = parallel ? Cross(grid.OriginStepX, grid.OriginStepY)
                                          : Cross(grid.DirectionStepX, grid.DirectionStepY);
  double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(length > 0))
  {
    // A picture without steps: one ray.
    std::copy(grid.Direction, grid.Direction + 3, normal.begin());
    length = std::hypot(normal[0], normal[1], normal[2]);
  }
  const double sign = Dot(normal.data(), grid.Direction) < 0 ? -1 : 1;
  for (double& n : normal)
  {
    n *= sign / length;
  }
  return normal;
}

} // namespace

double SlicePlanes::GetDepthOfDirection(const double direction[3]) const
{
  return this->Shape == SliceShape::Planes ? Dot(direction, this->Normal)
                                           : std::hypot(direction[0], direction[1], direction[2]);
}

IndexBox GetIndexBox(const ImageVolume& volume)
{
  IndexBox box;
  for (int a = 0; a < 3; ++a)
  {
    box.High[a] = volume.Dimensions[a] - 1;
  }
  return box;
}

SlicePlanes MakeSlicePlanes(
  const IndexBox& box, const RayGrid& grid, SliceShape shape, double distance)
{
  if (!(distance > 0) || !std::isfinite(distance))
  {
    throw std::invalid_argument("the distance of slices is not above 0");
  }
  SlicePlanes planes;
  planes.Shape = IsParallel(grid) ? SliceShape::Planes : shape;
  planes.Distance = distance;
  const std::array<double, 3> normal = FindNormal(grid);
  std::copy(normal.begin(), normal.end(), planes.Normal);

  double rows[3][3], offset[3];
  for (int a = 0; a < 3; ++a)
  {
    std::copy(grid.MeshFromWorld[a], grid.MeshFromWorld[a] + 3, rows[a]);
    offset[a] = Dot(rows[a], grid.Origin) + grid.MeshFromWorld[a][3];
  }
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0;
  double low[3], high[3]; // of the box, seen from the eye
  std::fill(low, low + 3, nearest);
  std::fill(high, high + 3, -nearest);
  for (int corner = 0; corner < 8; ++corner)
  {
    double right[3];
    for (int a = 0; a < 3; ++a)
    {
      right[a] = ((corner >> a & 1) != 0 ? box.High[a] : box.Low[a]) - offset[a];
    }
    const std::array<double, 3> point = Solve(rows, right);
    const double depth = planes.GetDepthOfDirection(point.data());
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
    for (int a = 0; a < 3; ++a)
    {
      low[a] = std::min(low[a], point[a]);
      high[a] = std::max(high[a], point[a]);
    }
  }
  if (planes.Shape == SliceShape::Shells)
  {
    // The box around the volume may be nearer than its corners.
    const auto outside = [&](int a) { return std::max({ low[a], -high[a], 0. }); };
    nearest = std::hypot(outside(0), outside(1), outside(2));
  }
  planes.Origin = std::max(nearest, 0.);
  planes.Back = farthest;
  const double slabs = std::ceil((farthest - planes.Origin) / distance);
  if (slabs > MostSlabs)
  {
    throw std::invalid_argument("the distance of slices is less than 2^-24 of the volume's depth");
  }
  planes.Count = static_cast<std::int32_t>(std::max(slabs, 0.));
  return planes;
}

} // namespace tetralux
