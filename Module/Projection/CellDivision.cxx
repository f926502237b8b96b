// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/CellDivision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tetralux
{
namespace
{

using Interval = IntervalTable::Interval;
using Part = CellDivision::Part;

/// Scalars beyond this are not in intervals as shaders compare them.
constexpr double LargestScalar = 1e30;

/// More are not counted in 32 bits.
constexpr std::int64_t MostSlicesOfAll = std::numeric_limits<std::uint32_t>::max();

float Evaluate(const Interval& interval, float scalar)
{
  return interval.Attenuation + interval.AttenuationSlope * (scalar - interval.Reference);
}

double FindLongestEdge(Span<const double> coordinates, const std::int32_t* cell)
{
  double largest = 0;
  for (int i = 0; i < 4; ++i)
  {
    for (int k = 0; k < i; ++k)
    {
      const double* p = &coordinates[3 * static_cast<std::size_t>(cell[i])];
      const double* q = &coordinates[3 * static_cast<std::size_t>(cell[k])];
      const double x = p[0] - q[0];
      const double y = p[1] - q[1];
      const double z = p[2] - q[2];
      largest = std::max(largest, x * x + y * y + z * z);
    }
  }
  return std::sqrt(largest);
}

/// Calls take(part) for each part of a cell; false where there is no dividing it.
template <class Take>
bool Divide(const DivisionSource& source, Span<const float> ends, std::int64_t cell, Take&& take)
{
  const std::int32_t* p = &source.Cells[4 * cell];
  double lo = std::numeric_limits<double>::infinity();
  double hi = -lo;
  bool finite = true;
  for (int i = 0; i < 4; ++i)
  {
    const double scalar = source.Points[p[i]].Scalar;
    finite = finite && std::isfinite(scalar);
    lo = std::min(lo, scalar);
    hi = std::max(hi, scalar);
  }
  if (!finite)
  {
    return true; // it is not drawn
  }
  if (lo < -LargestScalar || hi > LargestScalar)
  {
    return false;
  }
  const auto lowest = static_cast<float>(lo);
  const auto highest = static_cast<float>(hi);
  // A scalar at a node belongs to the interval above it.
  const auto find = [&](float scalar)
  { return std::upper_bound(ends.begin(), ends.end() - 1, scalar) - ends.begin(); };
  const auto first = find(lowest);
  const auto last = highest < ends[first] ? first : find(highest);
  double edge = -1;
  for (auto k = first; k <= last; ++k)
  {
    const Interval& interval = source.Intervals[k];
    const double attenuation =
      std::max(Evaluate(interval, std::clamp(lowest, interval.Lo, interval.Hi)),
        Evaluate(interval, std::clamp(highest, interval.Lo, interval.Hi)));
    if (!(attenuation > 0))
    {
      continue;
    }
    Part part = {};
    part.Interval = static_cast<std::uint32_t>(k);
    part.Slices = 1;
    part.OpenBelow = k == first;
    part.OpenAbove = k == last;
    if (source.LargestDepth < std::numeric_limits<double>::infinity())
    {
      edge = edge < 0 ? source.LengthScale * FindLongestEdge(source.Coordinates, p) : edge;
      const double slices = std::ceil(attenuation * edge / source.LargestDepth);
      if (!(slices <= CellDivision::MostSlices))
      {
        return false;
      }
      part.Slices = static_cast<std::uint32_t>(std::max(slices, 1.));
    }
    take(part);
  }
  return true;
}

} // namespace

void CellDivision::Clear() { *this = CellDivision(); }

bool CellDivision::Make(const DivisionSource& source)
{
  this->Clear();
  if (source.Intervals.size() > MostIntervals)
  {
    return false;
  }
  std::vector<float> ends(source.Intervals.size());
  std::transform(source.Intervals.begin(), source.Intervals.end(), ends.begin(),
    [](const Interval& interval) { return interval.Hi; });
  const auto n = static_cast<std::int64_t>(source.Cells.size() / 4);
  std::vector<std::uint32_t> begins(n + 1, 0);
  bool possible = true;
  std::int64_t cells = 0;
  std::int64_t slices = 0;
#pragma omp parallel for schedule(static) reduction(&& : possible) reduction(+ : cells, slices)
  for (std::int64_t cell = 0; cell < n; ++cell)
  {
    std::uint32_t count = 0;
    possible = Divide(source, ends, cell,
                 [&](const Part& part)
                 {
                   ++count;
                   slices += part.Slices;
                 }) &&
      possible;
    begins[cell + 1] = count;
    cells += count > 0;
  }
  const double perCell = cells > 0 ? static_cast<double>(slices) / static_cast<double>(cells) : 1;
  if (!possible || perCell > source.MostSlices || slices > MostSlicesOfAll)
  {
    return false;
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  const std::int64_t sum = begins.back();
  this->Parts.resize(sum);
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < n; ++cell)
  {
    Part* next = this->Parts.data() + begins[cell];
    Divide(source, ends, cell, [&](const Part& part) { *next++ = part; });
  }
  this->Begins = std::move(begins);
  this->Ends = std::move(ends);
  this->Sliced = slices > sum;
  return true;
}

std::int64_t CellDivision::GetNumberOfSlices(std::int32_t cell) const
{
  std::int64_t sum = 0;
  for (const Part& part : this->GetParts(cell))
  {
    sum += part.Slices;
  }
  return sum;
}

void CellDivision::FindOrder(
  std::int32_t cell, double eyeScalar, bool frontToBack, std::vector<Slice>& result) const
{
  result.clear();
  const Span<const Part> parts = this->GetParts(cell);
  const auto add = [&](const Part& part)
  {
    for (int k = 0; k < static_cast<int>(part.Slices); ++k)
    {
      result.push_back({ part, k });
    }
  };
  // Rays from the eye go up through what is above it, and down through what is below.
  std::size_t above = 0;
  while (above < parts.size() && this->Ends[parts[above].Interval] <= eyeScalar)
  {
    ++above;
  }
  for (std::size_t k = above; k < parts.size(); ++k)
  {
    add(parts[k]);
  }
  for (std::size_t k = above; k-- > 0;)
  {
    add(parts[k]);
  }
  if (!frontToBack)
  {
    std::reverse(result.begin(), result.end());
  }
}

} // namespace tetralux
