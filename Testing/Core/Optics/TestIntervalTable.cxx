// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/IntervalTable.h"

#include "ReferenceScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using tetralux::Evaluate;
using tetralux::IntervalTable;
using tetralux::MakeIntervalTable;
using tetralux::MakeLinearFunction;
using tetralux::TransferFunction;

/// Values, relative to the largest one, are rounded to single precision three times: at the node,
/// in the slope, and where the scalar is mapped.
constexpr double ValueError = 4. / (1 << 23);

TransferFunction MakeStepFunction()
{
  TransferFunction function;
  function.Nodes = {
    { -2, { { 0.1, 0.9, 0.3 }, 0.5 }, { { 0.8, 0.2, 0.4 }, 0 } },
    { 3, { { 0.7, 0.1, 0 }, 0 }, { { 0.2, 0.6, 1 }, 7 } },
    { 4, { { 0, 1, 0.5 }, 2 }, { { 0.9, 0.9, 0.2 }, 11 } },
  };
  return function;
}

/// What the table says at a scalar: of the last interval that reaches it.
TransferFunction::Value Read(const IntervalTable& table, double scalar)
{
  const double x = (scalar - table.Offset) / table.Scale;
  std::size_t i = table.Intervals.size() - 1;
  while (i > 0 && x < table.Intervals[i].Lo)
  {
    --i;
  }
  const IntervalTable::Interval& interval = table.Intervals[i];
  const double d = x - interval.Reference;
  TransferFunction::Value value;
  value.Attenuation = interval.Attenuation + d * interval.AttenuationSlope;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = interval.Color[c] + d * interval.ColorSlope[c];
  }
  return value;
}

void ExpectSameValue(
  const TransferFunction::Value& actual, const TransferFunction::Value& expected, double error)
{
  EXPECT_NEAR(actual.Attenuation, expected.Attenuation, error);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(actual.Color[c], expected.Color[c], error);
  }
}

std::string GetError(const TransferFunction& function)
{
  try
  {
    MakeIntervalTable(function);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(IntervalTable, EvaluatesBetweenNodesAndBeyondThem)
{
  const TransferFunction function = MakeStepFunction();
  const auto expect = [&](double scalar, double attenuation, double red)
  {
    const TransferFunction::Value value = Evaluate(function, scalar);
    EXPECT_NEAR(value.Attenuation, attenuation, 1e-15) << "at " << scalar;
    EXPECT_NEAR(value.Color[0], red, 1e-15) << "at " << scalar;
  };
  expect(-1e300, 0.5, 0.1);
  expect(std::nextafter(-2., -3.), 0.5, 0.1);
  expect(-2, 0, 0.8); // at a step the value from larger scalars
  expect(0.5, 0, 0.75);
  expect(3, 7, 0.2);
  expect(3.5, 4.5, 0.1);
  expect(4, 11, 0.9);
  expect(1e300, 11, 0.9);
}

TEST(IntervalTable, NodesLieFromMinusOneToOne)
{
  const IntervalTable table = MakeIntervalTable(MakeStepFunction());
  ASSERT_EQ(table.Intervals.size(), 4u);
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(table.Intervals[0].Lo, -Infinity);
  EXPECT_EQ(table.Intervals[0].Hi, -1.f);
  EXPECT_EQ(table.Intervals[3].Lo, 1.f);
  EXPECT_EQ(table.Intervals[3].Hi, Infinity);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(table.Intervals[i].Hi, table.Intervals[i + 1].Lo);
  }
  EXPECT_EQ(table.Offset, 1);
  EXPECT_EQ(table.Scale, 3);
  EXPECT_EQ(table.Intervals[1].Hi, static_cast<float>(2. / 3));
  EXPECT_EQ(table.MaximumAttenuation, 11);
  // 0.5 to 0, 0 to 7, 7 to 2, 2 to 11.
  EXPECT_DOUBLE_EQ(table.AttenuationVariation, 0.5 + 7 + 5 + 9);
  // The kernels gather rows of four floats.
  static_assert(sizeof(IntervalTable::Interval) == 64, "four rows of four floats");
  static_assert(alignof(IntervalTable::Interval) == 16, "rows are loaded aligned");
}

TEST(IntervalTable, ReadsAsTheFunctionDoes)
{
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int example = 0; example < 200; ++example)
  {
    const double unitScale = std::pow(10, 60 * unit(generator) - 30);
    TransferFunction function;
    double scalar = unitScale * (20 * unit(generator) - 10);
    const auto draw = [&]() -> TransferFunction::Value {
      return { { unit(generator), unit(generator), unit(generator) }, unit(generator) };
    };
    for (int node = 0; node < 1 + example % 9; ++node)
    {
      scalar += unitScale * (0.1 + unit(generator));
      const TransferFunction::Value left = draw();
      function.Nodes.push_back({ scalar, left, generator() % 2 ? left : draw() });
    }
    const IntervalTable table = MakeIntervalTable(function);
    const double first = function.Nodes.front().Scalar;
    const double range = scalar - first;
    for (int sample = 0; sample < 50; ++sample)
    {
      const double s = first + range * (1.4 * unit(generator) - 0.2);
      // A node may round to the other side of a scalar that is next to it.
      const bool nearNode = std::any_of(function.Nodes.begin(), function.Nodes.end(),
        [&](const TransferFunction::Node& node)
        { return std::abs(s - node.Scalar) <= ValueError * table.Scale; });
      if (!nearNode)
      {
        // Slopes are up to 1 / 0.1 in units of the scalars, and Scale of them are mapped to 1.
        const double error = ValueError * (1 + 10 * table.Scale / unitScale);
        ExpectSameValue(Read(table, s), Evaluate(function, s), error);
      }
    }
  }
}

TEST(IntervalTable, OneNodeIsAConstant)
{
  for (const double scalar : { 0., 5., -1e300, 1e-300 })
  {
    const TransferFunction function = MakeLinearFunction({ { scalar, 0.25, 0.5, 0.75, 2 } });
    const IntervalTable table = MakeIntervalTable(function);
    EXPECT_GT(table.Scale, 0);
    EXPECT_EQ(table.MaximumAttenuation, 2);
    EXPECT_EQ(table.AttenuationVariation, 0);
    for (const double s : { scalar - 7, scalar, scalar + 7 })
    {
      ExpectSameValue(Read(table, s), function.Nodes[0].Left, 0);
      ExpectSameValue(Evaluate(function, s), function.Nodes[0].Left, 0);
    }
  }
}

TEST(IntervalTable, NodesThatRoundToOneFloatMakeAStep)
{
  // The needle is narrower than single precision resolves; nothing divides by zero.
  const TransferFunction function = MakeLinearFunction(
    { { 0, 0, 0, 0, 1 }, { 0.75, 0, 0, 0, 2 }, { 0.75 + 1e-12, 0, 0, 0, 5 }, { 1, 0, 0, 0, 3 } });
  const IntervalTable table = MakeIntervalTable(function);
  for (const IntervalTable::Interval& interval : table.Intervals)
  {
    EXPECT_TRUE(std::isfinite(interval.AttenuationSlope));
    EXPECT_LE(interval.Lo, interval.Hi);
  }
  EXPECT_NEAR(Read(table, 0.7).Attenuation, Evaluate(function, 0.7).Attenuation, 1e-5);
  EXPECT_NEAR(Read(table, 0.8).Attenuation, Evaluate(function, 0.8).Attenuation, 1e-5);
}

TEST(IntervalTable, RefusesBadFunctionsInOneLine)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(GetError({}), "the transfer function has no nodes; it needs at least one");

  const std::string order =
    "node 1 of the transfer function is not finite or not above the node before it";
  for (const double second : { 0., -1., NaN, Infinity })
  {
    EXPECT_EQ(GetError(MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { second, 0, 0, 0, 0 } })), order);
  }
  EXPECT_EQ(GetError(MakeLinearFunction({ { NaN, 0, 0, 0, 0 } })),
    "node 0 of the transfer function is not finite or not above the node before it");

  const std::string value = "node 1 of the transfer function has a colour or attenuation that is "
                            "not finite or is negative";
  for (const double attenuation : { -1e-9, NaN, Infinity })
  {
    TransferFunction function = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 1, 0, 0, 0, 0 } });
    EXPECT_EQ(GetError(function), "no error");
    function.Nodes[1].Left.Attenuation = attenuation;
    EXPECT_EQ(GetError(function), value);
    function.Nodes[1].Left.Attenuation = 0;
    function.Nodes[1].Right.Attenuation = attenuation;
    EXPECT_EQ(GetError(function), value);
  }
  for (const double color : { NaN, -Infinity })
  {
    EXPECT_EQ(GetError(MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 1, 0, 0, color, 0 } })), value);
  }
}

TEST(IntervalTable, ValuesStayBetweenThoseOfTheNodes)
{
  // As the kernels evaluate it, with the product rounded or not. Half of all values are 0: below
  // that a colour or an attenuation would be negative.
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto draw = [&](double largest)
  { return generator() % 2 ? 0 : largest * std::pow(10, -6 * unit(generator)); };
  for (int i = 0; i < 20000; ++i)
  {
    TransferFunction::Value left = { { draw(1), draw(1), draw(1) }, draw(1e3) };
    TransferFunction::Value right = { { draw(1), draw(1), draw(1) }, draw(1e3) };
    const double scalar = unit(generator);
    const double width = std::pow(10, -7 * unit(generator));
    TransferFunction function;
    function.Nodes = { { -2, left, left }, { scalar, left, left }, { scalar + width, right, right },
      { 2, right, right } };
    const IntervalTable table = MakeIntervalTable(function);
    const IntervalTable::Interval& interval = table.Intervals[2];
    for (const double share : { 0., unit(generator), 0.999999, 1. })
    {
      const auto x = std::clamp(
        static_cast<float>((scalar + share * width) / table.Scale), interval.Lo, interval.Hi);
      const float d = x - interval.Reference;
      const auto expectBetween = [&](float value, float slope, double a, double b)
      {
        const float product = slope * d;
        for (const float result : { std::fma(slope, d, value), product + value })
        {
          ASSERT_GE(result, static_cast<float>(std::min(a, b)));
          ASSERT_LE(result, static_cast<float>(std::max(a, b)));
        }
      };
      expectBetween(
        interval.Attenuation, interval.AttenuationSlope, left.Attenuation, right.Attenuation);
      for (int c = 0; c < 3; ++c)
      {
        expectBetween(interval.Color[c], interval.ColorSlope[c], left.Color[c], right.Color[c]);
      }
    }
  }
}

TEST(IntervalTable, SmallAttenuationsKeepTheirRelativeAccuracy)
{
  // Down to 0 at the upper node, and up from it: next to it only the difference of scalars is left.
  for (const bool falling : { true, false })
  {
    const double ends[] = { falling ? 1e9 : 0, falling ? 0 : 1e9 };
    const IntervalTable table =
      MakeIntervalTable(MakeLinearFunction({ { -1, 1, 1, 1, ends[0] }, { 1, 1, 1, 1, ends[1] } }));
    const IntervalTable::Interval& interval = table.Intervals[1];
    const float x = falling ? std::nextafter(1.f, 0.f) : std::nextafter(-1.f, 0.f);
    const float d = x - interval.Reference;
    const double expected = 1e9 * (1 - std::abs(static_cast<double>(x))) / 2;
    EXPECT_NEAR(
      std::fma(interval.AttenuationSlope, d, interval.Attenuation), expected, 1e-6 * expected);
  }
}

} // namespace
