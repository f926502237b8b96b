// SPDX-License-Identifier: BSD-3-Clause
#include "CellIntegral/CellIntegral.h"

#include "Integral/RayIntegral.h"
#include "Walk/MeshLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <omp.h>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// a + t b.
Vector GoAlong(const Vector& a, double t, const Vector& b)
{
  return { a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2] };
}

/// A ray in world coordinates, with a direction of length 1.
struct WorldRay
{
  Vector Origin, Direction;
};

WorldRay MakeRay(const RayGrid& grid, int i, int j)
{
  WorldRay ray;
  for (int c = 0; c < 3; ++c)
  {
    ray.Origin[c] = grid.Origin[c] + i * grid.OriginStepX[c] + j * grid.OriginStepY[c];
    ray.Direction[c] = grid.Direction[c] + i * grid.DirectionStepX[c] + j * grid.DirectionStepY[c];
  }
  const double length = std::hypot(ray.Direction[0], ray.Direction[1], ray.Direction[2]);
  for (double& x : ray.Direction)
  {
    x /= length;
  }
  return ray;
}

/// Distances along a ray that count.
struct Stretch
{
  double Begin = -std::numeric_limits<double>::infinity();
  double End = std::numeric_limits<double>::infinity();
};

/// What half-spaces keep of a ray.
Stretch Clip(const WorldRay& ray, const std::vector<std::array<double, 4>>& planes)
{
  Stretch kept;
  for (const std::array<double, 4>& plane : planes)
  {
    const Vector normal = { plane[0], plane[1], plane[2] };
    const double height = Dot(normal, ray.Origin) + plane[3];
    const double slope = Dot(normal, ray.Direction);
    if (slope > 0)
    {
      kept.Begin = std::max(kept.Begin, -height / slope);
    }
    else if (slope < 0)
    {
      kept.End = std::min(kept.End, -height / slope);
    }
    else if (height < 0)
    {
      kept.End = kept.Begin;
    }
  }
  return kept;
}

/// The scene as rays are integrated through it.
class CellRays
{
public:
  CellRays(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits)
    : Scene(scene)
    , Mesh(*scene.Mesh.GetMesh())
    , Function(scene.Optics.GetTransferFunction())
    , Grid(grid)
    , Planes(limits.Planes)
    , Negligible(0.1 * CellIntegralError / std::max(1., GetLargestColor(this->Function)))
  {
  }

  SegmentRadiance Integrate(int i, int j) const
  {
    const WorldRay ray = MakeRay(this->Grid, i, j);
    const Stretch kept = Clip(ray, this->Planes);

    // In coordinates of the mesh's tables, from the place that is nearest to its middle.
    Vector origin, direction;
    for (int row = 0; row < 3; ++row)
    {
      const double* m = this->Grid.MeshFromWorld[row];
      const Vector axes = { m[0], m[1], m[2] };
      origin[row] =
        (Dot(axes, ray.Origin) + m[3] - this->Mesh.GetCenter()[row]) / this->Mesh.GetRadius();
      direction[row] = Dot(axes, ray.Direction) / this->Mesh.GetRadius();
    }
    const double scale = std::sqrt(Dot(direction, direction)); // of a world unit
    direction = { direction[0] / scale, direction[1] / scale, direction[2] / scale };
    const double shift = -Dot(origin, direction);
    const MeshLine<double> line(this->Mesh, this->Scene.Mesh.GetScalars(),
      this->Scene.Mesh.HasCellScalars(), GoAlong(origin, shift, direction), direction);

    SegmentRadiance sum;
    for (const LinePassage& passage : line.Walk())
    {
      const bool backward = passage.End < passage.Begin;
      const double near = ((backward ? passage.End : passage.Begin) + shift) / scale;
      const double far = ((backward ? passage.Begin : passage.End) + shift) / scale;
      const double begin = std::max(near, kept.Begin);
      const double end = std::min(far, kept.End);
      if (begin < end)
      {
        const double front = backward ? passage.Back : passage.Front;
        const double change = (backward ? passage.Front : passage.Back) - front;
        const double atBegin = front + change * ((begin - near) / (far - near));
        const double atEnd =
          end < far ? front + change * ((end - near) / (far - near)) : front + change;
        sum.AddBehind(IntegrateEmissionAbsorption(this->Function, atBegin, atEnd, end - begin));
        if (sum.Transmittance < this->Negligible)
        {
          break;
        }
      }
    }
    return sum;
  }

private:
  const VolumeScene& Scene;
  const WalkMesh& Mesh;
  const TransferFunction& Function;
  const RayGrid& Grid;
  const std::vector<std::array<double, 4>>& Planes;
  double Negligible; ///< transmittance
};

} // namespace

std::vector<double> IntegrateCells(
  VolumeScene& scene, const RayGrid& grid, const RayLimits& limits, int threads)
{
  scene.CheckComplete();
  if (scene.Optics.GetModel() != OpticalModel::EmissionAbsorption || scene.HasComponents())
  {
    throw std::invalid_argument(
      "the integral is one of emission and absorption by a single component");
  }
  if (limits.Cropping || limits.MaximumDistances)
  {
    throw std::invalid_argument("the integral knows no limits but planes");
  }
  SceneNeeds needs;
  needs.DoublePoints = true;
  scene.Prepare(needs);
  const CellRays rays(scene, grid, limits);
  std::vector<double> pixels(4 * static_cast<std::size_t>(grid.Width) * grid.Height);
  const int used = threads > 0 ? threads : omp_get_max_threads();
#pragma omp parallel for num_threads(used) schedule(dynamic)
  for (int j = 0; j < grid.Height; ++j)
  {
    for (int i = 0; i < grid.Width; ++i)
    {
      const SegmentRadiance radiance = rays.Integrate(i, j);
      double* pixel = &pixels[4 * (static_cast<std::size_t>(j) * grid.Width + i)];
      std::copy_n(radiance.Color, 3, pixel);
      pixel[3] = radiance.Opacity;
    }
  }
  return pixels;
}

} // namespace tetralux
