// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LabelModel_h
#define tetralux_LabelModel_h

// Labels that choose among functions, composited front to back.

#include "Simd/LaneFunctions.h"
#include "TriangleCaster/GradientModel.h"
#include "TriangleCaster/LitBuffer.h"
#include "TriangleCaster/MaskLanes.h"
#include "TriangleCaster/TransferLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// ImageOptics::Labels. Gradients: as of LitBuffer.
template <class Value, class Gradients>
class LabelModel : public LitBuffer<Gradients>
{
public:
  using LitBuffer<Gradients>::LitBuffer;

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    const LabelsLookup& labels = *in.Labels;
    const Float8 zero = 0.f;
    const Float8 x =
      Fma(sample.GetValue<Value>(in), Float8(labels.ValueScale), Float8(labels.ValueOffset));
    const Int8 label = LoadNearest(in, sample, labels.Labels);
    const Int8 function = GatherWords(labels.Rows, ShiftLeft(label, 2));
    const ManyIntervals ofLabel(labels.Transfer, x, function);
    if (!Any(sample.Active & (zero < ofLabel.GetOpacity())) && !(labels.Share < 1))
    {
      return;
    }
    Float8 gradientX = 0.f;
    LaneVector gradient;
    if constexpr (UsesGradients)
    {
      gradient = FindGradient<Value>(in, sample);
      if (labels.GradientTransfer.Count > 0)
      {
        gradientX = Fma(this->Gradient.GetLength(in, gradient), Float8(labels.GradientScale),
          Float8(labels.GradientOffset));
      }
    }
    Float8 opacity = FindOpacity(in, sample, ofLabel.GetOpacity(), gradientX, function);
    Float8 color[3];
    ofLabel.GetColor(color);
    if (labels.Share < 1)
    {
      const ManyIntervals plain(labels.Transfer, x);
      const Float8 plainOpacity = FindOpacity(in, sample, plain.GetOpacity(), gradientX, 0);
      Float8 plainColor[3];
      plain.GetColor(plainColor);
      const Float8 share = labels.Share;
      opacity = Mix(plainOpacity, opacity, share);
      for (int c = 0; c < 3; ++c)
      {
        // What is transparent has no colour.
        color[c] = Mix(Keep(zero < plainOpacity, plainColor[c]), color[c], share);
      }
    }
    const Mask8 visible = zero < opacity;
    if (!Any(visible))
    {
      return;
    }
    this->AddLit(in, sample, visible, gradient, opacity, color);
  }

private:
  using LitBuffer<Gradients>::UsesGradients;

  /// The opacity of a step, of one function of each lane.
  static TETRALUX_INLINE Float8 FindOpacity(const ImageKernelInput& in, const ImageSample& sample,
    Float8 scalarOpacity, Float8 gradientX, Int8 function)
  {
    const Float8 zero = 0.f;
    if (in.Labels->GradientTransfer.Count > 0)
    {
      scalarOpacity = scalarOpacity *
        ManyIntervals(in.Labels->GradientTransfer, gradientX, function).GetOpacity();
    }
    // False where the scalar is not a number.
    const Mask8 visible = sample.Active & (zero < scalarOpacity);
    const Float8 depth = (in.Power ? MinusLogOfRest(scalarOpacity) : scalarOpacity) * sample.Length;
    return Keep(visible, OneMinusExp(depth));
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
