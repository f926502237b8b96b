// SPDX-License-Identifier: BSD-3-Clause

// What the ray caster does beside pictures: threads, tiles, changes, early ends,
// progress, errors.

#include "BoxScene.h"
#include "RayScene.h"

#include "Generate/GeneratedMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::box_scene;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

bool AreIdentical(const RayPicture& a, const RayPicture& b)
{
  return a.Colors.size() == b.Colors.size() &&
    std::memcmp(a.Colors.data(), b.Colors.data(), a.Colors.size() * sizeof(float)) == 0 &&
    std::memcmp(a.Depths.data(), b.Depths.data(), a.Depths.size() * sizeof(float)) == 0;
}

TEST(RayCaster, SamePictureForAnyNumberOfThreads)
{
  for (RayScene scene : { MakeBoxScene(), CellScalars() })
  {
    scene.Grid = LookAtUnitCube(Oblique, 101); // tiles at the borders are partial
    VolumeScene volume = scene.MakeVolumeScene();
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      options.NumberOfThreads = 1;
      const RayPicture expected = Cast(volume, scene, options);
      for (const int threads : { 2, 3, 7 })
      {
        options.NumberOfThreads = threads;
        const RayPicture picture = Cast(volume, scene, options);
        EXPECT_TRUE(AreIdentical(picture, expected)) << threads << " threads";
        EXPECT_EQ(picture.Statistics.Segments, expected.Statistics.Segments);
        EXPECT_EQ(picture.Statistics.NumberOfThreads, threads);
      }
    }
  }
}

TEST(RayCaster, TilesMakeTheSamePictureAsTheWhole)
{
  RayScene scene = MakeBoxScene();
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  const RayPicture whole = Cast(volume, scene, options);
  RayScene part = scene;
  part.Grid = MakeTile(scene.Grid, 13, 7, 19, 23);
  const RayPicture tile = Cast(volume, part, options);
  for (int y = 0; y < 23; ++y)
  {
    for (int x = 0; x < 19; ++x)
    {
      for (int c = 0; c < 4; ++c)
      {
        // Origins of a tile are rounded.
        ASSERT_NEAR(tile.Colors[4 * (y * 19 + x) + c],
          whole.Colors[4 * ((y + 7) * ImageSize + x + 13) + c], KernelDifference);
      }
    }
  }
}

TEST(RayCaster, WhatIsSetAgainReplacesWhatWas)
{
  const auto cast = [](VolumeScene& volume, const RayScene& scene)
  {
    std::vector<RayPicture> pictures;
    for (const Precision precision : { Precision::Single, Precision::Double, Precision::Single })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      pictures.push_back(Cast(volume, scene, options));
    }
    EXPECT_TRUE(AreIdentical(pictures[0], pictures[2]));
    return pictures;
  };
  RayScene first = MakeBoxScene();
  VolumeScene volume = first.MakeVolumeScene();
  cast(volume, first);

  const auto expectFresh = [&](const RayScene& scene, const std::string& what)
  {
    VolumeScene fresh = scene.MakeVolumeScene();
    const std::vector<RayPicture> expected = cast(fresh, scene);
    const std::vector<RayPicture> actual = cast(volume, scene);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_TRUE(AreIdentical(actual[i], expected[i])) << what << ", picture " << i;
    }
  };
  const auto inOrder = [](const RayScene& scene, const std::vector<std::int32_t>& ids)
  {
    std::vector<double> scalars;
    for (const std::int64_t id : ids)
    {
      scalars.push_back(scene.Scalars[id]);
    }
    return scalars;
  };

  RayScene scene = Steps(); // another range of nodes
  volume.Optics.SetTransferFunction(scene.Function);
  expectFresh(scene, "transfer function");

  for (TransferFunction::Node& node : scene.Function.Nodes)
  {
    node.Right.Color[0] *= 0.5; // the same range
    node.Right.Attenuation *= 2;
  }
  volume.Optics.SetTransferFunction(scene.Function);
  expectFresh(scene, "values of the transfer function");

  for (double& s : scene.Scalars)
  {
    s = 0.8 * s + 0.05;
  }
  volume.Mesh.SetPointScalars(inOrder(scene, volume.Mesh.GetMesh()->GetMesh().OriginalPoints));
  expectFresh(scene, "point scalars");

  const RayScene cells = CellScalars();
  scene.CellScalars = true;
  scene.Scalars = cells.Scalars;
  volume.Mesh.SetCellScalars(inOrder(scene, volume.Mesh.GetMesh()->GetMesh().OriginalCells));
  expectFresh(scene, "cell scalars");

  volume.Optics.SetTransferFunction(cells.Function);
  scene.Function = cells.Function;
  expectFresh(scene, "transfer function of cell scalars");
}

TEST(RayCaster, EndsRaysEarlyWithinTheErrorAskedFor)
{
  RayScene scene = MakeBoxScene();
  scene.Function = MakeColorfulFunction(60);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  options.MaximumError = 1e-9;
  const RayPicture exact = Cast(volume, scene, options);
  std::int64_t segments = exact.Statistics.Segments;
  for (const double error : { 1e-4, 1e-2, 0.1 })
  {
    options.MaximumError = error;
    const RayPicture picture = Cast(volume, scene, options);
    EXPECT_EQ(picture.Statistics.TerminationError, 0.5 * error);
    EXPECT_LE(picture.Statistics.ErrorEstimate, error);
    EXPECT_LT(picture.Statistics.Segments, segments);
    segments = picture.Statistics.Segments;
    for (std::size_t i = 0; i < picture.Colors.size(); ++i)
    {
      ASSERT_LE(std::abs(picture.Colors[i] - exact.Colors[i]), 0.5 * error + 1e-6);
    }
  }
}

TEST(RayCaster, ClearWhereThereIsNothing)
{
  const auto expectClear = [](const RayScene& scene, const std::string& what)
  {
    SCOPED_TRACE(what);
    VolumeScene volume = scene.MakeVolumeScene();
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      const RayPicture picture = Cast(volume, scene, options);
      EXPECT_TRUE(
        std::all_of(picture.Colors.begin(), picture.Colors.end(), [](float c) { return c == 0; }));
      EXPECT_TRUE(
        std::all_of(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d == -1; }));
      EXPECT_FALSE(std::isnan(picture.Statistics.ErrorEstimate));
    }
  };
  RayScene scene = MakeBoxScene(3);
  scene.Mesh = {};
  scene.Scalars.clear();
  expectClear(scene, "no mesh");
  scene.CellScalars = true;
  expectClear(scene, "no cells");

  scene = MakeBoxScene(3);
  scene.Function = MakeConstantFunction(0, { 1, 1, 1 });
  expectClear(scene, "no attenuation");

  scene = MakeBoxScene(3);
  std::fill(scene.Scalars.begin(), scene.Scalars.end(), NaN);
  expectClear(scene, "no scalars");
  EXPECT_EQ(scene.MakeVolumeScene().Mesh.GetNumberOfBlankCells(), 3 * 3 * 3 * 5);

  scene = MakeBoxScene(3);
  scene.Grid = LookAtUnitCube({ 3, 2, 2 });
  scene.Limits.Planes.push_back({ 0, 0, 1, -1.5 });
  expectClear(scene, "all clipped");

  scene = MakeBoxScene(3);
  scene.Limits.Cropping = true;
  scene.Limits.CroppingFlags = 0;
  expectClear(scene, "all cropped");

  scene = MakeBoxScene(3);
  scene.Grid = MakePerspectiveGrid({ 5, 5, 5 }, { 5, 5, 6 }, { 0, 1, 0 }, 20, 16, 16);
  expectClear(scene, "beside the mesh");
}

TEST(RayCaster, ProgressIsToldAndAborts)
{
  RayScene scene = MakeBoxScene(5);
  scene.Grid = LookAtUnitCube(Oblique, 128);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  for (const int threads : { 1, 3 })
  {
    options.NumberOfThreads = threads;
    std::vector<double> told;
    options.Progress = [&](double share)
    {
      told.push_back(share);
      return true;
    };
    EXPECT_FALSE(Cast(volume, scene, options).Statistics.Aborted);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_TRUE(std::all_of(told.begin(), told.end(), [](double t) { return t > 0 && t <= 1; }));
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.back(), 1);
  }
  options.NumberOfThreads = 1;
  int calls = 0;
  options.Progress = [&](double)
  {
    ++calls;
    return false;
  };
  EXPECT_TRUE(Cast(volume, scene, options).Statistics.Aborted);
  EXPECT_EQ(calls, 1);

  // After an abort the next picture is as good as ever.
  options.Progress = nullptr;
  const RayPicture picture = Cast(volume, scene, options);
  EXPECT_FALSE(picture.Statistics.Aborted);
  VolumeScene fresh = scene.MakeVolumeScene();
  EXPECT_TRUE(AreIdentical(picture, Cast(fresh, scene, options)));
}

TEST(RayCaster, ExceptionsOfProgressReachTheCaller)
{
  const RayScene scene = MakeBoxScene(3);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Progress = [](double) -> bool { throw std::runtime_error("enough"); };
  options.NumberOfThreads = 1;
  EXPECT_THROW(Cast(volume, scene, options), std::runtime_error);
}

std::string GetError(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(RayCaster, RefusesWhatDoesNotFitInOneLine)
{
  const RayScene scene = MakeBoxScene(3);
  VolumeScene volume = scene.MakeVolumeScene();
  const std::size_t points = volume.Mesh.GetMesh()->GetMesh().GetNumberOfPoints();
  ASSERT_EQ(points, 64u);
  EXPECT_EQ(GetError(
              [&] {
                volume.Mesh.SetPointScalars({ 1, 2, 3 });
              }),
    "3 scalars were given for 64 points");
  EXPECT_EQ(GetError([&] { volume.Mesh.SetCellScalars(std::vector<double>(64)); }),
    "64 scalars were given for 135 cells");

  std::vector<float> colors(4 * ImageSize * ImageSize);
  std::vector<float> depths(ImageSize * ImageSize);
  const auto cast = [&](VolumeScene& c) { CastRays(c, scene.Grid, {}, {}, colors, depths); };
  EXPECT_EQ(GetError([&] { cast(volume); }), "no error");
  colors.pop_back();
  const std::string sizes = "the image arrays do not have the size of the ray grid";
  EXPECT_EQ(GetError([&] { cast(volume); }), sizes);
  colors.resize(4 * ImageSize * ImageSize);
  depths.push_back(0);
  EXPECT_EQ(GetError([&] { cast(volume); }), sizes);
  depths.pop_back();

  VolumeScene bare;
  EXPECT_EQ(GetError([&] { cast(bare); }),
    "a mesh and a transfer function must be set before rays are cast");
  EXPECT_EQ(
    GetError([&] { bare.Mesh.SetPointScalars({ 1 }); }), "the mesh must be set before its scalars");
  bare.Mesh.SetMesh(std::make_shared<WalkMesh>(scene.Mesh));
  bare.Optics.SetTransferFunction(scene.Function);
  EXPECT_EQ(
    GetError([&] { cast(bare); }), "scalars must be set after the mesh and before rays are cast");
  EXPECT_NE(GetError([&] { bare.Optics.SetTransferFunction({}); }), "no error");
}

} // namespace
