// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ExtendedIntegral_h
#define tetralux_ExtendedIntegral_h

// The integral over a segment of a ray by quadrature in a type of number that has more digits than
// double: what every form of it is compared with. It shares no code and no formula with them.

#include "Optics/TransferFunction.h"

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <limits>

#if LDBL_MANT_DIG < 64
#include <boost/multiprecision/cpp_bin_float.hpp>
#endif

namespace tetralux
{

/// At least 64 bits: relative rounding below 6e-20. Where long double has no more than double, a
/// hundred times slower numbers of Boost.
#if LDBL_MANT_DIG < 64
using Extended = boost::multiprecision::cpp_bin_float_quad;
#else
using Extended = long double;
#endif

/// TransferFunction::Value in other numbers.
template <class Number>
struct ExtendedValue
{
  Number Color[3];
  Number Attenuation;
};

/// What a segment adds, in front of nothing.
template <class Number>
struct ExtendedRadiance
{
  Number Color[3] = { 0, 0, 0 };    ///< integral of tau c exp(-optical depth)
  Number Emission[3] = { 0, 0, 0 }; ///< integral of tau c
  Number Depth = 0;                 ///< integral of tau
  Number Opacity = 0;               ///< 1 - exp(-Depth)
};

/// The function between nodes k - 1 and k.
template <class Number>
ExtendedValue<Number> EvaluateExtended(
  const TransferFunction& function, std::size_t k, const Number& s)
{
  const auto& nodes = function.Nodes;
  const TransferFunction::Value& left = k > 0 ? nodes[k - 1].Right : nodes.front().Left;
  const TransferFunction::Value& right = k < nodes.size() ? nodes[k].Left : nodes.back().Right;
  Number v = 1;
  Number w = 0;
  if (k > 0 && k < nodes.size())
  {
    const Number lo = nodes[k - 1].Scalar;
    const Number hi = nodes[k].Scalar;
    v = (hi - s) / (hi - lo);
    w = (s - lo) / (hi - lo);
  }
  ExtendedValue<Number> value;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = v * Number(left.Color[c]) + w * Number(right.Color[c]);
  }
  value.Attenuation = v * Number(left.Attenuation) + w * Number(right.Attenuation);
  return value;
}

/// Calls visit(front, back, length) for each piece of the segment on which the function is linear,
/// front to back. A constant scalar at a node belongs to the interval above it.
template <class Number, class Visit>
void ForEachExtendedPiece(
  const TransferFunction& function, double sf, double sb, double length, const Visit& visit)
{
  const auto& nodes = function.Nodes;
  const std::size_t n = nodes.size();
  const bool rising = sf <= sb;
  // All nodes between the ends, in order.
  std::size_t k = 0;
  while (k < n && (nodes[k].Scalar < sf || (rising && nodes[k].Scalar == sf)))
  {
    ++k;
  }
  Number s = sf;
  bool last = false;
  while (!last)
  {
    last = rising ? k == n || nodes[k].Scalar >= sb : k == 0 || nodes[k - 1].Scalar <= sb;
    const Number end = last ? sb : nodes[rising ? k : k - 1].Scalar;
    const Number share = sf == sb ? Number(1) : Number((end - s) / (Number(sb) - Number(sf)));
    visit(EvaluateExtended(function, k, s), EvaluateExtended(function, k, end),
      Number(share * Number(length)));
    s = end;
    k += rising ? 1 : -1;
  }
}

/// Gauss-Legendre points and weights on 0..1.
template <class Number>
class GaussLegendre
{
public:
  /// Twenty points integrate a quadratic polynomial times the exponential of a quadratic one that
  /// falls by 1 with a relative error of 1e-32.
  static constexpr int Order = 20;
  std::array<Number, Order> Points;
  std::array<Number, Order> Weights;

  GaussLegendre()
  {
    using std::abs;
    for (int i = 0; i < Order; ++i)
    {
      // Newton's method on the Legendre polynomial, from Tricomi's estimate of its root.
      const double pi = std::acos(-1.);
      Number x = std::cos(pi * (i + 0.75) / (Order + 0.5));
      Number derivative = 1;
      for (int iteration = 0; iteration < 10; ++iteration)
      {
        Number previous = 1;
        Number value = x;
        for (int n = 2; n <= Order; ++n)
        {
          const Number next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
          previous = value;
          value = next;
        }
        derivative = Order * (x * value - previous) / (x * x - 1);
        x -= value / derivative;
      }
      this->Points[i] = (1 - x) / 2;
      this->Weights[i] = 1 / ((1 - x * x) * derivative * derivative);
    }
  }
};

/// Adds a piece of a segment to what is in front of it.
template <class Number>
void AddExtendedPiece(ExtendedRadiance<Number>& sum, const ExtendedValue<Number>& front,
  const ExtendedValue<Number>& back, const Number& length)
{
  using std::exp;
  using std::sqrt;
  static const GaussLegendre<Number> rule;
  const Number a = front.Attenuation;
  const Number slope = back.Attenuation - front.Attenuation;
  const auto attenuation = [&](const Number& x) { return Number(a + slope * x); };
  // Optical depth from x to x + step; no term is negative.
  const auto depth = [&](const Number& x, const Number& step)
  { return Number(length * step * (attenuation(x) + attenuation(x + step)) / 2); };
  const Number whole = depth(0, 1);

  // What lies behind this optical depth is below rounding.
  const int largest = std::numeric_limits<Number>::digits;
  // Cut at every unit of optical depth: roots of length (a x + slope x^2 / 2) = k.
  Number begin = 0;
  for (int k = 0; k < largest && begin < 1; ++k)
  {
    Number end = 1;
    if (k + 1 < whole)
    {
      const Number y = (k + 1) / length;
      const Number square = a * a + 2 * slope * y;
      const Number root = 2 * y / (a + sqrt(square > 0 ? square : Number(0)));
      end = root < 1 ? root : Number(1);
    }
    const Number width = end - begin;
    const Number scale = exp(-Number(sum.Depth + depth(0, begin))) * length * width;
    for (int i = 0; i < GaussLegendre<Number>::Order; ++i)
    {
      const Number step = width * rule.Points[i];
      const Number x = begin + step;
      const Number emitted =
        scale * rule.Weights[i] * attenuation(x) * exp(-Number(depth(begin, step)));
      for (int c = 0; c < 3; ++c)
      {
        sum.Color[c] += emitted * (front.Color[c] + (back.Color[c] - front.Color[c]) * x);
      }
    }
    begin = end;
  }
  for (int i = 0; i < GaussLegendre<Number>::Order; ++i)
  {
    const Number& x = rule.Points[i];
    for (int c = 0; c < 3; ++c)
    {
      sum.Emission[c] += length * rule.Weights[i] * attenuation(x) *
        (front.Color[c] + (back.Color[c] - front.Color[c]) * x);
    }
  }
  sum.Depth += whole;
}

/// Emission and absorption along a segment of a ray over which the scalar goes linearly from sf to
/// sb: cut at the nodes of the transfer function, then at every unit of optical depth, then
/// Gauss-Legendre. A constant scalar that equals a node's takes the node's Right value.
template <class Number>
ExtendedRadiance<Number> IntegrateExtended(
  const TransferFunction& function, double sf, double sb, double length)
{
  using std::expm1;
  ExtendedRadiance<Number> sum;
  ForEachExtendedPiece<Number>(function, sf, sb, length,
    [&](const ExtendedValue<Number>& front, const ExtendedValue<Number>& back,
      const Number& pieceLength)
    {
      if (front.Attenuation + back.Attenuation > 0 && pieceLength > 0)
      {
        AddExtendedPiece(sum, front, back, pieceLength);
      }
    });
  sum.Opacity = -expm1(-sum.Depth);
  return sum;
}

} // namespace tetralux

#endif
