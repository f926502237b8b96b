// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MaximumModel_h
#define tetralux_MaximumModel_h

// The largest or smallest scalar of a ray.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/ValuePixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The largest one for Sign 1, the smallest one for -1. Slabs may come in any order: of several
/// samples with the same scalar the first one along the ray is kept. Front is its slab position.
template <class Value, int Sign>
class ExtremeModel
{
public:
  static constexpr bool AtEnds = false;
  static constexpr bool InAnyOrder = true;
  static constexpr bool JoinsSamples = false;
  static constexpr bool CountsEmptyRays = false;

  ExtremeModel(const ImageKernelInput&, const ImageRays& rays)
    : Best(LoadBest(rays))
    , Front(LoadFloat8(rays.Front))
  {
  }

  void StoreTo(ImageRays& rays) const
  {
    Store(rays.Kept[BestRow], this->Best);
    Store(rays.Front, this->Front);
  }

  /// Any sample may be the best.
  TETRALUX_INLINE Mask8 GetOpen() const { return Int8(0) == Int8(0); }

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    const Float8 x = sample.GetScalar<Value>(in) * Float8(static_cast<float>(Sign));
    const Mask8 better = (this->Best < x) | ((this->Best == x) & (sample.Middle < this->Front));
    const Mask8 taken = sample.Active & better & (x <= Float8(LargestScalar));
    this->Best = Select(taken, x, this->Best);
    this->Front = Select(taken, sample.Middle, this->Front);
  }

  /// What no sample of these values exceeds, in units of Best.
  static float FindBound(const ImageKernelInput& in, const BlockRanges::Range& range)
  {
    // Interpolated values are rounded, and so is where they lie among the intervals.
    constexpr float Rounding = 1e-6f;
    const float a = Sign * (in.ValueOffset + in.ValueScale * range.Low);
    const float b = Sign * (in.ValueOffset + in.ValueScale * range.High);
    const float margin =
      Rounding * std::max({ 1.f, std::abs(a), std::abs(b), std::abs(in.ValueOffset) });
    return std::isfinite(margin) ? std::max(a, b) + margin : std::numeric_limits<float>::infinity();
  }

  /// Whether samples of that bound change no ray.
  static bool IsSettled(const ImageRays& rays, float bound)
  {
    return !Any(AndNot(LoadInt8(rays.HasPart) == Int8(-1), Float8(bound) < LoadBest(rays)));
  }

  static PixelLanes GetPixels(const ImageKernelInput& in, const ImageRays& rays)
  {
    const Float8 front = LoadFloat8(rays.Front);
    return GetValuePixels(in, Float8(0.f) <= front,
      LoadFloat8(rays.Kept[BestRow]) * Float8(static_cast<float>(Sign)), front);
  }

private:
  static constexpr int BestRow = 0; ///< of Kept

  static TETRALUX_INLINE Float8 LoadBest(const ImageRays& rays)
  {
    return Select(LoadFloat8(rays.Front) < Float8(0.f),
      Float8(-std::numeric_limits<float>::infinity()), LoadFloat8(rays.Kept[BestRow]));
  }

  Float8 Best; ///< Sign times the best scalar so far; minus infinity where there is none
  Float8 Front;
};

template <class Value>
using MaximumModel = ExtremeModel<Value, 1>;
template <class Value>
using MinimumModel = ExtremeModel<Value, -1>;

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
