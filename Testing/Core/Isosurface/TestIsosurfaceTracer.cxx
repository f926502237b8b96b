// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceTracer.h"
#include "Simd/InstructionSet.h"

#include "Generate/GeneratedMeshes.h"
#include "IsosurfacePictures.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

using Parameters = std::map<std::string, double>;

/// Small ones of all generated meshes.
const std::map<std::string, Parameters>& GetMeshes()
{
  static const std::map<std::string, Parameters> meshes = {
    { "ring", { { "around", 60 }, { "across", 6 } } },
    { "ball", { { "cells", 14 } } },
    { "swinging-ball", { { "cells", 14 }, { "time", 0.3 } } },
    { "cylinder-with-hole", { { "across", 4 }, { "around", 24 }, { "along", 8 } } },
    { "boundary-layer", { { "ratio", 1e6 }, { "cells", 8 }, { "layers", 30 } } },
    { "gear", { { "teeth", 8 }, { "across", 3 }, { "along", 3 } } },
    { "helical-gear", { { "teeth", 8 }, { "across", 3 }, { "along", 8 } } },
    { "heat-sink", { { "fins", 3 }, { "cells", 2 }, { "length", 4 } } },
    { "schoenhardt", { { "cells", 4 } } },
    { "cubes", { { "count", 2 }, { "cells", 5 } } },
    { "cavity", { { "cells", 10 } } },
    { "shared-edge", { { "cells", 7 } } },
    { "checkerboard", { { "blocks", 3 }, { "cells", 3 } } },
    { "cycle", { { "cells", 2 } } },
    { "random", { { "cells", 10 } } },
  };
  return meshes;
}

constexpr int Width = 29; // no multiple of the edge of a packet
constexpr int Height = 21;

RayScene MakeScene(const std::string& mesh)
{
  return MakeIsosurfaceScene(mesh, GetMeshes().at(mesh));
}

enum Camera
{
  Perspective,
  Parallel,
  Inside,
  ParallelFromInside, ///< half of the depths are negative
  NumberOfCameras
};

RayGrid MakeGrid(const TetrahedralMesh& mesh, int camera)
{
  RayGrid grid = camera == Inside ? MakeInnerGrid(mesh, Width, Height)
                                  : MakeOuterGrid(mesh, camera != Perspective, Width, Height);
  if (camera == ParallelFromInside)
  {
    const MeshBox box(mesh);
    double depth = 0;
    for (int a = 0; a < 3; ++a)
    {
      depth += (box.Middle[a] - grid.Origin[a]) * grid.Direction[a];
    }
    for (int a = 0; a < 3; ++a)
    {
      grid.Origin[a] += depth * grid.Direction[a];
    }
  }
  return grid;
}

TEST(IsosurfaceTracer, TestsKnowAllGeneratedMeshes)
{
  for (const Generator& generator : GetGenerators())
  {
    EXPECT_EQ(GetMeshes().count(generator.Name), 1u) << generator.Name;
  }
}

TEST(IsosurfaceTracer, DrawsAllMeshes)
{
  for (const auto& [name, parameters] : GetMeshes())
  {
    RayScene scene = MakeScene(name);
    for (int camera = 0; camera < NumberOfCameras; ++camera)
    {
      const testing::ScopedTrace trace(
        __FILE__, __LINE__, name + ", camera " + std::to_string(camera));
      scene.Grid = MakeGrid(scene.Mesh, camera);
      const PictureDifference difference = ExpectOracle(scene, TracePicture(scene));
      EXPECT_GT(difference.Hits, 20);
    }
  }
}

TEST(IsosurfaceTracer, LightsAllMeshes)
{
  for (const auto& [name, parameters] : GetMeshes())
  {
    RayScene scene = MakeScene(name);
    scene.Shaded = true;
    scene.Lights = MakeIsosurfaceLights(scene.Mesh);
    for (int camera = 0; camera < NumberOfCameras; ++camera)
    {
      for (const bool smooth : { false, true })
      {
        const testing::ScopedTrace trace(__FILE__, __LINE__,
          name + ", camera " + std::to_string(camera) + (smooth ? ", smooth" : ", flat"));
        scene.SmoothShading = smooth;
        scene.Grid = MakeGrid(scene.Mesh, camera);
        ExpectOracle(scene, TracePicture(scene));
      }
    }
  }
}

/// A tetrahedron whose first corner alone is at least 0; it is at the origin, and the picture looks
/// at it along z, with the corner at a pixel.
RayScene MakeCornerScene(double scalar)
{
  RayScene scene;
  scene.Mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  scene.Mesh.Cells = { 0, 1, 2, 3 };
  scene.Scalars = { scalar, -1, -1, -1 };
  scene.Model = OpticalModel::Isosurfaces;
  scene.Function = MakeConstantFunction(0, { 0, 0, 0 });
  scene.Isosurfaces = { { 0, { 1, 1, 1 }, 0.5f } };
  scene.Grid = MakePerspectiveGrid({ 0.2, 0.1, 4 }, { 0.2, 0.1, 0 }, { 0, 1, 0 }, 30, 33, 33);
  return scene;
}

TEST(IsosurfaceTracer, DrawsPolygonsSmallerThanTheRounding)
{
  for (const double scalar : { 1e-18, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8 })
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(std::log10(scalar)));
    const RayScene scene = MakeCornerScene(scalar);
    // The ray of a pixel may pass it, as exactly as it is rounded.
    EXPECT_LE(TracePicture(scene).Statistics.Hits, 1);
  }
  EXPECT_GT(TracePicture(MakeCornerScene(1)).Statistics.Hits, 10);
}

TEST(IsosurfaceTracer, GivesTheSameBitsForAnyThreads)
{
  RayScene scene = MakeScene("random");
  scene.Shaded = true;
  scene.Lights = MakeIsosurfaceLights(scene.Mesh);
  scene.Grid = MakeGrid(scene.Mesh, 0);
  IsosurfaceOptions options;
  options.Shadows = true;
  options.NumberOfThreads = 1;
  const TracedPicture expected = TracePicture(scene, options);
  EXPECT_GT(expected.Statistics.Hits, 300);
  for (const int threads : { 2, 3, 7 })
  {
    options.NumberOfThreads = threads;
    const TracedPicture picture = TracePicture(scene, options);
    EXPECT_EQ(picture.Statistics.NumberOfThreads, threads);
    EXPECT_TRUE(IsSame(picture, expected)) << threads << " threads";
  }
}

/// Scenes in which options that may not change a picture are tried.
std::vector<RayScene> MakeSceneOptions()
{
  std::vector<RayScene> scenes;
  for (const char* mesh : { "random", "ring", "boundary-layer" })
  {
    for (int camera = 0; camera < NumberOfCameras; ++camera)
    {
      for (const bool smooth : { false, true })
      {
        scenes.push_back(MakeScene(mesh));
        RayScene& scene = scenes.back();
        scene.Grid = MakeGrid(scene.Mesh, camera);
        scene.Shaded = true;
        scene.SmoothShading = smooth;
        scene.Lights = MakeIsosurfaceLights(scene.Mesh);
      }
    }
  }
  return scenes;
}

TEST(IsosurfaceTracer, GivesTheSameBitsForPolygonsOnTheFly)
{
  for (const RayScene& scene : MakeSceneOptions())
  {
    IsosurfaceOptions options;
    options.Shadows = true;
    const TracedPicture precomputed = TracePicture(scene, options);
    options.Polygons = Isopolygons::OnTheFly;
    const TracedPicture made = TracePicture(scene, options);
    EXPECT_TRUE(IsSame(made, precomputed));
    EXPECT_GT(precomputed.Statistics.Polygons, 0);
    EXPECT_EQ(precomputed.Statistics.Primary.Extractions, 0);
    EXPECT_GT(made.Statistics.Primary.Extractions, 0);
    EXPECT_EQ(made.Statistics.Hits, precomputed.Statistics.Hits);
  }
}

TEST(IsosurfaceTracer, GivesTheSameBitsForPolygonsPlacedOnce)
{
  int otherNodes = 0; // scenes
  for (const RayScene& scene : MakeSceneOptions())
  {
    IsosurfaceOptions options;
    options.Shadows = true;
    options.PlaceOnce = false;
    const TracedPicture expected = TracePicture(scene, options);
    options.PlaceOnce = true;
    const TracedPicture placed = TracePicture(scene, options);
    EXPECT_TRUE(IsSame(placed, expected));
    // Packets go through nodes by other boxes.
    otherNodes += placed.Statistics.Shadow.NodeTests != expected.Statistics.Shadow.NodeTests;
  }
  EXPECT_GT(otherNodes, 0);
}

TEST(IsosurfaceTracer, GivesTheSameBitsForBothTrees)
{
  // No ray of these scenes goes exactly through an edge, where the first of equal hits counts.
  for (const RayScene& scene : MakeSceneOptions())
  {
    IsosurfaceOptions options;
    const TracedPicture median = TracePicture(scene, options);
    options.Build = TreeBuild::SurfaceArea;
    EXPECT_TRUE(IsSame(TracePicture(scene, options), median));
  }
}

TEST(IsosurfaceTracer, GivesTheSameBitsForRaysThroughEdges)
{
  // Pixels are in planes of the lattice. Which of the cells there is lit depends on the order in
  // which polygons are met; what is hit, and where, does not.
  RayScene scene = MakeCornerScene(1);
  scene.Mesh = MakeBox(8, 8, 8, { 0, 0, 0 }, { 1, 1, 1 });
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Isosurfaces = MakeSurfaces(scene.Scalars, 3, 0.5f);
  for (const double steps : { 0., 6. })
  {
    for (double& scalar : scene.Scalars)
    {
      scalar = steps > 0 ? std::round(steps * scalar) / steps : scalar;
    }
    for (const bool parallel : { false, true })
    {
      scene.Grid = RayGrid();
      scene.Grid.Width = scene.Grid.Height = 65;
      const double origin[3] = { parallel ? 0 : 0.5, parallel ? 0 : 0.5, 2 };
      std::copy_n(origin, 3, scene.Grid.Origin);
      scene.Grid.Direction[0] = scene.Grid.Direction[1] = parallel ? 0 : -0.5;
      double* steps0 = parallel ? scene.Grid.OriginStepX : scene.Grid.DirectionStepX;
      double* steps1 = parallel ? scene.Grid.OriginStepY : scene.Grid.DirectionStepY;
      steps0[0] = steps1[1] = 1. / 64;
      IsosurfaceOptions options;
      const TracedPicture expected = TracePicture(scene, options);
      EXPECT_GT(expected.Statistics.Hits, 1000);
      for (const bool once : { false, true })
      {
        options.PlaceOnce = once;
        EXPECT_TRUE(IsSame(TracePicture(scene, options), expected));
      }
      options.Polygons = Isopolygons::OnTheFly;
      EXPECT_TRUE(IsSame(TracePicture(scene, options), expected));
      options.Build = TreeBuild::SurfaceArea;
      EXPECT_TRUE(IsSame(TracePicture(scene, options), expected));
      options.Polygons = Isopolygons::Precomputed;
      EXPECT_TRUE(IsSame(TracePicture(scene, options), expected));
    }
  }
}

TEST(IsosurfaceTracer, GivesTheSameBitsForBothVectorKernels)
{
  if (GetWidestInstructionSet() != InstructionSet::Avx512)
  {
    GTEST_SKIP() << "this processor has no AVX-512";
  }
  for (const RayScene& scene : MakeSceneOptions())
  {
    IsosurfaceOptions options;
    options.Shadows = true;
    options.Kernels = InstructionSet::Avx2;
    const TracedPicture expected = TracePicture(scene, options);
    EXPECT_EQ(expected.Statistics.InstructionSet, "AVX2");
    options.Kernels = InstructionSet::Avx512;
    const TracedPicture picture = TracePicture(scene, options);
    EXPECT_EQ(picture.Statistics.InstructionSet, "AVX-512");
    EXPECT_TRUE(IsSame(picture, expected));
  }
}

TEST(IsosurfaceTracer, GenericKernelDiffersByRounding)
{
  // Of a channel: lights are found in single precision, some with fused operations. Of a depth:
  // its last digit.
  constexpr float ChannelRounding = 2e-6f;
  constexpr float DepthRounding = 1.f / (1 << 22);
  for (const RayScene& scene : MakeSceneOptions())
  {
    IsosurfaceOptions options;
    const TracedPicture expected = TracePicture(scene, options);
    options.Kernels = InstructionSet::Generic;
    const TracedPicture picture = TracePicture(scene, options);
    EXPECT_EQ(picture.Statistics.InstructionSet, GetName(InstructionSet::Generic));
    float channel = 0;
    float depth = 0;
    for (std::size_t i = 0; i < picture.Colors.size(); ++i)
    {
      channel = std::max(channel, std::abs(picture.Colors[i] - expected.Colors[i]));
    }
    for (std::size_t i = 0; i < picture.Depths.size(); ++i)
    {
      depth = std::max(
        depth, std::abs(picture.Depths[i] - expected.Depths[i]) / std::abs(expected.Depths[i]));
    }
    EXPECT_LE(channel, ChannelRounding);
    EXPECT_LE(depth, DepthRounding);
  }
}

} // namespace
} // namespace tetralux
