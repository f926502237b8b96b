// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SlabModel_h
#define tetralux_SlabModel_h

// Pre-integrated slabs: what is between two samples comes from a table of the scalars at both, so
// that no colour or opacity between them is missed.

#include "Simd/LaneFunctions.h"
#include "TriangleCaster/CompositingBuffer.h"
#include "TriangleCaster/ImageSample.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A place between texels along an axis of the table.
struct SlabPlace
{
  Int8 Index;
  Float8 Share;

  TETRALUX_INLINE SlabPlace(Float8 coordinate, int size)
  {
    const Float8 last = static_cast<float>(size - 2);
    this->Index = RoundToInt(Min(Max(coordinate - Float8(0.5f), Float8(0.f)), last));
    this->Share = Min(Max(coordinate - ToFloat(this->Index), Float8(0.f)), Float8(1.f));
  }
};

template <class Value>
class SlabModel : public CompositingBuffer
{
public:
  /// Samples are at the far ends of stretches.
  static constexpr bool AtEnds = true;

  SlabModel(const ImageKernelInput& in, const ImageRays& rays)
    : CompositingBuffer(in, rays)
    , Scalar(0.f)
    , End(-1.f)
  {
  }

  /// sample: at the far end of a stretch. getFront(): the sample at its near end.
  template <class GetFrontT>
  TETRALUX_INLINE void Add(
    const ImageKernelInput& in, const ImageSample& sample, const GetFrontT& getFront)
  {
    const SlabLookup& slab = in.Slab;
    // Where a stretch begins where the last one ended, its near scalar is known.
    const Mask8 continues = this->End == sample.Front;
    if (Any(AndNot(sample.Active, continues)))
    {
      this->Scalar = Select(continues, this->Scalar, GetCoordinate(in, getFront()));
    }
    const Float8 front = this->Scalar;
    const Float8 back = GetCoordinate(in, sample);
    this->Scalar = back;
    this->End = sample.Front + sample.Share;
    // False where a scalar is not a number.
    const Mask8 known = sample.Active & (front == front) & (back == back);
    const SlabPlace f(front, slab.Size);
    const SlabPlace b(back, slab.Size);
    const Int8 row = b.Index * Int8(slab.Size) + f.Index;
    Float8 texel[4];
    Float8 corners[4][4];
    for (int k = 0; k < 4; ++k)
    {
      const Int8 at = row + Int8((k & 1) + (k >> 1) * slab.Size);
      GatherRows(slab.Texels, at, corners[k][0], corners[k][1], corners[k][2], corners[k][3]);
    }
    for (int c = 0; c < 4; ++c)
    {
      texel[c] = Mix(Mix(corners[0][c], corners[1][c], f.Share),
        Mix(corners[2][c], corners[3][c], f.Share), b.Share);
    }
    const Float8 zero = 0.f;
    const Mask8 visible = known & (zero < texel[3]);
    if (!Any(visible))
    {
      return;
    }
    // A stretch of another length has another share of the same optical depth.
    const Float8 opacity = Keep(
      visible, OneMinusExp(MinusLogOfRest(texel[3]) * (sample.Length * Float8(slab.PerLength))));
    const Float8 share = Keep(visible, opacity / texel[3]);
    Float8 color[3];
    for (int c = 0; c < 3; ++c)
    {
      color[c] = share * Keep(visible, texel[c]);
    }
    Cue(in, sample, color); // by the factor in the middle of the slab
    this->AddPremultiplied(sample, opacity, color);
  }

private:
  static TETRALUX_INLINE Float8 GetCoordinate(const ImageKernelInput& in, const ImageSample& sample)
  {
    return Fma(sample.GetValue<Value>(in), Float8(in.Slab.CoordinateScale),
      Float8(in.Slab.CoordinateOffset));
  }

  Float8 Scalar; ///< texel coordinate at the last sample
  Float8 End;    ///< slab position of it
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
