// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/GeometryError.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

/// The attenuation over the scalar, its integral, and the variation of the function: the sum of all its
/// changes, each as it matters to a channel.
class FunctionTable
{
public:
  FunctionTable(const TransferFunction& function, double largestColor)
  {
    double scalar = function.Nodes.front().Scalar;
    const TransferFunction::Value* before = &function.Nodes.front().Left;
    double variation = 0;
    double integral = 0;
    for (const TransferFunction::Node& node : function.Nodes)
    {
      variation += Compare(*before, node.Left, largestColor);
      integral += 0.5 * (before->Attenuation + node.Left.Attenuation) * (node.Scalar - scalar);
      Entry entry{ node.Scalar, variation, 0, integral, node.Left.Attenuation,
        node.Right.Attenuation };
      variation += Compare(node.Left, node.Right, largestColor);
      entry.VariationAbove = variation;
      this->Entries.push_back(entry);
      scalar = node.Scalar;
      before = &node.Right;
    }
  }

  struct Sample
  {
    double Variation, Integral, Attenuation;
  };

  /// above: at a step the value above it.
  Sample At(double scalar, bool above) const
  {
    const auto less = [](double s, const Entry& entry) { return s < entry.Scalar; };
    const auto next = std::upper_bound(this->Entries.begin(), this->Entries.end(), scalar, less);
    if (next == this->Entries.begin())
    {
      const Entry& first = *next;
      return { 0, first.Integral - (first.Scalar - scalar) * first.Below, first.Below };
    }
    const Entry& entry = *(next - 1);
    if (scalar == entry.Scalar && !above)
    {
      return { entry.Variation, entry.Integral, entry.Below };
    }
    const double x = scalar - entry.Scalar;
    if (next == this->Entries.end())
    {
      return { entry.VariationAbove, entry.Integral + x * entry.Above, entry.Above };
    }
    const double share = x / (next->Scalar - entry.Scalar);
    const double attenuation = entry.Above + share * (next->Below - entry.Above);
    return { entry.VariationAbove + share * (next->Variation - entry.VariationAbove),
      entry.Integral + 0.5 * (entry.Above + attenuation) * x, attenuation };
  }

private:
  struct Entry
  {
    double Scalar, Variation, VariationAbove, Integral, Below, Above;
  };

  /// Of the optical depth and of the colour that goes with it, per unit of length.
  static double Compare(
    const TransferFunction::Value& a, const TransferFunction::Value& b, double largestColor)
  {
    double color = 0;
    for (int c = 0; c < 3; ++c)
    {
      color = std::max(color, std::abs(b.Color[c] - a.Color[c]));
    }
    return std::abs(b.Attenuation - a.Attenuation) * largestColor +
      std::max(a.Attenuation, b.Attenuation) * color;
  }

  std::vector<Entry> Entries;
};

/// What rounding does to a ray.
struct RayError
{
  double Sum;    ///< of all segments, as a camera anywhere on the ray sees it, at most
  double Inside; ///< of the worst segment by the function's changes in it
  double Ends;   ///< of the worst face by the function's jump there
  double Limit;  ///< of any segment that touches a surface of the function
};

/// Measures rays.
class RoundedRays
{
public:
  RoundedRays(const TransferFunction& function, bool absorbs, double lengthScale, double radius,
    double scalarUnit, const GeometryRounding& rounding)
    : LargestColor(std::max(1., GetLargestColor(function)))
    , Function(function, this->LargestColor)
    , Absorbs(absorbs)
    , LengthScale(lengthScale)
    , Across(rounding.Across)
    , Distance(rounding.Across * radius)
    , Scalar(rounding.Scalar * scalarUnit)
  {
    const double window = 2 * this->Scalar;
    for (const TransferFunction::Node& node : function.Nodes)
    {
      for (const double lower : { node.Scalar, node.Scalar - 0.5 * window, node.Scalar - window })
      {
        const double change = 0.5 * this->GetVariation(lower, lower + window);
        if (change > this->LargestChange)
        {
          this->LargestChange = change;
          this->AttenuationThere = 0.5 * std::max(node.Left.Attenuation, node.Right.Attenuation);
        }
      }
    }
  }

  RayError Measure(const std::vector<RaySegment>& ray) const
  {
    RayError error{ 0, 0, 0, 0 };
    double behind = 0;
    for (std::size_t k = ray.size(); k-- > 0;)
    {
      const RaySegment& segment = ray[k];
      const double length = this->LengthScale * segment.Length;
      const double depth = length * this->GetMeanAttenuation(segment);
      const double change = this->Scalar + this->Across * segment.Gradient;
      const double inside = Weaken(length * this->GetChange(segment, change), depth);
      const double ends = std::min(this->GetChangeAtEnds(ray, k), this->LargestColor);
      error.Inside = std::max(error.Inside, inside);
      error.Ends = std::max(error.Ends, ends);
      if (this->Scalar > 0)
      {
        error.Limit = std::max(error.Limit,
          Weaken(length * this->LargestChange * (change / this->Scalar),
            length * this->AttenuationThere));
      }
      const double transmittance = this->Absorbs ? std::exp(-depth) : 1;
      behind = std::hypot(inside + ends, transmittance * behind);
      error.Sum = std::max(error.Sum, behind);
    }
    return error;
  }

private:
  /// The change of an optical depth, where there is a depth that hides it.
  double Weaken(double change, double depth) const
  {
    return this->Absorbs ? change / std::max(1., depth) : change;
  }

  double GetVariation(double lower, double upper) const
  {
    return this->Function.At(upper, true).Variation - this->Function.At(lower, false).Variation;
  }

  double GetMeanAttenuation(const RaySegment& segment) const
  {
    const double lower = std::min(segment.Front, segment.Back);
    const double upper = std::max(segment.Front, segment.Back);
    const FunctionTable::Sample low = this->Function.At(lower, true);
    return upper > lower
      ? std::max(0., (this->Function.At(upper, true).Integral - low.Integral) / (upper - lower))
      : low.Attenuation;
  }

  /// Of a unit of length.
  double GetChange(const RaySegment& segment, double change) const
  {
    if (!(change > 0))
    {
      return 0;
    }
    const double lower = std::min(segment.Front, segment.Back) - change;
    const double upper = std::max(segment.Front, segment.Back) + change;
    return this->GetVariation(lower, upper) * change / (upper - lower);
  }

  double GetChangeAtEnds(const std::vector<RaySegment>& ray, std::size_t k) const
  {
    const RaySegment& segment = ray[k];
    double change = 0;
    if (segment.First)
    {
      change += segment.FrontSlope * this->Function.At(segment.Front, true).Attenuation;
    }
    if (segment.Last)
    {
      change += segment.BackSlope * this->Function.At(segment.Back, true).Attenuation;
    }
    change *= this->LargestColor;
    if (!segment.Last && k + 1 < ray.size() && ray[k + 1].Front != segment.Back &&
      segment.Front == segment.Back)
    {
      change += segment.BackSlope *
        this->GetVariation(std::min(ray[k + 1].Front, segment.Back),
          std::max(ray[k + 1].Front, segment.Back));
    }
    return this->Distance * change;
  }

  double LargestColor;
  FunctionTable Function;
  bool Absorbs;
  double LengthScale;
  double Across;   ///< in radii
  double Distance; ///< the same, world units
  double Scalar;   ///< units of the scalars
  double LargestChange = 0;
  double AttenuationThere = 0;
};

/// The largest of a picture's errors whose large ones are as rare as their inverse squares. sample: any
/// order; it is sorted.
double Extrapolate(std::vector<double>& sample)
{
  constexpr std::size_t Fewest = 8; // of the largest; fewer are chance
  std::sort(sample.begin(), sample.end(), [](double a, double b) { return a > b; });
  double largest = 0;
  for (std::size_t k = Fewest; k <= sample.size(); ++k)
  {
    largest = std::max(largest, sample[k - 1] * sample[k - 1] * static_cast<double>(k));
  }
  return std::sqrt(largest / static_cast<double>(sample.size()) * RaysOfPicture);
}

} // namespace

double EstimateRoundingError(const RaySample& rays, double lengthScale, double radius,
  double scalarUnit, const TransferFunction& function, bool absorbs,
  const GeometryRounding& rounding)
{
  const RoundedRays rounded(function, absorbs, lengthScale, radius, scalarUnit, rounding);
  const std::size_t n = rays.Rays.size();
  if (n == 0)
  {
    return 0;
  }
  std::vector<double> inside(n), ends(n);
  double sum = 0;
  double limit = 0;
#pragma omp parallel for schedule(dynamic, 8) reduction(max : sum, limit)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(n); ++i)
  {
    const RayError error = rounded.Measure(rays.Rays[i]);
    inside[i] = error.Inside;
    ends[i] = error.Ends;
    sum = std::max(sum, error.Sum);
    limit = std::max(limit, error.Limit);
  }
  const double touching = std::min(Extrapolate(inside), limit);
  const double grazing = Extrapolate(ends);
  if (std::getenv("TX_DEBUG"))
  {
    std::fprintf(stderr, "sum %.2g inside %.2g limit %.2g ends %.2g rays %zu\n", sum,
      Extrapolate(inside), limit, grazing, n);
  }
  return sum + std::max(touching, grazing);
}

} // namespace tetralux
