// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/EightBitError.h"

#include "ReferenceScenes.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace
{

using tetralux::EightBitErrors;
using tetralux::EstimateEightBitErrors;
using tetralux::MakeLinearFunction;
using tetralux::OpticalModel;
using tetralux::RaySample;
using tetralux::TransferFunction;

/// One step of eight bits.
constexpr double Step = 1. / 255;

/// Rays of so many cells of one scalar and length 1.
RaySample MakeRays(int numberOfRays, int cells)
{
  RaySample sample;
  sample.Rays.assign(numberOfRays, { static_cast<std::size_t>(cells), { 0.5, 0.5, 1 } });
  return sample;
}

/// Grey of a brightness everywhere. opacity: of a cell.
TransferFunction MakeGrey(double brightness, double opacity)
{
  const double attenuation = -std::log1p(-opacity);
  return MakeLinearFunction({ { 0, brightness, brightness, brightness, attenuation },
    { 1, brightness, brightness, brightness, attenuation } });
}

TEST(EightBitError, ACellThatIsRoundedOnce)
{
  // Red, green, blue 0.3 and opacity 0.5: 76.5 and 127.5 steps, half a step off to the nearest.
  const EightBitErrors errors =
    EstimateEightBitErrors(MakeRays(1, 1), 1, MakeGrey(0.6, 0.5), OpticalModel::EmissionAbsorption);
  EXPECT_NEAR(errors.Nearest.MeanSquare, 0.25 * Step * Step, 1e-9);
  EXPECT_NEAR(errors.Nearest.Largest, 5 * 0.5 * Step, 1e-6);
  EXPECT_EQ(EstimateEightBitErrors(RaySample(), 1, MakeGrey(1, 0.5), OpticalModel::EmissionOnly)
              .Nearest.MeanSquare,
    0);
}

TEST(EightBitError, ThinCellsAreLostToTheNearest)
{
  // A fifth of a step each, 20 in all: nothing remains. At random it is right on the average.
  for (const OpticalModel model :
    { OpticalModel::EmissionAbsorption, OpticalModel::EmissionOnly, OpticalModel::AbsorptionOnly })
  {
    const EightBitErrors errors =
      EstimateEightBitErrors(MakeRays(500, 100), 1, MakeGrey(1, 0.2 * Step), model);
    const double channels = model == OpticalModel::EmissionAbsorption ? 4
      : model == OpticalModel::EmissionOnly                           ? 3
                                                                      : 1;
    EXPECT_NEAR(std::sqrt(4 / channels * errors.Nearest.MeanSquare), 20 * Step, Step);
    EXPECT_LT(std::sqrt(4 / channels * errors.Random.MeanSquare), 3 * Step);
    EXPECT_TRUE(errors.IsRandomBetter());
  }
}

TEST(EightBitError, BlendingTakesNothingFromDarkColours)
{
  // Cells of 2.4 steps make grey of 0.3: to the nearest each is 0.7 of a step and 2, so 0.36; at
  // random a cell of three steps adds one and one of two steps adds one: 0.4 or more.
  const EightBitErrors errors = EstimateEightBitErrors(
    MakeRays(500, 1000), 1, MakeGrey(0.3, 2.4 * Step), OpticalModel::EmissionAbsorption);
  EXPECT_GT(errors.Nearest.MeanSquare, 0.01 * 0.01);
  EXPECT_GT(errors.Random.MeanSquare, 0.01 * 0.01);
  EXPECT_FALSE(errors.IsRandomBetter());
}

TEST(EightBitError, WeightsAreThoseOfThePicture)
{
  RaySample sample = MakeRays(2, 100);
  sample.Rays[1].clear();
  const TransferFunction function = MakeGrey(1, 0.2 * Step);
  const auto measure = [&](std::vector<double> weights)
  {
    sample.Weights = std::move(weights);
    return EstimateEightBitErrors(sample, 1, function, OpticalModel::EmissionAbsorption);
  };
  EXPECT_NEAR(measure({ 1, 3 }).Nearest.MeanSquare, measure({ 1, 0 }).Nearest.MeanSquare / 4, 1e-9);
  EXPECT_EQ(measure({ 1, 1e6 }).Nearest.Largest, 0) << "fewer than one ray in a thousand";
}

TEST(EightBitError, DoesNotDependOnTheNumberOfThreads)
{
  const TransferFunction function = MakeGrey(0.5, 0.7 * Step);
  const RaySample sample = MakeRays(50, 40);
  const double expected =
    EstimateEightBitErrors(sample, 1, function, OpticalModel::EmissionAbsorption).Random.MeanSquare;
  ForEachThreadCount(
    [&]
    {
      EXPECT_EQ(EstimateEightBitErrors(sample, 1, function, OpticalModel::EmissionAbsorption)
                  .Random.MeanSquare,
        expected);
    });
}

TEST(EightBitError, OtherModelsAreRefused)
{
  for (const OpticalModel model : { OpticalModel::MaximumIntensity, OpticalModel::Isosurfaces })
  {
    EXPECT_THROW(
      EstimateEightBitErrors(MakeRays(1, 1), 1, MakeGrey(1, 0.5), model), std::invalid_argument);
  }
}

} // namespace
