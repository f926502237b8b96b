// SPDX-License-Identifier: BSD-3-Clause
// Polynomials through values of a function.
#include "Preparation/ValueCurve.h"
#include "Preparation/ValueInterpolant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace tetralux
{
namespace
{

/// Rounding of coefficients that are sums of some hundred times the values, about 1 each.
constexpr double Rounding = 1e-12;

constexpr int Parts = 8;

/// A polynomial of each channel, by coefficients in -1..1.
template <int Degree>
struct Polynomial
{
  explicit Polynomial(std::mt19937_64& random)
  {
    std::uniform_real_distribution<double> coefficient(-1, 1);
    for (auto& channel : this->Coefficients)
    {
      std::generate(channel, channel + Degree + 1, [&] { return coefficient(random); });
    }
  }

  double Evaluate(int channel, double t) const
  {
    double value = 0;
    for (int k = Degree; k >= 0; --k)
    {
      value = this->Coefficients[channel][k] + t * value;
    }
    return value;
  }

  TransferFunction::Value Evaluate(double t) const
  {
    return { { this->Evaluate(0, t), this->Evaluate(1, t), this->Evaluate(2, t) },
      this->Evaluate(3, t) };
  }

  double Coefficients[ValueCurve::Channels][Degree + 1];
};

template <class Curve, class Exact>
void ExpectSame(const Curve& curve, const Exact& exact)
{
  for (double t = 0; t <= 1; t += 1. / 64)
  {
    const TransferFunction::Value a = curve.Evaluate(t);
    const TransferFunction::Value b = exact.Evaluate(t);
    for (int c = 0; c < ValueCurve::Channels; ++c)
    {
      EXPECT_NEAR(ValueCurve::Get(a, c), ValueCurve::Get(b, c), Rounding) << t;
    }
  }
}

TEST(ValueCurve, HasPolynomialsOfDegreeFour)
{
  std::mt19937_64 random(1);
  for (int example = 0; example < 20; ++example)
  {
    const Polynomial<4> exact(random);
    std::array<TransferFunction::Value, 5> values;
    for (int k = 0; k < 5; ++k)
    {
      values[k] = exact.Evaluate(k / 4.);
    }
    const ValueCurve curve(values);
    ExpectSame(curve, exact);
    for (int c = 0; c < ValueCurve::Channels; ++c)
    {
      // Brute force comes as near as its steps: bends change by less than 30 in all.
      constexpr int Steps = 10000;
      double largest = 0;
      for (int i = 0; i <= Steps; ++i)
      {
        const double t = static_cast<double>(i) / Steps;
        const double* p = exact.Coefficients[c];
        largest = std::max(largest, std::abs(2 * p[2] + t * (6 * p[3] + t * 12 * p[4])));
      }
      EXPECT_LE(largest, curve.GetLargestBend(c) + 100 * Rounding);
      EXPECT_GE(largest, curve.GetLargestBend(c) - 30. / Steps);
    }
  }
}

TEST(ValueCurve, OfConstantsHasNoBend)
{
  std::array<TransferFunction::Value, 5> values;
  values.fill({ { 1, 0.5, 0 }, 2 });
  for (int c = 0; c < ValueCurve::Channels; ++c)
  {
    EXPECT_EQ(ValueCurve(values).GetLargestBend(c), 0);
  }
}

TEST(ValueInterpolant, HasPolynomialsOfAsManyParts)
{
  std::mt19937_64 random(2);
  for (int example = 0; example < 20; ++example)
  {
    const Polynomial<Parts> exact(random);
    TransferFunction::Value values[Parts + 1];
    for (int k = 0; k <= Parts; ++k)
    {
      values[k] = exact.Evaluate(static_cast<double>(k) / Parts);
    }
    ExpectSame(ValueInterpolant<Parts>(values), exact);
  }
}

} // namespace
} // namespace tetralux
