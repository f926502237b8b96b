// SPDX-License-Identifier: BSD-3-Clause

// What rounding is estimated to do to pictures, against rays cast in single and in double
// precision.

#include "Scene/GeometryError.h"

#include "Generate/GeneratedMeshes.h"
#include "RayScene.h"
#include "Scene/OrderError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

constexpr int ImageSize = 128;

/// Pixels that graze, of those that see the mesh: three in a thousand where a wall of constant
/// density is seen from its edge all around, next to none elsewhere.
constexpr double LargestGrazedShare = 4e-3;

struct Case
{
  const char* Name;
  const char* Generator;
  std::map<std::string, double> Parameters;
  TransferFunction (*MakeFunction)();
  bool CellScalars;
};

TransferFunction MakeConstant()
{
  return MakeLinearFunction({ { 0, 1, 1, 1, 3 }, { 1, 1, 1, 1, 3 } });
}

TransferFunction MakeColors() { return MakeColorfulFunction(10); }

TransferFunction MakeNeedle()
{
  return MakeLinearFunction({ { 0, 0.3, 0.4, 1, 0.1 }, { 0.499, 0.3, 0.4, 1, 0.1 },
    { 0.5, 1, 0.9, 0.2, 50 }, { 0.501, 0.3, 0.9, 0.5, 0.1 }, { 1, 1, 0.3, 0.2, 0.2 } });
}

/// Attenuations of 0.2 and, between 0.4 and 0.6, of the given one; steps at both ends.
TransferFunction MakeSteps(double attenuation)
{
  TransferFunction function = MakeLinearFunction({ { 0, 0.2, 0.3, 0.9, 0.2 },
    { 0.4, 0.2, 0.3, 0.9, 0.2 }, { 0.6, 0.9, 0.8, 0.1, attenuation }, { 1, 0.9, 0.1, 0.1, 0.2 } });
  function.Nodes[1].Right = function.Nodes[2].Left;
  function.Nodes[2].Right = function.Nodes[3].Left;
  return function;
}

TransferFunction MakeLowSteps() { return MakeSteps(5); }
TransferFunction MakeStiffSteps() { return MakeSteps(1e5); }

class RoundedPictures : public testing::TestWithParam<Case>
{
protected:
  void SetUp() override
  {
    const Case& given = this->GetParam();
    this->Scene.Mesh = GenerateMesh(given.Generator, given.Parameters).Mesh;
    this->Scene.Scalars = MakeSmoothField(this->Scene.Mesh);
    this->Scene.CellScalars = given.CellScalars;
    if (given.CellScalars)
    {
      std::vector<double> cells;
      for (std::size_t t = 0; t < this->Scene.Mesh.GetNumberOfCells(); ++t)
      {
        cells.push_back(this->Scene.Scalars[this->Scene.Mesh.Cells[4 * t]]);
      }
      this->Scene.Scalars = cells;
    }
    this->Scene.Function = given.MakeFunction();
    this->Scene.Grid =
      MakePerspectiveGrid({ 2.1, 1.6, 2.6 }, { 0, 0, 0 }, { 0, 1, 0 }, 40, ImageSize, ImageSize);
  }

  RayPicture CastWith(Precision precision, double right = 0, double up = 0)
  {
    VolumeScene volume = this->Scene.MakeVolumeScene();
    RayScene moved = this->Scene;
    const double distance = GrazingRounding * volume.Mesh.GetMesh()->GetRadius();
    const double* steps[] = { moved.Grid.DirectionStepX, moved.Grid.DirectionStepY };
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = steps[0][axis] / std::hypot(steps[0][0], steps[0][1], steps[0][2]);
      const double y = steps[1][axis] / std::hypot(steps[1][0], steps[1][1], steps[1][2]);
      moved.Grid.Origin[axis] += distance * (right * x + up * y);
    }
    RayCastOptions options;
    options.MaximumError = 0;
    options.Arithmetic = precision;
    return Cast(volume, moved, options);
  }

  RayScene Scene;
};

double GetDifference(const RayPicture& a, const RayPicture& b, std::size_t pixel)
{
  double largest = 0;
  for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
  {
    largest = std::max<double>(largest, std::abs(a.Colors[k] - b.Colors[k]));
  }
  return largest;
}

TEST_P(RoundedPictures, AreNotWorseThanEstimated)
{
  const RayPicture exact = this->CastWith(Precision::Double);
  const RayPicture rounded = this->CastWith(Precision::Single);
  ASSERT_FALSE(rounded.Statistics.DoublePrecision);
  EXPECT_EQ(exact.Statistics.GeometryError, 0);
  const double estimate = rounded.Statistics.ErrorEstimate;
  const RayPicture moved[] = { this->CastWith(Precision::Double, 1, 0),
    this->CastWith(Precision::Double, -1, 0), this->CastWith(Precision::Double, 0, 1),
    this->CastWith(Precision::Double, 0, -1) };
  double largest = 0;
  int covered = 0;
  int grazed = 0;
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(ImageSize) * ImageSize; ++pixel)
  {
    covered += exact.Colors[4 * pixel + 3] > 0;
    if (std::any_of(std::begin(moved), std::end(moved),
          [&](const RayPicture& picture)
          { return GetDifference(picture, exact, pixel) > estimate; }))
    {
      ++grazed;
      continue;
    }
    largest = std::max(largest, GetDifference(rounded, exact, pixel));
  }
  std::cout << this->GetParam().Name << ": error " << largest << ", estimate " << estimate << ", "
            << grazed << " of " << covered << " pixels graze\n";
  ASSERT_GT(covered, ImageSize * ImageSize / 20);
  EXPECT_LE(largest, estimate);
  EXPECT_LE(grazed, LargestGrazedShare * covered);
}

const std::map<std::string, double> Small = { { "cells", 10 } };
const std::map<std::string, double> SmallRing = { { "around", 60 }, { "across", 6 } };
const std::map<std::string, double> SmallPipe = { { "across", 4 }, { "around", 48 },
  { "along", 12 } };

INSTANTIATE_TEST_SUITE_P(GeometryError, RoundedPictures,
  testing::Values(Case{ "RingColors", "ring", SmallRing, MakeColors, false },
    Case{ "RingNeedle", "ring", SmallRing, MakeNeedle, false },
    Case{ "RingSteps", "ring", SmallRing, MakeLowSteps, false },
    Case{ "RingStiff", "ring", SmallRing, MakeStiffSteps, false },
    Case{ "OGridColors", "cylinder-with-hole", SmallPipe, MakeColors, false },
    Case{ "OGridConstant", "cylinder-with-hole", SmallPipe, MakeConstant, false },
    Case{ "OGridStiff", "cylinder-with-hole", SmallPipe, MakeStiffSteps, false },
    Case{ "BallNeedle", "ball", Small, MakeNeedle, false },
    Case{ "BallCells", "ball", Small, MakeColors, true },
    Case{ "BallCellSteps", "ball", Small, MakeLowSteps, true },
    Case{ "RandomColors", "random", Small, MakeColors, false }),
  [](const testing::TestParamInfo<Case>& given) { return std::string(given.param.Name); });

/// One ray, whose error can be told by hand.
TEST(GeometryError, OfOneRay)
{
  RaySample sample;
  sample.Weights = { 1 };
  sample.Rays.push_back({ { 0, 1, 1, 0, 0, 0, true, true } });
  const TransferFunction ramp = MakeLinearFunction({ { -9, 1, 1, 1, 0 }, { 9, 1, 1, 1, 0.018 } });
  const RayUnits units{ 1, 1, 1 };
  constexpr GeometryRounding Scalars = { 0, 1e-6 };
  // An attenuation that rises by 0.001 for a scalar, an optical depth of 0.009 or so.
  EXPECT_NEAR(EstimateRoundingError(sample, units, ramp, false, Scalars),
    WorstOfPicture * 1e-3 * 1e-6, 1e-14);
  // Twice as long, twice as much.
  EXPECT_NEAR(EstimateRoundingError(sample, { 2, 1, 1 }, ramp, false, Scalars),
    2 * WorstOfPicture * 1e-3 * 1e-6, 1e-14);
  // A boundary that is seen at 45 degrees, where the attenuation is 0.009.
  sample.Rays[0][0].FrontSlope = 1;
  EXPECT_NEAR(EstimateRoundingError(sample, units, ramp, false, { 1e-6, 0 }),
    WorstOfPicture * 9e-3 * 1e-6, 1e-14);
  // Nothing of it is seen behind what is opaque.
  const TransferFunction opaque = MakeLinearFunction({ { 0, 1, 1, 1, 100 }, { 1, 1, 1, 1, 100 } });
  EXPECT_LT(EstimateRoundingError(sample, units, opaque, true, { 1e-6, 1e-6 }), 1e-12);
  EXPECT_EQ(EstimateRoundingError(RaySample(), units, ramp, true, Scalars), 0);
}

TEST(OrderError, OfTwoSegments)
{
  RaySample sample;
  sample.Rays.push_back({ { 0, 0, 1 }, { 1, 1, 1 } });
  const double a = 1 - std::exp(-0.1);
  const TransferFunction colors = MakeLinearFunction({ { 0, 1, 0, 0, 0.1 }, { 1, 0, 1, 0, 0.1 } });
  EXPECT_NEAR(EstimateOrderError(sample, 1, colors), a * a, 1e-12);
  // In one colour any order is right.
  const TransferFunction white = MakeLinearFunction({ { 0, 1, 1, 1, 0.1 }, { 1, 1, 1, 1, 0.3 } });
  EXPECT_NEAR(EstimateOrderError(sample, 1, white), 0, 1e-15);
}

} // namespace
