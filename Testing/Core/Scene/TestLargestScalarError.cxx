// SPDX-License-Identifier: BSD-3-Clause

// What rounding is estimated to do to pictures of the largest scalar, against rays cast in single
// and in double precision.

#include "Scene/LargestScalarError.h"

#include "Generate/GeneratedMeshes.h"
#include "RayScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>

namespace
{

using namespace tetralux;

constexpr int ImageSize = 128;

/// Pixels of those that see the mesh whose ray grazes an edge of it or a bend of the function: the
/// estimate is of all others.
constexpr double LargestGrazedShare = 1e-3;

/// An estimate above this many times the largest error warns of what is right.
constexpr double LargestExcess = 20;

/// Random scalars, and colours that change from node to node by up to 1.
RayScene MakeRandomScene(int nodes)
{
  RayScene scene;
  scene.Mesh = GenerateMesh("random", { { "cells", 6 } }).Mesh;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    scene.Scalars.push_back(unit(generator));
  }
  for (int k = 0; k < nodes; ++k)
  {
    TransferFunction::Value value{};
    value.Attenuation = unit(generator);
    std::generate(value.Color, value.Color + 3, [&] { return unit(generator); });
    scene.Function.Nodes.push_back({ static_cast<double>(k) / (nodes - 1), value, value });
  }
  scene.Model = OpticalModel::MaximumIntensity;
  scene.Grid =
    MakePerspectiveGrid({ 2.1, 1.6, 2.6 }, { 0, 0, 0 }, { 0, 1, 0 }, 40, ImageSize, ImageSize);
  return scene;
}

RayPicture CastWith(const RayScene& scene, Precision precision)
{
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.MaximumError = 1e-4;
  options.Arithmetic = precision;
  return Cast(volume, scene, options);
}

class LargestScalarPictures : public testing::TestWithParam<int>
{
};

TEST_P(LargestScalarPictures, AreNotWorseThanEstimated)
{
  const RayScene scene = MakeRandomScene(this->GetParam());
  const RayPicture exact = CastWith(scene, Precision::Double);
  const RayPicture rounded = CastWith(scene, Precision::Single);
  ASSERT_FALSE(rounded.Statistics.DoublePrecision);
  const double estimate = rounded.Statistics.ErrorEstimate;
  double largest = 0;
  int covered = 0;
  int above = 0;
  for (std::size_t pixel = 0; pixel < exact.Colors.size() / 4; ++pixel)
  {
    double error = 0;
    for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
    {
      error = std::max<double>(error, std::abs(exact.Colors[k] - rounded.Colors[k]));
    }
    covered += exact.Colors[4 * pixel + 3] > 0;
    above += error > estimate;
    largest = error > estimate ? largest : std::max(largest, error);
  }
  std::cout << this->GetParam() << " nodes: error " << largest << ", estimate " << estimate << ", "
            << above << " of " << covered << " pixels above it\n";
  ASSERT_GT(covered, ImageSize * ImageSize / 20);
  EXPECT_LE(above, LargestGrazedShare * covered);
  EXPECT_LE(estimate, LargestExcess * largest);
  // What single precision is not right enough for is cast in double precision.
  const RayPicture chosen = CastWith(scene, Precision::Automatic);
  EXPECT_EQ(chosen.Statistics.DoublePrecision,
    rounded.Statistics.GeometryError > rounded.Statistics.Budget.Geometry);
}

INSTANTIATE_TEST_SUITE_P(LargestScalarError, LargestScalarPictures, testing::Values(2, 8, 70));

/// Rays whose errors can be told by hand.
TEST(LargestScalarError, OfOneRay)
{
  const RayUnits units{ 1, 1, 1 };
  constexpr GeometryRounding Scalars = { 0, 1e-6 };
  constexpr GeometryRounding Across = { 1e-6, 0 };
  const TransferFunction ramp = MakeLinearFunction({ { 0, 1, 1, 1, 0 }, { 1, 1, 1, 1, 1 } });
  RaySample sample;
  sample.Weights = { 1 };
  sample.Rays.push_back({ { 0.1, 0.5, 1 }, { 0.5, 0.2, 1 } });
  const auto estimate = [&](const TransferFunction& function, const GeometryRounding& rounding)
  { return EstimateLargestScalarError(sample, units, function, false, rounding); };
  EXPECT_NEAR(estimate(ramp, Scalars), WorstOfPicture * 1e-6, 1e-12);
  EXPECT_EQ(estimate(ramp, Across), 0);
  // The face at the largest scalar, with what the scalar changes by across the ray and along it.
  sample.Rays[0][0].Gradient = 20;
  EXPECT_NEAR(estimate(ramp, Across), WorstOfPicture * 20e-6, 1e-12);
  sample.Rays[0][0].BackSlope = 10;
  EXPECT_NEAR(estimate(ramp, Across), WorstOfPicture * 24e-6, 1e-12);
  // Far below the largest scalar nothing counts.
  sample.Rays[0][0].FrontSlope = 1000;
  sample.Rays[0][1].BackSlope = 1000;
  EXPECT_NEAR(estimate(ramp, Across), WorstOfPicture * 24e-6, 1e-12);

  // A step may be missed, by all that a channel has.
  TransferFunction step = MakeLinearFunction({ { 0, 1, 1, 1, 0 }, { 0.5, 1, 1, 1, 0 } });
  step.Nodes[1].Right.Attenuation = 1;
  EXPECT_EQ(estimate(step, Scalars), 1);
  // Not by cells, whose scalars are rounded as the nodes are.
  EXPECT_EQ(EstimateLargestScalarError(sample, units, step, true, Scalars), 0);
  EXPECT_EQ(EstimateLargestScalarError(RaySample(), units, ramp, false, Scalars), 0);
}

} // namespace
