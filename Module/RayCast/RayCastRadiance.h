// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastRadiance_h
#define tetralux_RayCastRadiance_h

// Light that rays gather front to back.

#include "RayCast/RayCastLight.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Light composited front to back. It adds opacities rather than multiplying transmittances, so
/// that segments count even if they are too thin for 1 - opacity to differ from 1 in single
/// precision.
struct Radiance
{
  Float8 Red = 0.f, Green = 0.f, Blue = 0.f;
  Float8 Opacity = 0.f;

  TETRALUX_INLINE void Add(Mask8 valid, Float8 red, Float8 green, Float8 blue, Float8 opacity)
  {
    const Float8 transmittance = Float8(1.f) - this->Opacity;
    this->Red = Fma(transmittance, Keep(valid, red), this->Red);
    this->Green = Fma(transmittance, Keep(valid, green), this->Green);
    this->Blue = Fma(transmittance, Keep(valid, blue), this->Blue);
    this->Opacity = Fma(transmittance, Keep(valid, opacity), this->Opacity);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput& in) const
  {
    return Float8(in.MaximumOpacity) <= this->Opacity;
  }

  TETRALUX_INLINE void GetColors(const KernelInput&, ColorsOfLanes& colors) const
  {
    Store(colors[0], this->Red);
    Store(colors[1], this->Green);
    Store(colors[2], this->Blue);
    Store(colors[3], this->Opacity);
  }
};

/// Radiance that is added as it comes: nothing lights it, or who adds it has lit it.
struct Unlit : Radiance
{
  Unlit(const WorldRays&, Double8) {}

  template <class V>
  TETRALUX_INLINE void Enter(const KernelInput&, Mask8, Int8, V, V)
  {
  }
};

/// Radiance under lights that are the same all through a cell: the gradient is that of the cell,
/// and lights are distant. Nothing is clamped, so that what a segment adds is linear in the light.
struct Lit : Radiance
{
  LaneLights Lights;
  LaneFactors Factors;

  Lit(const WorldRays& rays, Double8 start)
    : Lights(rays, start)
  {
  }

  template <class V>
  TETRALUX_INLINE void Enter(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V)
  {
    if (Any(valid))
    {
      const KernelLighting& lighting = *in.Lighting;
      const LaneVector gradient = LoadGradient(lighting, cell);
      this->Factors = this->Lights.Find(lighting,
        LaneLights::ToWorld(lighting, gradient * LaneLights::GetScale(gradient)), Widen(z0));
    }
  }

  TETRALUX_INLINE void Add(Mask8 valid, Float8 red, Float8 green, Float8 blue, Float8 opacity)
  {
    const auto apply = [&](int c, Float8 color)
    { return Fma(color, this->Factors.Scale.C[c], opacity * this->Factors.Add.C[c]); };
    this->Radiance::Add(valid, apply(0, red), apply(1, green), apply(2, blue), opacity);
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
