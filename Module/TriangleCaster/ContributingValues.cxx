// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/ContributingValues.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// Interpolated values are rounded, and so is where they lie among the intervals.
constexpr float Rounding = 1e-6f;

} // namespace

ContributingValues::ContributingValues(
  const ImageKernelInput& in, const IntervalTable& table, float scale, float offset)
  : In(in)
  , Intervals(table.Intervals)
  , Scale(scale)
  , Offset(offset)
  , VisibleBefore(table.Intervals.size() + 1, 0)
{
  for (std::size_t k = 0; k < this->Intervals.size(); ++k)
  {
    const IntervalTable::Interval& interval = this->Intervals[k];
    const bool visible = interval.Attenuation > 0 || interval.AttenuationSlope != 0;
    this->VisibleBefore[k + 1] = this->VisibleBefore[k] + (visible ? 1 : 0);
  }
}

bool ContributingValues::Include(const BlockRanges::Range& range) const
{
  if (!(range.Low <= range.High))
  {
    return false;
  }
  const float margin = Rounding * std::max(std::abs(range.Low), std::abs(range.High));
  if (!std::isfinite(margin))
  {
    return true;
  }
  const float low = range.Low - margin;
  const float high = range.High + margin;
  switch (this->In.Blend)
  {
    case ImageBlend::AverageIntensity:
      return low <= this->In.AverageHigh && this->In.AverageLow <= high;
    case ImageBlend::Isosurfaces:
    {
      const SurfaceLookup& surfaces = this->In.Surfaces;
      const float* begin = surfaces.Bounds + 1;
      const float* end = begin + surfaces.Count;
      const float* first = std::lower_bound(begin, end, surfaces.Sign > 0 ? low : -high);
      return range.Mixed || (first != end && *first <= (surfaces.Sign > 0 ? high : -low));
    }
    default:
      return this->IncludeTransfer(range.Low, range.High);
  }
}

bool ContributingValues::IncludeTransfer(float low, float high) const
{
  const float a = this->Offset + this->Scale * low;
  const float b = this->Offset + this->Scale * high;
  const float margin =
    Rounding * std::max({ 1.f, std::abs(a), std::abs(b), std::abs(this->Offset) });
  if (!std::isfinite(margin))
  {
    return true;
  }
  // The first interval that ends at the lowest scalar or above, and the first one that begins above
  // the highest.
  const IntervalTable::Interval* begin = this->Intervals.data();
  const IntervalTable::Interval* end = begin + this->Intervals.size();
  const auto first = this->In.Blend == ImageBlend::MaximumIntensity
    ? begin
    : std::lower_bound(begin, end, std::min(a, b) - margin,
        [](const IntervalTable::Interval& interval, float x) { return interval.Hi < x; });
  const auto last = this->In.Blend == ImageBlend::MinimumIntensity
    ? end
    : std::upper_bound(begin, end, std::max(a, b) + margin,
        [](float x, const IntervalTable::Interval& interval) { return x < interval.Lo; });
  return this->VisibleBefore[last - begin] > this->VisibleBefore[first - begin];
}

} // namespace tetralux
