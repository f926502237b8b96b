// SPDX-License-Identifier: BSD-3-Clause

// Functions of thousands of pieces: what adding them up in single precision costs is in the
// estimate.

#include "CellIntegral/CellIntegral.h"
#include "RayScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

using namespace tetralux;

constexpr int ImageSize = 32;

/// A field that goes up and down many times, so that rays cross each piece often. attenuation: per
/// world unit, at most.
RayScene MakeScene(int pieces, double attenuation)
{
  RayScene scene;
  scene.Mesh = MakeBox(6, 6, 6, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  for (const double s : MakeSmoothField(scene.Mesh))
  {
    scene.Scalars.push_back(0.5 + 0.5 * std::sin(40 * s));
  }
  for (int k = 0; k <= pieces; ++k)
  {
    const double s = static_cast<double>(k) / pieces;
    const TransferFunction::Value value = { { s, 1 - s, 0.5 }, 0.1 + attenuation * s };
    scene.Function.Nodes.push_back({ s, value, value });
  }
  scene.Grid = MakePerspectiveGrid(
    { 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, ImageSize, ImageSize);
  return scene;
}

/// The largest difference of a channel from the integral in double precision.
double FindError(VolumeScene& volume, const RayScene& scene, const RayPicture& picture)
{
  const std::vector<double> exact = IntegrateCells(volume, scene.Grid, {}, 1);
  double largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    largest = std::max(largest, std::abs(picture.Colors[k] - exact[k]));
  }
  return largest;
}

TEST(ManyPieces, AreInTheEstimate)
{
  for (const double attenuation : { 0.5, 4., 30. })
  {
    for (const int pieces : { 1, 500, 5000 })
    {
      const RayScene scene = MakeScene(pieces, attenuation);
      VolumeScene volume = scene.MakeVolumeScene();
      for (const Precision precision : { Precision::Single, Precision::Double })
      {
        SCOPED_TRACE(pieces);
        RayCastOptions options;
        options.MaximumError = 0;
        options.Arithmetic = precision;
        const RayPicture picture = Cast(volume, scene, options);
        EXPECT_LE(FindError(volume, scene, picture), picture.Statistics.ErrorEstimate);
      }
    }
  }
}

/// A segment without a node is one piece, and the estimate does not know of pieces elsewhere.
TEST(ManyPieces, CountOnlyWhereRaysCrossThem)
{
  RayScene scene = MakeScene(5000, 4);
  for (double& s : scene.Scalars)
  {
    s = 0.4321;
  }
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.MaximumError = 0;
  options.Arithmetic = Precision::Double;
  const RayPicture picture = Cast(volume, scene, options);
  EXPECT_EQ(volume.EstimatePieces(), 1);
  EXPECT_LE(picture.Statistics.SummationError, 1e-6);
}

} // namespace
