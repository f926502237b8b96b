// SPDX-License-Identifier: BSD-3-Clause
#include "ModelRays.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationError.h"
#include "PreIntegration/PreIntegrationTable.h"
#include "PreIntegration/TableChoice.h"
#include "PreIntegration/TexelFormats.h"
#include "ReferenceIntegral.h"
#include "SampleFunctions.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using namespace tetralux;

namespace
{

using Value = TransferFunction::Value;

/// Scalars of a function of 0..1 mapped to lo..hi.
TransferFunction Stretch(TransferFunction function, double lo, double hi)
{
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Scalar = (1 - node.Scalar) * lo + node.Scalar * hi;
  }
  return function;
}

PreIntegrationTable Build(const TransferFunction& function, const PreIntegrationSettings& settings)
{
  PreIntegrationTable table;
  BuildPreIntegrationTable(function, settings, table);
  return table;
}

PreIntegrationSettings MakeSettings(int scalars, int lengths)
{
  PreIntegrationSettings settings;
  settings.ScalarSize = scalars;
  settings.LengthSize = lengths;
  return settings;
}

PreIntegrationSettings MakeLogarithmic(int scalars, int lengths, int steps)
{
  PreIntegrationSettings settings = MakeSettings(scalars, lengths);
  settings.Scale = LengthScale::Logarithmic;
  settings.StepsPerDoubling = steps;
  return settings;
}

double GetDifference(const ReferenceSegment& exact, const float rgba[4])
{
  double difference = std::abs(exact.Alpha - rgba[3]);
  for (int c = 0; c < 3; ++c)
  {
    difference = std::max(difference, std::abs(exact.Color[c] - rgba[c]));
  }
  return difference;
}

/// Whether a texel is on one side of a step, as one of two of the same scalar.
bool IsSideOfStep(const PreIntegrationTable& table, int texel)
{
  const std::vector<double>& texels = table.Scalars.Texels;
  return (texel > 0 && texels[texel - 1] == texels[texel]) ||
    (texel + 1 < table.Scalars.GetSize() && texels[texel + 1] == texels[texel]);
}

/// Largest error of texels, by quadrature; both scalars on the sides of one step apart.
double GetTexelError(
  const TransferFunction& function, const PreIntegrationTable& table, int samples)
{
  std::mt19937_64 generator(7);
  std::uniform_int_distribution<int> texel(0, table.Scalars.GetSize() - 1);
  std::uniform_int_distribution<int> length(0, table.Lengths.Size - 1);
  double worst = 0;
  for (int i = 0; i < samples; ++i)
  {
    const int f = texel(generator);
    const int b = i % 4 == 0 ? f : texel(generator);
    const int r = length(generator);
    const double sf = table.Scalars.Texels[f];
    const double sb = table.Scalars.Texels[b];
    if (sf == sb && IsSideOfStep(table, f))
    {
      continue;
    }
    float rgba[4];
    table.GetTexel(f, b, r, rgba);
    worst = std::max(
      worst, GetDifference(IntegrateReference(function, sf, sb, table.Lengths.GetLength(r)), rgba));
  }
  return worst;
}

/// Not a number, infinite, negative, or more opaque than opaque.
bool IsSound(const float rgba[4])
{
  return std::all_of(rgba, rgba + 4, [](float c) { return std::isfinite(c) && c >= 0; }) &&
    rgba[3] <= 1;
}

bool IsSound(const PreIntegrationTable& table)
{
  const int n = table.Scalars.GetSize();
  float rgba[4];
  for (int r = 0; r < table.Lengths.Size; ++r)
  {
    for (int b = 0; b < n; ++b)
    {
      for (int f = 0; f < n; ++f)
      {
        table.GetTexel(f, b, r, rgba);
        if (!IsSound(rgba))
        {
          return false;
        }
      }
    }
  }
  return true;
}

bool IsIdentical(const PreIntegrationTable& a, const PreIntegrationTable& b)
{
  return a.GetNumberOfBytes() == b.GetNumberOfBytes() && a.Scalars.Texels == b.Scalars.Texels &&
    std::memcmp(a.Texels.GetData(), b.Texels.GetData(), a.GetNumberOfBytes()) == 0;
}

const TexelFormat Formats[] = { TexelFormat::UNorm8, TexelFormat::UNorm16, TexelFormat::Half,
  TexelFormat::Float };

} // namespace

// ------------------------------------------------------------------------------------------------
// Axes

TEST(PreIntegrationTable, ScalarsOfTexelsHaveTheirCoordinates)
{
  std::mt19937_64 generator(1);
  for (int trial = 0; trial < 20; ++trial)
  {
    const TransferFunction function = MakeRandomFunction(generator, 3 + trial, 1, trial % 2 == 1);
    for (const ScalarAxis kind : { ScalarAxis::Uniform, ScalarAxis::Nodes })
    {
      PreIntegrationSettings settings = MakeSettings(100, 2);
      settings.Axis = kind;
      settings.ScalarRange[0] = -0.3;
      settings.ScalarRange[1] = 1.2;
      const ScalarAxisMap axis = MakeScalarAxis(function, settings);
      ASSERT_EQ(axis.GetSize(), 100);
      EXPECT_EQ(axis.Texels.front(), -0.3);
      EXPECT_EQ(axis.Texels.back(), 1.2);
      EXPECT_TRUE(std::is_sorted(axis.Texels.begin(), axis.Texels.end()));
      EXPECT_TRUE(kind == ScalarAxis::Nodes || axis.Intervals.size() == 1);
      for (int i = 0; i < axis.GetSize(); ++i)
      {
        const bool left = i < 99 && axis.Texels[i] == axis.Texels[i + 1];
        const double x = (axis.Texels[i] - axis.Offset) / axis.Scale;
        // Texels are at most 100 roundings of x apart from their coordinates.
        EXPECT_NEAR(axis.GetCoordinate(static_cast<float>(x)), i + (left ? 1 : 0), 2e-3);
      }
      EXPECT_EQ(axis.GetCoordinate(-1e30f), 0);
      EXPECT_EQ(axis.GetCoordinate(1e30f), 99);
      const float nowhere = axis.GetCoordinate(std::numeric_limits<float>::quiet_NaN());
      EXPECT_TRUE(0 <= nowhere && nowhere <= 99);
      for (const TransferFunction::Node& node : function.Nodes)
      {
        EXPECT_TRUE(kind == ScalarAxis::Uniform ||
          std::binary_search(axis.Texels.begin(), axis.Texels.end(), node.Scalar));
      }
    }
  }
}

TEST(PreIntegrationTable, SidesOfAStepAreTwoTexels)
{
  const Value low{ { 1, 0, 0 }, 0.5 }, high{ { 0, 1, 0 }, 2 };
  const TransferFunction function{ { { 0, low, low }, { 0.4, low, high }, { 1, high, high } } };
  const PreIntegrationTable table = Build(function, MakeSettings(32, 16));
  const std::vector<double>& texels = table.Scalars.Texels;
  const int left = static_cast<int>(std::find(texels.begin(), texels.end(), 0.4) - texels.begin());
  ASSERT_LT(left, 31);
  ASSERT_EQ(texels[left + 1], 0.4);
  float rgba[4];
  table.GetTexel(left, left, 15, rgba);
  EXPECT_NEAR(rgba[3], 1 - std::exp(-0.5), 1e-6);
  EXPECT_NEAR(rgba[0], 1 - std::exp(-0.5), 1e-6);
  table.GetTexel(left + 1, left + 1, 15, rgba);
  EXPECT_NEAR(rgba[3], 1 - std::exp(-2.), 1e-6);
  // From one side to the other: half of each, the front first.
  table.GetTexel(left, left + 1, 15, rgba);
  EXPECT_NEAR(rgba[3], 1 - std::exp(-1.25), 1e-6);
  EXPECT_NEAR(rgba[0], 1 - std::exp(-0.25), 1e-6);
  EXPECT_NEAR(rgba[1], std::exp(-0.25) * (1 - std::exp(-1.)), 1e-6);
  // Constant segments close to the step belong to one side.
  for (const double s : { 0.3999, 0.4001 })
  {
    table.Lookup(s, s, 1, rgba);
    EXPECT_NEAR(rgba[3], 1 - std::exp(s < 0.4 ? -0.5 : -2.), 1e-5);
  }
}

TEST(PreIntegrationTable, LengthsOfTexelsHaveTheirCoordinates)
{
  for (const double longest : { 1e-6, 1., 12345. })
  {
    for (const int steps : { 0, 1, 2, 8 })
    {
      PreIntegrationSettings settings = MakeLogarithmic(2, 40, std::max(steps, 1));
      settings.Scale = steps > 0 ? LengthScale::Logarithmic : LengthScale::Linear;
      settings.LongestSegment = longest;
      const LengthAxisMap axis = MakeLengthAxis(settings);
      EXPECT_EQ(axis.GetLength(0), 0);
      EXPECT_NEAR(axis.GetLength(39) / longest, 1, 1e-15);
      for (int r = 0; r + 1 < 40; ++r)
      {
        const double a = axis.GetLength(r);
        const double b = axis.GetLength(r + 1);
        EXPECT_LT(a, b);
        for (const double t : { 0., 0.25, 0.5, 0.9 })
        {
          EXPECT_NEAR(
            axis.GetCoordinate(static_cast<float>(a + t * (b - a))), r + t, 40 * 1.2e-7 * 8);
        }
      }
      EXPECT_EQ(axis.GetCoordinate(static_cast<float>(2 * longest)), 39);
      EXPECT_EQ(axis.GetCoordinate(std::numeric_limits<float>::infinity()), 39);
      EXPECT_EQ(axis.GetCoordinate(std::numeric_limits<float>::quiet_NaN()), 0);
      EXPECT_EQ(axis.GetCoordinate(-1), 0);
    }
  }
}

TEST(PreIntegrationTable, LogarithmicScaleIsThatOfThePaper)
{
  // Equation 1 of Kraus et al. 2004, at the texels, with 8 texels as in figure 6.
  PreIntegrationSettings settings = MakeLogarithmic(2, 8, 1);
  settings.LongestSegment = 64;
  const LengthAxisMap axis = MakeLengthAxis(settings);
  EXPECT_EQ(axis.Delta, 1);
  for (const double length : { 0., 0.25, 1., 2., 4., 8., 16., 32., 64. })
  {
    const double r =
      (std::max(length > 0 ? std::log2(length) : 0, 0.) + std::min(length, 1.)) / 8 + 1. / 16;
    EXPECT_EQ(axis.GetCoordinate(static_cast<float>(length)), 8 * r - 0.5);
  }
}

// ------------------------------------------------------------------------------------------------
// Texels

TEST(PreIntegrationTable, TexelsAreTheIntegral)
{
  std::mt19937_64 generator(2);
  for (int trial = 0; trial < 24; ++trial)
  {
    const double attenuation = std::pow(10, trial % 6 - 2);
    const TransferFunction function =
      MakeRandomFunction(generator, 2 + trial % 7, attenuation, trial % 3 == 0);
    PreIntegrationSettings settings = trial % 2 == 0
      ? MakeSettings(20 + trial % 3, 10 + 30 * (trial % 8))
      : MakeLogarithmic(20 + trial % 3, 30, 1 << trial % 4);
    settings.Axis = trial % 4 < 2 ? ScalarAxis::Nodes : ScalarAxis::Uniform;
    settings.ScalarRange[0] = trial % 5 == 0 ? -0.5 : 0.1;
    settings.ScalarRange[1] = trial % 5 == 1 ? 1.5 : 0.95;
    settings.LongestSegment = 2;
    const PreIntegrationTable table = Build(function, settings);
    EXPECT_LE(GetTexelError(function, table, 1500), table.Bound.Rounding) << "trial " << trial;
    EXPECT_LE(table.Bound.Rounding, 2e-5);
    EXPECT_TRUE(IsSound(table));
  }
}

TEST(PreIntegrationTable, ThinSegmentsKeepTheirRelativeAccuracy)
{
  std::mt19937_64 generator(3);
  const TransferFunction function = MakeRandomFunction(generator, 5, 1e-9, false);
  const PreIntegrationTable table = Build(function, MakeSettings(16, 256));
  for (int r = 1; r < 256; r += 17)
  {
    float rgba[4];
    table.GetTexel(3, 11, r, rgba);
    const ReferenceSegment exact = IntegrateReference(
      function, table.Scalars.Texels[3], table.Scalars.Texels[11], table.Lengths.GetLength(r));
    EXPECT_NEAR(rgba[3] / exact.Alpha, 1, 1e-5);
    EXPECT_NEAR(rgba[0] / exact.Color[0], 1, 1e-5);
  }
}

TEST(PreIntegrationTable, EveryFormatRoundsToItsNearest)
{
  std::mt19937_64 generator(4);
  const TransferFunction function = MakeRandomFunction(generator, 6, 3, true);
  for (const LengthScale scale : { LengthScale::Linear, LengthScale::Logarithmic })
  {
    PreIntegrationSettings settings = MakeSettings(24, 50);
    settings.Scale = scale;
    const PreIntegrationTable exact = Build(function, settings);
    const double steps[] = { 1. / 255, 1. / 65535, 1. / 1024, 0 };
    for (int k = 0; k < 4; ++k)
    {
      settings.Format = Formats[k];
      const PreIntegrationTable table = Build(function, settings);
      EXPECT_EQ(table.GetNumberOfBytes(), 24u * 24 * 50 * GetTexelSize(Formats[k]));
      for (int i = 0; i < 24 * 24 * 50; i += 7)
      {
        float a[4], b[4];
        exact.GetTexel(i % 24, i / 24 % 24, i / 576, a);
        table.GetTexel(i % 24, i / 24 % 24, i / 576, b);
        for (int c = 0; c < 4; ++c)
        {
          const double unit = Formats[k] == TexelFormat::Half ? std::max<double>(a[c], 1e-4) : 1.;
          EXPECT_LE(std::abs(a[c] - b[c]), 0.5001 * steps[k] * unit);
        }
      }
    }
  }
}

TEST(PreIntegrationTable, HalvesAreThoseOfTheStandard)
{
  for (int bits = 0; bits < 0x7c00; ++bits)
  {
    const auto half = static_cast<std::uint16_t>(bits);
    const float value = HalfChannel::Decode(half);
    const int exponent = bits >> 10;
    const double expected =
      exponent == 0 ? std::ldexp(bits, -24) : std::ldexp(1024 + (bits & 1023), exponent - 25);
    ASSERT_EQ(value, expected);
    ASSERT_EQ(HalfChannel::Encode(value), half);
    ASSERT_EQ(HalfChannel::Encode(-value), half | 0x8000);
    // Halfway to the next one: to the even one.
    if (bits + 1 < 0x7c00)
    {
      const float next = HalfChannel::Decode(static_cast<std::uint16_t>(bits + 1));
      const float middle = 0.5f * (value + next);
      ASSERT_EQ(HalfChannel::Encode(middle), bits % 2 == 0 ? bits : bits + 1);
      ASSERT_EQ(HalfChannel::Encode(std::nextafter(middle, next)), bits + 1);
    }
  }
  EXPECT_EQ(HalfChannel::Encode(1e30f), 0x7bff);
}

TEST(PreIntegrationTable, ColorsBeyondOneNeedFloatingPoint)
{
  TransferFunction function = MakeNeedle(0.5, 0.2, 1);
  function.Nodes[2].Left.Color[0] = function.Nodes[2].Right.Color[0] = 3;
  PreIntegrationSettings settings = MakeSettings(16, 16);
  for (const TexelFormat format : Formats)
  {
    settings.Format = format;
    PreIntegrationTable table;
    if (format == TexelFormat::UNorm8 || format == TexelFormat::UNorm16)
    {
      EXPECT_THROW(BuildPreIntegrationTable(function, settings, table), std::invalid_argument);
      continue;
    }
    BuildPreIntegrationTable(function, settings, table);
    EXPECT_LE(GetTexelError(function, table, 500), table.Bound.Rounding);
  }
}

// ------------------------------------------------------------------------------------------------
// Lookups

TEST(PreIntegrationTable, LookupIsTrilinear)
{
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const TransferFunction function = MakeRandomFunction(generator, 5, 3, true);
  for (const TexelFormat format : Formats)
  {
    PreIntegrationSettings settings = MakeLogarithmic(20, 24, 2);
    settings.Format = format;
    const PreIntegrationTable table = Build(function, settings);
    for (int i = 0; i < 2000; ++i)
    {
      const double sf = unit(generator), sb = unit(generator), l = std::pow(unit(generator), 4);
      const auto x = [&table](double s)
      { return static_cast<float>((s - table.Scalars.Offset) / table.Scalars.Scale); };
      const double u[3] = { table.Scalars.GetCoordinate(x(sf)), table.Scalars.GetCoordinate(x(sb)),
        table.Lengths.GetCoordinate(static_cast<float>(l)) };
      const int sizes[3] = { 20, 20, 24 };
      double expected[4] = { 0, 0, 0, 0 };
      for (int corner = 0; corner < 8; ++corner)
      {
        double weight = 1;
        int texel[3];
        for (int a = 0; a < 3; ++a)
        {
          const int lower = std::min(static_cast<int>(u[a]), sizes[a] - 2);
          const bool upper = corner >> a & 1;
          texel[a] = lower + upper;
          weight *= upper ? u[a] - lower : 1 - (u[a] - lower);
        }
        float rgba[4];
        table.GetTexel(texel[0], texel[1], texel[2], rgba);
        for (int c = 0; c < 4; ++c)
        {
          expected[c] += weight * rgba[c];
        }
      }
      float rgba[4];
      table.Lookup(sf, sb, l, rgba);
      for (int c = 0; c < 4; ++c)
      {
        EXPECT_NEAR(rgba[c], expected[c], 1e-6);
      }
    }
  }
}

TEST(PreIntegrationTable, LookupTakesAnyNumbers)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  const double numbers[] = { 0, -0., 1, 0.5, -1e300, 1e300, 1e-300, Infinity, -Infinity, NaN };
  std::mt19937_64 generator(6);
  const TransferFunction function = MakeRandomFunction(generator, 5, 100, true);
  for (const PreIntegrationSettings& settings :
    { MakeSettings(16, 16), MakeLogarithmic(16, 33, 4) })
  {
    const PreIntegrationTable table = Build(function, settings);
    for (const double sf : numbers)
    {
      for (const double sb : numbers)
      {
        for (const double length : numbers)
        {
          float rgba[4];
          table.Lookup(sf, sb, length, rgba);
          EXPECT_TRUE(IsSound(rgba));
        }
      }
    }
  }
}

// ------------------------------------------------------------------------------------------------
// Errors

TEST(PreIntegrationTable, NoSegmentExceedsTheBound)
{
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<TransferFunction> functions = { MakeNeedle(0.4, 0.01, 50),
    MakeNeedle(0.7, 1e-4, 1e3) };
  for (int i = 0; i < 10; ++i)
  {
    functions.push_back(MakeRandomFunction(generator, 3 + i, std::pow(10, i % 4 - 1), i % 2 == 0));
  }
  double sharpest = 1;
  for (std::size_t i = 0; i < functions.size(); ++i)
  {
    for (const ScalarAxis axis : { ScalarAxis::Uniform, ScalarAxis::Nodes })
    {
      for (const TexelFormat format : { TexelFormat::UNorm16, TexelFormat::Float })
      {
        PreIntegrationSettings settings =
          i % 2 == 0 ? MakeSettings(48, 40) : MakeLogarithmic(48, 40, 4);
        settings.Axis = axis;
        settings.Format = format;
        settings.LongestSegment = 0.7;
        const PreIntegrationTable table = Build(functions[i], settings);
        const PreIntegrationError& bound = table.Bound;
        const PreIntegrationError estimate = EstimatePreIntegrationError(functions[i], table, 4000);
        EXPECT_LE(estimate.Segment, bound.Segment);
        EXPECT_LE(estimate.PerLength, bound.PerLength);
        double worst = 0;
        for (int k = 0; k < 3000; ++k)
        {
          const double sf = unit(generator);
          const double sb =
            k % 2 == 0 ? unit(generator) : std::clamp(sf + 0.1 * (unit(generator) - 0.5), 0., 1.);
          const double length = 0.7 * std::pow(unit(generator), 1 + k % 3);
          float rgba[4];
          table.Lookup(sf, sb, length, rgba);
          const double error =
            GetDifference(IntegrateReference(functions[i], sf, sb, length), rgba);
          EXPECT_LE(error, bound.Segment + bound.Rounding);
          EXPECT_LE(error, bound.PerLength * length + bound.Rounding);
          worst = std::max(worst, error);
        }
        // The estimate looks where it matters: random segments are not much worse.
        EXPECT_LE(worst, 3 * estimate.Segment + 2 * estimate.Rounding);
        sharpest = std::min(sharpest, bound.Segment / worst);
      }
    }
  }
  // Somewhere the bound is within a factor of what happens.
  EXPECT_LT(sharpest, 3);
}

TEST(PreIntegrationTable, BoundsFallWithFinerTables)
{
  const Value low{ { 0, 1, 0.5 }, 0.5 }, high{ { 1, 0.5, 0 }, 2 };
  const TransferFunction function{ { { 0, low, low }, { 0.4, high, high }, { 1, low, low } } };
  double last = 1;
  for (const int size : { 16, 32, 64, 128, 256 })
  {
    PreIntegrationSettings settings = MakeSettings(size, size / 4);
    settings.Axis = ScalarAxis::Uniform;
    const PreIntegrationTable table = Build(function, settings);
    EXPECT_LT(table.Bound.Segment, 0.8 * last);
    last = table.Bound.Segment;
  }
  EXPECT_LT(last, 0.03);
}

TEST(PreIntegrationTable, PicturesStayBelowTheirBound)
{
  std::mt19937_64 generator(10);
  const TransferFunction function = MakeRandomFunction(generator, 4, 2, false);
  const PreIntegrationTable table = Build(function, MakeSettings(128, 64));
  RayModel model;
  model.PathLength = 5;
  const double estimate = EstimatePictureError(function, table, DrawModelRays(model));
  EXPECT_GT(estimate, 0);
  EXPECT_LT(estimate, GetPictureError(table.Bound, 6, 400));
  EXPECT_LT(estimate, 3e-3);
}

// ------------------------------------------------------------------------------------------------
// Extremes

TEST(PreIntegrationTable, ExtremesAreSound)
{
  struct Case
  {
    const char* Name;
    TransferFunction Function;
    double Lo, Hi, Longest;
  };
  std::mt19937_64 generator(12);
  const TransferFunction any = MakeRandomFunction(generator, 5, 1, true);
  const auto scale = [](TransferFunction function, double factor)
  {
    for (TransferFunction::Node& node : function.Nodes)
    {
      node.Left.Attenuation *= factor;
      node.Right.Attenuation *= factor;
    }
    return function;
  };
  const TransferFunction one{ { { 3, { { 1, 1, 1 }, 2 }, { { 1, 0, 0 }, 3 } } } };
  const std::vector<Case> cases = {
    { "depth 1e-12", scale(any, 1e-12), 0, 1, 1 },
    { "depth 1e6", scale(any, 1e6), 0, 1, 1 },
    { "depth 1e30", scale(any, 1e30), 0, 1, 1 },
    { "depth 1e100", scale(any, 1e100), 0, 1, 1 },
    { "nothing", scale(any, 0), 0, 1, 1 },
    { "needle narrower than a texel", MakeNeedle(0.4, 1e-6, 1e5), 0, 1, 1 },
    { "opaque needle", MakeNeedle(0.4, 1e-3, 1e12), 0, 1, 1 },
    { "constant field", any, 0.3, 0.3, 1 },
    { "constant field on a step", one, 3, 3, 1 },
    { "one node", one, 0, 10, 1 },
    { "constant field of 1e30", any, 1e30, 1e30, 1 },
    { "scalars of 1e-30", Stretch(any, 0, 1e-30), 0, 1e-30, 1 },
    { "scalars of 1e30", Stretch(any, -1e30, 1e30), -1e30, 1e30, 1 },
    { "range beside the nodes", any, 2, 3, 1 },
    { "short lengths", scale(any, 1e9), 0, 1, 1e-9 },
    { "long lengths", scale(any, 1e-9), 0, 1, 1e9 },
  };
  for (const Case& c : cases)
  {
    for (const bool logarithmic : { false, true })
    {
      for (const ScalarAxis axis : { ScalarAxis::Uniform, ScalarAxis::Nodes })
      {
        const testing::ScopedTrace trace(__FILE__, __LINE__,
          std::string(c.Name) + (logarithmic ? ", logarithmic" : ", linear") +
            (axis == ScalarAxis::Nodes ? ", nodes" : ", uniform"));
        // 2^30: lengths with a ratio of 1e9.
        PreIntegrationSettings settings =
          logarithmic ? MakeLogarithmic(17, 32, 1) : MakeSettings(17, 70);
        settings.Axis = axis;
        settings.ScalarRange[0] = c.Lo;
        settings.ScalarRange[1] = c.Hi;
        settings.LongestSegment = c.Longest;
        const PreIntegrationTable table = Build(c.Function, settings);
        EXPECT_TRUE(IsSound(table));
        EXPECT_TRUE(std::isfinite(table.Bound.Segment) && table.Bound.Segment >= 0);
        EXPECT_TRUE(std::isfinite(table.Bound.Rounding) && table.Bound.Rounding > 0);
        EXPECT_LE(GetTexelError(c.Function, table, 300), table.Bound.Rounding);
        std::uniform_real_distribution<double> unit(0, 1);
        for (int i = 0; i < 100; ++i)
        {
          const auto scalar = [&]() { return c.Lo + unit(generator) * (c.Hi - c.Lo); };
          float rgba[4];
          table.Lookup(scalar(), scalar(), c.Longest * std::pow(10, -9 * unit(generator)), rgba);
          EXPECT_TRUE(IsSound(rgba));
        }
        // A constant field is looked up exactly.
        if (c.Lo == c.Hi)
        {
          float rgba[4];
          table.Lookup(c.Lo, c.Lo, c.Longest, rgba);
          EXPECT_LE(GetDifference(IntegrateReference(c.Function, c.Lo, c.Lo, c.Longest), rgba),
            table.Bound.Rounding);
        }
      }
    }
  }
}

TEST(PreIntegrationTable, ThinSegmentsAreExactOnALogarithmicScale)
{
  // Lengths with a ratio of 1e9; interpolation along the length must not add what is not there.
  const Value v{ { 1, 0.5, 0.25 }, 0.1 };
  const TransferFunction function{ { { 0, v, v }, { 1, v, v } } };
  const PreIntegrationTable table = Build(function, MakeLogarithmic(4, 34, 1));
  for (double length = 1e-9; length < 1e-3; length *= 1.37)
  {
    float rgba[4];
    table.Lookup(0.3, 0.6, length, rgba);
    EXPECT_NEAR(rgba[3] / -std::expm1(-0.1 * length), 1, 2e-5);
  }
}

// ------------------------------------------------------------------------------------------------
// Changes

TEST(PreIntegrationTable, UpdatesEqualRebuilds)
{
  std::mt19937_64 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 24; ++trial)
  {
    PreIntegrationSettings settings =
      trial % 3 == 0 ? MakeLogarithmic(40, 20, 2) : MakeSettings(40, 64);
    settings.Axis = ScalarAxis::Uniform;
    settings.Format = Formats[trial % 4];
    TransferFunction before = MakeRandomFunction(generator, 9, 1, trial % 2 == 0);
    before.Nodes[0].Left.Attenuation = before.Nodes[0].Right.Attenuation = 1.1;
    PreIntegrationTable table = Build(before, settings);
    TransferFunction after = before;
    std::uniform_int_distribution<std::size_t> node(1, 8);
    const std::size_t changed = node(generator);
    after.Nodes[changed].Left.Attenuation = unit(generator);
    after.Nodes[changed].Right.Color[trial % 3] = unit(generator);
    const std::int64_t rebuilt = UpdatePreIntegrationTable(before, after, table);
    EXPECT_TRUE(IsIdentical(table, Build(after, settings))) << "trial " << trial;
    const std::int64_t all = std::int64_t{ 40 } * 40 * settings.LengthSize;
    EXPECT_GT(rebuilt, 0);
    EXPECT_LE(rebuilt, all);
    if (changed == 8)
    {
      EXPECT_LT(rebuilt, all);
    }
    // Nothing changed, nothing to do.
    EXPECT_EQ(UpdatePreIntegrationTable(after, after, table), 0);
  }
}

TEST(PreIntegrationTable, UpdatesTouchOnlySegmentsThatMeetTheChange)
{
  PreIntegrationSettings settings = MakeSettings(101, 20);
  settings.Axis = ScalarAxis::Uniform;
  const auto value = [](double tau) { return Value{ { 1, 0, 0 }, tau }; };
  TransferFunction before;
  for (int k = 0; k <= 10; ++k)
  {
    before.Nodes.push_back({ 0.1 * k, value(0.5), value(0.5) });
  }
  TransferFunction after = before;
  after.Nodes[5].Left = after.Nodes[5].Right = value(0.6);
  PreIntegrationTable table = Build(before, settings);
  // Segments wholly in texels 0..39 or 61..100 do not meet [0.4, 0.6].
  EXPECT_EQ(UpdatePreIntegrationTable(before, after, table), (101 * 101 - 2 * 40 * 40) * 20);
  EXPECT_TRUE(IsIdentical(table, Build(after, settings)));
}

TEST(PreIntegrationTable, UpdatesFollowNodesThatMove)
{
  const PreIntegrationSettings settings = MakeSettings(40, 30);
  const TransferFunction before = MakeNeedle(0.4, 0.01, 50);
  const TransferFunction after = MakeNeedle(0.5, 0.02, 80);
  PreIntegrationTable table = Build(before, settings);
  EXPECT_EQ(UpdatePreIntegrationTable(before, after, table), 40 * 40 * 30);
  EXPECT_TRUE(IsIdentical(table, Build(after, settings)));
}

TEST(PreIntegrationTable, CoarseTablesFit)
{
  PreIntegrationSettings settings = MakeSettings(128, 256);
  const PreIntegrationSettings coarse = GetCoarseSettings(settings, 1 << 20);
  EXPECT_LE(16 * coarse.ScalarSize * coarse.ScalarSize * coarse.LengthSize, 1 << 20);
  EXPECT_GE(coarse.ScalarSize, 32);
  const PreIntegrationTable table = Build(MakeNeedle(0.4, 0.1, 5), coarse);
  EXPECT_LE(table.GetNumberOfBytes(), 1u << 20);
  const PreIntegrationSettings least = GetCoarseSettings(settings, 0);
  EXPECT_EQ(least.ScalarSize, 16);
  EXPECT_EQ(least.LengthSize, 8);
  // What is small enough stays.
  EXPECT_EQ(GetCoarseSettings(settings, std::size_t{ 1 } << 30).ScalarSize, 128);
}

TEST(PreIntegrationTable, ThreadsDoNotMatter)
{
  std::mt19937_64 generator(14);
  const TransferFunction function = MakeRandomFunction(generator, 6, 10, true);
  for (const PreIntegrationSettings& settings :
    { MakeSettings(33, 100), MakeLogarithmic(33, 30, 4) })
  {
    const PreIntegrationTable expected = Build(function, settings);
    ForEachThreadCount(
      [&]()
      {
        const PreIntegrationTable table = Build(function, settings);
        EXPECT_TRUE(IsIdentical(expected, table));
        EXPECT_EQ(expected.Bound.Segment, table.Bound.Segment);
      });
  }
}

// ------------------------------------------------------------------------------------------------
// Wrong settings

TEST(PreIntegrationTable, WrongSettingsAreRefused)
{
  const TransferFunction function = MakeNeedle(0.4, 0.1, 5);
  const auto expectRefused =
    [&](const std::string& word, const std::function<void(PreIntegrationSettings&)>& change)
  {
    PreIntegrationSettings settings = MakeLogarithmic(16, 16, 1);
    change(settings);
    PreIntegrationTable table;
    try
    {
      BuildPreIntegrationTable(function, settings, table);
      ADD_FAILURE() << word << " was not refused";
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  expectRefused("scalar size", [](PreIntegrationSettings& s) { s.ScalarSize = 1; });
  expectRefused("scalar size", [](PreIntegrationSettings& s) { s.ScalarSize = 5000; });
  expectRefused("length size", [](PreIntegrationSettings& s) { s.LengthSize = 1; });
  expectRefused("power of 2", [](PreIntegrationSettings& s) { s.StepsPerDoubling = 3; });
  expectRefused("power of 2", [](PreIntegrationSettings& s) { s.StepsPerDoubling = 16; });
  expectRefused("scalar range", [](PreIntegrationSettings& s) { s.ScalarRange[0] = 2; });
  expectRefused("scalar range", [&](PreIntegrationSettings& s) { s.ScalarRange[1] = NaN; });
  expectRefused("scalar range", [](PreIntegrationSettings& s) { s.ScalarRange[1] = 1e60; });
  expectRefused("longest segment", [](PreIntegrationSettings& s) { s.LongestSegment = 0; });
  expectRefused("longest segment", [&](PreIntegrationSettings& s) { s.LongestSegment = NaN; });
  expectRefused("single precision", [](PreIntegrationSettings& s) { s.LongestSegment = 1e-40; });
  expectRefused("single precision", [](PreIntegrationSettings& s) { s.LengthSize = 400; });
  PreIntegrationTable table;
  EXPECT_THROW(BuildPreIntegrationTable({}, MakeSettings(16, 16), table), std::invalid_argument);
}
