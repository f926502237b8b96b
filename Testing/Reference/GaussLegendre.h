// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GaussLegendre_h
#define tetralux_GaussLegendre_h

#include <array>
#include <cmath>

namespace tetralux
{

/// Gauss-Legendre points and weights on 0..1. Ten points integrate a quadratic polynomial times the
/// exponential of a quadratic one that falls by at most 1 to the last bit of a double.
struct GaussLegendre
{
  static constexpr int Order = 10;
  std::array<double, Order> Points; ///< ascending
  std::array<double, Order> Weights;

  /// The integral from 0 to point i of the polynomial through the values at all points is the sum
  /// of Partial[i][j] times value j.
  std::array<std::array<double, Order>, Order> Partial;

  GaussLegendre()
  {
    const long double pi = std::acos(-1.0L);
    long double values[Order][Order + 1]; // of Legendre polynomials 0 to Order at the points
    for (int i = 0; i < Order; ++i)
    {
      // Newton's method on the Legendre polynomial, from Tricomi's estimate of its root.
      long double x = -std::cos(pi * (i + 0.75L) / (Order + 0.5L));
      long double derivative = 1;
      for (int iteration = 0; iteration < 20; ++iteration)
      {
        const long double value = EvaluateLegendre(x, values[i]);
        derivative = Order * (x * value - values[i][Order - 1]) / (x * x - 1);
        x -= value / derivative;
      }
      EvaluateLegendre(x, values[i]);
      this->Points[i] = static_cast<double>((1 + x) / 2);
      this->Weights[i] = static_cast<double>(1 / ((1 - x * x) * derivative * derivative));
    }
    // The polynomial that is 1 at point j and 0 at the others, as a sum of Legendre's.
    for (int i = 0; i < Order; ++i)
    {
      for (int j = 0; j < Order; ++j)
      {
        long double sum = (1 + values[i][1]) / 2;
        for (int m = 1; m < Order; ++m)
        {
          sum += values[j][m] * (values[i][m + 1] - values[i][m - 1]) / 2;
        }
        this->Partial[i][j] = static_cast<double>(this->Weights[j] * sum);
      }
    }
  }

private:
  /// The last one of the polynomials' values at x of -1..1.
  static long double EvaluateLegendre(long double x, long double (&values)[Order + 1])
  {
    values[0] = 1;
    values[1] = x;
    for (int n = 2; n <= Order; ++n)
    {
      values[n] = ((2 * n - 1) * x * values[n - 1] - (n - 1) * values[n - 2]) / n;
    }
    return values[Order];
  }
};

} // namespace tetralux

#endif
