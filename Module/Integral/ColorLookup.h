// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ColorLookup_h
#define tetralux_ColorLookup_h

#include "Optics/IntervalTable.h"
#include "Simd/Lanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Colour and opacity at a scalar, as the intervals map it; at a step the value from larger
/// scalars. What is not a number is transparent.
TETRALUX_INLINE void LookUpColor(
  const IntervalTable::Interval* intervals, int count, float x, float (&color)[4])
{
  int first = 0;
  while (count > 1)
  {
    const int half = count / 2;
    const bool above = intervals[first + half].Lo <= x;
    first += above ? half : 0;
    count = above ? count - half : half;
  }
  const IntervalTable::Interval& t = intervals[first];
  const float along = x - t.Reference;
  const float opacity = t.Attenuation + t.AttenuationSlope * along;
  const float positive = opacity > 0.f ? opacity : 0.f; // also of what is not a number
  color[3] = positive < 1.f ? positive : 1.f;
  for (int c = 0; c < 3; ++c)
  {
    color[c] = x == x ? t.Color[c] + t.ColorSlope[c] * along : 0.f;
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
