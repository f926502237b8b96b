// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceTracer.h"

#include "IsosurfacePictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

RayScene MakeScene(int surfaces = 3)
{
  RayScene scene = MakeIsosurfaceScene("random", { { "cells", 8 } }, surfaces);
  scene.Grid = MakeOuterGrid(scene.Mesh, false, 37, 29);
  return scene;
}

/// Scalars in few steps on the points of a box, so that surfaces of a value of theirs go through
/// vertices, edges and whole faces, and cells are flat.
RayScene MakeStepScene(int steps, bool jittered)
{
  RayScene scene = MakeScene();
  scene.Mesh = MakeBox(9, 8, 7, { 0, 0, 0 }, { 1, 1, 1 }, jittered ? 0.15 : 0, 4);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  for (double& scalar : scene.Scalars)
  {
    scalar = std::round(scalar * steps);
  }
  scene.Isosurfaces.clear();
  for (int k = 1; k < steps; ++k)
  {
    const float hue = static_cast<float>(k) / static_cast<float>(steps);
    scene.Isosurfaces.push_back({ static_cast<double>(k), { hue, 1 - hue, 0.5f }, 0.4f });
  }
  return scene;
}

TEST(IsosurfaceValues, ManyAtOnce)
{
  RayScene scene = MakeScene(200);
  for (Isosurface& surface : scene.Isosurfaces)
  {
    surface.Opacity = 0.02f;
  }
  scene.Shaded = true;
  scene.SmoothShading = true;
  scene.Lights = MakeIsosurfaceLights(scene.Mesh);
  EXPECT_GT(ExpectOracle(scene, TracePicture(scene)).Hits, 50000);
}

TEST(IsosurfaceValues, OutsideOfTheRange)
{
  RayScene scene = MakeScene();
  const auto [least, largest] = std::minmax_element(scene.Scalars.begin(), scene.Scalars.end());
  scene.Isosurfaces.clear();
  // Nothing is below the least scalar.
  for (const double value : { *least, *least - 1, std::nextafter(*largest, Infinity), 1e300 })
  {
    scene.Isosurfaces.push_back({ value, { 1, 1, 1 }, 1 });
  }
  const TracedPicture picture = TracePicture(scene);
  EXPECT_EQ(picture.Statistics.Hits, 0);
  for (std::size_t p = 0; p < picture.Depths.size(); ++p)
  {
    EXPECT_EQ(picture.Depths[p], -1);
    EXPECT_EQ(picture.Colors[4 * p], 0);
    EXPECT_EQ(picture.Colors[4 * p + 3], 0);
  }
}

TEST(IsosurfaceValues, NoValues)
{
  RayScene scene = MakeScene();
  scene.Isosurfaces.clear();
  EXPECT_EQ(TracePicture(scene).Statistics.Hits, 0);
}

TEST(IsosurfaceValues, OfScalars)
{
  for (const int steps : { 2, 4, 9 })
  {
    for (const bool jittered : { false, true })
    {
      const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(steps) + " steps");
      const RayScene scene = MakeStepScene(steps, jittered);
      EXPECT_GT(ExpectOracle(scene, TracePicture(scene)).Hits, 300);
    }
  }
}

TEST(IsosurfaceValues, SurfacesInFaces)
{
  // Scalars -1, 0 and 1 of layers of points: the surface of 0 is a plane of faces, above the cells
  // whose lower points are below it; what is all 0 has none.
  RayScene scene = MakeScene();
  scene.Mesh = MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    const double z = scene.Mesh.Points[3 * p + 2];
    scene.Scalars.resize(scene.Mesh.GetNumberOfPoints());
    scene.Scalars[p] = z < 0.4 ? -1 : z < 0.8 ? 0 : 1;
  }
  scene.Isosurfaces = { { 0, { 1, 0.5f, 0.25f }, 0.5f } };
  // Rays along z, through vertices, edges and faces among them, whose depths are heights below 2.
  scene.Grid = MakeParallelGrid({ 0.5, 0.5, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.5, 16, 16);
  for (int shift = 0; shift < 2; ++shift)
  {
    const TracedPicture picture = TracePicture(scene);
    EXPECT_EQ(picture.Statistics.Hits, 256);
    for (std::size_t p = 0; p < picture.Depths.size(); ++p)
    {
      EXPECT_EQ(picture.Depths[p], 1.5f);
      EXPECT_EQ(picture.Colors[4 * p + 3], 0.5f);
    }
    // From between faces to vertices; the outer ones are at the left and lower side, which count.
    scene.Grid.Origin[0] -= 1. / 32;
    scene.Grid.Origin[1] -= 1. / 32;
  }
}

TEST(IsosurfaceValues, RaysThroughVerticesAndEdges)
{
  // Each ray goes through vertices, or along edges or faces, of a box whose planes of points are at
  // multiples of 1/8; the surface is a plane or a slope.
  for (const std::array<double, 3>& slope :
    { std::array<double, 3>{ 0, 0, 1 }, { 0.25, 0.125, 1 }, { 0.3, 0.7, 0.4 } })
  {
    for (const double value : { 0.5, 0.40625, 0.7 })
    {
      for (const bool parallel : { false, true })
      {
        RayScene scene = MakeScene();
        scene.Mesh = MakeBox(8, 8, 8, { 0, 0, 0 }, { 1, 1, 1 });
        scene.Scalars.clear();
        for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
        {
          const double* x = &scene.Mesh.Points[3 * p];
          scene.Scalars.push_back(slope[0] * x[0] + slope[1] * x[1] + slope[2] * x[2]);
        }
        scene.Isosurfaces = { { value, { 1, 1, 1 }, 0.5f } };
        RayGrid& grid = scene.Grid;
        grid = RayGrid();
        grid.Width = grid.Height = 49;
        const double center[3] = { 0.5, 0.5, 2 };
        std::copy_n(center, 3, grid.Origin);
        if (parallel)
        {
          grid.Origin[0] = grid.Origin[1] = 1. / 8;
          grid.OriginStepX[0] = grid.OriginStepY[1] = 1. / 64;
        }
        else
        {
          // At z = 1/2 as of the parallel picture, and to points of the planes before and behind.
          grid.Direction[0] = grid.Direction[1] = -3. / 8 / 1.5;
          grid.DirectionStepX[0] = grid.DirectionStepY[1] = 1. / 64 / 1.5;
        }
        const TracedPicture picture = TracePicture(scene);
        double worst = 0;
        for (int p = 0; p < 49 * 49; ++p)
        {
          double origin[3], direction[3];
          for (int a = 0; a < 3; ++a)
          {
            origin[a] =
              grid.Origin[a] + p % 49 * grid.OriginStepX[a] + p / 49 * grid.OriginStepY[a];
            direction[a] =
              grid.Direction[a] + p % 49 * grid.DirectionStepX[a] + p / 49 * grid.DirectionStepY[a];
          }
          const double length = std::hypot(direction[0], direction[1], direction[2]);
          double start = 0;
          double along = 0;
          for (int a = 0; a < 3; ++a)
          {
            start += slope[a] * origin[a];
            along += slope[a] * direction[a] / length;
          }
          const double depth = (value - start) / along;
          const double z = origin[2] + depth * direction[2] / length;
          if (z > 0.05 && z < 0.95)
          {
            worst = std::max(worst, std::abs(picture.Depths[p] - depth));
            EXPECT_EQ(picture.Colors[4 * p + 3], 0.5f);
          }
        }
        EXPECT_LT(worst, 1e-6);
      }
    }
  }
}

TEST(IsosurfaceValues, ScalarsThatAreNotFinite)
{
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    RayScene scene = MakeScene();
    std::mt19937 generator(3);
    for (double& scalar : scene.Scalars)
    {
      scalar = generator() % 20 == 0 ? bad : scalar;
    }
    for (const Isopolygons polygons : { Isopolygons::Precomputed, Isopolygons::OnTheFly })
    {
      IsosurfaceOptions options;
      options.Polygons = polygons;
      EXPECT_GT(ExpectOracle(scene, TracePicture(scene, options)).Hits, 100);
    }
    std::fill(scene.Scalars.begin(), scene.Scalars.end(), bad);
    EXPECT_EQ(TracePicture(scene).Statistics.Hits, 0);
  }
}

TEST(IsosurfaceValues, TinyAndHugeScalars)
{
  RayScene scene = MakeScene();
  scene.Shaded = true;
  scene.Lights = MakeIsosurfaceLights(scene.Mesh);
  for (const bool smooth : { false, true })
  {
    scene.SmoothShading = smooth;
    const TracedPicture expected = TracePicture(scene);
    // Powers of two change no digit: 1e-30, 1e30, 1e-300 and 1e307.
    for (const int power : { -100, 100, -997, 1020 })
    {
      RayScene scaled = scene;
      for (double& scalar : scaled.Scalars)
      {
        scalar = std::ldexp(scalar, power);
      }
      for (Isosurface& surface : scaled.Isosurfaces)
      {
        surface.Value = std::ldexp(surface.Value, power);
      }
      EXPECT_TRUE(IsSame(TracePicture(scaled), expected)) << power;
    }
  }
}

TEST(IsosurfaceValues, TinyAndHugeMeshes)
{
  RayScene scene = MakeScene();
  scene.Shaded = true;
  scene.Lights = { MakeIsosurfaceLights(scene.Mesh)[0] };
  for (const bool parallel : { false, true })
  {
    scene.Grid = MakeOuterGrid(scene.Mesh, parallel, 37, 29);
    const TracedPicture expected = TracePicture(scene);
    for (const int power : { -100, 100 })
    {
      RayScene scaled = scene;
      const double factor = std::ldexp(1., power);
      for (double& x : scaled.Mesh.Points)
      {
        x *= factor;
      }
      for (auto* vector :
        { &scaled.Grid.Origin, &scaled.Grid.OriginStepX, &scaled.Grid.OriginStepY })
      {
        for (double& x : *vector)
        {
          x *= factor;
        }
      }
      TracedPicture picture = TracePicture(scaled);
      for (float& depth : picture.Depths)
      {
        depth = depth == -1 ? -1 : std::ldexp(depth, -power);
      }
      EXPECT_TRUE(IsSame(picture, expected)) << power;
    }
  }
}

TEST(IsosurfaceValues, EmptyMesh)
{
  RayScene scene = MakeScene();
  scene.Mesh = {};
  scene.Scalars.clear();
  for (const Isopolygons polygons : { Isopolygons::Precomputed, Isopolygons::OnTheFly })
  {
    for (const bool shaded : { false, true })
    {
      scene.Shaded = shaded;
      IsosurfaceOptions options;
      options.Polygons = polygons;
      options.Shadows = shaded;
      const TracedPicture picture = TracePicture(scene, options);
      EXPECT_EQ(picture.Statistics.Hits, 0);
      EXPECT_EQ(
        std::count(picture.Depths.begin(), picture.Depths.end(), -1.f), scene.Grid.Width * 29);
    }
  }
}

TEST(IsosurfaceValues, TransparentSurfaces)
{
  RayScene scene = MakeScene();
  RayScene without = scene;
  scene.Isosurfaces[1].Opacity = 0;
  without.Isosurfaces.erase(without.Isosurfaces.begin() + 1);
  const TracedPicture expected = TracePicture(without);
  const TracedPicture picture = TracePicture(scene);
  EXPECT_TRUE(IsSame(picture, expected));
  ExpectOracle(scene, picture);
}

TEST(IsosurfaceValues, ColorsAreNotClampedWithoutLight)
{
  RayScene scene = MakeScene(1);
  scene.Isosurfaces[0].Opacity = 1;
  scene.Isosurfaces[0].Color[0] = 3;
  scene.Isosurfaces[0].Color[1] = -2;
  ExpectOracle(scene, TracePicture(scene));
}

TEST(IsosurfaceValues, LargerErrorsEndRaysEarlier)
{
  RayScene scene = MakeScene(40);
  const TracedPicture exact = TracePicture(scene);
  IsosurfaceOptions options;
  std::int64_t hits = exact.Statistics.Hits;
  for (const double error : { 1e-3, 1e-2, 1e-1 })
  {
    options.MaximumError = error;
    const TracedPicture picture = TracePicture(scene, options);
    EXPECT_LT(picture.Statistics.Hits, hits);
    hits = picture.Statistics.Hits;
    for (std::size_t i = 0; i < picture.Colors.size(); ++i)
    {
      EXPECT_NEAR(picture.Colors[i], exact.Colors[i], error);
    }
    EXPECT_EQ(picture.Depths, exact.Depths);
  }
}

} // namespace
} // namespace tetralux
