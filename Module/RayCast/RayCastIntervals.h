// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastIntervals_h
#define tetralux_RayCastIntervals_h

// Intervals of a transfer function in lanes.

#include "Optics/IntervalTable.h"
#include "RayCast/RayCastKernel.h"
#include "Simd/Lanes.h"

#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The first row of an interval of an IntervalTable.
TETRALUX_INLINE Int8 FindIntervalRow(Int8 interval) { return ShiftLeft(interval, 2); }

/// Where intervals end.
TETRALUX_INLINE Float8 LoadEnd(const KernelInput& in, Int8 interval)
{
  if (in.NumberOfIntervals <= IntervalColumns::Few)
  {
    return LookUp(reinterpret_cast<const float(&)[IntervalColumns::Few]>(in.Columns->Hi), interval);
  }
  constexpr auto Row = static_cast<std::int32_t>(sizeof(IntervalTable::Interval));
  return FromBits(GatherWords(&in.Intervals->Hi, interval * Int8(Row)));
}

/// The first interval for which endsBefore(its end) is false. That of the last one is false.
template <class EndsBeforeT>
TETRALUX_INLINE Int8 FindInterval(const KernelInput& in, EndsBeforeT endsBefore)
{
  Int8 first = 0;
  Int8 last = in.NumberOfIntervals - 1;
  for (Mask8 open = last > first; Any(open); open = last > first)
  {
    const Int8 middle = ShiftRight(first + last, 1);
    const Mask8 before = open & endsBefore(LoadEnd(in, middle));
    first = Select(before, middle + Int8(1), first);
    last = Select(AndNot(open, before), middle, last);
  }
  return first;
}

/// An interval of the transfer function in each lane.
struct IntervalLanes
{
  Float8 Lo, Hi, Reference, Attenuation, AttenuationSlope;
  Float8 Color[3], ColorSlope[3], ColorBend[3];
};

/// Looks intervals up in the first Size ones of the table.
template <int Size>
TETRALUX_INLINE IntervalLanes LookUpInterval(const KernelInput& in, Int8 interval)
{
  const IntervalColumns& columns = *in.Columns;
  const auto find = [&](const IntervalColumns::Column& column)
  { return LookUp(reinterpret_cast<const float(&)[Size]>(column), interval); };
  IntervalLanes t;
  t.Lo = find(columns.Lo);
  t.Hi = find(columns.Hi);
  t.Reference = find(columns.Reference);
  t.Attenuation = find(columns.Attenuation);
  t.AttenuationSlope = find(columns.AttenuationSlope);
  for (int c = 0; c < 3; ++c)
  {
    t.Color[c] = find(columns.Color[c]);
    t.ColorSlope[c] = find(columns.ColorSlope[c]);
    t.ColorBend[c] = 0.f;
  }
  if (in.Curved)
  {
    for (int c = 0; c < 3; ++c)
    {
      t.ColorBend[c] = find(columns.ColorBend[c]);
    }
  }
  return t;
}

TETRALUX_INLINE IntervalLanes GatherInterval(const KernelInput& in, Int8 interval)
{
  const Int8 row = FindIntervalRow(interval);
  const auto* rows = reinterpret_cast<const float*>(in.Intervals);
  IntervalLanes t;
  t.ColorBend[0] = t.ColorBend[1] = t.ColorBend[2] = 0.f;
  Float8 unused;
  GatherRows(rows, row, t.Lo, t.Hi, t.Reference, t.Attenuation);
  GatherRows(rows, row + Int8(1), t.AttenuationSlope, t.Color[0], t.Color[1], t.Color[2]);
  GatherRows(rows, row + Int8(2), t.ColorSlope[0], t.ColorSlope[1], t.ColorSlope[2], unused);
  if (in.Curved)
  {
    GatherRows(rows, row + Int8(3), t.ColorBend[0], t.ColorBend[1], t.ColorBend[2], unused);
  }
  return t;
}

TETRALUX_INLINE IntervalLanes LoadInterval(const KernelInput& in, Int8 interval)
{
  if (in.NumberOfIntervals <= IntervalColumns::Few)
  {
    return LookUpInterval<IntervalColumns::Few>(in, interval);
  }
  if constexpr (IntervalColumns::Most == 4 * LaneCount)
  {
    if (in.NumberOfIntervals <= 2 * LaneCount)
    {
      return LookUpInterval<2 * LaneCount>(in, interval);
    }
    if (in.NumberOfIntervals <= 3 * LaneCount)
    {
      return LookUpInterval<3 * LaneCount>(in, interval);
    }
    if (in.NumberOfIntervals <= IntervalColumns::Most)
    {
      return LookUpInterval<IntervalColumns::Most>(in, interval);
    }
  }
  return GatherInterval(in, interval);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
