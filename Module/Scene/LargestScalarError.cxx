// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/LargestScalarError.h"

#include "Optics/IntervalTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

using Channels = std::array<double, 4>;

/// What a scalar is seen as.
Channels Classify(const TransferFunction::Value& value)
{
  const double opacity = std::clamp(value.Attenuation, 0., 1.);
  return { opacity * value.Color[0], opacity * value.Color[1], opacity * value.Color[2], opacity };
}

/// What a ray's largest scalar is, and may be.
struct LargestScalar
{
  double Exact = -std::numeric_limits<double>::infinity();
  double Least = -std::numeric_limits<double>::infinity();
  double Most = -std::numeric_limits<double>::infinity();

  void Add(double scalar, double change)
  {
    this->Exact = std::max(this->Exact, scalar);
    this->Least = std::max(this->Least, scalar - change);
    this->Most = std::max(this->Most, scalar + change);
  }
};

LargestScalar FindLargest(
  const std::vector<RaySegment>& ray, const RayUnits& units, const GeometryRounding& rounding)
{
  const double scalar = rounding.Scalar * units.Scalar;
  LargestScalar largest;
  for (const RaySegment& segment : ray)
  {
    const double along =
      std::abs(segment.Back - segment.Front) * units.Radius / (units.Length * segment.Length);
    largest.Add(
      segment.Front, scalar + rounding.Across * (segment.Gradient + along * segment.FrontSlope));
    largest.Add(
      segment.Back, scalar + rounding.Across * (segment.Gradient + along * segment.BackSlope));
  }
  return largest;
}

/// Largest change of a channel from that of the exact scalar.
double MeasureChange(const TransferFunction& function, const LargestScalar& scalar)
{
  const Channels exact = Classify(Evaluate(function, scalar.Exact));
  double change = 0;
  const auto compare = [&](const TransferFunction::Value& value)
  {
    const Channels other = Classify(value);
    for (std::size_t c = 0; c < other.size(); ++c)
    {
      change = std::max(change, std::abs(other[c] - exact[c]));
    }
  };
  compare(Evaluate(function, scalar.Least));
  compare(Evaluate(function, scalar.Most));
  auto node = std::upper_bound(function.Nodes.begin(), function.Nodes.end(), scalar.Least,
    [](double s, const TransferFunction::Node& n) { return s < n.Scalar; });
  for (; node != function.Nodes.end() && node->Scalar <= scalar.Most; ++node)
  {
    compare(node->Left);
    compare(node->Right);
  }
  return change;
}

} // namespace

double EstimateLargestScalarError(const RaySample& rays, const RayUnits& units,
  const TransferFunction& function, bool ofCells, const GeometryRounding& rounding)
{
  const auto n = static_cast<std::ptrdiff_t>(rays.Rays.size());
  std::vector<double> errors(rays.Rays.size(), 0.);
#pragma omp parallel for schedule(dynamic, 8)
  for (std::ptrdiff_t i = 0; i < n; ++i)
  {
    if (!rays.Rays[i].empty())
    {
      LargestScalar largest = FindLargest(rays.Rays[i], units, rounding);
      largest.Least = ofCells ? largest.Exact : largest.Least;
      errors[i] = MeasureChange(function, largest);
    }
  }
  return std::min(WorstOfPicture * FindOneInThousand(errors, rays.Weights),
    std::max(1., GetLargestColor(function)));
}

} // namespace tetralux
