// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CompositingBuffer_h
#define tetralux_CompositingBuffer_h

// Compositing front to back (Knittel 1999, section 3.2).

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The compositing buffer of one vector, in registers.
class CompositingBuffer
{
public:
  /// Whether a ray has a pixel even if nothing of it contributes.
  static constexpr bool CountsEmptyRays = false;
  /// Whether a sample depends on the one before it.
  static constexpr bool JoinsSamples = false;

  /// Whether slabs may come in any order.
  static constexpr bool InAnyOrder = false;

  CompositingBuffer(const ImageKernelInput& in, const ImageRays& rays)
    : Translucency(LoadFloat8(rays.Translucency))
    , Front(LoadFloat8(rays.Front))
    , Threshold(in.Threshold)
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = LoadFloat8(rays.Color[c]);
    }
  }

  void StoreTo(ImageRays& rays) const
  {
    for (int c = 0; c < 3; ++c)
    {
      Store(rays.Color[c], this->Color[c]);
    }
    Store(rays.Translucency, this->Translucency);
    Store(rays.Front, this->Front);
  }

  /// Rays that what is behind can still change.
  TETRALUX_INLINE Mask8 GetOpen() const { return this->Threshold <= this->Translucency; }

  /// What the picture has of rays that have ended.
  static PixelLanes GetPixels(const ImageKernelInput&, const ImageRays& rays)
  {
    PixelLanes pixels;
    for (int c = 0; c < 3; ++c)
    {
      pixels.Color[c] = LoadFloat8(rays.Color[c]);
    }
    pixels.Opacity = Float8(1.f) - LoadFloat8(rays.Translucency);
    pixels.Front = LoadFloat8(rays.Front);
    return pixels;
  }

protected:
  /// Depth cueing (section 2.2), if there is any.
  static TETRALUX_INLINE void Cue(
    const ImageKernelInput& in, const ImageSample& sample, Float8 (&color)[3])
  {
    if (!in.Cued)
    {
      return;
    }
    const Float8 depth = Fma(Float8(0.5f), sample.Share, sample.Front);
    for (int c = 0; c < 3; ++c)
    {
      color[c] = color[c] * Fma(Float8(in.CueStep[c]), depth, Float8(in.Cue[c]));
    }
  }

  /// Equation 5. Where the opacity is 0, colours have to be numbers.
  TETRALUX_INLINE void AddSample(
    const ImageSample& sample, Float8 opacity, const Float8 (&color)[3])
  {
    const Float8 share = this->Translucency * opacity;
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = Fma(share, color[c], this->Color[c]);
    }
    this->Attenuate(sample, opacity, share);
  }
  /// The same with colours that the opacity is multiplied to.
  TETRALUX_INLINE void AddPremultiplied(
    const ImageSample& sample, Float8 opacity, const Float8 (&color)[3])
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = Fma(this->Translucency, color[c], this->Color[c]);
    }
    this->Attenuate(sample, opacity, this->Translucency * opacity);
  }

private:
  TETRALUX_INLINE void Attenuate(const ImageSample& sample, Float8 opacity, Float8 share)
  {
    const Float8 zero = 0.f;
    this->Front = Select((zero < opacity) & (this->Front < zero), sample.Front, this->Front);
    this->Translucency = this->Translucency - share;
  }

  Float8 Color[3];
  Float8 Translucency;
  Float8 Front;
  Float8 Threshold;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
