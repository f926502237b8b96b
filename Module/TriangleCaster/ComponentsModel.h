// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComponentsModel_h
#define tetralux_ComponentsModel_h

// Several independent components, each with functions of its own, composited front to back.

#include "Simd/LaneFunctions.h"
#include "TriangleCaster/ClassifiedLanes.h"
#include "TriangleCaster/ComponentLanes.h"
#include "TriangleCaster/CompositingBuffer.h"
#include "TriangleCaster/GradientModel.h"

#include <type_traits>
#include <utility>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// What components of a sample add up to; ImageComponents::Independent.
struct ComponentSum
{
  Float8 Opacity = 0.f; ///< of w alpha
  Float8 Squares = 0.f; ///< of alpha^2
  Float8 Color[3] = { 0.f, 0.f, 0.f };
};

/// N components. Gradients: as of LitBuffer.
template <class Value, int N, class Gradients>
class ComponentsModel : public CompositingBuffer
{
public:
  static constexpr bool AtEnds = false;

  ComponentsModel(const ImageKernelInput& in, const ImageRays& rays)
    : CompositingBuffer(in, rays)
    , Gradient(in, rays)
  {
  }

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    Float8 value[N];
    InterpolatePoints<Value>(in.Values, sample.Index, in.Row, in.Slice, sample.Place, value);
    ComponentSum sum;
    this->AddAll(in, sample, value, sum, std::make_integer_sequence<int, N>());
    const Float8 zero = 0.f;
    const Mask8 visible = zero < sum.Opacity;
    if (!Any(visible))
    {
      return;
    }
    Cue(in, sample, sum.Color);
    const Float8 opacity = Min(Keep(visible, sum.Squares / sum.Opacity), Float8(1.f));
    this->AddPremultiplied(sample, opacity, sum.Color);
  }

private:
  static constexpr bool UsesGradients = !std::is_same_v<Gradients, NoGradients>;

  template <int... Cs>
  TETRALUX_INLINE void AddAll(const ImageKernelInput& in, const ImageSample& sample,
    const Float8 (&value)[N], ComponentSum& sum, std::integer_sequence<int, Cs...>) const
  {
    (this->AddComponent<Cs>(in, sample, value[Cs], sum), ...);
  }

  template <int C>
  TETRALUX_INLINE void AddComponent(
    const ImageKernelInput& in, const ImageSample& sample, Float8 value, ComponentSum& sum) const
  {
    const ComponentLookup& part = in.Parts[C];
    if (!(part.Weight > 0))
    {
      return;
    }
    const Float8 zero = 0.f;
    Classified classified =
      Classify(part.Transfer, Fma(value, Float8(part.ValueScale), Float8(part.ValueOffset)));
    Float8 scalarOpacity = classified.Opacity;
    // False where the scalar is not a number.
    Mask8 visible = sample.Active & (zero < scalarOpacity);
    if (!Any(visible))
    {
      return;
    }
    if constexpr (UsesGradients)
    {
      if (part.Lighting || part.GradientTransfer.Count > 0)
      {
        const LaneVector gradient = FindGradient<Component<Value, N, C>>(in, sample);
        if (part.GradientTransfer.Count > 0)
        {
          const Float8 x = Fma(this->Gradient.GetLength(in, gradient), Float8(part.GradientScale),
            Float8(part.GradientOffset));
          scalarOpacity = scalarOpacity * Classify(part.GradientTransfer, x).Opacity;
          visible = visible & (zero < scalarOpacity);
        }
        if (part.Lighting && Any(visible))
        {
          this->Gradient.Light(in, *part.Lighting, sample, gradient, classified.Color);
        }
      }
    }
    const Float8 depth = (in.Power ? MinusLogOfRest(scalarOpacity) : scalarOpacity) *
      (sample.Length * Float8(part.LengthScale));
    const Float8 opacity = Keep(visible, OneMinusExp(depth));
    const Float8 weighted = opacity * Float8(part.Weight);
    sum.Opacity = sum.Opacity + weighted;
    sum.Squares = Fma(opacity, opacity, sum.Squares);
    for (int c = 0; c < 3; ++c)
    {
      sum.Color[c] = Fma(weighted, Keep(visible, classified.Color[c]), sum.Color[c]);
    }
  }

  Gradients Gradient;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
