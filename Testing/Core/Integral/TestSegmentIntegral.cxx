// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/SegmentIntegral.h"

#include "ReferenceIntegral.h"
#include "ReferenceScenes.h"
#include "Stability/SegmentLanes.h"

#include "BulgeWeight.h"
#include "Optics/BulgeShareError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace tetralux
{

namespace
{

constexpr int NumberOfLanes = 8;
using Lanes = std::array<float, NumberOfLanes>;

/// Relative errors that the functions' comments promise.
constexpr double ExpMinusError = 2e-7;
constexpr double ErfcxError = 3e-7;
constexpr double DawsonError = 8e-7;

constexpr double MinusLogError = 2e-7;
constexpr double MinusLogOfRestError = 3e-7;
constexpr double OneMinusExpError = 3e-7;
constexpr double PowerError = 3e-7;   ///< for each e-fold, and one more for the exponential itself
constexpr double BulgeError = 2.5e-4; ///< absolute

/// Optical depth that is thin, as in SegmentIntegral.h.
constexpr double ThinDepth = 1.5;

/// From here on exp(-x) counts as zero.
constexpr double ExpMinusEnd = 87;

/// From 10^lowest to 10^highest, and 0.
std::vector<float> MakeArguments(double lowest, double highest, int count)
{
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> exponent(lowest, highest);
  std::vector<float> x(count);
  std::generate(
    x.begin(), x.end(), [&] { return static_cast<float>(std::pow(10, exponent(generator))); });
  x[0] = 0;
  return x;
}

/// exp(x^2) erfc(x).
long double PreciseErfcx(long double x)
{
  if (x < 50)
  {
    return std::exp(x * x) * std::erfc(x);
  }
  const long double y = 1 / (2 * x * x);
  const long double rootOfPi = std::sqrt(std::acos(-1.0L));
  return (1 - y * (1 - 3 * y * (1 - 5 * y))) / (x * rootOfPi);
}

/// Dawson's function by series without cancellation.
long double PreciseDawson(long double x)
{
  long double sum = 0;
  if (x < 12)
  {
    // exp(-x^2) times the sum of x^(2k+1) / (k! (2k+1)).
    long double term = x;
    for (int k = 0; k < 1000; ++k)
    {
      sum += term / (2 * k + 1);
      term *= x * x / (k + 1);
    }
    return sum * std::exp(-x * x);
  }
  // The sum of (2k-1)!! / (2 x^2)^k over 2 x; terms shrink for 2k < 2 x^2.
  long double term = 1;
  for (int k = 0; k < 60; ++k)
  {
    sum += term;
    term *= (2 * k + 1) / (2 * x * x);
  }
  return sum / (2 * x);
}

/// The largest relative error of one function over the arguments.
double MeasureError(SegmentLanes::Function function, const std::vector<float>& arguments,
  const std::function<long double(long double)>& precise)
{
  double largest = 0;
  for (std::size_t i = 0; i + NumberOfLanes <= arguments.size(); i += NumberOfLanes)
  {
    Lanes result;
    function(&arguments[i], result.data());
    for (int lane = 0; lane < NumberOfLanes; ++lane)
    {
      const long double expected = precise(arguments[i + lane]);
      const long double difference = std::abs(result[lane] - expected);
      largest =
        std::max(largest, static_cast<double>(expected == 0 ? difference : difference / expected));
      EXPECT_FALSE(std::isnan(result[lane])) << "at " << arguments[i + lane];
    }
  }
  return largest;
}

void Report(const SegmentLanes& lanes, const std::string& what, double error)
{
  std::cout << what << ", " << lanes.Name << ": largest relative error " << error << "\n";
  testing::Test::RecordProperty(what + "-" + lanes.Name, std::to_string(error * 1e9) + "e-9");
}

TEST(SegmentIntegral, FunctionsHaveTheErrorTheyPromise)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    SCOPED_TRACE(lanes.Name);
    std::vector<float> x = MakeArguments(-12, std::log10(ExpMinusEnd), 20000);
    const double expMinus =
      MeasureError(lanes.ExpMinus, x, [](long double y) { return std::exp(-y); });
    EXPECT_LE(expMinus, ExpMinusError);
    Report(lanes, "ExpMinus", expMinus);

    x = MakeArguments(-10, 16, 20000);
    const double erfcx = MeasureError(lanes.Erfcx, x, PreciseErfcx);
    EXPECT_LE(erfcx, ErfcxError);
    Report(lanes, "Erfcx", erfcx);

    const double dawson = MeasureError(lanes.Dawson, x, PreciseDawson);
    EXPECT_LE(dawson, DawsonError);
    Report(lanes, "Dawson", dawson);
  }
}

TEST(SegmentIntegral, OpacitiesKeepTheirRelativeAccuracyNearZero)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    SCOPED_TRACE(lanes.Name);
    std::vector<float> x = MakeArguments(-30, 0, 20000);
    for (std::size_t i = 0; i < x.size(); i += 2)
    {
      x[i] = 1 - std::min(x[i], 0.5f);
    }
    // What the argument itself is rounded by is not the function's error.
    x.erase(std::remove_if(x.begin(), x.end(), [](float y) { return y >= 1; }), x.end());
    x.resize(x.size() / NumberOfLanes * NumberOfLanes);
    const double log =
      MeasureError(lanes.MinusLogOfRest, x, [](long double y) { return -std::log1p(-y); });
    EXPECT_LE(log, MinusLogOfRestError);
    Report(lanes, "MinusLogOfRest", log);
    const Lanes beyond = { 1.f, 1.0000001f, 1.5f, 2.f, 10.f, 1e10f, 1e30f, 3e38f };
    Lanes result;
    lanes.MinusLogOfRest(beyond.data(), result.data());
    EXPECT_EQ(*std::min_element(result.begin(), result.end()), 1e37f) << "nothing comes through";

    x = MakeArguments(-30, std::log10(ExpMinusEnd), 20000);
    const double exp =
      MeasureError(lanes.OneMinusExp, x, [](long double y) { return -std::expm1(-y); });
    EXPECT_LE(exp, OneMinusExpError);
    Report(lanes, "OneMinusExp", exp);
    const Lanes large = { 0.f, 87.f, 1e3f, 1e10f, 1e30f, 1e37f, 3e38f, 88.f };
    lanes.OneMinusExp(large.data(), result.data());
    EXPECT_EQ(result[0], 0);
    EXPECT_EQ(*std::min_element(result.begin() + 1, result.end()), 1);
  }
}

TEST(SegmentIntegral, ShortFunctionsAreTheSameBits)
{
  constexpr float MostOfShortLog = 0.25f; // as in LaneFunctions.h
  constexpr float MostOfShortExp = 0.346f;
  const auto expectSame = [](const auto& one, const auto& other, float most)
  {
    std::vector<float> arguments = MakeArguments(-30, std::log10(most), 20000);
    arguments.resize(arguments.size() / NumberOfLanes * NumberOfLanes);
    arguments.back() = most;
    for (std::size_t i = 0; i < arguments.size(); i += NumberOfLanes)
    {
      Lanes a, b;
      one(arguments.data() + i, a.data());
      other(arguments.data() + i, b.data());
      ASSERT_EQ(a, b) << "from argument " << arguments[i];
    }
  };
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    SCOPED_TRACE(lanes.Name);
    expectSame(lanes.ExpMinus, lanes.ShortExpMinus, MostOfShortExp);
    expectSame(lanes.MinusLogOfRest, lanes.ShortMinusLogOfRest, MostOfShortLog);
    expectSame(lanes.OneMinusExp, lanes.ShortOneMinusExp, MostOfShortExp);
  }
}

TEST(SegmentIntegral, LogarithmsKeepTheirRelativeAccuracyNearOne)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    SCOPED_TRACE(lanes.Name);
    std::vector<float> x = MakeArguments(-30, 0, 20000);
    for (std::size_t i = 0; i < x.size(); i += 2)
    {
      x[i] = 1 - std::min(x[i], 0.5f);
    }
    const double log =
      MeasureError(lanes.MinusLog, x, [](long double y) { return y < 1 ? -std::log(y) : 0; });
    EXPECT_LE(log, MinusLogError);
    Report(lanes, "MinusLog", log);
    const Lanes beyond = { 1.f, 1.0000001f, 1.5f, 2.f, 10.f, 1e10f, 1e30f, 3e38f };
    Lanes result;
    lanes.MinusLog(beyond.data(), result.data());
    EXPECT_EQ(*std::max_element(result.begin(), result.end()), 0) << "no more than 1";
  }
}

TEST(SegmentIntegral, PowersLoseARoundingForEachEFold)
{
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    double worst = 0;
    for (int i = 0; i < 5000; ++i)
    {
      Lanes x, power, result;
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        x[lane] = lane % 2 == 0 ? unit(generator) : 1 - 0.01f * unit(generator);
        power[lane] = std::exp(7 * unit(generator)) * unit(generator);
      }
      lanes.Power(x.data(), power.data(), result.data());
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        const double folds = -power[lane] * std::log(static_cast<double>(x[lane]));
        if (folds < ExpMinusEnd)
        {
          worst = std::max(worst, std::abs(result[lane] / std::exp(-folds) - 1) / (1 + folds));
        }
      }
    }
    EXPECT_LE(worst, PowerError);
    Report(lanes, "Power", worst);
  }
}

// Against quadrature, over all thin segments.
TEST(SegmentIntegral, WeightsOfBulges)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    double worst = 0;
    for (int i = 1; i <= 60; ++i)
    {
      const double depth = ThinDepth * i / 60;
      Lanes d0, d1, share;
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        d0[lane] = static_cast<float>(2 * depth * lane / (NumberOfLanes - 1));
        d1[lane] = static_cast<float>(2 * depth) - d0[lane];
      }
      lanes.FindBulgeShare(d0.data(), d1.data(), share.data());
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        // The midpoint rule, whose error is below 1e-7 with so many steps.
        constexpr int Steps = 2000;
        double opacity = 0;
        double bulge = 0;
        for (int step = 0; step < Steps; ++step)
        {
          const double w = (step + 0.5) / Steps;
          const double slope = static_cast<double>(d1[lane]) - d0[lane];
          const double weight =
            (d0[lane] + slope * w) * std::exp(-w * (d0[lane] + slope * w / 2)) / Steps;
          opacity += weight;
          bulge += weight * 4 * w * (1 - w);
        }
        worst = std::max(worst, std::abs(share[lane] - bulge / opacity));
      }
    }
    EXPECT_LE(worst, BulgeError);
    Report(lanes, "FindBulgeShare", worst);
  }
}

TEST(SegmentIntegral, ExpMinusIsZeroFarOut)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    const Lanes x = { 87.f, 88.f, 127.f, 1e3f, 1e10f, 1e30f, 3e38f,
      std::numeric_limits<float>::infinity() };
    Lanes result;
    lanes.ExpMinus(x.data(), result.data());
    for (const float value : result)
    {
      EXPECT_EQ(value, 0.f) << lanes.Name;
    }
  }
}

/// Optical depths at both ends of eight segments.
struct Ends
{
  Lanes Front, Back;
};

/// Every optical depth from 1e-12 to 1e12, most of them where the forms change over, with every
/// ratio of the two ends.
std::vector<Ends> MakeEnds(int count)
{
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto draw = [&](double& front, double& back)
  {
    const double exponent =
      unit(generator) < 0.5 ? 24 * unit(generator) - 12 : 3 * unit(generator) - 1.5;
    const double depth = std::pow(10, exponent);
    double share = 0.5; // of the front end
    switch (generator() % 6)
    {
      case 0:
        share = unit(generator);
        break;
      case 1:
        share = std::pow(10, -12 * unit(generator));
        break;
      case 2:
        share = 0.5 + 0.5 * std::pow(10, -7 * unit(generator));
        break;
      case 3:
        share = 0;
        break;
      case 4:
        share = 0.5;
        break;
      default: // a few units in the last place from equal
        share = 0.5 * (1 + static_cast<double>(generator() % 9) / (1 << 23));
        break;
    }
    front = 2 * depth * share;
    back = 2 * depth * (1 - share);
    if (generator() % 2)
    {
      std::swap(front, back);
    }
  };
  std::vector<Ends> all(count);
  for (Ends& ends : all)
  {
    for (int lane = 0; lane < NumberOfLanes; ++lane)
    {
      double front, back;
      draw(front, back);
      ends.Front[lane] = static_cast<float>(front);
      ends.Back[lane] = static_cast<float>(back);
    }
  }
  return all;
}

/// The weights by quadrature: colour red at the front end and green at the back end.
ReferenceSegment GetWeights(double front, double back)
{
  return IntegrateReference(
    MakeLinearFunction({ { 0, 1, 0, 0, front }, { 1, 0, 1, 0, back } }), 0, 1, 1);
}

TEST(SegmentIntegral, WeightsAgreeWithQuadrature)
{
  const std::vector<SegmentLanes> sets = GetSegmentLanes();
  std::vector<double> largest(sets.size(), 0.);
  for (const Ends& ends : MakeEnds(2000))
  {
    std::array<ReferenceSegment, NumberOfLanes> expected;
    for (int lane = 0; lane < NumberOfLanes; ++lane)
    {
      expected[lane] = GetWeights(ends.Front[lane], ends.Back[lane]);
    }
    for (std::size_t set = 0; set < sets.size(); ++set)
    {
      Lanes front, back, transmittance;
      sets[set].IntegrateSegment(
        ends.Front.data(), ends.Back.data(), front.data(), back.data(), transmittance.data());
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        SCOPED_TRACE(sets[set].Name + std::string(": ") + std::to_string(ends.Front[lane]) +
          " to " + std::to_string(ends.Back[lane]));
        const double alpha = expected[lane].Alpha;
        ASSERT_GE(front[lane], 0.f);
        ASSERT_GE(back[lane], 0.f);
        ASSERT_GE(transmittance[lane], 0.f);
        ASSERT_LE(transmittance[lane], 1.f);
        const double error = std::max(std::abs(front[lane] - expected[lane].Color[0]),
                               std::abs(back[lane] - expected[lane].Color[1])) /
          alpha;
        ASSERT_LE(error, SegmentWeightError);
        largest[set] = std::max(largest[set], error);
        // A constant colour must not change along a chain of segments.
        const double sum = static_cast<double>(front[lane]) + back[lane];
        ASSERT_LE(std::abs(sum - alpha), SegmentWeightError * alpha);
        ASSERT_LE(std::abs(transmittance[lane] - (1 - alpha)), SegmentWeightError);
      }
    }
  }
  for (std::size_t set = 0; set < sets.size(); ++set)
  {
    Report(sets[set], "Weights", largest[set]);
  }
}

// Of any depth; the other weights are those of IntegrateSegment.
TEST(SegmentIntegral, WeightsOfBulgesAgreeWithQuadrature)
{
  const std::vector<SegmentLanes> sets = GetSegmentLanes();
  std::vector<double> largest(sets.size(), 0.);
  for (const Ends& ends : MakeEnds(400))
  {
    Lanes expected;
    for (int lane = 0; lane < NumberOfLanes; ++lane)
    {
      expected[lane] =
        static_cast<float>(tetralux::GetBulgeWeight(ends.Front[lane], ends.Back[lane]));
    }
    for (std::size_t set = 0; set < sets.size(); ++set)
    {
      Lanes front, back, transmittance, curvedFront, curvedBack, bulge;
      sets[set].IntegrateSegment(
        ends.Front.data(), ends.Back.data(), front.data(), back.data(), transmittance.data());
      sets[set].IntegrateCurvedSegment(
        ends.Front.data(), ends.Back.data(), curvedFront.data(), curvedBack.data(), bulge.data());
      EXPECT_EQ(front, curvedFront);
      EXPECT_EQ(back, curvedBack);
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        const double opacity = static_cast<double>(front[lane]) + back[lane];
        const double error = std::abs(static_cast<double>(bulge[lane]) - expected[lane]) / opacity;
        ASSERT_LE(error, tetralux::BulgeShareError)
          << sets[set].Name << ": " << ends.Front[lane] << " to " << ends.Back[lane] << ", "
          << bulge[lane] << " instead of " << expected[lane];
        largest[set] = std::max(largest[set], error);
      }
    }
  }
  for (std::size_t set = 0; set < sets.size(); ++set)
  {
    Report(sets[set], "Weights of bulges", largest[set]);
  }
}

TEST(SegmentIntegral, ConstantSegmentsKeepTheirRelativeAccuracy)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    const std::vector<float> depths = MakeArguments(-30, 30, 20000);
    double largest = 0;
    for (std::size_t i = 0; i + NumberOfLanes <= depths.size(); i += NumberOfLanes)
    {
      Lanes opacity, transmittance;
      lanes.IntegrateConstant(&depths[i], opacity.data(), transmittance.data());
      for (int lane = 0; lane < NumberOfLanes; ++lane)
      {
        const double depth = depths[i + lane];
        const double expected = -std::expm1(-depth);
        const double error = std::abs(opacity[lane] - expected);
        largest = std::max(largest, expected > 0 ? error / expected : error);
        EXPECT_NEAR(transmittance[lane], std::exp(-depth), SegmentWeightError);
      }
    }
    EXPECT_LE(largest, SegmentWeightError) << lanes.Name;
    Report(lanes, "Opacity", largest);
  }
}

TEST(SegmentIntegral, EmptySegmentsAddNothing)
{
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    const Lanes zero{};
    Lanes front, back, transmittance;
    lanes.IntegrateSegment(
      zero.data(), zero.data(), front.data(), back.data(), transmittance.data());
    EXPECT_EQ(front, zero) << lanes.Name;
    EXPECT_EQ(back, zero) << lanes.Name;
    for (const float t : transmittance)
    {
      EXPECT_EQ(t, 1.f) << lanes.Name;
    }
  }
}

TEST(SegmentIntegral, HugeDepthsStayFinite)
{
  // The largest depths that the kernels hand over, and the smallest.
  constexpr float Huge = 1e30f;
  constexpr float Tiny = std::numeric_limits<float>::denorm_min();
  const Lanes d0 = { Huge, 0.f, Huge, Huge, 1.f, Tiny, 0.f, Huge };
  const Lanes d1 = { Huge, Huge, 0.f, 1.f, Huge, 0.f, Tiny, Tiny };
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    Lanes front, back, transmittance;
    lanes.IntegrateSegment(d0.data(), d1.data(), front.data(), back.data(), transmittance.data());
    for (int lane = 0; lane < NumberOfLanes; ++lane)
    {
      const bool opaque = d0[lane] == Huge || d1[lane] == Huge;
      EXPECT_EQ(transmittance[lane], opaque ? 0.f : 1.f) << lanes.Name << " " << lane;
      EXPECT_GE(front[lane], 0.f) << lanes.Name << " " << lane;
      EXPECT_GE(back[lane], 0.f) << lanes.Name << " " << lane;
      EXPECT_NEAR(front[lane] + back[lane], opaque ? 1. : 0., SegmentWeightError)
        << lanes.Name << " " << lane;
    }
    // From 0 to a huge end all of the light is gone after an infinitely short way.
    EXPECT_NEAR(front[1], 1., SegmentWeightError) << lanes.Name;
  }
}

} // namespace
} // namespace tetralux
