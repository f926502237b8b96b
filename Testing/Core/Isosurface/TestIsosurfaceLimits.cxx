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

constexpr float Infinity = std::numeric_limits<float>::infinity();

RayScene MakeScene(bool parallel)
{
  RayScene scene = MakeIsosurfaceScene("random", { { "cells", 8 } });
  scene.Grid = MakeOuterGrid(scene.Mesh, parallel, 37, 29);
  return scene;
}

TEST(IsosurfaceLimits, ClippingPlanes)
{
  const std::vector<std::array<double, 4>> planes = { { -1, 0.3, -0.5, 0.7 }, { 0.2, 1, 0.1, -0.3 },
    { 0, 0, 1, -0.15 }, { 1, 1, 1, 10 }, { 0.3, -1, 0, 0.6 } };
  for (const bool parallel : { false, true })
  {
    RayScene scene = MakeScene(parallel);
    const TracedPicture whole = TracePicture(scene);
    for (const std::array<double, 4>& plane : planes)
    {
      scene.Limits.Planes.push_back(plane);
      const testing::ScopedTrace trace(
        __FILE__, __LINE__, std::to_string(scene.Limits.Planes.size()) + " planes");
      const TracedPicture picture = TracePicture(scene);
      EXPECT_GT(ExpectOracle(scene, picture).Hits, 40);
      EXPECT_LT(picture.Statistics.Hits, whole.Statistics.Hits);
    }
  }
}

TEST(IsosurfaceLimits, PlanesThatCutNothingOrAll)
{
  RayScene scene = MakeScene(false);
  const TracedPicture whole = TracePicture(scene);
  scene.Limits.Planes = { { 0, 0, 1, 1e-3 }, { 1, 2, 3, 1e6 } };
  EXPECT_TRUE(IsSame(TracePicture(scene), whole));
  scene.Limits.Planes = { { 0, 0, 1, -2 } };
  EXPECT_EQ(TracePicture(scene).Statistics.Hits, 0);
}

TEST(IsosurfaceLimits, NearAndFarPlane)
{
  for (const bool parallel : { false, true })
  {
    RayScene scene = MakeScene(parallel);
    std::array<double, 3> position, middle = MeshBox(scene.Mesh).Middle;
    std::copy_n(scene.Grid.Origin, 3, position.data());
    const double distance =
      std::hypot(position[0] - middle[0], position[1] - middle[1], position[2] - middle[2]);
    AddClippingRange(scene.Limits, position, middle, 0.9 * distance, 1.1 * distance);
    EXPECT_GT(ExpectOracle(scene, TracePicture(scene)).Hits, 100);
  }
}

TEST(IsosurfaceLimits, EachCroppingRegion)
{
  RayScene scene = MakeScene(false);
  scene.Grid = MakeOuterGrid(scene.Mesh, false, 19, 17);
  scene.Limits.Cropping = true;
  const double planes[6] = { 0.2, 0.7, 0.3, 0.8, 0.1, 0.6 };
  std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
  int hits = 0;
  for (int region = 0; region < 27; ++region)
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, "region " + std::to_string(region));
    scene.Limits.CroppingFlags = 1u << region;
    hits += ExpectOracle(scene, TracePicture(scene)).Hits;
  }
  scene.Limits.Cropping = false;
  EXPECT_EQ(ExpectOracle(scene, TracePicture(scene)).Hits, hits);
}

TEST(IsosurfaceLimits, ManyCroppingRegions)
{
  std::mt19937 generator(5);
  for (const bool parallel : { false, true })
  {
    RayScene scene = MakeScene(parallel);
    scene.Limits.Cropping = true;
    const double planes[6] = { 0.3, 0.6, 0.25, 0.75, 0.4, 0.9 };
    std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
    for (int i = 0; i < 4; ++i)
    {
      scene.Limits.CroppingFlags = generator() & 0x7ffffff;
      ExpectOracle(scene, TracePicture(scene));
      scene.Limits.Planes = { { -1, 0.3, -0.5, 0.7 } };
    }
    scene.Limits.Planes.clear();
    scene.Limits.CroppingFlags = 0;
    EXPECT_EQ(TracePicture(scene).Statistics.Hits, 0);
  }
}

TEST(IsosurfaceLimits, OpaqueGeometry)
{
  std::mt19937_64 generator(7);
  for (const bool parallel : { false, true })
  {
    RayScene scene = MakeScene(parallel);
    const TracedPicture whole = TracePicture(scene);
    const float farthest = *std::max_element(whole.Depths.begin(), whole.Depths.end());
    const float diameter = static_cast<float>(2 * MeshBox(scene.Mesh).Radius);
    std::uniform_real_distribution<float> distances(farthest - diameter, farthest + 0.1f);
    for (std::size_t p = 0; p < whole.Depths.size(); ++p)
    {
      scene.MaximumDistances.push_back(distances(generator));
    }
    const PictureDifference difference = ExpectOracle(scene, TracePicture(scene));
    EXPECT_GT(difference.Hits, whole.Statistics.Hits / 10);
    EXPECT_LT(difference.Hits, whole.Statistics.Hits);

    std::fill(scene.MaximumDistances.begin(), scene.MaximumDistances.end(), Infinity);
    EXPECT_TRUE(IsSame(TracePicture(scene), whole));
    for (const float before : { 0.5f * (farthest - diameter), 0.f, -1e30f })
    {
      std::fill(scene.MaximumDistances.begin(), scene.MaximumDistances.end(), before);
      EXPECT_EQ(TracePicture(scene).Statistics.Hits, 0);
    }
  }
}

TEST(IsosurfaceLimits, Layers)
{
  RayScene scene = MakeScene(false);
  for (Isosurface& surface : scene.Isosurfaces)
  {
    surface.Opacity = 0.5f;
  }
  const TracedPicture whole = TracePicture(scene);
  EXPECT_EQ(whole.Statistics.LostRays, 0);
  for (const int layers : { 1, 2, 3 })
  {
    IsosurfaceOptions options;
    options.MaximumLayers = layers;
    const TracedPicture picture = TracePicture(scene, options);
    EXPECT_EQ(picture.Depths, whole.Depths);
    const float largest = 1 - std::ldexp(1.f, -layers);
    std::int64_t lost = 0;
    for (std::size_t p = 0; p < picture.Depths.size(); ++p)
    {
      EXPECT_EQ(picture.Colors[4 * p + 3], std::min(largest, whole.Colors[4 * p + 3]));
      lost += picture.Colors[4 * p + 3] == largest ? 1 : 0;
    }
    EXPECT_GT(lost, 0);
    EXPECT_EQ(picture.Statistics.LostRays, lost);
    EXPECT_EQ(picture.Statistics.TerminationError, 1 - largest);
  }
}

TEST(IsosurfaceLimits, PictureSizes)
{
  RayScene scene = MakeScene(false);
  for (const auto& [width, height] : std::initializer_list<std::pair<int, int>>{
         { 1, 1 }, { 1, 33 }, { 47, 1 }, { 16, 16 }, { 17, 15 }, { 5, 3 }, { 32, 48 } })
  {
    for (const bool parallel : { false, true })
    {
      const testing::ScopedTrace trace(
        __FILE__, __LINE__, std::to_string(width) + " x " + std::to_string(height));
      scene.Grid = MakeOuterGrid(scene.Mesh, parallel, width, height);
      EXPECT_GT(ExpectOracle(scene, TracePicture(scene)).Hits, 0);
    }
  }
}

TEST(IsosurfaceLimits, MeshesPlacedInTheWorld)
{
  const double places[2][3][4] = {
    { { 2, 0.5, 0, 3 }, { 0, 0.3, 0.1, -1 }, { 0.7, 0, -1.5, 2 } }, // sheared and mirrored
    { { 1e-3, 0, 0, 5 }, { 0, 1, 0, 0 }, { 0, 0, 20, 0 } },
  };
  for (const auto& place : places)
  {
    for (const bool parallel : { false, true })
    {
      RayScene scene = MakeScene(parallel);
      scene.Limits.Cropping = true;
      scene.Limits.CroppingFlags = 0x7ffdfff;
      const double planes[6] = { 0.2, 0.7, 0.3, 0.8, 0.1, 0.6 };
      std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
      scene.Limits.Planes = { { 0.3, -0.2, 1, 1.5 } };
      TetrahedralMesh world = scene.Mesh;
      for (std::size_t p = 0; p < world.GetNumberOfPoints(); ++p)
      {
        const double* x = &scene.Mesh.Points[3 * p];
        for (int a = 0; a < 3; ++a)
        {
          const double* row = place[a];
          world.Points[3 * p + a] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3];
        }
      }
      scene.Grid = MakeOuterGrid(world, parallel, 37, 29);
      PlaceMesh(scene.Grid, place);
      scene.Shaded = true;
      scene.Lights = MakeIsosurfaceLights(world);
      for (const bool smooth : { false, true })
      {
        scene.SmoothShading = smooth;
        PictureTolerance tolerance;
        // Of the mesh: depths are distances in the world.
        tolerance.Depth *= MeshBox(world).Radius / MeshBox(scene.Mesh).Radius;
        EXPECT_GT(ExpectOracle(scene, TracePicture(scene), false, tolerance).Hits, 40);
      }
    }
  }
}

TEST(IsosurfaceLimits, MeshesFarFromTheOrigin)
{
  // Coordinates are rounded to 1e-9 of a mesh whose offset is 1e7 diameters: the picture is that of
  // the mesh as it is rounded, but for rays that are rounded likewise.
  for (const double offset : { 1e4, 1e7 })
  {
    for (const bool parallel : { false, true })
    {
      for (const bool inWorld : { false, true })
      {
        const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(offset));
        RayScene scene = MakeScene(parallel);
        const double distance = offset * 2 * MeshBox(scene.Mesh).Radius;
        TetrahedralMesh world = scene.Mesh;
        for (std::size_t i = 0; i < world.Points.size(); ++i)
        {
          world.Points[i] += (i % 3 == 1 ? -0.7 : 0.5) * distance;
        }
        scene.Grid = MakeOuterGrid(world, parallel, 37, 29);
        if (inWorld)
        {
          const double place[3][4] = { { 1, 0, 0, 0.5 * distance }, { 0, 1, 0, -0.7 * distance },
            { 0, 0, 1, 0.5 * distance } };
          PlaceMesh(scene.Grid, place);
        }
        else
        {
          scene.Mesh = world;
        }
        scene.Shaded = true;
        scene.Lights = MakeIsosurfaceLights(world);
        PictureTolerance tolerance;
        tolerance.Displacement = 1e-15 * offset; // ten times the rounding of a coordinate
        tolerance.Displacement = std::max(tolerance.Displacement, 1e-9);
        EXPECT_GT(ExpectOracle(scene, TracePicture(scene), false, tolerance).Hits, 100);
      }
    }
  }
}

} // namespace
} // namespace tetralux
