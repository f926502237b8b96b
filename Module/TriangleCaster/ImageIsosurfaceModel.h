// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageIsosurfaceModel_h
#define tetralux_ImageIsosurfaceModel_h

// Surfaces of constant scalar between the samples of a ray.

#include "TriangleCaster/CompositingBuffer.h"
#include "TriangleCaster/GradientModel.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/SamplePlaces.h"

#include <cstdint>
#include <type_traits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Each ray knows between which two values its last sample was, so that a sample is compared with
/// two values, however many surfaces there are. Gradients: NoGradients, or GradientModel where
/// lights shine.
template <class Value, class Gradients>
class ImageIsosurfaceModel : public CompositingBuffer
{
public:
  static constexpr bool AtEnds = false;
  static constexpr bool JoinsSamples = true;

  ImageIsosurfaceModel(const ImageKernelInput& in, const ImageRays& rays)
    : CompositingBuffer(in, rays)
    , Rays(rays)
    , Gradient(in, rays)
    , Scalar(LoadFloat8(rays.Kept[ScalarRow]))
    , Middle(LoadFloat8(rays.Kept[MiddleRow]))
    , Next(LoadFloat8(rays.Kept[NextRow]))
    , Below(RoundToInt(LoadFloat8(rays.Kept[BelowRow])))
  {
    this->FindBounds(in);
  }

  void StoreTo(ImageRays& rays) const
  {
    CompositingBuffer::StoreTo(rays);
    Store(rays.Kept[ScalarRow], this->Scalar);
    Store(rays.Kept[MiddleRow], this->Middle);
    Store(rays.Kept[NextRow], this->Next);
    Store(rays.Kept[BelowRow], ToFloat(this->Below));
  }

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    const Float8 scalar = sample.GetValue<Value>(in) * Float8(in.Surfaces.Sign);
    const Mask8 exists = sample.Active & (Abs(scalar) <= Float8(LargestScalar));
    const auto slab = static_cast<float>(sample.Slab);
    // A sample that none of the same part is in front of, in the slab before, begins anew.
    const Mask8 follows = AndNot(exists & (this->Next == Float8(slab)), sample.Begins);
    const Mask8 crosses = follows & this->LeavesBounds(scalar);
    if (Any(crosses))
    {
      this->Cross(in, sample, scalar, crosses);
    }
    const Mask8 begins = AndNot(exists, follows);
    if (Any(begins))
    {
      this->Begin(in, scalar, begins);
    }
    this->Scalar = Select(exists, scalar, this->Scalar);
    this->Middle = Select(exists, sample.Middle, this->Middle);
    this->Next = Select(sample.Active, Keep(exists, Float8(slab + 1.f)), this->Next);
  }

  /// No sample follows the last one of these rays.
  TETRALUX_INLINE void Restart(Mask8 rays) { this->Next = Select(rays, Float8(0.f), this->Next); }

private:
  // Rows of Kept.
  static constexpr int ScalarRow = 0;
  static constexpr int MiddleRow = 1;
  static constexpr int NextRow = 2;
  static constexpr int BelowRow = 3;

  TETRALUX_INLINE Mask8 LeavesBounds(Float8 scalar) const
  {
    return (scalar < this->Lower) | (this->Upper <= scalar);
  }

  /// The values that the ray's scalar is between, by Below.
  TETRALUX_INLINE void FindBounds(const ImageKernelInput& in)
  {
    const Int8 offset = ShiftLeft(this->Below, 2);
    this->Lower = FromBits(GatherWords(in.Surfaces.Bounds, offset));
    this->Upper = FromBits(GatherWords(in.Surfaces.Bounds + 1, offset));
  }

  TETRALUX_NOINLINE void Begin(const ImageKernelInput& in, Float8 scalar, Mask8 begins)
  {
    Int8 below = 0;
    for (int k = 1; k <= in.Surfaces.Count; ++k)
    {
      below = below + Ones(Float8(in.Surfaces.Bounds[k]) <= scalar);
    }
    this->Below = Select(begins, below, this->Below);
    this->FindBounds(in);
  }

  /// Composites the surfaces between the last sample and this one, in the order along the ray.
  TETRALUX_NOINLINE void Cross(
    const ImageKernelInput& in, const ImageSample& sample, Float8 scalar, Mask8 crosses)
  {
    ImageSample hit = sample;
    const Mask8 rises = this->Scalar < scalar;
    const Float8 way = (sample.Middle - this->Middle) / (scalar - this->Scalar);
    do
    {
      const Int8 surface =
        Select(crosses, Select(rises, this->Below, this->Below - Int8(1)), Int8(0));
      Float8 color[3], opacity;
      GatherRows(in.Surfaces.Optics, surface, color[0], color[1], color[2], opacity);
      const Float8 value = Select(rises, this->Upper, this->Lower);
      hit.Front = Fma(value - this->Scalar, way, this->Middle);
      if constexpr (IsLit)
      {
        hit.Front = Select(crosses, hit.Front, sample.Middle); // a place for each ray
        this->Light(in, hit, color);
      }
      this->AddSample(hit, Keep(crosses & this->GetOpen(), opacity), color);
      this->Below = Select(crosses, Select(rises, this->Below + Int8(1), surface), this->Below);
      this->FindBounds(in);
      crosses = crosses & this->LeavesBounds(scalar);
    } while (Any(crosses));
  }

  /// Lets lights shine on what is at hit.Front.
  TETRALUX_INLINE void Light(const ImageKernelInput& in, ImageSample& hit, Float8 (&color)[3])
  {
    hit.Share = 0.f;
    const auto slab = static_cast<float>(hit.Slab);
    PlaceSample(in, FindPositions(in, this->Rays, hit.Slab), hit.Front - Float8(slab), hit);
    typename Gradients::template Field<Value> field;
    field.LoadScalar(in, hit);
    this->Gradient.Light(in, *in.Lighting, hit, field.GetGradient(in, hit), color);
  }

  static constexpr bool IsLit = !std::is_same_v<Gradients, NoGradients>;

  const ImageRays& Rays;
  Gradients Gradient;
  Float8 Scalar; ///< of the last sample
  Float8 Middle; ///< slab position of the last sample
  Float8 Next;   ///< slab of the sample that follows the last one; 0 where none does
  Int8 Below;    ///< surfaces whose values are not above Scalar
  Float8 Lower, Upper;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
