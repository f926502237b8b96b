// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/GeometryError.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace tetralux
{
namespace
{

/// Optical depth behind which nothing is seen any more: e^-16 is 1e-7.
constexpr double OpaqueDepth = 16;

/// Sums over a transfer function, from its first node to a scalar.
class FunctionSums
{
public:
  struct Sum
  {
    double Attenuation; ///< of its changes, absolute
    double Color;       ///< the same of the channel that changes most
    double Integral;    ///< of the attenuation
    double Value;       ///< the attenuation itself
  };

  explicit FunctionSums(const TransferFunction& function)
  {
    const TransferFunction::Value* before = &function.Nodes.front().Left;
    double scalar = function.Nodes.front().Scalar;
    Sum sum{ 0, 0, 0, 0 };
    for (const TransferFunction::Node& node : function.Nodes)
    {
      sum.Integral += 0.5 * (before->Attenuation + node.Left.Attenuation) * (node.Scalar - scalar);
      Add(sum, *before, node.Left);
      const Sum below = sum;
      Add(sum, node.Left, node.Right);
      this->Nodes.push_back({ node.Scalar, below, sum });
      scalar = node.Scalar;
      before = &node.Right;
    }
  }

  /// above: at a step, with the step.
  Sum At(double scalar, bool above) const
  {
    const auto next = std::upper_bound(this->Nodes.begin(), this->Nodes.end(), scalar,
      [](double s, const Node& node) { return s < node.Scalar; });
    if (next == this->Nodes.begin())
    {
      Sum sum = next->Below;
      sum.Integral += (scalar - next->Scalar) * sum.Value;
      return sum;
    }
    const Node& node = *(next - 1);
    if (scalar == node.Scalar && !above)
    {
      return node.Below;
    }
    Sum sum = node.Above;
    const double x = scalar - node.Scalar;
    if (next != this->Nodes.end())
    {
      const double share = x / (next->Scalar - node.Scalar);
      sum.Attenuation += share * (next->Below.Attenuation - sum.Attenuation);
      sum.Color += share * (next->Below.Color - sum.Color);
      sum.Value += share * (next->Below.Value - sum.Value);
    }
    sum.Integral += 0.5 * (node.Above.Value + sum.Value) * x;
    return sum;
  }

private:
  struct Node
  {
    double Scalar;
    Sum Below, Above; ///< without and with the step at it
  };

  static void Add(Sum& sum, const TransferFunction::Value& a, const TransferFunction::Value& b)
  {
    double color = 0;
    for (int c = 0; c < 3; ++c)
    {
      color = std::max(color, std::abs(b.Color[c] - a.Color[c]));
    }
    sum.Color += color;
    sum.Attenuation += std::abs(b.Attenuation - a.Attenuation);
    sum.Value = b.Attenuation;
  }

  std::vector<Node> Nodes;
};

/// What rounding does to rays.
class RoundedRays
{
public:
  RoundedRays(const RayUnits& units, const TransferFunction& function, bool absorbs,
    const GeometryRounding& rounding)
    : Function(function)
    , LargestColor(std::max(1., GetLargestColor(function)))
    , Absorbs(absorbs)
    , Length(units.Length)
    , Across(rounding.Across)
    , Distance(rounding.Across * units.Radius)
    , Scalar(rounding.Scalar * units.Scalar)
  {
  }

  /// Error of a channel that a camera anywhere on the ray sees, at most.
  double Measure(const std::vector<RaySegment>& ray) const
  {
    double largest = 0;
    double squares = 0; // behind, as seen from here
    for (std::size_t k = ray.size(); k-- > 0;)
    {
      const double faces = this->MeasureFaces(ray, k);
      const SegmentError segment = this->MeasureSegment(ray[k], faces);
      squares =
        segment.Error * segment.Error + segment.Transmittance * segment.Transmittance * squares;
      largest = std::max(largest, squares);
    }
    return std::sqrt(largest);
  }

private:
  struct SegmentError
  {
    double Error, Transmittance;
  };

  /// Optical depth of a segment from one scalar to another one.
  double GetDepth(double from, double to, double length) const
  {
    const double lower = std::min(from, to);
    const double upper = std::max(from, to);
    const FunctionSums::Sum low = this->Function.At(lower, true);
    return length *
      (upper > lower
          ? std::max(0., this->Function.At(upper, false).Integral - low.Integral) / (upper - lower)
          : low.Value);
  }

  /// Cuts off what is behind OpaqueDepth. Returns the depth of what is left.
  double CutOpaque(double front, double& back, double& length, double depth) const
  {
    double share = 1;
    double lowest = 0;
    const double wholeBack = back;
    const double wholeLength = length;
    constexpr int Halvings = 24;
    for (int i = 0; i < Halvings; ++i)
    {
      const double middle = 0.5 * (lowest + share);
      const double end = front + middle * (wholeBack - front);
      const double found = this->GetDepth(front, end, middle * wholeLength);
      if (found > OpaqueDepth)
      {
        share = middle;
        back = end;
        length = middle * wholeLength;
        depth = found;
      }
      else
      {
        lowest = middle;
      }
    }
    return depth;
  }

  /// faces: what the depth changes by at the ends of the segment.
  SegmentError MeasureSegment(const RaySegment& segment, double faces) const
  {
    double length = this->Length * segment.Length;
    double back = segment.Back;
    double depth = this->GetDepth(segment.Front, back, length);
    const double transmittance = this->Absorbs ? std::exp(-depth) : 1;
    if (this->Absorbs && depth > OpaqueDepth)
    {
      depth = this->CutOpaque(segment.Front, back, length, depth);
    }
    const double change = this->Scalar + this->Across * segment.Gradient;
    const double lower = std::min(segment.Front, back) - change;
    const double upper = std::max(segment.Front, back) + change;
    const FunctionSums::Sum low = this->Function.At(lower, false);
    const FunctionSums::Sum high = this->Function.At(upper, true);
    const double share = upper > lower ? change / (upper - lower) : 0;
    const double colors = high.Color - low.Color;
    const double thickness = this->Absorbs ? std::max(1., depth) : 1;
    const double depthChange =
      length * (high.Attenuation - low.Attenuation) * share / thickness + faces;
    if (!this->Absorbs)
    {
      return { this->LargestColor * depthChange + depth * colors * share, 1 };
    }
    // A depth matters as far as what it hides has another colour.
    const double hidden = std::min(1., transmittance + colors / this->LargestColor);
    return { hidden * this->LargestColor * std::min(1., depthChange) +
        std::min(depth, 1.) * colors * share,
      transmittance };
  }

  double MeasureFaces(const std::vector<RaySegment>& ray, std::size_t k) const
  {
    const RaySegment& segment = ray[k];
    double change = 0;
    if (segment.First)
    {
      change += segment.FrontSlope * this->Function.At(segment.Front, true).Value;
    }
    if (segment.Last)
    {
      change += segment.BackSlope * this->Function.At(segment.Back, true).Value;
    }
    else if (k + 1 < ray.size() && ray[k + 1].Front != segment.Back)
    {
      change += segment.BackSlope *
        std::abs(this->Function.At(ray[k + 1].Front, true).Value -
          this->Function.At(segment.Back, true).Value);
    }
    return this->Distance * change;
  }

  FunctionSums Function;
  double LargestColor;
  bool Absorbs;
  double Length;
  double Across;   ///< radii
  double Distance; ///< the same, world units
  double Scalar;   ///< units of the scalars
};

} // namespace

double EstimateRoundingError(const RaySample& rays, const RayUnits& units,
  const TransferFunction& function, bool absorbs, const GeometryRounding& rounding)
{
  const RoundedRays rounded(units, function, absorbs, rounding);
  const auto n = static_cast<std::ptrdiff_t>(rays.Rays.size());
  std::vector<double> errors(rays.Rays.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::ptrdiff_t i = 0; i < n; ++i)
  {
    errors[i] = rounded.Measure(rays.Rays[i]);
  }
  return WorstOfPicture * FindOneInThousand(errors, rays.Weights);
}

} // namespace tetralux
