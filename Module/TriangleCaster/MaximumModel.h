// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MaximumModel_h
#define tetralux_MaximumModel_h

// The largest or smallest scalar of a ray.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/ValuePixels.h"

#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Which of two scalars counts.
///@{
struct LargerScalar
{
  static constexpr float Worst = -std::numeric_limits<float>::infinity();
  static TETRALUX_INLINE Mask8 IsBetter(Float8 a, Float8 b) { return b < a; }
};
struct SmallerScalar
{
  static constexpr float Worst = std::numeric_limits<float>::infinity();
  static TETRALUX_INLINE Mask8 IsBetter(Float8 a, Float8 b) { return a < b; }
};
///@}

/// Front is the slab position of the best sample so far.
template <class Value, class Order>
class ExtremeModel
{
public:
  static constexpr bool AtEnds = false;
  static constexpr bool CountsEmptyRays = false;

  ExtremeModel(const ImageKernelInput&, const ImageRays& rays)
    : Front(LoadFloat8(rays.Front))
  {
    this->Best =
      Select(this->Front < Float8(0.f), Float8(Order::Worst), LoadFloat8(rays.Kept[BestRow]));
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
    const Float8 x = sample.GetScalar<Value>(in);
    const Mask8 better =
      sample.Active & Order::IsBetter(x, this->Best) & (Abs(x) <= Float8(LargestScalar));
    this->Best = Select(better, x, this->Best);
    this->Front = Select(better, sample.Middle, this->Front);
  }

  static PixelLanes GetPixels(const ImageKernelInput& in, const ImageRays& rays)
  {
    const Float8 front = LoadFloat8(rays.Front);
    return GetValuePixels(in, Float8(0.f) <= front, LoadFloat8(rays.Kept[BestRow]), front);
  }

private:
  static constexpr int BestRow = 0; ///< of Kept: the best scalar, where Front is not below 0

  Float8 Best;
  Float8 Front;
};

template <class Value>
using MaximumModel = ExtremeModel<Value, LargerScalar>;
template <class Value>
using MinimumModel = ExtremeModel<Value, SmallerScalar>;

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
