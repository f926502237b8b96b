// SPDX-License-Identifier: BSD-3-Clause

// Rays that walk through imaginary cells see what rays see that enter by the boundary.

#include "RayScene.h"

#include "Generate/GeneratedMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

namespace
{

using namespace tetralux;

/// Both walk through the same cells and add the same segments: their sums differ by the rounding of
/// where a ray enters, 2^-23 of the mesh times an optical depth of 15.
constexpr double ReentryDifference = 1e-5;

constexpr int ImageSize = 96;

RayScene MakeScene(const std::string& name, const std::map<std::string, double>& parameters)
{
  GeneratedMesh generated = GenerateMesh(name, parameters);
  RayScene scene;
  scene.Mesh = std::move(generated.Mesh);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  double lo[3], hi[3];
  std::copy_n(&scene.Mesh.Points[0], 3, lo);
  std::copy_n(&scene.Mesh.Points[0], 3, hi);
  for (std::size_t i = 0; i < scene.Mesh.Points.size(); ++i)
  {
    lo[i % 3] = std::min(lo[i % 3], scene.Mesh.Points[i]);
    hi[i % 3] = std::max(hi[i % 3], scene.Mesh.Points[i]);
  }
  const double diagonal = std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
  const std::array<double, 3> middle = { 0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]),
    0.5 * (lo[2] + hi[2]) };
  scene.Function = MakeColorfulFunction(15 / diagonal);
  scene.Grid = MakePerspectiveGrid(
    { middle[0] + 1.2 * diagonal, middle[1] + 0.9 * diagonal, middle[2] + 1.1 * diagonal }, middle,
    { 0, 0.1, 1 }, 30, ImageSize, ImageSize);
  return scene;
}

class Reentries
  : public ::testing::TestWithParam<std::pair<std::string, std::map<std::string, double>>>
{
};

void ExpectTheSame(const RayScene& scene)
{
  VolumeScene volume = scene.MakeVolumeScene();
  for (const Precision precision : { Precision::Single, Precision::Double })
  {
    RayCastOptions options;
    options.Arithmetic = precision;
    options.ReentryBy = Reentry::Boundary;
    const RayPicture boundary = Cast(volume, scene, options);
    EXPECT_FALSE(boundary.Statistics.ImaginaryCells);
    options.ReentryBy = Reentry::Imaginary;
    const RayPicture imaginary = Cast(volume, scene, options);
    ASSERT_TRUE(imaginary.Statistics.ImaginaryCells)
      << volume.Mesh.GetMesh()->GetConvexification()->Refusal;

    double largest = 0;
    for (std::size_t i = 0; i < boundary.Colors.size(); ++i)
    {
      largest = std::max<double>(largest, std::abs(boundary.Colors[i] - imaginary.Colors[i]));
    }
    EXPECT_LE(largest, ReentryDifference);
    // Every ray enters a convex mesh once at most.
    EXPECT_LE(imaginary.Statistics.Paths, imaginary.Statistics.Rays);
    EXPECT_GT(imaginary.Statistics.Segments, boundary.Statistics.Segments);
  }
}

TEST_P(Reentries, SeeTheSame) { ExpectTheSame(MakeScene(GetParam().first, GetParam().second)); }

TEST_P(Reentries, SeeTheSameOfScalarsAtCells)
{
  RayScene scene = MakeScene(GetParam().first, GetParam().second);
  std::vector<double> scalars;
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    scalars.push_back(scene.Scalars[scene.Mesh.Cells[4 * cell]]);
  }
  scene.Scalars = scalars;
  scene.CellScalars = true;
  ExpectTheSame(scene);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, Reentries,
  ::testing::Values(std::make_pair(std::string("ring"),
                      std::map<std::string, double>{ { "around", 24 }, { "across", 4 } }),
    std::make_pair(
      std::string("gear"), std::map<std::string, double>{ { "teeth", 12 }, { "across", 3 } }),
    std::make_pair(std::string("heat-sink"), std::map<std::string, double>{ { "fins", 5 } }),
    std::make_pair(std::string("schoenhardt"), std::map<std::string, double>{ { "cells", 2 } }),
    std::make_pair(std::string("cubes"), std::map<std::string, double>{ { "cells", 3 } }),
    std::make_pair(std::string("checkerboard"), std::map<std::string, double>{ { "cells", 2 } })),
  [](const auto& info)
  {
    std::string name = info.param.first;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

/// Asked for imaginary cells, rays enter by the boundary all the same.
void ExpectNoImaginaryCells(VolumeScene& volume, const RayScene& scene)
{
  RayCastOptions options;
  const RayPicture boundary = Cast(volume, scene, options);
  options.ReentryBy = Reentry::Imaginary;
  const RayPicture imaginary = Cast(volume, scene, options);
  EXPECT_FALSE(imaginary.Statistics.ImaginaryCells);
  EXPECT_EQ(boundary.Colors, imaginary.Colors);
}

TEST(RayCasterReentry, AConvexMeshNeedsNoImaginaryCells)
{
  RayScene scene;
  scene.Mesh = MakeBox(6, 6, 6, { 0, 0, 0 }, { 1, 1, 1 }, 0);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(15);
  scene.Grid =
    MakePerspectiveGrid({ 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, 32, 32);
  VolumeScene volume = scene.MakeVolumeScene();
  ExpectNoImaginaryCells(volume, scene);
  EXPECT_TRUE(volume.Mesh.GetMesh()->GetConvexification()->Convex);
}

TEST(RayCasterReentry, AMeshThatCannotBeMadeConvexIsEnteredByItsBoundary)
{
  // Two boxes of different cells through each other.
  RayScene scene;
  scene.Mesh = MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0);
  const TetrahedralMesh other = MakeBox(4, 4, 4, { 0.51, 0.52, 0.53 }, { 1.7, 1.6, 1.5 }, 0);
  const std::int32_t first = static_cast<std::int32_t>(scene.Mesh.GetNumberOfPoints());
  scene.Mesh.Points.insert(scene.Mesh.Points.end(), other.Points.begin(), other.Points.end());
  for (const std::int32_t id : other.Cells)
  {
    scene.Mesh.Cells.push_back(first + id);
  }
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(15);
  scene.Grid = MakePerspectiveGrid({ 3.1, 2.2, 2.7 }, { 1, 1, 1 }, { 0.1, 1, 0.2 }, 40, 32, 32);
  VolumeScene volume = scene.MakeVolumeScene();
  ExpectNoImaginaryCells(volume, scene);
  EXPECT_NE(volume.Mesh.GetMesh()->GetConvexification()->Refusal, "");
}

TEST(RayCasterReentry, AbortsWhileImaginaryCellsAreMade)
{
  RayScene scene = MakeScene("gear", { { "teeth", 12 }, { "across", 3 } });
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.ReentryBy = Reentry::Imaginary;
  options.Progress = [](double) { return false; };
  EXPECT_TRUE(Cast(volume, scene, options).Statistics.Aborted);
  options.Progress = nullptr;
  EXPECT_TRUE(Cast(volume, scene, options).Statistics.ImaginaryCells);
}

} // namespace
