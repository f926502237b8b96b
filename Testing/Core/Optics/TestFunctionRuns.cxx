// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/FunctionRuns.h"

#include "ColorMaps.h"
#include "Optics/IntervalTable.h"
#include "SampleFunctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{

using tetralux::ColorMap;
using tetralux::Evaluate;
using tetralux::FindFunctionRuns;
using tetralux::FunctionRun;
using tetralux::FunctionRuns;
using tetralux::IntervalTable;
using tetralux::MakeColorMaps;
using tetralux::MakeIntervalTable;
using tetralux::MakeRunTolerance;
using tetralux::OpticalModel;
using tetralux::RunTolerance;
using tetralux::TransferFunction;

/// Rounding of values in double precision, relative to the largest.
constexpr double Rounding = 1e-12;

/// Intervals visited for each node: runs of some hundred nodes, three channels, twice each.
constexpr double MostVisitsOfNode = 100;

constexpr double Errors[] = { 1e-2, 1e-3, 1e-4, 1e-5, 1e-6 };

RunTolerance MakeTolerance(const TransferFunction& function, double error)
{
  return MakeRunTolerance(OpticalModel::EmissionAbsorption, function, error, 1);
}

/// What a run has at a scalar in it.
TransferFunction::Value Read(const TransferFunction& function, const FunctionRun& run, double s)
{
  const TransferFunction::Node& begin = function.Nodes[run.First];
  const TransferFunction::Node& end = function.Nodes[run.Last];
  const double w = (s - begin.Scalar) / (end.Scalar - begin.Scalar);
  TransferFunction::Value value;
  value.Attenuation = (1 - w) * begin.Right.Attenuation + w * end.Left.Attenuation;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] =
      (1 - w) * begin.Right.Color[c] + w * end.Left.Color[c] + run.Bulge[c] * 4 * w * (1 - w);
  }
  return value;
}

/// Expects runs that follow each other from end to end, and are as near as a tolerance says.
void ExpectNear(
  const TransferFunction& function, const FunctionRuns& runs, const RunTolerance& tolerance)
{
  constexpr int SamplesOfRun = 199;
  std::size_t next = 0;
  for (const FunctionRun& run : runs.Runs)
  {
    ASSERT_EQ(run.First, next);
    ASSERT_LT(run.First, run.Last);
    next = run.Last;
    const double begin = function.Nodes[run.First].Scalar;
    const double end = function.Nodes[run.Last].Scalar;
    for (int i = 1; i < SamplesOfRun; ++i)
    {
      const double s = begin + (end - begin) * i / SamplesOfRun;
      const TransferFunction::Value exact = Evaluate(function, s);
      const TransferFunction::Value actual = Read(function, run, s);
      ASSERT_NEAR(actual.Attenuation, exact.Attenuation,
        (tolerance.AttenuationShare + Rounding) * exact.Attenuation);
      for (int c = 0; c < 3 && exact.Attenuation > 0; ++c)
      {
        ASSERT_NEAR(actual.Color[c], exact.Color[c], tolerance.Color + Rounding);
      }
    }
  }
  EXPECT_EQ(next, function.Nodes.size() - 1);
}

/// Smooth but for its many nodes.
TransferFunction MakeSmooth(int nodes)
{
  return tetralux::SampleColors(nodes, 1, tetralux::EvaluateCoolToWarm);
}

TEST(FunctionRuns, AreWithinTheirTolerance)
{
  for (const ColorMap& map : MakeColorMaps(2))
  {
    for (const double error : Errors)
    {
      SCOPED_TRACE(map.Name + " " + std::to_string(error));
      const RunTolerance tolerance = MakeTolerance(map.Function, error);
      ExpectNear(map.Function, FindFunctionRuns(map.Function, tolerance), tolerance);
    }
  }
}

TEST(FunctionRuns, OfRandomFunctionsAreWithinTheirTolerance)
{
  std::mt19937_64 generator(5);
  for (int example = 0; example < 60; ++example)
  {
    const TransferFunction function =
      tetralux::MakeRandomFunction(generator, 2 + example % 40, 3, example % 2 == 0);
    // Up to errors that leave next to nothing of a function.
    for (const double error : { 1e-5, 1e-2, 0.3, 1. })
    {
      SCOPED_TRACE(std::to_string(example) + " " + std::to_string(error));
      const RunTolerance tolerance = MakeTolerance(function, error);
      ExpectNear(function, FindFunctionRuns(function, tolerance), tolerance);
    }
  }
}

TEST(FunctionRuns, OfSmoothColorsAreFew)
{
  for (const ColorMap& map : MakeColorMaps(2))
  {
    std::size_t previous = map.Function.Nodes.size();
    for (const double error : { 1e-6, 1e-5, 2e-5, 1e-4, 1e-3, 1e-2 })
    {
      const std::size_t runs =
        FindFunctionRuns(map.Function, MakeTolerance(map.Function, error)).Runs.size();
      EXPECT_LE(runs, previous) << map.Name << " " << error;
      previous = runs;
      std::cout << map.Name << " " << error << ": " << runs << " runs of "
                << map.Function.Nodes.size() - 1 << "\n";
      // What mappers have at their default.
      constexpr double Usual = 2e-5;
      constexpr std::size_t Few = 40; // of intervals
      EXPECT_TRUE(error < Usual || runs <= Few) << map.Name;
    }
  }
}

TEST(FunctionRuns, BeginAtStepsAndWhereAttenuationBends)
{
  TransferFunction function = MakeSmooth(200);
  const std::size_t colorStep = 150;
  const std::size_t attenuationStep = 120;
  function.Nodes[colorStep].Right.Color[1] += 1e-9;
  function.Nodes[attenuationStep].Left.Attenuation += 1e-9;
  const RunTolerance tolerance = MakeTolerance(function, 1e-2);
  const FunctionRuns runs = FindFunctionRuns(function, tolerance);
  const auto begins = [&](std::size_t node)
  {
    return std::any_of(runs.Runs.begin(), runs.Runs.end(),
      [node](const FunctionRun& run) { return run.First == node; });
  };
  EXPECT_TRUE(begins(colorStep));
  EXPECT_TRUE(begins(attenuationStep));
  for (std::size_t k = 1; k + 1 < function.Nodes.size(); ++k)
  {
    for (const double bend : { 0.15, 0.3, 0.45, 0.8 })
    {
      EXPECT_TRUE(function.Nodes[k].Scalar != bend || begins(k)) << bend;
    }
  }
}

TEST(FunctionRuns, AreTheIntervalsWhereNoErrorIsAllowed)
{
  const TransferFunction function = MakeSmooth(300);
  const IntervalTable exact = MakeIntervalTable(function);
  EXPECT_EQ(exact.Intervals.size(), function.Nodes.size() + 1);
  EXPECT_TRUE(exact.Exact);
  EXPECT_FALSE(exact.Curved);
  for (const OpticalModel model : { OpticalModel::MaximumIntensity, OpticalModel::Isosurfaces })
  {
    const RunTolerance tolerance = MakeRunTolerance(model, function, 1e-2, 1);
    EXPECT_FALSE(tolerance.Allows());
    EXPECT_TRUE(MakeIntervalTable(function, tolerance).Exact);
  }
}

TEST(FunctionRuns, OfAbsorptionAloneHaveNoColors)
{
  const TransferFunction function = MakeSmooth(300);
  const RunTolerance tolerance = MakeRunTolerance(OpticalModel::AbsorptionOnly, function, 1e-4, 1);
  EXPECT_EQ(FindFunctionRuns(function, tolerance).Runs.size(), 5u) << "between bends";
}

TEST(FunctionRuns, KeepColorsFromBelowZero)
{
  // The red of a cubic curve that comes down to 0.
  const TransferFunction function = tetralux::SampleColors(400, 1,
    [](double t, double(&rgb)[3])
    {
      rgb[0] = std::abs((t - 0.6) * (t - 0.6) * (t - 0.6));
      rgb[1] = rgb[2] = 0.5;
    });
  for (const double error : { 1e-2, 1e-4 })
  {
    const IntervalTable table = MakeIntervalTable(function, MakeTolerance(function, error));
    ASSERT_TRUE(table.Curved);
    EXPECT_LT(table.Intervals.size(), 60u);
    for (std::size_t k = 1; k + 1 < table.Intervals.size(); ++k)
    {
      const IntervalTable::Interval& t = table.Intervals[k];
      for (int i = 0; i <= 1000; ++i)
      {
        const float share = static_cast<float>(i) / 1000;
        const float d = t.Lo + (t.Hi - t.Lo) * share - t.Reference;
        EXPECT_GE(t.Color[0] + d * (t.ColorSlope[0] + d * t.ColorBend[0]), 0.f);
        EXPECT_GE(std::fma(std::fma(t.ColorBend[0], d, t.ColorSlope[0]), d, t.Color[0]), 0.f);
      }
    }
  }
}

// Parts of the nodes are looked through at once.
TEST(FunctionRuns, OfManyNodesFollowEachOther)
{
  constexpr int Nodes = 100000;
  const TransferFunction function = MakeSmooth(Nodes);
  const RunTolerance tolerance = MakeTolerance(function, 1e-4);
  const FunctionRuns runs = FindFunctionRuns(function, tolerance);
  ExpectNear(function, runs, tolerance);
  constexpr std::size_t Parts = 4;
  EXPECT_LE(
    runs.Runs.size(), FindFunctionRuns(MakeSmooth(Nodes / 10), tolerance).Runs.size() + Parts);
}

TEST(FunctionRuns, TakeTimeInProportionToTheNodes)
{
  for (const double error : { 1e-6, 1e-4, 1e-2 })
  {
    for (const int nodes : { 512, 4096, 32768 })
    {
      const TransferFunction function = MakeSmooth(nodes);
      const FunctionRuns runs = FindFunctionRuns(function, MakeTolerance(function, error));
      EXPECT_LE(static_cast<double>(runs.Visits), MostVisitsOfNode * nodes)
        << nodes << " nodes, " << error;
    }
  }
  // Nothing fits together.
  std::mt19937_64 generator(9);
  const TransferFunction noise = tetralux::MakeRandomFunction(generator, 4096, 1, false);
  const FunctionRuns runs = FindFunctionRuns(noise, MakeTolerance(noise, 1e-4));
  EXPECT_LE(runs.Visits, 2 * static_cast<std::int64_t>(noise.Nodes.size()));
}

TEST(FunctionRuns, AreReadFromTheTable)
{
  constexpr double SinglePrecision = 1e-6;
  for (const ColorMap& map : MakeColorMaps(2))
  {
    const RunTolerance tolerance = MakeTolerance(map.Function, 1e-3);
    const IntervalTable table = MakeIntervalTable(map.Function, tolerance);
    const FunctionRuns runs = FindFunctionRuns(map.Function, tolerance);
    ASSERT_EQ(table.Intervals.size(), runs.Runs.size() + 2) << map.Name;
    for (std::size_t k = 0; k < runs.Runs.size(); ++k)
    {
      const FunctionRun& run = runs.Runs[k];
      const IntervalTable::Interval& t = table.Intervals[k + 1];
      for (const double share : { 0., 0.3, 0.5, 1. })
      {
        const double s = (1 - share) * map.Function.Nodes[run.First].Scalar +
          share * map.Function.Nodes[run.Last].Scalar;
        const double d = (s - table.Offset) / table.Scale - t.Reference;
        const TransferFunction::Value expected = Read(map.Function, run, s);
        EXPECT_NEAR(t.Attenuation + d * t.AttenuationSlope, expected.Attenuation, SinglePrecision);
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(t.Color[c] + d * (t.ColorSlope[c] + d * t.ColorBend[c]), expected.Color[c],
            SinglePrecision);
        }
      }
    }
  }
}

} // namespace
