// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/ScreenFrame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// A world vector in the mesh.
void RotateToMesh(const RayGrid& grid, const double vector[3], double result[3])
{
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    result[a] = row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2];
  }
}

void Cross(const double a[3], const double b[3], double result[3])
{
  result[0] = a[1] * b[2] - a[2] * b[1];
  result[1] = a[2] * b[0] - a[0] * b[2];
  result[2] = a[0] * b[1] - a[1] * b[0];
}

double Dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

} // namespace

ScreenFrame::ScreenFrame(const RayGrid& grid, const double center[3], double radius)
{
  std::copy_n(center, 3, this->Center);
  const double* steps[2] = { grid.DirectionStepX, grid.DirectionStepY };
  const auto isZero = [](const double v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
  this->Perspective = !isZero(steps[0]) || !isZero(steps[1]);
  if (!this->Perspective)
  {
    steps[0] = grid.OriginStepX;
    steps[1] = grid.OriginStepY;
  }
  std::copy_n(steps[0], 3, this->Steps[0]);
  std::copy_n(steps[1], 3, this->Steps[1]);
  std::copy_n(grid.Direction, 3, this->Direction);
  std::copy_n(grid.Origin, 3, this->Origin);
  this->Middle[0] = 0.5 * (grid.Width - 1);
  this->Middle[1] = 0.5 * (grid.Height - 1);
  double columns[3][3];
  RotateToMesh(grid, steps[0], columns[0]);
  RotateToMesh(grid, steps[1], columns[1]);
  RotateToMesh(grid, grid.Direction, columns[2]);

  // The rows of the inverse, by cross products.
  double normal[3];
  Cross(columns[1], columns[2], normal);
  const double determinant = Dot(columns[0], normal);
  if (determinant == 0 || !std::isfinite(determinant))
  {
    throw std::invalid_argument("the rays of the picture do not span space");
  }
  double origin[3];
  RotateToMesh(grid, grid.Origin, origin);
  for (int a = 0; a < 3; ++a)
  {
    origin[a] += grid.MeshFromWorld[a][3] - center[a];
  }
  for (int row = 0; row < 3; ++row)
  {
    Cross(columns[(row + 1) % 3], columns[(row + 2) % 3], normal);
    for (int a = 0; a < 3; ++a)
    {
      this->Rows[row][a] = normal[a] / determinant;
    }
    this->Rows[row][3] = -Dot(this->Rows[row], origin);
  }

  // Depths of the mesh are then 1 at most, and their squares no number that a shader can't hold.
  const double* depth = this->Rows[2];
  this->DepthUnit = std::abs(depth[3]) + radius * std::sqrt(Dot(depth, depth));
  for (double& element : this->Rows[2])
  {
    element /= this->DepthUnit;
  }
  for (int a = 0; a < 4; ++a)
  {
    this->WorldDepth[a] = depth[0] * grid.MeshFromWorld[0][a] +
      depth[1] * grid.MeshFromWorld[1][a] + depth[2] * grid.MeshFromWorld[2][a];
  }
  this->WorldDepth[3] += depth[3] - Dot(depth, center);
  if (this->Perspective)
  {
    for (int row = 0; row < 2; ++row)
    {
      for (double& element : this->Rows[row])
      {
        element /= this->DepthUnit;
      }
    }
  }
}

ScreenPoint ScreenFrame::Project(const double point[3], double scalar) const
{
  double d[3];
  for (int a = 0; a < 3; ++a)
  {
    d[a] = point[a] - this->Center[a];
  }
  ScreenPoint result;
  result.X = Dot(this->Rows[0], d) + this->Rows[0][3];
  result.Y = Dot(this->Rows[1], d) + this->Rows[1][3];
  result.Depth = Dot(this->Rows[2], d) + this->Rows[2][3];
  result.Scalar = scalar;
  if (this->Perspective && this->IsInFront(result))
  {
    result.X /= result.Depth;
    result.Y /= result.Depth;
  }
  return result;
}

void ScreenFrame::Project(Span<const double> points, Span<const double> scalars, double offset,
  double scale, Span<ScreenPoint> result) const
{
  const auto n = static_cast<std::int64_t>(result.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t p = 0; p < n; ++p)
  {
    result[p] = this->Project(&points[3 * p], scalars.empty() ? 0 : (scalars[p] - offset) / scale);
  }
}

std::array<double, 2> ScreenFrame::ProjectDepth(
  const double position[3], const double point[4]) const
{
  const double* row = this->WorldDepth;
  return { Dot(row, point) + (Dot(row, position) + row[3]) * point[3], point[3] };
}

ScreenFrame::FramePlane ScreenFrame::ToFrame(const std::array<double, 4>& plane) const
{
  // Depths are in units of DepthUnit; in a perspective so are the products with them.
  const double unit = this->Perspective ? this->DepthUnit : 1;
  return { { unit * Dot(plane.data(), this->Steps[0]), unit * Dot(plane.data(), this->Steps[1]),
             this->DepthUnit * Dot(plane.data(), this->Direction) },
    Dot(plane.data(), this->Origin) + plane[3] };
}

bool ScreenFrame::IsOutside(const FramePlane& plane, const ScreenPoint& point) const
{
  const double factor = this->Perspective && this->IsInFront(point) ? point.Depth : 1;
  return factor * (plane.Normal[0] * point.X + plane.Normal[1] * point.Y) +
    plane.Normal[2] * point.Depth + plane.Offset <
    0;
}

ScreenPlane ScreenFrame::ProjectPlane(const std::array<double, 4>& plane) const
{
  const FramePlane inFrame = this->ToFrame(plane);
  const double* normal = inFrame.Normal;
  const double constant = normal[0] * this->Middle[0] + normal[1] * this->Middle[1] +
    (this->Perspective ? normal[2] : inFrame.Offset);
  const double slope = this->Perspective ? inFrame.Offset : -normal[2];
  // The largest number is 1: the sides are all that counts.
  const double scale = 1 /
    std::max({ std::abs(normal[0]), std::abs(normal[1]), std::abs(constant), std::abs(slope),
      std::numeric_limits<double>::min() });
  return { static_cast<float>(scale * normal[0]), static_cast<float>(scale * normal[1]),
    static_cast<float>(scale * constant), static_cast<float>(scale * slope) };
}

ScreenFrame::Limits ScreenFrame::FindLimits(Span<const std::array<double, 4>> planes,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells,
  Span<const std::uint8_t> candidates) const
{
  Limits limits;
  const auto numberOfPoints = static_cast<std::int64_t>(points.size());
  const auto numberOfCells = static_cast<std::int64_t>(cells.size() / 4);
  std::vector<std::uint8_t> outside(points.size());
  for (const std::array<double, 4>& plane : planes)
  {
    const FramePlane inFrame = this->ToFrame(plane);
    std::int64_t sum = 0;
#pragma omp parallel for schedule(static) reduction(+ : sum)
    for (std::int64_t p = 0; p < numberOfPoints; ++p)
    {
      outside[p] = this->IsOutside(inFrame, points[p]);
      sum += outside[p];
    }
    if (sum == 0)
    {
      continue;
    }
    limits.Planes.push_back(this->ProjectPlane(plane));
    if (limits.Cells.empty())
    {
      limits.Cells.assign(numberOfCells, 1);
      std::copy(candidates.begin(), candidates.end(), limits.Cells.begin());
    }
#pragma omp parallel for schedule(static)
    for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
    {
      const std::int32_t* p = &cells[4 * cell];
      limits.Cells[cell] &=
        static_cast<std::uint8_t>(!(outside[p[0]] & outside[p[1]] & outside[p[2]] & outside[p[3]]));
    }
  }
  return limits;
}

} // namespace tetralux
