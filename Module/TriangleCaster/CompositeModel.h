// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CompositeModel_h
#define tetralux_CompositeModel_h

// What emits and absorbs, looked up at each sample.

#include "Simd/LaneFunctions.h"
#include "TriangleCaster/GradientModel.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/LitBuffer.h"
#include "TriangleCaster/TransferLanes.h"
#include "TriangleCaster/TransferTableLanes.h"

#include <algorithm>
#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Samples at the middle of stretches. Gradients: as of LitBuffer.
template <class Value, class Intervals, class Gradients>
class CompositeModel : public LitBuffer<Gradients>
{
public:
  CompositeModel(const ImageKernelInput& in, const ImageRays& rays)
    : LitBuffer<Gradients>(in, rays)
    , Short(!Any(Float8(MostOfShortStep) < LoadFloat8(rays.StepLength)))
  {
  }

  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample)
  {
    Field field;
    const Float8 scalar = field.LoadScalar(in, sample);
    this->AddScalar(in, sample, field, scalar);
  }

  /// The same where the scalar is known, without gradients.
  TETRALUX_INLINE void Add(const ImageKernelInput& in, const ImageSample& sample, Float8 scalar)
  {
    static_assert(!UsesGradients, "gradients need the sample's place");
    Field field;
    this->AddScalar(in, sample, field, scalar);
  }

private:
  using Field = typename Gradients::template Field<Value>;
  using LitBuffer<Gradients>::UsesGradients;

  TETRALUX_INLINE void AddScalar(
    const ImageKernelInput& in, const ImageSample& sample, Field& field, Float8 scalar)
  {
    const Intervals intervals(in.Transfer, scalar);
    const Float8 zero = 0.f;
    Float8 scalarOpacity = intervals.GetOpacity();
    // False where the scalar is not a number.
    Mask8 visible = sample.Active & (zero < scalarOpacity);
    if (!Any(visible))
    {
      return;
    }
    LaneVector gradient;
    LaneEntry entry;
    if constexpr (UsesGradients)
    {
      gradient = field.GetGradient(in, sample);
      if (Gradients::HasTables && in.Table.Entries)
      {
        const Float8 length = Gradients::GetLength(in, gradient);
        entry = LookUpTable(in.Table, scalar, length);
        scalarOpacity = entry.C[3];
      }
      else if (in.GradientTransfer.Count > 0)
      {
        scalarOpacity = scalarOpacity * Gradients::GetOpacityFactor(in, gradient);
      }
      visible = visible & (zero < scalarOpacity);
      if (!Any(visible))
      {
        return;
      }
    }
    const Float8 opacity = Keep(visible, this->GetOpacity(in, sample, visible, scalarOpacity));
    Float8 color[3];
    intervals.GetColor(color);
    if constexpr (UsesGradients)
    {
      if (Gradients::HasTables && in.Table.Entries)
      {
        std::copy(entry.C, entry.C + 3, color);
      }
    }
    this->AddLit(in, sample, visible, gradient, opacity, color);
  }

  /// Of a stretch.
  TETRALUX_INLINE Float8 GetOpacity(
    const ImageKernelInput& in, const ImageSample& sample, Mask8 visible, Float8 scalarOpacity)
  {
    if (this->Short && !Any(visible & (Float8(MostOfShortLog) < scalarOpacity)))
    {
      const Float8 log = in.Power ? ShortMinusLogOfRest(scalarOpacity) : scalarOpacity;
      return ShortOneMinusExp(log * sample.Length);
    }
    const Float8 log = in.Power ? MinusLogOfRest(scalarOpacity) : scalarOpacity;
    return OneMinusExp(log * sample.Length);
  }

  /// Unit distances up to which short functions do for scalar opacities of MostOfShortLog, whose
  /// logarithm is 0.2877.
  static constexpr float MostOfShortStep = 1.2f;
  static_assert(0.2877f * MostOfShortStep < MostOfShortExp, "steps are too long");

  bool Short; ///< all steps are
};

template <class Value, class Intervals>
using PlainComposite = CompositeModel<Value, Intervals, NoGradients>;
template <class Value, class Intervals>
using GradientComposite = CompositeModel<Value, Intervals, GradientModel<false>>;
template <class Value, class Intervals>
using PreparedComposite = CompositeModel<Value, Intervals, GradientModel<true>>;

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
