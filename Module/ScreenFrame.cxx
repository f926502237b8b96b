// SPDX-License-Identifier: BSD-3-Clause
#include "ScreenFrame.h"

#include <algorithm>
#include <cmath>
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

} // namespace tetralux
