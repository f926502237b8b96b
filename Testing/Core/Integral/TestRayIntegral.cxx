// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/RayIntegral.h"
#include "Integral/SpecialFunctions.h"

#include "ReferenceScenes.h"

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <utility>
#include <vector>

// Accuracy over stiff segments is tested by TestStability.cxx.

namespace tetralux
{
namespace
{

using FiftyDigits = boost::multiprecision::cpp_bin_float_50;

/// The sum of (sign)^k (2k-1)!! / (2 x^2)^k over 2 x: Dawson's function with +, erfcx times
/// sqrt(pi) / 2 with -.
FiftyDigits SumAsymptoticSeries(const FiftyDigits& x, int sign)
{
  FiftyDigits sum = 0;
  FiftyDigits term = 1;
  for (int k = 0; k < 60 && abs(term) > 1e-40; ++k)
  {
    sum += term;
    term *= sign * (2 * k + 1) / (2 * x * x);
  }
  return sum / (2 * x);
}

FiftyDigits PreciseErfcx(const FiftyDigits& x)
{
  if (x < 15)
  {
    return exp(FiftyDigits(x * x)) * boost::math::erfc(x);
  }
  return 2 * SumAsymptoticSeries(x, -1) / sqrt(boost::math::constants::pi<FiftyDigits>());
}

FiftyDigits PreciseDawson(const FiftyDigits& x)
{
  if (x > 13)
  {
    return SumAsymptoticSeries(x, 1);
  }
  // exp(-x^2) times the sum of x^(2k+1) / (k! (2k+1)): no term is negative.
  FiftyDigits sum = 0;
  FiftyDigits term = x;
  for (int k = 0; term > 1e-60; ++k)
  {
    sum += term / (2 * k + 1);
    term *= x * x / (k + 1);
  }
  return sum * exp(FiftyDigits(-x * x));
}

template <class Function, class Precise>
double MeasureError(const Function& function, const Precise& precise)
{
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> exponent(-12, 12);
  std::uniform_real_distribution<double> middle(0, 14);
  double largest = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const double x = i % 2 ? middle(generator) : std::pow(10, exponent(generator));
    const FiftyDigits expected = precise(FiftyDigits(x));
    largest = std::max(largest,
      static_cast<double>(abs(FiftyDigits(FiftyDigits(function(x)) - expected)) / expected));
  }
  return largest;
}

TEST(SpecialFunctions, AgreeWithFiftyDigits)
{
  const double erfcx = MeasureError(Erfcx, PreciseErfcx);
  const double dawson = MeasureError(Dawson, PreciseDawson);
  EXPECT_LE(erfcx, SpecialFunctionError);
  EXPECT_LE(dawson, SpecialFunctionError);
  std::cout << "Largest relative error: erfcx " << erfcx << ", Dawson " << dawson << "\n";
}

TEST(SpecialFunctions, EndsOfTheRange)
{
  constexpr double Huge = std::numeric_limits<double>::max();
  EXPECT_DOUBLE_EQ(Erfcx(0), 1);
  EXPECT_EQ(Dawson(0), 0);
  EXPECT_GE(Erfcx(Huge), 0);
  EXPECT_LE(Erfcx(Huge), 1 / Huge);
  EXPECT_DOUBLE_EQ(Dawson(1e300), 0.5e-300);
  EXPECT_GE(Dawson(Huge), 0);
}

/// Red to green to blue, attenuation 1, 3, 0 at the scalars 0, 1, 4; a step at 1 to 2.
TransferFunction MakeFunction()
{
  TransferFunction function =
    MakeLinearFunction({ { 0, 1, 0, 0, 1 }, { 1, 0, 1, 0, 3 }, { 4, 0, 0, 1, 0 } });
  function.Nodes[1].Right.Attenuation = 2;
  return function;
}

void ExpectNear(const SegmentRadiance& actual, const SegmentRadiance& expected, double error)
{
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(actual.Color[c], expected.Color[c], error);
  }
  EXPECT_NEAR(actual.Opacity, expected.Opacity, error);
  EXPECT_NEAR(actual.Transmittance, expected.Transmittance, error);
}

/// Sums of a few numbers up to 1.
constexpr double Rounding = 4e-15;

TEST(RayIntegral, PartsOfASegmentAddUp)
{
  const TransferFunction function = MakeFunction();
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> scalar(-1, 5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 300; ++i)
  {
    const double sf = scalar(generator);
    const double sb = scalar(generator);
    const double w = share(generator);
    const double middle = sf + w * (sb - sf);
    for (const auto integrate : { IntegrateEmissionAbsorption, IntegrateAbsorptionOnly })
    {
      SegmentRadiance parts = integrate(function, sf, middle, 2 * w);
      parts.AddBehind(integrate(function, middle, sb, 2 * (1 - w)));
      ExpectNear(parts, integrate(function, sf, sb, 2), Rounding);
    }
  }
}

TEST(RayIntegral, ModelsAgreeOnWhatTheyShare)
{
  const TransferFunction function = MakeFunction();
  const std::pair<double, double> ends[] = { { -1, 5 }, { 5, -1 }, { 0.5, 2 }, { 1, 1 } };
  for (const auto& [sf, sb] : ends)
  {
    const SegmentRadiance full = IntegrateEmissionAbsorption(function, sf, sb, 1.5);
    const SegmentRadiance smoke = IntegrateAbsorptionOnly(function, sf, sb, 1.5);
    EXPECT_EQ(smoke.Color[0] + smoke.Color[1] + smoke.Color[2], 0);
    EXPECT_NEAR(smoke.Opacity, full.Opacity, Rounding);
    EXPECT_NEAR(smoke.Transmittance, full.Transmittance, Rounding);

    // The light that thin smoke holds back is of second order.
    constexpr double Thin = 1e-7;
    const SegmentRadiance light = IntegrateEmissionOnly(function, sf, sb, Thin);
    const SegmentRadiance thin = IntegrateEmissionAbsorption(function, sf, sb, Thin);
    EXPECT_EQ(light.Opacity, 0);
    EXPECT_EQ(light.Transmittance, 1);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(light.Color[c], thin.Color[c], 10 * Thin * Thin);
    }
  }
}

TEST(RayIntegral, ConstantsAtAStepTakeTheUpperSide)
{
  const TransferFunction function = MakeFunction();
  EXPECT_NEAR(IntegrateAbsorptionOnly(function, 1, 1, 0.5).Transmittance, std::exp(-1.), Rounding);
  EXPECT_NEAR(IntegrateAbsorptionOnly(function, std::nextafter(1., 0.), 1, 0.5).Transmittance,
    std::exp(-1.5), Rounding);
}

TEST(RayIntegral, NothingComesOfNothing)
{
  const TransferFunction function = MakeFunction();
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  const std::pair<double, double> ends[] = { { NaN, 1 }, { 1, NaN }, { -Infinity, 1 },
    { 0, Infinity } };
  for (const auto& [sf, sb] : ends)
  {
    for (const auto integrate :
      { IntegrateEmissionAbsorption, IntegrateEmissionOnly, IntegrateAbsorptionOnly })
    {
      ExpectNear(integrate(function, sf, sb, 1), SegmentRadiance(), 0);
    }
    const Isosurface surface = { 0.5, { 1, 1, 1 }, 1 };
    ExpectNear(
      IntegrateIsosurfaces(Span<const Isosurface>(&surface, 1), sf, sb), SegmentRadiance(), 0);
  }
  ExpectNear(ClassifyMaximum(function, NaN), SegmentRadiance(), 0);
  ExpectNear(IntegrateEmissionAbsorption(function, 0, 4, 0), SegmentRadiance(), 0);
  ExpectNear(IntegrateEmissionAbsorption(function, 5, 6, 1), SegmentRadiance(), 0);
}

TEST(RayIntegral, ScalarsOfTheWholeRangeOfDouble)
{
  constexpr double Huge = std::numeric_limits<double>::max();
  const TransferFunction function =
    MakeLinearFunction({ { -Huge, 1, 0, 0, 0 }, { 0, 0, 1, 0, 2 }, { Huge, 0, 0, 1, 0 } });
  const TransferFunction same =
    MakeLinearFunction({ { -1, 1, 0, 0, 0 }, { 0, 0, 1, 0, 2 }, { 1, 0, 0, 1, 0 } });
  ExpectNear(IntegrateEmissionAbsorption(function, -Huge, Huge, 1),
    IntegrateEmissionAbsorption(same, -1, 1, 1), Rounding);
}

TEST(RayIntegral, MaximumTakesAttenuationForOpacity)
{
  TransferFunction function = MakeLinearFunction({ { 0, 1, 0, 0, 0 }, { 1, 0, 1, 0.5, 0.8 } });
  ExpectNear(ClassifyMaximum(function, 0.5), { { 0.2, 0.2, 0.1 }, 0.4, 0.6 }, Rounding);
  function.Nodes[1].Right.Attenuation = 3;
  ExpectNear(ClassifyMaximum(function, 2), { { 0, 1, 0.5 }, 1, 0 }, Rounding);
}

TEST(RayIntegral, SurfacesAreCrossedOnceAlongAChain)
{
  const std::vector<Isosurface> surfaces = { { 1, { 1, 0, 0 }, 0.5f }, { 2, { 0, 1, 0 }, 0.25f },
    { 3, { 0, 0, 1 }, 1 } };
  // Up to a value, through it, back to it, down through two.
  const double scalars[] = { 0, 1, 1.5, 1, 1, 2, 2.5, 2.5, 0.5 };
  std::vector<std::size_t> crossed;
  for (std::size_t i = 0; i + 1 < std::size(scalars); ++i)
  {
    ForEachCrossing(Span<const Isosurface>(surfaces), scalars[i], scalars[i + 1],
      [&](std::size_t index, double w)
      {
        crossed.push_back(index);
        EXPECT_NEAR(
          scalars[i] + w * (scalars[i + 1] - scalars[i]), surfaces[index].Value, Rounding);
      });
  }
  EXPECT_EQ(crossed, (std::vector<std::size_t>{ 0, 1, 1, 0 }));

  // Front to back: red over green going up, green over red going down.
  ExpectNear(IntegrateIsosurfaces(surfaces, 0, 2.5), { { 0.5, 0.125, 0 }, 0.625, 0.375 }, Rounding);
  ExpectNear(
    IntegrateIsosurfaces(surfaces, 2.5, 0), { { 0.375, 0.25, 0 }, 0.625, 0.375 }, Rounding);
}

} // namespace
} // namespace tetralux
