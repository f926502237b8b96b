// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DependentModel_h
#define tetralux_DependentModel_h

// Components that together are colour and opacity, composited front to back.

#include "Simd/LaneFunctions.h"
#include "TriangleCaster/ClassifiedLanes.h"
#include "TriangleCaster/ComponentLanes.h"
#include "TriangleCaster/GradientModel.h"
#include "TriangleCaster/LitBuffer.h"

#include <algorithm>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// N, 2 or 4, components; ImageComponents::Dependent. Gradients: as of LitBuffer.
template <class Value, int N, class Gradients>
class DependentModel : public LitBuffer<Gradients>
{
public:
  using LitBuffer<Gradients>::LitBuffer;

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    Float8 value[N];
    InterpolatePoints<Value>(in.Values, sample.Index, in.Row, in.Slice, sample.Place, value);
    const Float8 zero = 0.f;
    Float8 scalarOpacity = Classify(in.Transfer, this->GetScalar(in, value[N - 1])).Opacity;
    // False where a scalar is not a number.
    Mask8 visible = sample.Active & (zero < scalarOpacity);
    for (int c = 0; c + 1 < N; ++c)
    {
      visible = visible & (value[c] == value[c]);
    }
    if (!Any(visible))
    {
      return;
    }
    LaneVector gradient;
    if constexpr (UsesGradients)
    {
      gradient = FindGradient<Component<Value, N, N - 1>>(in, sample);
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
    if constexpr (N == 2)
    {
      const Classified classified = Classify(in.Transfer, this->GetScalar(in, value[0]));
      std::copy(classified.Color, classified.Color + 3, color);
    }
    else
    {
      for (int c = 0; c < 3; ++c)
      {
        color[c] = Fma(value[c], Float8(in.ColorScale[c]), Float8(in.ColorOffset[c]));
      }
    }
    this->AddLit(in, sample, visible, gradient, opacity, color);
  }

private:
  using LitBuffer<Gradients>::UsesGradients;

  static TETRALUX_INLINE Float8 GetScalar(const ImageKernelInput& in, Float8 value)
  {
    return Fma(value, Float8(in.ValueScale), Float8(in.ValueOffset));
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
