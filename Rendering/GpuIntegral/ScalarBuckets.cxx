// SPDX-License-Identifier: BSD-3-Clause
#include "GpuIntegral/ScalarBuckets.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// 4 KB: in every cache, and with a dozen nodes one scalar in a hundred is in a bucket with one.
constexpr int FewestBuckets = 1024;

/// With the two beyond the ends, no more texels than OpenGL 3.1 promises.
constexpr int MostBuckets = 65536 - 2;

/// Buckets begin this much earlier, in widths: a shader's rounding of a bucket's number is less.
constexpr double Margin = 0.02;

} // namespace

std::vector<std::int32_t> MakeScalarBuckets(Span<const float> ends)
{
  double nearest = 2;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
  {
    const double distance = static_cast<double>(ends[k + 1]) - ends[k];
    nearest = distance > 0 ? std::min(nearest, distance) : nearest; // steps
  }
  const int size =
    static_cast<int>(std::clamp<double>(std::ceil(2 / nearest), FewestBuckets, MostBuckets));
  std::vector<std::int32_t> buckets(size + 2, 0);
  std::size_t interval = 0;
  for (int k = 1; k < size + 2; ++k)
  {
    const double begin = -1 + 2 * (k - 1 - Margin) / size;
    while (interval < ends.size() && ends[interval] <= begin)
    {
      ++interval;
    }
    buckets[k] = static_cast<std::int32_t>(interval);
  }
  return buckets;
}

} // namespace tetralux
