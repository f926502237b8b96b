// SPDX-License-Identifier: BSD-3-Clause
// The oracle's integral over one segment, against quadrature with fifty digits.
#include "ReferenceIntegral.h"
#include "ReferenceScenes.h"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using Precise = boost::multiprecision::cpp_bin_float_50;

struct PreciseSegment
{
  Precise Color[3];
  Precise Alpha;
};

/// Over which attenuation and colour are linear in x = 0..1.
struct PrecisePiece
{
  Precise Begin[4]; ///< colour and attenuation
  Precise End[4];
  Precise Length;

  Precise Value(int channel, const Precise& x) const
  {
    return this->Begin[channel] + (this->End[channel] - this->Begin[channel]) * x;
  }
  Precise OpticalDepth(const Precise& x) const
  {
    return this->Length * (this->Begin[3] * x + (this->End[3] - this->Begin[3]) * x * x / 2);
  }
};

/// What reaches the begin of the piece; channel 3: its alpha.
Precise IntegratePrecisely(const PrecisePiece& piece, int channel)
{
  static boost::math::quadrature::tanh_sinh<Precise> rule(12);
  const Precise depth = piece.OpticalDepth(1);
  if (depth == 0)
  {
    return 0;
  }
  // exp(-100) is 4e-44: beyond any digit that counts.
  Precise sum = 0;
  Precise begin = 0;
  for (int k = 0; k < 5 && begin < 1; ++k)
  {
    Precise end = 1;
    if (depth > 20 * (k + 1))
    {
      Precise low = begin;
      Precise high = 1;
      for (int bisection = 0; bisection < 120; ++bisection)
      {
        const Precise middle = (low + high) / 2;
        (piece.OpticalDepth(middle) < 20 * (k + 1) ? low : high) = middle;
      }
      end = high;
    }
    const Precise halfWidth = (end - begin) / 2;
    const auto integrand = [&](const Precise& y) -> Precise { // y = -1..1
      const Precise x = begin + (1 + y) * halfWidth;
      const Precise value = channel == 3 ? Precise(1) : piece.Value(channel, x);
      return value * piece.Value(3, x) * exp(-piece.OpticalDepth(x));
    };
    sum += rule.integrate(integrand, Precise(1e-22)) * halfWidth * piece.Length;
    begin = end;
  }
  return sum;
}

PreciseSegment IntegratePrecisely(
  const TransferFunction& function, double s0, double s1, double length)
{
  const auto& nodes = function.Nodes;
  std::vector<Precise> cuts{ 0, 1 };
  for (const auto& node : nodes)
  {
    if ((node.Scalar > s0 && node.Scalar < s1) || (node.Scalar < s0 && node.Scalar > s1))
    {
      cuts.push_back((Precise(node.Scalar) - s0) / (Precise(s1) - s0));
    }
  }
  std::sort(cuts.begin(), cuts.end());

  PreciseSegment result{};
  Precise transmittance = 1;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    const auto scalar = [&](const Precise& x) -> Precise { return s0 + (Precise(s1) - s0) * x; };
    const Precise middle = scalar((cuts[i] + cuts[i + 1]) / 2);
    std::size_t k = 0;
    while (k < nodes.size() && nodes[k].Scalar <= middle)
    {
      ++k;
    }
    const auto value = [&](const Precise& s, int channel) -> Precise
    {
      const auto get = [channel](const TransferFunction::Value& v) -> Precise
      { return channel == 3 ? v.Attenuation : v.Color[channel]; };
      if (k == 0 || k == nodes.size())
      {
        return get(k == 0 ? nodes.front().Left : nodes.back().Right);
      }
      const Precise w =
        (s - nodes[k - 1].Scalar) / (Precise(nodes[k].Scalar) - nodes[k - 1].Scalar);
      return (1 - w) * get(nodes[k - 1].Right) + w * get(nodes[k].Left);
    };
    PrecisePiece piece;
    piece.Length = (cuts[i + 1] - cuts[i]) * length;
    for (int channel = 0; channel < 4; ++channel)
    {
      piece.Begin[channel] = value(scalar(cuts[i]), channel);
      piece.End[channel] = value(scalar(cuts[i + 1]), channel);
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      result.Color[channel] += transmittance * IntegratePrecisely(piece, channel);
    }
    const Precise alpha = IntegratePrecisely(piece, 3);
    result.Alpha += transmittance * alpha;
    transmittance *= exp(-piece.OpticalDepth(1));
  }
  return result;
}

double RelativeError(double value, const Precise& expected)
{
  return expected == 0 ? std::abs(value)
                       : static_cast<double>(abs(value - expected) / abs(expected));
}

/// The largest relative error of the four channels; fails above 1e-12.
double CheckSegment(const TransferFunction& function, double s0, double s1, double length)
{
  const ReferenceSegment segment = IntegrateReference(function, s0, s1, length);
  const PreciseSegment expected = IntegratePrecisely(function, s0, s1, length);
  double error = RelativeError(segment.Alpha, expected.Alpha);
  for (int channel = 0; channel < 3; ++channel)
  {
    error = std::max(error, RelativeError(segment.Color[channel], expected.Color[channel]));
  }
  EXPECT_LT(error, 1e-12) << "s0 " << s0 << " s1 " << s1 << " length " << length;
  return error;
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsAtEveryOpticalDepthAndSlope)
{
  const double slopes[][2] = { { 1, 1 }, { 0, 1 }, { 1, 0 }, { 1, 1.0000001 }, { 1.0000001, 1 },
    { 1e-6, 1 }, { 1, 1e-6 } };
  double largest = 0;
  for (double depth = 1e-12; depth < 2e6; depth *= 10)
  {
    for (const auto& slope : slopes)
    {
      const double scale = 2 * depth / (slope[0] + slope[1]);
      const TransferFunction function = MakeLinearFunction(
        { { 0, 1, 0, 0.3, scale * slope[0] }, { 1, 0, 1, 0.7, scale * slope[1] } });
      largest = std::max(largest, CheckSegment(function, 0, 1, 1));
    }
  }
  RecordProperty("LargestRelativeError", std::to_string(largest * 1e15) + "e-15");
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsAcrossNeedles)
{
  for (const double width : { 1e-3, 1e-9, 1e-14 })
  {
    for (const double depth : { 1e-12, 0.3, 30.0, 1e6 })
    {
      const TransferFunction function = MakeLinearFunction({ { 0, 0.1, 0.2, 0.3, 0 },
        { 0.5 - width, 0.4, 0.1, 0.9, 0 }, { 0.5, 1, 0, 0.5, depth / width },
        { 0.5 + width, 0, 0.8, 0.5, 0 }, { 1, 0.2, 0.2, 0.2, 0 } });
      CheckSegment(function, -0.5, 1.5, 2);
      CheckSegment(function, 1.5, -0.5, 2);
      CheckSegment(function, 0.5, 1.0, 1e-3);
      CheckSegment(function, 0.5 - width / 4, 0.5 + width / 2, 1);
    }
  }
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsForNearlyEqualScalars)
{
  const TransferFunction function = MakeFunctionWithSteps();
  for (const double s : { 0.0, 0.1, 0.4, 0.7, 1.0, 1e5 })
  {
    for (const double difference : { 1e-16, 1e-15, 1e-12, 1e-8, 1e-4 })
    {
      CheckSegment(function, s, s + difference, 0.7);
      CheckSegment(function, s + difference, s, 0.7);
      CheckSegment(function, s - difference, s + difference, 0.7);
      CheckSegment(function, s + difference, s - difference, 0.7);
    }
    CheckSegment(function, s, s, 0.7);
  }
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsForRandomFunctions)
{
  std::mt19937_64 generator(20);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int example = 0; example < 60; ++example)
  {
    TransferFunction function;
    const auto randomValue = [&]() -> TransferFunction::Value
    {
      const double attenuation = unit(generator) < 0.2 ? 0 : std::pow(10, 8 * unit(generator) - 5);
      return { { unit(generator), unit(generator), unit(generator) }, attenuation };
    };
    double scalar = -3;
    const int numberOfNodes = 1 + static_cast<int>(8 * unit(generator));
    for (int node = 0; node < numberOfNodes; ++node)
    {
      scalar += std::pow(10, 4 * unit(generator) - 4);
      const TransferFunction::Value left = randomValue();
      function.Nodes.push_back({ scalar, left, unit(generator) < 0.5 ? left : randomValue() });
    }
    const double s0 = -3.5 + (scalar + 4) * unit(generator);
    const double s1 = -3.5 + (scalar + 4) * unit(generator);
    CheckSegment(function, s0, s1, std::pow(10, 3 * unit(generator) - 2));
  }
}

TEST(ReferenceIntegral, ConstantScalarAtAStepTakesTheRightValue)
{
  const ReferenceSegment segment = IntegrateReference(MakeFunctionWithSteps(), 0.4, 0.4, 0.5);
  EXPECT_NEAR(segment.Alpha, 1 - std::exp(-3.5), 1e-15);
  EXPECT_NEAR(segment.Color[1], 0.6 * (1 - std::exp(-3.5)), 1e-15);
}

TEST(ReferenceIntegral, FindsTheFirstContribution)
{
  const TransferFunction function = MakeFunctionWithSteps();
  EXPECT_DOUBLE_EQ(IntegrateReference(function, 0.1, 0.5, 1).FirstContribution, 0.75);
  EXPECT_DOUBLE_EQ(IntegrateReference(function, 0.5, 0.1, 1).FirstContribution, 0);
  EXPECT_EQ(IntegrateReference(function, 0.1, 0.3, 1).FirstContribution, -1);
  EXPECT_EQ(IntegrateReference(function, 0.1, 0.3, 1).Alpha, 0);
  EXPECT_EQ(IntegrateReference(function, 2, 3, 0).FirstContribution, -1);
}

} // namespace
