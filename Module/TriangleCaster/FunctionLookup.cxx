// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/FunctionLookup.h"

#include "Base/Span.h"

#include <algorithm>
#include <limits>

namespace tetralux
{
namespace
{

/// Appends the buckets of a function. before: intervals of functions before it.
void AppendBuckets(const std::vector<IntervalTable::Interval>& intervals, std::int32_t before,
  int count, IntervalBuckets& buckets)
{
  // The bucket of a scalar is rounded; a scalar may lie this far outside of its own.
  constexpr double Rounding = 1e-5; // of the whole range
  std::size_t first = 0;
  std::size_t last = 0;
  for (int b = 0; b < count; ++b)
  {
    const double low = 2. * b / count - 1 - Rounding;
    const double high = 2. * (b + 1) / count - 1 + Rounding;
    while (intervals[first].Hi <= low)
    {
      ++first;
    }
    while (last + 1 < intervals.size() && intervals[last].Hi <= high)
    {
      ++last;
    }
    // The first and last bucket take what is beyond.
    const std::size_t begin = b == 0 ? 0 : first;
    const std::size_t end = b + 1 == count ? intervals.size() - 1 : last;
    buckets.First.push_back(before + static_cast<std::int32_t>(begin));
    buckets.MostSteps = std::max(buckets.MostSteps, static_cast<int>(end - begin));
  }
}

/// Buckets of functions, as few as it takes to find any scalar in a few steps. Returns how many
/// each function has.
int MakeBuckets(Span<const IntervalTable> tables, IntervalBuckets& buckets)
{
  // A step to the next interval costs as much as looking up a bucket; nodes that are closer
  // together than the smallest buckets cost more steps.
  constexpr int FewSteps = 2;
  constexpr int FirstCount = 1024;
  constexpr int LargestCount = 65536;
  for (int count = FirstCount;; count *= 4)
  {
    buckets = IntervalBuckets();
    std::int32_t before = 0;
    for (const IntervalTable& table : tables)
    {
      AppendBuckets(table.Intervals, before, count, buckets);
      before += static_cast<std::int32_t>(table.Intervals.size());
    }
    if (buckets.MostSteps <= FewSteps || count == LargestCount)
    {
      return count;
    }
  }
}

/// Makes functions reach over the same range of scalars.
void Widen(std::vector<TransferFunction>& functions)
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const TransferFunction& function : functions)
  {
    if (!function.Nodes.empty())
    {
      low = std::min(low, function.Nodes.front().Scalar);
      high = std::max(high, function.Nodes.back().Scalar);
    }
  }
  for (TransferFunction& function : functions)
  {
    std::vector<TransferFunction::Node>& nodes = function.Nodes;
    if (!nodes.empty() && low < nodes.front().Scalar)
    {
      const TransferFunction::Value first = nodes.front().Left;
      nodes.insert(nodes.begin(), { low, first, first });
    }
    if (!nodes.empty() && nodes.back().Scalar < high)
    {
      const TransferFunction::Value last = nodes.back().Right;
      nodes.push_back({ high, last, last });
    }
  }
}

} // namespace

void FunctionLookup::Set(const TransferFunction& function)
{
  this->Table = MakeIntervalTable(function);
  const std::vector<IntervalTable::Interval>& intervals = this->Table.Intervals;
  TransferLookup& transfer = this->Lookup;
  transfer = TransferLookup();
  transfer.Count = static_cast<int>(intervals.size());
  transfer.Intervals = intervals.data();
  for (int k = 0; k < TransferLookup::MostFew; ++k)
  {
    const IntervalTable::Interval& interval =
      intervals[std::min<std::size_t>(k, intervals.size() - 1)];
    transfer.Lower[k] = interval.Lo;
    transfer.Reference[k] = interval.Reference;
    transfer.Opacity[k] = interval.Attenuation;
    transfer.OpacitySlope[k] = interval.AttenuationSlope;
    for (int c = 0; c < 3; ++c)
    {
      transfer.Color[c][k] = interval.Color[c];
      transfer.ColorSlope[c][k] = interval.ColorSlope[c];
    }
  }
  if (transfer.Count > TransferLookup::MostFew)
  {
    transfer.NumberOfBuckets =
      static_cast<float>(MakeBuckets(Span<const IntervalTable>(&this->Table, 1), this->Buckets));
    transfer.Buckets = this->Buckets.First.data();
    transfer.MostSteps = this->Buckets.MostSteps;
  }
}

void FunctionsLookup::Set(std::vector<TransferFunction> functions)
{
  this->Tables.clear();
  this->Intervals.clear();
  this->Lookup = TransferLookup();
  if (functions.empty())
  {
    return;
  }
  Widen(functions);
  for (const TransferFunction& function : functions)
  {
    this->Tables.push_back(MakeIntervalTable(function));
    const std::vector<IntervalTable::Interval>& intervals = this->Tables.back().Intervals;
    this->Intervals.insert(this->Intervals.end(), intervals.begin(), intervals.end());
  }
  this->Lookup.Count = static_cast<int>(this->Intervals.size());
  this->Lookup.Intervals = this->Intervals.data();
  this->Lookup.NumberOfBuckets = static_cast<float>(MakeBuckets(this->Tables, this->Buckets));
  this->Lookup.Buckets = this->Buckets.First.data();
  this->Lookup.MostSteps = this->Buckets.MostSteps;
}

} // namespace tetralux
