// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/RayIntegral.h"

#include "Integral/SpecialFunctions.h"
#include "Optics/IntervalTable.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralux
{
namespace
{

using Value = TransferFunction::Value;

/// (a - b) / (c - d), also where the differences overflow.
double RatioOfDifferences(double a, double b, double c, double d)
{
  const double ratio = (a - b) / (c - d);
  return std::isfinite(c - d) ? ratio : (0.5 * a - 0.5 * b) / (0.5 * c - 0.5 * d);
}

/// The function between nodes k - 1 and k, at a scalar there. Both shares are computed from
/// differences, and no term is subtracted: a small attenuation keeps its relative accuracy.
Value Evaluate(const TransferFunction& function, std::size_t k, double s)
{
  const auto& nodes = function.Nodes;
  if (k == 0)
  {
    return nodes.front().Left;
  }
  if (k == nodes.size())
  {
    return nodes.back().Right;
  }
  const TransferFunction::Node& left = nodes[k - 1];
  const TransferFunction::Node& right = nodes[k];
  const double w = RatioOfDifferences(s, left.Scalar, right.Scalar, left.Scalar);
  const double v = RatioOfDifferences(right.Scalar, s, right.Scalar, left.Scalar);
  Value value;
  value.Attenuation = v * left.Right.Attenuation + w * right.Left.Attenuation;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = v * left.Right.Color[c] + w * right.Left.Color[c];
  }
  return value;
}

/// Calls visit(front, back, length) for each piece of the segment on which the function is linear,
/// front to back.
template <class Visit>
void ForEachPiece(
  const TransferFunction& function, double sf, double sb, double length, const Visit& visit)
{
  if (!std::isfinite(sf) || !std::isfinite(sb))
  {
    return;
  }
  // The interval in which the segment starts, on that side of a node to which it leads.
  const auto& nodes = function.Nodes;
  const bool rising = sf <= sb;
  const auto next = std::partition_point(nodes.begin(), nodes.end(),
    [&](const TransferFunction::Node& node)
    { return rising ? node.Scalar <= sf : node.Scalar < sf; });
  auto k = static_cast<std::size_t>(next - nodes.begin());
  for (double s = sf;;)
  {
    double end = sb;
    bool more = false;
    if (rising && k < nodes.size() && nodes[k].Scalar < sb)
    {
      end = nodes[k].Scalar;
      more = true;
    }
    else if (!rising && k > 0 && nodes[k - 1].Scalar > sb)
    {
      end = nodes[k - 1].Scalar;
      more = true;
    }
    const double share = sf == sb ? 1 : RatioOfDifferences(end, s, sb, sf);
    visit(Evaluate(function, k, s), Evaluate(function, k, end), share * length);
    if (!more)
    {
      return;
    }
    s = end;
    k += rising ? 1 : -1;
  }
}

/// Largest optical depth in double precision, opaque by far. A larger one is taken for this, which
/// keeps products of depths finite.
constexpr double LargestDoubleDepth = 1e100;

/// Optical depth up to which the power series is used; beyond it the difference of the thick form
/// loses less than one bit.
constexpr double ThinDepth = 1;

/// cosh(D/2) - J of SegmentIntegral.h as a power series in b and D^2: the coefficient of b^n D^2m
/// is -(integral of x^2m q^n over [-1/2, 1/2]) / ((2m)! n!), and for n = 0 that of cosh(D/2) more.
class BracketSeries
{
public:
  BracketSeries()
  {
    double cosh = 1;  // 1 / (4^m (2m)!)
    double first = 1; // of n = 0
    for (int m = 0; m <= SquareOrder; ++m)
    {
      double term = first;
      for (int n = 0; n <= Order; ++n)
      {
        this->Coefficients[m][n] = -term;
        term *= 1 / (4 * (m + n + 1.5));
      }
      // 1 - 1 / (2m + 1) of the cosh is left for n = 0, by itself: nothing cancels.
      this->Coefficients[m][0] = cosh * (2 * m) / (2 * m + 1);
      cosh /= 4. * (2 * m + 1) * (2 * m + 2);
      first = cosh / (2 * m + 3);
    }
  }

  double Evaluate(double b, double depth) const
  {
    double sum = 0;
    for (int m = SquareOrder; m >= 0; --m)
    {
      double row = 0;
      for (int n = Order; n >= 0; --n)
      {
        row = row * b + this->Coefficients[m][n];
      }
      sum = sum * depth * depth + row;
    }
    return sum;
  }

private:
  // The first terms left out are below 1e-17 at D = |b| = ThinDepth.
  static constexpr int Order = 12;
  static constexpr int SquareOrder = 7;
  double Coefficients[SquareOrder + 1][Order + 1];
};

/// How the colours at both ends of a piece add up; see SegmentIntegral.h.
struct Weights
{
  double Front, Back;
};

/// d0, d1: attenuation at both ends times the length.
Weights IntegratePiece(double d0, double d1)
{
  d0 = std::min(d0, LargestDoubleDepth);
  d1 = std::min(d1, LargestDoubleDepth);
  const double depth = 0.5 * d0 + 0.5 * d1;
  const double b = 0.5 * d1 - 0.5 * d0;
  if (depth <= ThinDepth)
  {
    static const BracketSeries series;
    const double root = std::exp(-0.5 * depth);
    const double mean = std::sinh(0.5 * depth);
    const double bracket = series.Evaluate(b, depth);
    return { root * (mean + bracket), root * (mean - bracket) };
  }
  // A slope that is smaller leaves the same limit, see SegmentIntegral.h.
  const double floor = 1e-18 * depth;
  const double slopeRoot = std::sqrt(std::max(std::abs(b), floor));
  const double x0 = 0.5 * d0 / slopeRoot;
  const double x1 = 0.5 * d1 / slopeRoot;
  const double transmittance = std::exp(-depth);
  constexpr double HalfRootOfPi = 0.88622692545275801365;
  const double integral = b < 0
    ? (Dawson(x0) - transmittance * Dawson(x1)) / slopeRoot
    : HalfRootOfPi * (Erfcx(x0) - transmittance * Erfcx(x1)) / slopeRoot;
  return { std::max(0., 1 - integral), std::max(0., integral - transmittance) };
}

/// Optical depth of a piece, by halves, which cannot overflow.
double GetDepth(const Value& front, const Value& back, double length)
{
  return (0.5 * front.Attenuation + 0.5 * back.Attenuation) * length;
}

void SetDepth(SegmentRadiance& result, double depth)
{
  result.Opacity = -std::expm1(-depth);
  result.Transmittance = std::exp(-depth);
}

} // namespace

void SegmentRadiance::AddBehind(const SegmentRadiance& behind)
{
  for (int c = 0; c < 3; ++c)
  {
    this->Color[c] += this->Transmittance * behind.Color[c];
  }
  this->Opacity += this->Transmittance * behind.Opacity;
  this->Transmittance *= behind.Transmittance;
}

SegmentRadiance IntegrateEmissionAbsorption(
  const TransferFunction& function, double sf, double sb, double length)
{
  SegmentRadiance result;
  double depth = 0;
  ForEachPiece(function, sf, sb, length,
    [&](const Value& front, const Value& back, double pieceLength)
    {
      const double pieceDepth = GetDepth(front, back, pieceLength);
      if (!(pieceDepth > 0))
      {
        return;
      }
      const Weights w =
        IntegratePiece(front.Attenuation * pieceLength, back.Attenuation * pieceLength);
      const double transmittance = std::exp(-depth);
      for (int c = 0; c < 3; ++c)
      {
        result.Color[c] += transmittance * (w.Front * front.Color[c] + w.Back * back.Color[c]);
      }
      depth += pieceDepth;
    });
  SetDepth(result, depth);
  return result;
}

SegmentRadiance IntegrateEmissionOnly(
  const TransferFunction& function, double sf, double sb, double length)
{
  SegmentRadiance result;
  ForEachPiece(function, sf, sb, length,
    [&](const Value& front, const Value& back, double pieceLength)
    {
      const double front1 = front.Attenuation * pieceLength / 6;
      const double back1 = back.Attenuation * pieceLength / 6;
      for (int c = 0; c < 3; ++c)
      {
        result.Color[c] +=
          front.Color[c] * (2 * front1 + back1) + back.Color[c] * (front1 + 2 * back1);
      }
    });
  return result;
}

SegmentRadiance IntegrateAbsorptionOnly(
  const TransferFunction& function, double sf, double sb, double length)
{
  double depth = 0;
  ForEachPiece(function, sf, sb, length,
    [&](const Value& front, const Value& back, double pieceLength)
    { depth += GetDepth(front, back, pieceLength); });
  SegmentRadiance result;
  SetDepth(result, depth);
  return result;
}

SegmentRadiance ClassifyMaximum(const TransferFunction& function, double largestScalar)
{
  SegmentRadiance result;
  if (!std::isfinite(largestScalar))
  {
    return result;
  }
  const Value value = Evaluate(function, largestScalar);
  result.Opacity = std::min(1., value.Attenuation);
  result.Transmittance = 1 - result.Opacity;
  for (int c = 0; c < 3; ++c)
  {
    result.Color[c] = result.Opacity * value.Color[c];
  }
  return result;
}

SegmentRadiance IntegrateIsosurfaces(Span<const Isosurface> surfaces, double sf, double sb)
{
  SegmentRadiance result;
  if (!std::isfinite(sf) || !std::isfinite(sb))
  {
    return result;
  }
  ForEachCrossing(surfaces, sf, sb,
    [&](std::size_t index, double)
    {
      const Isosurface& surface = surfaces[index];
      SegmentRadiance crossing;
      crossing.Opacity = surface.Opacity;
      crossing.Transmittance = 1 - crossing.Opacity;
      for (int c = 0; c < 3; ++c)
      {
        crossing.Color[c] = crossing.Opacity * surface.Color[c];
      }
      result.AddBehind(crossing);
    });
  return result;
}

} // namespace tetralux
