// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientModel_h
#define tetralux_GradientModel_h

// What gradients change of a sample (Knittel 1999, section 7): opacity by their length, colour by
// lights.

#include "TriangleCaster/GradientLanes.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/TransferLanes.h"

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

/// What the gradients of a vector's samples do.
class GradientModel
{
public:
  GradientModel(const ImageKernelInput& in, const ImageRays& rays)
    : Rays(rays)
    , Lights(MakeRays(in, rays), Double8(0.))
  {
  }

  /// The length of a gradient that gradient opacities depend on.
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
  TETRALUX_INLINE Float8 GetOpacityFactor(
    const ImageKernelInput& in, const LaneVector& gradient) const
  {
    const Float8 length = GetLength(in, gradient);
    const Float8 x = Fma(length, Float8(in.GradientScale), Float8(in.GradientOffset));
    return in.GradientTransfer.Count <= TransferLookup::MostFew
      ? FewIntervals<TransferLookup::MostFew>(in.GradientTransfer, x).GetOpacity()
      : ManyIntervals(in.GradientTransfer, x).GetOpacity();
  }

  /// Lets the lights shine on colours.
  TETRALUX_INLINE void Light(const ImageKernelInput& in, const KernelLighting& lighting,
    const ImageSample& sample, const LaneVector& gradient, Float8 (&color)[3]) const
  {
    const LaneVector normal =
      LaneLights::ToWorld(lighting, gradient * LaneLights::GetScale(gradient));
    const Double8 depth = Fma(ToDouble(Fma(Float8(0.5f), sample.Share, sample.Front)),
      Double8(in.Slices.Distance), Double8(in.Slices.Origin));
    const LaneFactors factors =
      this->Lights.Find(lighting, normal, depth * LoadDouble8(this->Rays.WorldLength));
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Fma(color[c], factors.Scale.C[c], factors.Add.C[c]);
    }
  }

private:
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
