// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferLanes_h
#define tetralux_TransferLanes_h

// The transfer function at a scalar in each lane: exact at every node, by no table of samples.

#include "Simd/Lanes.h"
#include "TriangleCaster/ImageKernel.h"

#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A transfer function of at most Capacity intervals, looked up in registers.
template <int Capacity>
class FewIntervals
{
public:
  TETRALUX_INLINE FewIntervals(const TransferLookup& transfer, Float8 x)
    : Transfer(transfer)
    , X(x)
  {
    Int8 index = 0;
    for (int k = 1; k < transfer.Count; ++k)
    {
      index = index + Ones(Float8(transfer.Lower[k]) <= x);
    }
    this->Index = index;
    this->Offset = x - this->Find(transfer.Reference);
  }
  TETRALUX_INLINE Float8 GetOpacity() const
  {
    return Fma(
      this->Find(this->Transfer.OpacitySlope), this->Offset, this->Find(this->Transfer.Opacity));
  }
  TETRALUX_INLINE void GetColor(Float8 (&color)[3]) const
  {
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Fma(this->Find(this->Transfer.ColorSlope[c]), this->Offset,
        this->Find(this->Transfer.Color[c]));
    }
  }

private:
  TETRALUX_INLINE Float8 Find(const float (&fields)[TransferLookup::MostFew]) const
  {
    if constexpr (Capacity <= LaneCount)
    {
      return LookUp(reinterpret_cast<const float(&)[LaneCount]>(fields), this->Index);
    }
    else
    {
      return LookUp(fields, this->Index);
    }
  }

  const TransferLookup& Transfer;
  Float8 X;
  Float8 Offset;
  Int8 Index;
};

/// One of any number of intervals.
class ManyIntervals
{
public:
  /// function: which one, if the lookup has several of them.
  ManyIntervals(const TransferLookup& transfer, Float8 x, Int8 function = 0)
  {
    const Float8 most = transfer.NumberOfBuckets - 1.f;
    const Float8 half = 0.5f * transfer.NumberOfBuckets;
    const Float8 bucket = Min(Max(Fma(x, half, half - Float8(0.5f)), Float8(0.f)), most);
    const Int8 ofFunction = function * Int8(static_cast<std::int32_t>(transfer.NumberOfBuckets));
    Int8 index = GatherWords(transfer.Buckets, ShiftLeft(RoundToInt(bucket) + ofFunction, 2));
    const auto* rows = reinterpret_cast<const float*>(transfer.Intervals);
    // No scalar is above the last interval, an infinite one neither.
    const Float8 finite = Min(Float8(std::numeric_limits<float>::max()), x);
    Float8 lower, upper;
    for (int step = 0;; ++step)
    {
      GatherRows(rows, ShiftLeft(index, 2), lower, upper, this->Reference, this->Opacity);
      const Mask8 above = upper <= finite;
      if (step == transfer.MostSteps || !Any(above))
      {
        break;
      }
      index = index + Ones(above);
    }
    this->Row = ShiftLeft(index, 2); // four rows of an interval
    this->Rows = rows;
    this->Offset = x - this->Reference;
    GatherRows(rows, this->Row + Int8(1), this->OpacitySlope, this->Color[0], this->Color[1],
      this->Color[2]);
  }
  TETRALUX_INLINE Float8 GetOpacity() const
  {
    return Fma(this->OpacitySlope, this->Offset, this->Opacity);
  }
  TETRALUX_INLINE void GetColor(Float8 (&color)[3]) const
  {
    Float8 slope[3], unused;
    GatherRows(this->Rows, this->Row + Int8(2), slope[0], slope[1], slope[2], unused);
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Fma(slope[c], this->Offset, this->Color[c]);
    }
  }

private:
  const float* Rows;
  Int8 Row;
  Float8 Reference, Opacity, OpacitySlope, Offset;
  Float8 Color[3];
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
