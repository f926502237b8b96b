// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceIntegral.h"

#include "GaussLegendre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// exp(-42) is 6e-19: what lies behind this optical depth does not change a double's sum.
constexpr int LargestOpticalDepth = 42;

/// A piece of a ray over which attenuation and colour are linear.
struct Piece
{
  TransferFunction::Value Begin;
  TransferFunction::Value End;
  double Length;
};

double OpticalDepth(const Piece& piece)
{
  return piece.Length * 0.5 * (piece.Begin.Attenuation + piece.End.Attenuation);
}

/// The colour that the piece emits is weights[0] * Begin.Color + weights[1] * End.Color.
void IntegrateEmission(const Piece& piece, double weights[2])
{
  static const GaussLegendre rule;
  weights[0] = weights[1] = 0;
  for (int i = 0; i < GaussLegendre::Order; ++i)
  {
    const double x = rule.Points[i];
    const double local = piece.Begin.Attenuation * (1 - x) + piece.End.Attenuation * x;
    const double emitted = piece.Length * rule.Weights[i] * local;
    weights[0] += emitted * (1 - x);
    weights[1] += emitted * x;
  }
}

/// What of it reaches the begin of the piece.
void IntegrateEmissionAbsorption(const Piece& piece, double weights[2])
{
  static const GaussLegendre rule;
  weights[0] = weights[1] = 0;
  const double a = piece.Begin.Attenuation;
  const double b = piece.End.Attenuation;
  const double depth = OpticalDepth(piece);
  const auto attenuation = [&](double x) { return a * (1 - x) + b * x; };

  // Subintervals of unit optical depth: the root of length * (a x + (b - a) x^2 / 2) = k.
  double begin = 0;
  for (int k = 0; k < LargestOpticalDepth && k < depth; ++k)
  {
    double end = 1;
    if (k + 1 < depth)
    {
      const double y = (k + 1) / piece.Length;
      end = std::min(1.0, 2 * y / (a + std::sqrt(std::max(0.0, a * a + 2 * (b - a) * y))));
    }
    const double width = end - begin;
    const double front = attenuation(begin);
    double sum[2] = { 0, 0 };
    for (int i = 0; i < GaussLegendre::Order; ++i)
    {
      const double step = width * rule.Points[i];
      const double x = begin + step;
      const double local = attenuation(x);
      const double absorbed = piece.Length * step * 0.5 * (front + local);
      const double emitted = rule.Weights[i] * local * std::exp(-absorbed);
      sum[0] += emitted * (1 - x);
      sum[1] += emitted * x;
    }
    const double scale = piece.Length * width * std::exp(-static_cast<double>(k));
    weights[0] += scale * sum[0];
    weights[1] += scale * sum[1];
    begin = end;
  }
}

/// What lights make of it and reaches its begin, added to color. light: at a share of the piece.
class LitPiece
{
public:
  using Light = std::function<ReferenceLight(double share)>;

  /// sharpest: a share of the piece, or beyond it.
  LitPiece(const Piece& piece, const Light& light, double sharpest)
    : Of(piece)
    , Lights(light)
    , Sharpest(sharpest)
  {
  }

  void Integrate(double color[3]) const
  {
    // Parts of at most unit optical depth are smooth but for the light.
    const double depth = OpticalDepth(this->Of);
    const double a = this->Of.Begin.Attenuation;
    const double b = this->Of.End.Attenuation;
    double begin = 0;
    for (int k = 0; k < LargestOpticalDepth && k < depth; ++k)
    {
      double end = 1;
      if (k + 1 < depth)
      {
        const double y = (k + 1) / this->Of.Length;
        end = std::min(1.0, 2 * y / (a + std::sqrt(std::max(0.0, a * a + 2 * (b - a) * y))));
      }
      if (begin < this->Sharpest && this->Sharpest < end)
      {
        this->Add(begin, this->Sharpest, color);
        begin = this->Sharpest;
      }
      this->Add(begin, end, color);
      begin = end;
    }
  }

private:
  void Add(double begin, double end, double color[3]) const
  {
    double part[3];
    this->Sum(begin, end, part);
    constexpr int Halvings = 40;
    this->Refine(begin, end, part, Halvings, color);
  }

  /// The rule over an interval.
  void Sum(double begin, double end, double sum[3]) const
  {
    static const GaussLegendre rule;
    std::fill_n(sum, 3, 0.);
    const double a = this->Of.Begin.Attenuation;
    const double b = this->Of.End.Attenuation;
    for (int i = 0; i < GaussLegendre::Order; ++i)
    {
      const double x = begin + (end - begin) * rule.Points[i];
      const double absorbed = this->Of.Length * x * (a + (b - a) * x / 2);
      const double emitted = this->Of.Length * (end - begin) * rule.Weights[i] *
        (a * (1 - x) + b * x) * std::exp(-absorbed);
      const ReferenceLight light = this->Lights(x);
      for (int c = 0; c < 3; ++c)
      {
        const double plain = (1 - x) * this->Of.Begin.Color[c] + x * this->Of.End.Color[c];
        sum[c] += emitted * (plain * light.Scale[c] + light.Add[c]);
      }
    }
  }

  /// Whether light between an end of an interval and the outermost point of the rule, where the
  /// rule would not see a jump, changes no more than between the two outermost points.
  bool EndsLike(double begin, double end, int side) const
  {
    static const GaussLegendre rule;
    constexpr double Jump = 1e-3; ///< of light, over a hundredth of an interval
    const auto at = [&](double share)
    {
      const ReferenceLight light =
        this->Lights(side == 0 ? begin + (end - begin) * share : end - (end - begin) * share);
      return light.Scale[0] + light.Scale[1] + light.Scale[2] + light.Add[0] + light.Add[1] +
        light.Add[2];
    };
    const double first = at(std::min(rule.Points.front(), rule.Points.back()));
    const double second = at(std::min(rule.Points[1], rule.Points[GaussLegendre::Order - 2]));
    return std::abs(at(0) - first) <= std::abs(first - second) + Jump;
  }

  /// Adds an interval of which the rule has the sum.
  void Refine(double begin, double end, const double sum[3], int halvings, double color[3]) const
  {
    constexpr double Tolerance = 1e-10;
    const double middle = begin + (end - begin) / 2;
    double halves[2][3];
    this->Sum(begin, middle, halves[0]);
    this->Sum(middle, end, halves[1]);
    bool fits = this->EndsLike(begin, middle, 0) && this->EndsLike(middle, end, 1);
    for (int c = 0; c < 3; ++c)
    {
      fits = fits && std::abs(halves[0][c] + halves[1][c] - sum[c]) <= Tolerance;
    }
    if (fits || halvings == 0)
    {
      for (int c = 0; c < 3; ++c)
      {
        color[c] += halves[0][c] + halves[1][c];
      }
      return;
    }
    this->Refine(begin, middle, halves[0], halvings - 1, color);
    this->Refine(middle, end, halves[1], halvings - 1, color);
  }

  const Piece& Of;
  const Light& Lights;
  double Sharpest;
};

/// The function in interval k, which lies between nodes k - 1 and k.
TransferFunction::Value Evaluate(const TransferFunction& function, std::size_t k, double s)
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
  const auto& left = nodes[k - 1];
  const auto& right = nodes[k];
  const long double width = static_cast<long double>(right.Scalar) - left.Scalar;
  const double w = static_cast<double>((static_cast<long double>(s) - left.Scalar) / width);
  const double v = static_cast<double>((right.Scalar - static_cast<long double>(s)) / width);
  TransferFunction::Value value;
  for (int channel = 0; channel < 3; ++channel)
  {
    value.Color[channel] = v * left.Right.Color[channel] + w * right.Left.Color[channel];
  }
  value.Attenuation = v * left.Right.Attenuation + w * right.Left.Attenuation;
  return value;
}

/// light: of a share of the segment; empty: there is none.
ReferenceSegment IntegrateAny(const TransferFunction& function, double s0, double s1, double length,
  OpticalModel model, const std::function<ReferenceLight(double share)>& light, double sharpest)
{
  const bool absorbs =
    model == OpticalModel::EmissionAbsorption || model == OpticalModel::AbsorptionOnly;
  const bool emits =
    model == OpticalModel::EmissionAbsorption || model == OpticalModel::EmissionOnly;
  if (!absorbs && !emits)
  {
    throw std::invalid_argument("IntegrateReference: the model is no integral");
  }
  const auto& nodes = function.Nodes;
  const long double range = static_cast<long double>(s1) - s0;
  ReferenceSegment result;

  // The interval in which the segment starts, on the side of the node to which it leads.
  std::size_t k = 0;
  while (k < nodes.size() && (nodes[k].Scalar < s0 || (nodes[k].Scalar == s0 && s1 >= s0)))
  {
    ++k;
  }
  for (double s = s0;;)
  {
    double next = s1;
    std::size_t nextInterval = k;
    if (s1 > s0 && k < nodes.size() && nodes[k].Scalar < s1)
    {
      next = nodes[k].Scalar;
      nextInterval = k + 1;
    }
    else if (s1 < s0 && k > 0 && nodes[k - 1].Scalar > s1)
    {
      next = nodes[k - 1].Scalar;
      nextInterval = k - 1;
    }

    // A share of differences of scalars, so that a needle between close nodes keeps its width.
    const double share =
      s0 == s1 ? 1.0 : static_cast<double>((static_cast<long double>(next) - s) / range);
    const Piece piece{ Evaluate(function, k, s), Evaluate(function, k, next), share * length };
    const double depth = OpticalDepth(piece);
    if (depth > 0)
    {
      if (result.FirstContribution < 0)
      {
        result.FirstContribution =
          s0 == s1 ? 0.0 : static_cast<double>((static_cast<long double>(s) - s0) / range);
      }
      double weights[2] = { 0, 0 };
      double lit[3] = { 0, 0, 0 };
      if (light)
      {
        const double from =
          s0 == s1 ? 0.0 : static_cast<double>((static_cast<long double>(s) - s0) / range);
        const LitPiece::Light ofPiece = [&](double x) { return light(from + x * share); };
        LitPiece(piece, ofPiece, (sharpest - from) / share).Integrate(lit);
      }
      else if (emits)
      {
        (absorbs ? IntegrateEmissionAbsorption : IntegrateEmission)(piece, weights);
      }
      const double transmittance = absorbs ? std::exp(-result.OpticalDepth) : 1;
      for (int channel = 0; channel < 3; ++channel)
      {
        result.Color[channel] += transmittance *
          (lit[channel] + weights[0] * piece.Begin.Color[channel] +
            weights[1] * piece.End.Color[channel]);
      }
      result.OpticalDepth += depth;
    }
    if (nextInterval == k)
    {
      break;
    }
    s = next;
    k = nextInterval;
  }
  result.Alpha = absorbs ? -std::expm1(-result.OpticalDepth) : 0;
  return result;
}

} // namespace

ReferenceSegment IntegrateReference(
  const TransferFunction& function, double s0, double s1, double length, OpticalModel model)
{
  return IntegrateAny(function, s0, s1, length, model, {}, 0);
}

ReferenceSegment IntegrateLitReference(const TransferFunction& function, double s0, double s1,
  double length, const std::function<ReferenceLight(double share)>& light, double sharpest)
{
  return IntegrateAny(function, s0, s1, length, OpticalModel::EmissionAbsorption, light, sharpest);
}

TransferFunction::Value EvaluateReference(const TransferFunction& function, double s)
{
  std::size_t k = 0;
  while (k < function.Nodes.size() && function.Nodes[k].Scalar <= s)
  {
    ++k;
  }
  return Evaluate(function, k, s);
}

} // namespace tetralux
