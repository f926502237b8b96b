// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/SpecialFunctions.h"

#include <array>
#include <cmath>

namespace tetralux
{

double Erfcx(double x)
{
  // (1 + 2 x) erfcx(x) is smooth in t = (x - K) / (x + K), which takes [0, infinity) to [-1, 1]
  // (M. M. Shepherd and J. G. Laframboise, Chebyshev approximation of (1 + 2x) exp(x^2) erfc x,
  // Mathematics of Computation 36, 1981; K as there). The coefficients of the Chebyshev polynomials
  // were computed anew, in 60 digits; the first one left out is 2e-18.
  constexpr double K = 3.75;
  static constexpr double c[] = { 1.1775789345674017541, -0.0045900545806464773309,
    -0.084249133366517915584, 0.059209939998191890498, -0.026658668435305752277,
    0.0090749976707052650939, -0.0024131635404176081909, 0.00049077583652580863229,
    -0.000069169733025012063671, 4.1390279860730101675e-6, 7.7403830661984906686e-7,
    -2.1886401049234395661e-7, 1.0764999465670910377e-8, 4.5219598112182868979e-9,
    -7.7544002088313511065e-10, -6.3180883408866844944e-11, 2.8687950109306698981e-11,
    1.945586854577734723e-13, -9.6546967484334389059e-13, 3.2525481481487398415e-14,
    3.3478119482868053878e-14, -1.8645628804193131015e-15, -1.2507950530688647085e-15,
    7.418235256624043463e-17, 5.0681489047961113168e-17 };
  // t differs from 1 by less than half a rounding: the limit 2 / sqrt(pi) / (1 + 2 x), kept from
  // dividing infinity by infinity.
  constexpr double Large = 1e18;
  const double t = x < Large ? (x - K) / (x + K) : 1;
  // Clenshaw's recurrence.
  double b1 = 0;
  double b2 = 0;
  for (int k = static_cast<int>(std::size(c)) - 1; k > 0; --k)
  {
    const double b = 2 * t * b1 - b2 + c[k];
    b2 = b1;
    b1 = b;
  }
  return (t * b1 - b2 + c[0]) / (1 + 2 * x);
}

namespace
{

/// exp(-((2 i + 1) h)^2), the weights of Rybicki's sum.
struct DawsonWeights
{
  static constexpr int Count = 12;
  static constexpr double Step = 0.25; ///< h
  std::array<double, Count> Values;

  DawsonWeights()
  {
    for (int i = 0; i < Count; ++i)
    {
      const double y = (2 * i + 1) * Step;
      this->Values[i] = std::exp(-y * y);
    }
  }
};

} // namespace

double Dawson(double x)
{
  const double y = x * x;
  if (x < 0.5)
  {
    // The sum of (-2 y)^k / (2k+1)!! times x; the first term left out is 4e-18.
    double sum = 0;
    for (int k = 13; k > 0; --k)
    {
      sum = (1 + sum) * (-2 * y / (2 * k + 1));
    }
    return x * (1 + sum);
  }
  if (x > 10)
  {
    // The sum of (2k-1)!! / (2 y)^k over 2 x; the first term left out is 2e-17. From 1e9 on only 1
    // is left, and y need not be finite.
    const double z = x < 1e9 ? 0.5 / y : 0;
    double sum = 0;
    for (int k = 11; k > 0; --k)
    {
      sum = (1 + sum) * ((2 * k - 1) * z);
    }
    return (1 + sum) * (0.5 / x);
  }
  // The trapezoidal rule converges exponentially here: the sum over odd n of
  // exp(-(x - n h)^2) / n, over sqrt(pi), has an error of exp(-(pi / 2 h)^2), 7e-18 for h = 1/4
  // (G. B. Rybicki, Dawson's integral and the sampling theorem, Computers in Physics 3, 1989). It
  // is summed around the even n0 that is nearest to x / h.
  static const DawsonWeights weights;
  constexpr double h = DawsonWeights::Step;
  const double n0 = 2 * std::nearbyint(0.5 * x / h);
  const double rest = x - n0 * h;
  double grow = std::exp(2 * rest * h);
  const double ratio = grow * grow;
  double sum = 0;
  double above = n0 + 1;
  double below = n0 - 1;
  for (const double weight : weights.Values)
  {
    sum += weight * (grow / above + 1 / (below * grow));
    above += 2;
    below -= 2;
    grow *= ratio;
  }
  constexpr double RootOfPi = 1.7724538509055160273;
  return sum * std::exp(-rest * rest) / RootOfPi;
}

} // namespace tetralux
