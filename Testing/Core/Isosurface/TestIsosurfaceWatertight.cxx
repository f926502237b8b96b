// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceTracer.h"

#include "Generate/GeneratedMeshes.h"
#include "IsosurfacePictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

double GetLength(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// Surfaces of |x|^2, closed around the origin, in a ball of radius 1.
RayScene MakeSphere(double value, int cells)
{
  RayScene scene;
  scene.Mesh = GenerateMesh("ball", { { "cells", static_cast<double>(cells) } }).Mesh;
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &scene.Mesh.Points[3 * p];
    scene.Scalars.push_back(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  }
  scene.Model = OpticalModel::Isosurfaces;
  scene.Function = MakeConstantFunction(0, { 0, 0, 0 });
  scene.Isosurfaces = { { value, { 1, 1, 1 }, 0.5f } };
  return scene;
}

/// Between rays, in units of the mesh: below the rounding of coordinates, about it, and as in
/// pictures.
constexpr double Spreads[] = { 1e-17, 1e-15, 1e-13, 1e-10, 1e-3 };

/// Edge of the pictures below: one packet.
constexpr int Edge = 16;

/// Rays around the one from an origin to a target, which is that of pixel (8, 8). spread: between
/// neighbours at the target, in units of the mesh. Depths count from origin.
RayGrid MakeRaysAround(const Vector& origin, const Vector& target, double spread, bool parallel)
{
  RayGrid grid;
  grid.Width = grid.Height = Edge;
  const Vector to = { target[0] - origin[0], target[1] - origin[1], target[2] - origin[2] };
  const Vector right = Cross(to, { 0.3, 0.5, 0.8 });
  const Vector up = Cross(right, to);
  for (int a = 0; a < 3; ++a)
  {
    const double x = right[a] / GetLength(right) * spread;
    const double y = up[a] / GetLength(up) * spread;
    (parallel ? grid.OriginStepX : grid.DirectionStepX)[a] = x;
    (parallel ? grid.OriginStepY : grid.DirectionStepY)[a] = y;
    grid.Origin[a] = origin[a] - (parallel ? Edge / 2 * (x + y) : 0);
    grid.Direction[a] = to[a] - (parallel ? 0 : Edge / 2 * (x + y));
  }
  return grid;
}

/// Points where rays are hard: vertices, and points of edges and faces, of cells that the surface
/// crosses.
std::vector<Vector> FindHardPoints(const RayScene& scene, int stride)
{
  const double value = scene.Isosurfaces[0].Value;
  std::vector<Vector> points;
  int next = 0;
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* ids = &scene.Mesh.Cells[4 * cell];
    const auto above =
      std::count_if(ids, ids + 4, [&](std::int32_t id) { return scene.Scalars[id] >= value; });
    if (above == 0 || above == 4 || ++next % stride != 0)
    {
      continue;
    }
    const auto add = [&](std::initializer_list<int> corners)
    {
      Vector point = { 0, 0, 0 };
      for (const int corner : corners)
      {
        for (int a = 0; a < 3; ++a)
        {
          point[a] += scene.Mesh.Points[3 * static_cast<std::size_t>(ids[corner]) + a] /
            static_cast<double>(corners.size());
        }
      }
      points.push_back(point);
    };
    add({ next % 4 });
    add({ next % 4, (next + 1) % 4 });
    add({ next % 4, (next + 1) % 4, (next + 2) % 4 });
    // Where the surface cuts an edge: a corner of its polygons.
    for (int i = 1; i < 4; ++i)
    {
      const double s = scene.Scalars[ids[0]], t = scene.Scalars[ids[i]];
      if ((s < value) != (t < value))
      {
        Vector point;
        for (int a = 0; a < 3; ++a)
        {
          const double p = scene.Mesh.Points[3 * static_cast<std::size_t>(ids[0]) + a];
          const double q = scene.Mesh.Points[3 * static_cast<std::size_t>(ids[i]) + a];
          point[a] = p + (value - s) / (t - s) * (q - p);
        }
        points.push_back(point);
      }
    }
  }
  return points;
}

struct HoleCount
{
  std::int64_t Rays = 0;
  std::int64_t Holes = 0;   ///< rays that meet fewer surfaces than there are
  std::int64_t Doubles = 0; ///< rays that meet more
};

enum class RayStart
{
  Camera, ///< a perspective picture
  Plane,  ///< a parallel one, from the plane through the camera
  Target  ///< a parallel one, where depths are 0 at the target
};

/// Counts rays from cameras to points that do not meet as many surfaces as expected.
HoleCount CountHoles(const RayScene& scene, const std::vector<Vector>& points,
  const std::vector<Vector>& cameras, RayStart rayStart, int expected)
{
  VolumeScene volume = scene.MakeVolumeScene();
  IsosurfaceTracer tracer;
  HoleCount count;
  const double radius = std::sqrt(scene.Isosurfaces[0].Value);
  const float opacity = static_cast<float>(1 - std::pow(0.5, expected));
  RayScene rays = scene;
  for (const Vector& camera : cameras)
  {
    for (const Vector& point : points)
    {
      // Away from the silhouette: rays pass the middle within 0.7 radii of the surface.
      const Vector way = { point[0] - camera[0], point[1] - camera[1], point[2] - camera[2] };
      const double beside = GetLength(Cross(camera, way)) / GetLength(way);
      if (beside > 0.7 * radius)
      {
        continue;
      }
      for (const double spread : Spreads)
      {
        rays.Grid = MakeRaysAround(camera, point, spread, rayStart != RayStart::Camera);
        for (int a = 0; a < 3; ++a)
        {
          rays.Grid.Origin[a] += rayStart == RayStart::Target ? way[a] : 0;
        }
        IsosurfaceOptions options;
        options.NumberOfThreads = 1;
        const TracedPicture picture = TracePicture(tracer, volume, rays, options);
        for (int p = 0; p < Edge * Edge; ++p)
        {
          const float alpha = picture.Colors[4 * static_cast<std::size_t>(p) + 3];
          count.Holes += alpha < opacity ? 1 : 0;
          count.Doubles += alpha > opacity ? 1 : 0;
        }
        count.Rays += Edge * Edge;
      }
    }
  }
  return count;
}

Vector Scale(const Vector& v, double factor)
{
  return { v[0] * factor, v[1] * factor, v[2] * factor };
}

/// Values of surfaces: between scalars, that of a point of the mesh, and next to it, where polygons
/// are smaller than the rounding.
std::vector<double> GetValues(int cells)
{
  const RayScene scene = MakeSphere(0.4, cells);
  std::vector<double> sorted = scene.Scalars;
  std::sort(sorted.begin(), sorted.end());
  const double scalar = *std::lower_bound(sorted.begin(), sorted.end(), 0.45);
  return { 0.4, scalar, std::nextafter(scalar, 0), std::nextafter(scalar, 1) };
}

constexpr int Cells = 16;

void ExpectNoHole(const HoleCount& count, std::int64_t rays)
{
  EXPECT_GE(count.Rays, rays);
  EXPECT_EQ(count.Holes, 0);
  EXPECT_EQ(count.Doubles, 0);
}

TEST(IsosurfaceWatertight, SeenFromInside)
{
  for (const double value : GetValues(Cells))
  {
    const RayScene scene = MakeSphere(value, Cells);
    const std::vector<Vector> points = FindHardPoints(scene, 8);
    ExpectNoHole(
      CountHoles(scene, points, { { 0, 0, 0 }, { 0.013, -0.021, 0.017 } }, RayStart::Camera, 1),
      100000);
  }
}

TEST(IsosurfaceWatertight, SeenFromOutside)
{
  for (const double value : GetValues(Cells))
  {
    const RayScene scene = MakeSphere(value, Cells);
    const std::vector<Vector> points = FindHardPoints(scene, 8);
    for (const double distance : { 3., 100., 1e4 })
    {
      const testing::ScopedTrace trace(
        __FILE__, __LINE__, "from " + std::to_string(distance) + " radii");
      const std::vector<Vector> cameras = { Scale({ 0.6, 0.64, 0.48 }, distance),
        Scale({ 0, 0, 1 }, distance) };
      ExpectNoHole(CountHoles(scene, points, cameras, RayStart::Camera, 2), 100000);
    }
  }
}

TEST(IsosurfaceWatertight, SeenByParallelRays)
{
  for (const double value : GetValues(Cells))
  {
    const RayScene scene = MakeSphere(value, Cells);
    const std::vector<Vector> points = FindHardPoints(scene, 8);
    const std::vector<Vector> cameras = { { 0.9, 0.96, 0.72 }, { 0, 0, 2 } };
    ExpectNoHole(CountHoles(scene, points, cameras, RayStart::Plane, 2), 100000);
    ExpectNoHole(CountHoles(scene, points, cameras, RayStart::Target, 2), 100000);
  }
}

TEST(IsosurfaceWatertight, ThroughFlatCells)
{
  // Scalars in steps: cells of one scalar, and surfaces in faces. They separate the middle from
  // what is outside, and may be met three times.
  for (const double value : { 0.4, 0.45, std::nextafter(0.5, 0) })
  {
    RayScene scene = MakeSphere(value, Cells);
    for (double& scalar : scene.Scalars)
    {
      scalar = std::round(20 * scalar) / 20;
    }
    const std::vector<Vector> points = FindHardPoints(scene, 8);
    const std::vector<Vector> cameras = { { 0, 0, 0 }, { 0.013, -0.021, 0.017 } };
    const HoleCount count = CountHoles(scene, points, cameras, RayStart::Camera, 1);
    EXPECT_GE(count.Rays, 100000);
    EXPECT_EQ(count.Holes, 0);
  }
}

} // namespace
} // namespace tetralux
