// SPDX-License-Identifier: BSD-3-Clause
#include "GpuIntegral/RayGridUniforms.h"

#include "View/MeshToWorld.h"
#include "View/RayAcross.h"

#include "vtkShaderProgram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Add(const Vector& a, double t, const Vector& b)
{
  return { a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2] };
}

/// A vector for each pixel: in the middle of the picture, and the changes for a pixel to the right
/// and up.
struct PixelVectors
{
  Vector Middle, X, Y;

  PixelVectors(const double (&first)[3], const double (&stepX)[3], const double (&stepY)[3],
    const double (&middle)[2], double scale)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->X[a] = scale * stepX[a];
      this->Y[a] = scale * stepY[a];
      this->Middle[a] = scale * first[a] + middle[0] * this->X[a] + middle[1] * this->Y[a];
    }
  }

  void Store(float (&out)[3][3]) const
  {
    for (int a = 0; a < 3; ++a)
    {
      out[0][a] = static_cast<float>(this->Middle[a]);
      out[1][a] = static_cast<float>(this->X[a]);
      out[2][a] = static_cast<float>(this->Y[a]);
    }
  }
};

/// Squares of directions, in radii of the mesh for a unit, from which single precision can divide.
constexpr double SmallestSquare = 1e-30;
constexpr double LargestSquare = 1e30;

} // namespace

double GetRayLengthUnit(const RayGrid& grid, double radius)
{
  return std::exp2(std::ilogb(radius * MeasureMeshToWorld(grid.MeshFromWorld).Largest));
}

RayGridUniforms::RayGridUniforms(
  const RayGrid& grid, const RayLimits& limits, const double center[3], double radius)
{
  const double unit = GetRayLengthUnit(grid, radius);
  this->LengthUnit = static_cast<float>(unit);
  const double middle[2] = { 0.5 * (grid.Width - 1), 0.5 * (grid.Height - 1) };
  this->Middle[0] = static_cast<float>(0.5 * grid.Width);
  this->Middle[1] = static_cast<float>(0.5 * grid.Height);

  double length = 0;
  for (int a = 0; a < 3; ++a)
  {
    length = std::hypot(length,
      grid.Direction[a] + middle[0] * grid.DirectionStepX[a] + middle[1] * grid.DirectionStepY[a]);
  }
  // World directions are of length 1 in the middle.
  PixelVectors world(grid.Direction, grid.DirectionStepX, grid.DirectionStepY, middle, 1 / length);
  PixelVectors worldPoint(grid.Origin, grid.OriginStepX, grid.OriginStepY, middle, 1);
  PixelVectors direction = world;
  PixelVectors point = worldPoint;
  const auto transform = [&](Vector& v, bool isPoint)
  {
    const Vector x = v;
    for (int a = 0; a < 3; ++a)
    {
      const double* row = grid.MeshFromWorld[a];
      const double offset = isPoint ? row[3] - center[a] : 0;
      v[a] = (row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + offset) / radius;
    }
  };
  for (Vector* v : { &direction.Middle, &direction.X, &direction.Y })
  {
    transform(*v, false);
    *v = { unit * (*v)[0], unit * (*v)[1], unit * (*v)[2] };
  }
  transform(point.Middle, true);
  transform(point.X, false);
  transform(point.Y, false);

  const RayAxes axes = FindRayAxes(grid);
  this->Parallel = axes.Common;
  for (int a = 0; a < 3; ++a)
  {
    this->Axes[0][a] = static_cast<float>(axes.First[a]);
    this->Axes[1][a] = static_cast<float>(axes.Second[a]);
  }
  const double time =
    -Dot(point.Middle, direction.Middle) / Dot(direction.Middle, direction.Middle);
  this->Time = static_cast<float>(time);
  point.Middle = Add(point.Middle, time, direction.Middle);
  point.X = Add(point.X, time, direction.X);
  point.Y = Add(point.Y, time, direction.Y);
  worldPoint.Middle = Add(worldPoint.Middle, unit * time, world.Middle);
  worldPoint.X = Add(worldPoint.X, unit * time, world.X);
  worldPoint.Y = Add(worldPoint.Y, unit * time, world.Y);
  point.Store(this->Points);
  direction.Store(this->Directions);
  world.Store(this->WorldDirections);

  for (const auto& plane : limits.Planes)
  {
    // A plane may be given by numbers of any size.
    const double scale = 1 / std::hypot(plane[0], plane[1], plane[2]);
    const Vector normal = { scale * plane[0], scale * plane[1], scale * plane[2] };
    const auto add = [](std::vector<float>& out, double a, double b, double c)
    {
      out.push_back(static_cast<float>(a));
      out.push_back(static_cast<float>(b));
      out.push_back(static_cast<float>(c));
    };
    add(this->PlaneHeights, (Dot(normal, worldPoint.Middle) + scale * plane[3]) / unit,
      Dot(normal, worldPoint.X) / unit, Dot(normal, worldPoint.Y) / unit);
    add(this->PlaneSlopes, Dot(normal, world.Middle), Dot(normal, world.X), Dot(normal, world.Y));
  }
  this->CheckRange();
}

void RayGridUniforms::CheckRange() const
{
  const auto areFinite = [](const float(&vectors)[3][3])
  {
    return std::all_of(
      &vectors[0][0], &vectors[0][0] + 9, [](float x) { return std::isfinite(x); });
  };
  double squared = 0;
  for (const float x : this->Directions[0])
  {
    squared += static_cast<double>(x) * x;
  }
  if (!areFinite(this->Points) || !areFinite(this->Directions) ||
    !areFinite(this->WorldDirections) || !std::isfinite(this->Time) ||
    !(SmallestSquare <= squared && squared <= LargestSquare))
  {
    throw std::invalid_argument(
      "the rays of the picture are beyond the single precision of a graphics card: the camera is "
      "too far from the mesh, or a scale of the volume is too different from the others");
  }
}

std::string RayGridUniforms::GetDefines() const
{
  return "#define NUMBER_OF_PLANES " + std::to_string(this->PlaneHeights.size() / 3) + "\n";
}

void RayGridUniforms::Set(vtkShaderProgram* program) const
{
  program->SetUniform2f("rayMiddle", this->Middle);
  program->SetUniform3fv("rayPoints", 3, this->Points);
  program->SetUniform3fv("rayDirections", 3, this->Directions);
  program->SetUniform3fv("rayWorldDirections", 3, this->WorldDirections);
  program->SetUniform3fv("rayAxes", 2, this->Axes);
  program->SetUniformf("rayTime", this->Time);
  program->SetUniformf("rayLengthUnit", this->LengthUnit);
  const int planes = static_cast<int>(this->PlaneHeights.size() / 3);
  if (planes > 0)
  {
    program->SetUniform3fv("planeHeights", planes, this->PlaneHeights.data());
    program->SetUniform3fv("planeSlopes", planes, this->PlaneSlopes.data());
  }
}

} // namespace tetralux
