// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/PixelProjection.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// How much farther from the eye's plane than a radius the centre has to be.
constexpr double RadiusReserve = 1.01;

} // namespace

PixelProjection::PixelProjection(const RayGrid& grid, const double center[3], double radius)
{
  const bool perspective =
    std::any_of(grid.DirectionStepX, grid.DirectionStepX + 3, [](double x) { return x != 0; }) ||
    std::any_of(grid.DirectionStepY, grid.DirectionStepY + 3, [](double x) { return x != 0; });
  const double* stepX = perspective ? grid.DirectionStepX : grid.OriginStepX;
  const double* stepY = perspective ? grid.DirectionStepY : grid.OriginStepY;
  // A point less the origin is i stepX + j stepY + direction, times any number in a perspective, or
  // with any multiple of the direction in a parallel projection.
  double columns[3][3];
  // Directions of any length: only their ratios matter.
  const double size = std::hypot(grid.Direction[0], grid.Direction[1], grid.Direction[2]);
  const double ofStep = perspective ? size : radius;
  double origin[3];
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const auto turn = [row](const double* v, double unit)
    { return (row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) / unit; };
    columns[a][0] = turn(stepX, ofStep);
    columns[a][1] = turn(stepY, ofStep);
    columns[a][2] = turn(grid.Direction, size);
    origin[a] = turn(grid.Origin, radius) + (row[3] - center[a]) / radius;
  }
  double inverse[3][3];
  vtkMath::Invert3x3(columns, inverse);
  for (int row = 0; row < 3; ++row)
  {
    std::copy_n(inverse[row], 3, this->Rows[row]);
    this->Rows[row][3] = -vtkMath::Dot(inverse[row], origin);
  }
  if (!perspective)
  {
    std::fill_n(this->Rows[2], 3, 0.);
    this->Rows[2][3] = 1;
  }
  for (int row = 0; row < 2; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      this->Rows[row][column] += 0.5 * this->Rows[2][column];
    }
  }
  bool finite = true;
  for (const auto& row : this->Rows)
  {
    finite = finite && std::all_of(row, row + 4, [](double x) { return std::isfinite(x); });
  }
  this->Regular =
    finite && RadiusReserve * vtkMath::Norm(this->Rows[2]) < std::abs(this->Rows[2][3]);
}

} // namespace tetralux
