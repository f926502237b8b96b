// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_AverageModel_h
#define tetralux_AverageModel_h

// The mean of what samples have of grey, over scalars of a range.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/TransferLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Grey of a value, 0..1.
TETRALUX_INLINE Float8 FindGrey(const ImageKernelInput& in, Float8 value)
{
  const Float8 grey = Fma(value, Float8(in.GreyScale), Float8(in.GreyOffset));
  return Min(Max(grey, Float8(0.f)), Float8(1.f));
}

/// Pixels of one grey, at most 1, opaque where they exist.
inline PixelLanes GetGreyPixels(Mask8 exists, Float8 grey, Float8 front)
{
  PixelLanes pixels;
  const Float8 one = 1.f;
  for (Float8& color : pixels.Color)
  {
    color = Keep(exists, Min(grey, one));
  }
  pixels.Opacity = Keep(exists, one);
  pixels.Front = front;
  return pixels;
}

template <class Value, class Intervals>
class AverageModel
{
public:
  static constexpr bool AtEnds = false;
  static constexpr bool InAnyOrder = false;
  static constexpr bool JoinsSamples = false;
  static constexpr bool CountsEmptyRays = false;

  AverageModel(const ImageKernelInput&, const ImageRays& rays)
    : Sum(LoadFloat8(rays.Kept[SumRow]))
    , Weight(LoadFloat8(rays.Kept[WeightRow]))
    , Front(LoadFloat8(rays.Front))
  {
  }

  void StoreTo(ImageRays& rays) const
  {
    Store(rays.Kept[SumRow], this->Sum);
    Store(rays.Kept[WeightRow], this->Weight);
    Store(rays.Front, this->Front);
  }

  /// Any sample counts.
  TETRALUX_INLINE Mask8 GetOpen() const { return Int8(0) == Int8(0); }

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    const Float8 value = sample.GetValue<Value>(in);
    const Mask8 counts =
      sample.Active & (Float8(in.AverageLow) <= value) & (value <= Float8(in.AverageHigh));
    if (!Any(counts))
    {
      return;
    }
    const Intervals intervals(in.Transfer, FindScalar(in, value));
    // All slabs of a ray have the same length.
    const Float8 share = Keep(counts, sample.Share);
    const Float8 grey = Keep(counts, intervals.GetOpacity() * FindGrey(in, value));
    this->Sum = Fma(share, grey, this->Sum);
    this->Weight = this->Weight + share;
    this->Front = Select(counts & (this->Front < Float8(0.f)), sample.Front, this->Front);
  }

  static PixelLanes GetPixels(const ImageKernelInput&, const ImageRays& rays)
  {
    const Float8 front = LoadFloat8(rays.Front);
    const Mask8 exists = Float8(0.f) <= front;
    const Float8 weight = Select(exists, LoadFloat8(rays.Kept[WeightRow]), Float8(1.f));
    return GetGreyPixels(exists, LoadFloat8(rays.Kept[SumRow]) / weight, front);
  }

private:
  // Rows of Kept.
  static constexpr int SumRow = 0;
  static constexpr int WeightRow = 1;

  Float8 Sum;    ///< of opacity times grey times the share of a slab
  Float8 Weight; ///< of those shares
  Float8 Front;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
