// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CompositeModel_h
#define tetralux_CompositeModel_h

// What emits and absorbs, composited front to back (Knittel 1999, section 3.2).

#include "Simd/LaneFunctions.h"
#include "TriangleCaster/GradientModel.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/TransferLanes.h"

#include <cstdint>
#include <type_traits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// For models that use no gradients.
struct NoGradients
{
  NoGradients(const ImageKernelInput&, const ImageRays&) {}
};

/// The compositing buffer of one vector, in registers. Gradients: NoGradients, or GradientModel
/// where lights shine or opacity depends on gradients.
template <class Value, class Intervals, class Gradients>
class CompositeModel
{
public:
  CompositeModel(const ImageKernelInput& in, const ImageRays& rays)
    : Gradient(in, rays)
    , Translucency(LoadFloat8(rays.Translucency))
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

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    const Intervals intervals(in.Transfer, sample.GetScalar<Value>(in));
    const Float8 zero = 0.f;
    Float8 scalarOpacity = intervals.GetOpacity();
    // False where the scalar is not a number.
    Mask8 visible = sample.Active & (zero < scalarOpacity);
    if (!Any(visible))
    {
      return;
    }
    LaneVector gradient;
    if constexpr (UsesGradients)
    {
      gradient = FindGradient<Value>(in, sample);
      if (in.GradientTransfer.Count > 0)
      {
        scalarOpacity = scalarOpacity * this->Gradient.GetOpacityFactor(in, gradient);
        visible = visible & (zero < scalarOpacity);
        if (!Any(visible))
        {
          return;
        }
      }
    }
    const Float8 depth = (in.Power ? MinusLogOfRest(scalarOpacity) : scalarOpacity) * sample.Length;
    const Float8 opacity = Keep(visible, OneMinusExp(depth));
    Float8 color[3];
    intervals.GetColor(color);
    if constexpr (UsesGradients)
    {
      if (in.Lighting)
      {
        this->Gradient.Light(in, sample, gradient, color);
      }
    }
    const Mask8 first = (zero < opacity) & (this->Front < zero);
    this->Front = Select(first, sample.Front, this->Front);
    // Equation 5.
    const Float8 share = this->Translucency * opacity;
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = Fma(share, Keep(visible, color[c]), this->Color[c]);
    }
    this->Translucency = this->Translucency - share;
  }

  /// The picture's pixel of a lane.
  static void GetPixel(const ImageKernelInput&, const ImageRays& rays, int lane, float (&pixel)[4])
  {
    for (int c = 0; c < 3; ++c)
    {
      pixel[c] = rays.Color[c][lane];
    }
    pixel[3] = 1.f - rays.Translucency[lane];
  }

private:
  static constexpr bool UsesGradients = !std::is_same_v<Gradients, NoGradients>;

  Gradients Gradient;
  Float8 Color[3];
  Float8 Translucency;
  Float8 Front;
  Float8 Threshold;
};

template <class Value, class Intervals>
using PlainComposite = CompositeModel<Value, Intervals, NoGradients>;
template <class Value, class Intervals>
using GradientComposite = CompositeModel<Value, Intervals, GradientModel>;

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
