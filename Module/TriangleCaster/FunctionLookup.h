// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FunctionLookup_h
#define tetralux_FunctionLookup_h

#include "Optics/IntervalTable.h"
#include "TriangleCaster/ImageKernel.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// For each bucket of equal width over [-1, 1] the interval that its lower end lies in, or one
/// below.
struct IntervalBuckets
{
  std::vector<std::int32_t> First;
  int MostSteps = 0; ///< the most intervals that a scalar of a bucket lies above that
};

/// A transfer function, and what its lookup points to.
struct FunctionLookup
{
  IntervalTable Table;
  IntervalBuckets Buckets;
  TransferLookup Lookup;

  /// Throws as MakeIntervalTable.
  void Set(const TransferFunction& function);

  /// Where a scalar lies in the intervals: x = scale s + offset.
  ///@{
  double GetScale() const { return 1 / this->Table.Scale; }
  double GetOffset() const { return -this->Table.Offset / this->Table.Scale; }
  ///@}
};

/// Several transfer functions over one range of scalars, and what their common lookup points to.
/// A kernel looks them up by buckets.
struct FunctionsLookup
{
  std::vector<IntervalTable> Tables; ///< all of the same Offset and Scale
  std::vector<IntervalTable::Interval> Intervals;
  IntervalBuckets Buckets;
  TransferLookup Lookup; ///< of no intervals if there are no functions

  /// Throws as MakeIntervalTable.
  void Set(std::vector<TransferFunction> functions);

  /// As those of FunctionLookup.
  ///@{
  double GetScale() const { return 1 / this->Tables.front().Scale; }
  double GetOffset() const { return -this->Tables.front().Offset / this->Tables.front().Scale; }
  ///@}
};

} // namespace tetralux

#endif
