// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/LargestChannel.h"

#include "Integral/RayIntegral.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetralux
{

double EstimateLargestChannel(
  const RaySample& rays, double lengthScale, const TransferFunction& function, OpticalModel model)
{
  if (model != OpticalModel::EmissionOnly)
  {
    return std::max(1., GetLargestColor(function));
  }
  double largest = 1;
  const auto n = static_cast<std::ptrdiff_t>(rays.Rays.size());
#pragma omp parallel for schedule(dynamic, 8) reduction(max : largest)
  for (std::ptrdiff_t i = 0; i < n; ++i)
  {
    double sums[3] = { 0, 0, 0 };
    for (const RaySegment& segment : rays.Rays[i])
    {
      const SegmentRadiance added =
        IntegrateEmissionOnly(function, segment.Front, segment.Back, lengthScale * segment.Length);
      for (int c = 0; c < 3; ++c)
      {
        sums[c] += std::abs(added.Color[c]);
      }
    }
    largest = std::max({ largest, sums[0], sums[1], sums[2] });
  }
  return largest;
}

} // namespace tetralux
