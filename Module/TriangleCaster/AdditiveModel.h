// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_AdditiveModel_h
#define tetralux_AdditiveModel_h

// The sum of what samples have of grey.

#include "TriangleCaster/AverageModel.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/TransferLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

template <class Value, class Intervals>
class AdditiveModel
{
public:
  static constexpr bool AtEnds = false;
  static constexpr bool InAnyOrder = false;
  static constexpr bool JoinsSamples = false;
  static constexpr bool CountsEmptyRays = true;

  AdditiveModel(const ImageKernelInput&, const ImageRays& rays)
    : Sum(LoadFloat8(rays.Kept[SumRow]))
    , Front(LoadFloat8(rays.Front))
  {
  }

  void StoreTo(ImageRays& rays) const
  {
    Store(rays.Kept[SumRow], this->Sum);
    Store(rays.Front, this->Front);
  }

  /// Nothing is taken away, and nothing is brighter than 1.
  TETRALUX_INLINE Mask8 GetOpen() const { return this->Sum < Float8(1.f); }

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    const Float8 zero = 0.f;
    const Float8 value = sample.GetValue<Value>(in);
    const Intervals intervals(in.Transfer, FindScalar(in, value));
    const Float8 grey = intervals.GetOpacity() * FindGrey(in, value) * sample.Length;
    // False where the scalar is not a number.
    const Mask8 counts = sample.Active & (zero < grey) & (Abs(value) <= Float8(LargestScalar));
    this->Sum = this->Sum + Keep(counts, grey);
    this->Front = Select(counts & (this->Front < zero), sample.Front, this->Front);
  }

  static PixelLanes GetPixels(const ImageKernelInput&, const ImageRays& rays)
  {
    return GetGreyPixels(
      LoadInt8(rays.HasPart) == Int8(-1), LoadFloat8(rays.Kept[SumRow]), LoadFloat8(rays.Front));
  }

private:
  static constexpr int SumRow = 0; ///< of Kept

  Float8 Sum; ///< of opacity times grey times length
  Float8 Front;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
