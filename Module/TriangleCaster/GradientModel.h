// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientModel_h
#define tetralux_GradientModel_h

// What gradients change of a sample (Knittel 1999, section 7): opacity by their length, colour by
// lights.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/IntensityLanes.h"
#include "TriangleCaster/SampleField.h"
#include "TriangleCaster/TransferLanes.h"

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
  static constexpr bool HasTables = false;

  template <class Value>
  using Field = ValueField<Value>;

  NoGradients(const ImageKernelInput&, const ImageRays&) {}
};

/// What the gradients of a vector's samples do. Prepared: gradients may come from GradientVoxels,
/// light from an IntensityMap, and colours from a TransferTable; without all those it is faster.
template <bool Prepared>
class GradientModel
{
public:
  static constexpr bool HasTables = Prepared;

  template <class Value>
  using Field = std::conditional_t<Prepared, StoredField<Value>, GradientField<Value>>;

  GradientModel(const ImageKernelInput& in, const ImageRays& rays)
    : Rays(rays)
    , Lights(MakeRays(in, rays), Double8(0.))
  {
  }

  /// How long a gradient is, in scalars for a GradientLength of the world.
  static TETRALUX_INLINE Float8 GetLength(const ImageKernelInput& in, const LaneVector& gradient)
  {
    LaneVector world;
    for (int a = 0; a < 3; ++a)
    {
      world.C[a] = Dot(Broadcast(in.WorldGradient[a]), gradient);
    }
    return in.Norm == GradientNorm::Euclidean ? Sqrt(Dot(world, world))
                                              : Abs(world.C[0]) + Abs(world.C[1]) + Abs(world.C[2]);
  }

  /// The factor that the gradient opacity has for a gradient.
  static TETRALUX_INLINE Float8 GetOpacityFactor(
    const ImageKernelInput& in, const LaneVector& gradient)
  {
    const Float8 x =
      Fma(GetLength(in, gradient), Float8(in.GradientScale), Float8(in.GradientOffset));
    return in.GradientTransfer.Count <= TransferLookup::MostFew
      ? FewIntervals<TransferLookup::MostFew>(in.GradientTransfer, x).GetOpacity()
      : ManyIntervals(in.GradientTransfer, x).GetOpacity();
  }

  /// Lets lights shine on colours. Prepared: those of in.Intensities, if there are any.
  TETRALUX_INLINE void Light(const ImageKernelInput& in, const KernelLighting& lighting,
    const ImageSample& sample, const LaneVector& gradient, Float8 (&color)[3]) const
  {
    LaneFactors factors;
    if (Prepared && in.Intensities)
    {
      factors = LookUpIntensities(in, gradient);
    }
    else
    {
      factors = this->SumLights(in, lighting, sample, gradient);
    }
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Fma(color[c], factors.Scale.C[c], factors.Add.C[c]);
    }
  }

private:
  static TETRALUX_NOINLINE LaneFactors LookUpIntensities(
    const ImageKernelInput& in, const LaneVector& gradient)
  {
    const IntensityLanes intensities(in, gradient);
    return in.InterpolateIntensities ? intensities.Interpolate() : intensities.GetNearest();
  }

  TETRALUX_INLINE LaneFactors SumLights(const ImageKernelInput& in, const KernelLighting& lighting,
    const ImageSample& sample, const LaneVector& gradient) const
  {
    const LaneVector normal =
      LaneLights::ToWorld(lighting, gradient * LaneLights::GetScale(gradient));
    const Double8 depth = Fma(ToDouble(Fma(Float8(0.5f), sample.Share, sample.Front)),
      Double8(in.Slices.Distance), Double8(in.Slices.Origin));
    return this->Lights.Find(lighting, normal, depth * LoadDouble8(this->Rays.WorldLength));
  }

  static WorldRays MakeRays(const ImageKernelInput& in, const ImageRays& rays)
  {
    double x[LaneCount], y[LaneCount];
    for (int l = 0; l < LaneCount; ++l)
    {
      x[l] = rays.X[l];
      y[l] = rays.Y[l];
    }
    return MakeWorldRays(*in.Grid, LoadDouble8(x), LoadDouble8(y));
  }

  const ImageRays& Rays;
  LaneLights Lights;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
