// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/OrderError.h"

#include "Integral/RayIntegral.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tetralux
{
namespace
{

/// Cells of a cycle hide each other, so they are near to each other on a ray: cells between them.
constexpr std::size_t FarthestOfPair = 16;

/// Of what two segments add in either order.
double GetDifference(const SegmentRadiance& a, const SegmentRadiance& b)
{
  double largest = 0;
  for (int c = 0; c < 3; ++c)
  {
    largest = std::max(largest, std::abs(a.Color[c] * b.Opacity - b.Color[c] * a.Opacity));
  }
  return largest;
}

} // namespace

double EstimateOrderError(
  const RaySample& rays, double lengthScale, const TransferFunction& function)
{
  double largest = 0;
  const auto n = static_cast<std::ptrdiff_t>(rays.Rays.size());
#pragma omp parallel for schedule(dynamic, 8) reduction(max : largest)
  for (std::ptrdiff_t i = 0; i < n; ++i)
  {
    std::vector<SegmentRadiance> segments;
    for (const RaySegment& segment : rays.Rays[i])
    {
      segments.push_back(IntegrateEmissionAbsorption(
        function, segment.Front, segment.Back, lengthScale * segment.Length));
      const std::size_t last = segments.size() - 1;
      for (std::size_t k = last - std::min(last, FarthestOfPair); k < last; ++k)
      {
        largest = std::max(largest, GetDifference(segments[k], segments[last]));
      }
    }
  }
  return largest;
}

} // namespace tetralux
