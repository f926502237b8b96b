// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ClassifiedLanes_h
#define tetralux_ClassifiedLanes_h

// Transfer functions looked up one by one, where a sample has several of them.

#include "TriangleCaster/TransferLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A transfer function at a scalar.
struct Classified
{
  Float8 Opacity;
  Float8 Color[3];
};

/// By the lookup that is fastest for this function.
TETRALUX_NOINLINE Classified Classify(const TransferLookup& transfer, Float8 x)
{
  const auto evaluate = [](const auto& intervals)
  {
    Classified classified;
    classified.Opacity = intervals.GetOpacity();
    intervals.GetColor(classified.Color);
    return classified;
  };
  if (transfer.Count <= LaneCount)
  {
    return evaluate(FewIntervals<LaneCount>(transfer, x));
  }
  if (transfer.Count <= TransferLookup::MostFew)
  {
    return evaluate(FewIntervals<TransferLookup::MostFew>(transfer, x));
  }
  return evaluate(ManyIntervals(transfer, x));
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
