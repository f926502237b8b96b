// SPDX-License-Identifier: BSD-3-Clause

// Rays that find the boundary by tiles of the picture see the same bits as rays that find it by the
// hierarchy over it.

#include "RayScene.h"

#include "Generate/GeneratedMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace
{

using namespace tetralux;

/// Not whole tiles, nor whole packets.
constexpr int Width = 149;
constexpr int Height = 83;

using Parameters = std::map<std::string, double>;

class BoundaryTilesOf : public ::testing::TestWithParam<std::pair<std::string, Parameters>>
{
protected:
  void SetUp() override
  {
    this->Scene.Mesh = GenerateMesh(GetParam().first, GetParam().second).Mesh;
    this->Scene.Scalars = MakeSmoothField(this->Scene.Mesh);
    const std::vector<double>& points = this->Scene.Mesh.Points;
    std::array<double, 3> lower{ points[0], points[1], points[2] };
    std::array<double, 3> upper = lower;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      lower[i % 3] = std::min(lower[i % 3], points[i]);
      upper[i % 3] = std::max(upper[i % 3], points[i]);
    }
    for (int a = 0; a < 3; ++a)
    {
      this->Middle[a] = 0.5 * (lower[a] + upper[a]);
      this->Size = std::max(this->Size, upper[a] - lower[a]);
    }
    this->Scene.Function = MakeColorfulFunction(5 / this->Size);
  }

  /// A point of the world, in sizes of the mesh from its middle.
  std::array<double, 3> FindPlace(double x, double y, double z) const
  {
    return { this->Middle[0] + x * this->Size, this->Middle[1] + y * this->Size,
      this->Middle[2] + z * this->Size };
  }

  /// By tiles, if those are possible.
  void ExpectTheSameBits(bool possible)
  {
    VolumeScene volume = this->Scene.MakeVolumeScene();
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      options.Boundary = BoundarySearch::Hierarchy;
      const RayPicture expected = Cast(volume, this->Scene, options);
      EXPECT_FALSE(expected.Statistics.BoundaryTiles);
      EXPECT_GT(expected.Statistics.Paths, 0);
      options.Boundary = BoundarySearch::Tiles;
      for (const int threads : { 1, 3 })
      {
        options.NumberOfThreads = threads;
        const RayPicture picture = Cast(volume, this->Scene, options);
        EXPECT_EQ(picture.Statistics.BoundaryTiles, possible);
        EXPECT_EQ(picture.Colors, expected.Colors);
        EXPECT_EQ(picture.Depths, expected.Depths);
        EXPECT_EQ(picture.Statistics.Segments, expected.Statistics.Segments);
        EXPECT_EQ(picture.Statistics.Paths, expected.Statistics.Paths);
      }
    }
  }

  RayScene Scene;
  std::array<double, 3> Middle{};
  double Size = 0;
};

} // namespace

TEST_P(BoundaryTilesOf, SeeTheSameInAPerspective)
{
  this->Scene.Grid = MakePerspectiveGrid(
    this->FindPlace(1.2, 0.9, 1.6), this->FindPlace(0, 0, 0), { 0, 0.1, 1 }, 40, Width, Height);
  this->ExpectTheSameBits(true);
}

/// Faces that are larger than tiles, and beyond the edges of the picture.
TEST_P(BoundaryTilesOf, SeeTheSameFromNearby)
{
  this->Scene.Grid = MakePerspectiveGrid(this->FindPlace(0.9, 0.2, 0.3),
    this->FindPlace(0.4, 0.1, 0.1), { 0, 0.1, 1 }, 8, Width, Height);
  this->ExpectTheSameBits(true);
}

/// Along an axis, where rays go through edges and are displaced.
TEST_P(BoundaryTilesOf, SeeTheSameInParallel)
{
  this->Scene.Grid = MakeParallelGrid(this->FindPlace(0, 0, 3), this->FindPlace(0, 0, 0),
    { 0, 1, 0 }, 0.6 * this->Size, Width, Height);
  this->ExpectTheSameBits(true);
}

/// The matrix of the volume turns, shears and mirrors it.
TEST_P(BoundaryTilesOf, SeeTheSameOfASkewedVolume)
{
  this->Scene.Grid = MakePerspectiveGrid(
    this->FindPlace(0.2, -0.3, 2.6), this->FindPlace(0, 0, 0), { 0, 1, 0 }, 40, Width, Height);
  const double rows[3][3] = { { 0.9, 0.4, 0 }, { -0.2, 0.8, 0.3 }, { 0, 0.1, -1.1 } };
  for (int a = 0; a < 3; ++a)
  {
    double* row = this->Scene.Grid.MeshFromWorld[a];
    row[3] = this->Middle[a];
    for (int b = 0; b < 3; ++b)
    {
      row[b] = rows[a][b];
      row[3] -= rows[a][b] * this->Middle[b];
    }
  }
  this->ExpectTheSameBits(true);
}

TEST_P(BoundaryTilesOf, AreNotMadeFromInside)
{
  this->Scene.Grid = MakePerspectiveGrid(this->FindPlace(0.05, 0.02, 0.03),
    this->FindPlace(1, 0.3, 0.2), { 0, 0.1, 1 }, 60, Width, Height);
  this->ExpectTheSameBits(false);
}

/// So far away that products with its place overflow.
TEST_P(BoundaryTilesOf, AreNotMadeFromBeyondDoubles)
{
  this->Scene.Grid = MakeParallelGrid(this->FindPlace(0.5, 0.7, 3), this->FindPlace(0, 0, 0),
    { 0, 1, 0 }, 0.6 * this->Size, Width, Height);
  constexpr double Far = 2.6e307;
  for (int a = 0; a < 3; ++a)
  {
    this->Scene.Grid.Origin[a] -= Far * this->Size * this->Scene.Grid.Direction[a];
  }
  VolumeScene volume = this->Scene.MakeVolumeScene();
  RayCastOptions options;
  options.Boundary = BoundarySearch::Tiles;
  EXPECT_FALSE(Cast(volume, this->Scene, options).Statistics.BoundaryTiles);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, BoundaryTilesOf,
  ::testing::Values(std::make_pair(std::string("ball"), Parameters{ { "cells", 12 } }),
    std::make_pair(std::string("ring"), Parameters{ { "around", 24 }, { "across", 4 } }),
    std::make_pair(std::string("heat-sink"), Parameters{ { "fins", 5 } }),
    std::make_pair(std::string("checkerboard"), Parameters{ { "cells", 2 } })),
  [](const auto& info)
  {
    std::string name = info.param.first;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

/// Small pictures of many faces are faster without.
TEST(BoundaryTiles, AreMadeWhereTheyPay)
{
  RayScene scene;
  scene.Mesh = GenerateMesh("ball", { { "cells", 12 } }).Mesh;
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(5);
  VolumeScene volume = scene.MakeVolumeScene();
  for (const int size : { 4, 200 })
  {
    scene.Grid = MakePerspectiveGrid({ 0, 0.3, 4 }, { 0, 0, 0 }, { 0, 1, 0 }, 40, size, size);
    EXPECT_EQ(Cast(volume, scene).Statistics.BoundaryTiles, size == 200);
  }
}
