// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastLight_h
#define tetralux_RayCastLight_h

// Light that rays gather front to back, and the lights that shine on what they meet.

#include "Optics/SurfaceShading.h"
#include "RayCast/RayCastGather.h"

#include <cstdint>

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

/// The light where the rays of a packet are. Computed ray by ray, since lights are mostly branches.
class LaneLights
{
public:
  LaneLights(const WorldRays& rays, Double8 start)
    : Rays(rays)
    , Start(start)
  {
  }

  /// Returns LightFactors (scale, add) of the valid rays, in their cells at distance z.
  template <class V>
  TETRALUX_NOINLINE void Find(
    const KernelInput& in, Mask8 valid, Int8 cell, V z, Float8 (&scale)[3], Float8 (&add)[3]) const
  {
    std::int32_t cells[LaneCount];
    double distances[LaneCount], origins[3][LaneCount], directions[3][LaneCount];
    float scales[3][LaneCount] = {}, adds[3][LaneCount] = {};
    Store(cells, cell);
    Store(distances, this->Start + Widen(z));
    for (int a = 0; a < 3; ++a)
    {
      Store(origins[a], this->Rays.Origin[a]);
      Store(directions[a], this->Rays.Direction[a]);
    }
    const unsigned bits = Bits(valid);
    for (int i = 0; i < LaneCount; ++i)
    {
      if (!((bits >> i) & 1u))
      {
        continue;
      }
      const double direction[3] = { directions[0][i], directions[1][i], directions[2][i] };
      double position[3];
      for (int a = 0; a < 3; ++a)
      {
        position[a] = origins[a][i] + distances[i] * direction[a];
      }
      const LightFactors factors = FindLight(*in.Shading, cells[i], position, direction);
      for (int a = 0; a < 3; ++a)
      {
        scales[a][i] = factors.Scale[a];
        adds[a][i] = factors.Add[a];
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      scale[a] = LoadFloat8(scales[a]);
      add[a] = LoadFloat8(adds[a]);
    }
  }

private:
  WorldRays Rays;
  Double8 Start; ///< distance of z = 0 along the rays
};

/// Radiance that lights do not change.
struct Unlit : Radiance
{
  Unlit(const WorldRays&, Double8) {}

  template <class V>
  TETRALUX_INLINE void Enter(const KernelInput&, Mask8, Int8, V, V)
  {
  }
};

/// Radiance under lights. A segment is lit as its middle is. The gradient is the same all along it,
/// and so is the direction to a distant light or to one at the viewer. Nothing is clamped, so that
/// what a segment adds is linear in the light.
struct Lit : Radiance
{
  LaneLights Lights;
  Float8 Scale[3], More[3];

  Lit(const WorldRays& rays, Double8 start)
    : Lights(rays, start)
  {
  }

  template <class V>
  TETRALUX_INLINE void Enter(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V z1)
  {
    this->Lights.Find(in, valid, cell, z0 + (z1 - z0) * V(0.5f), this->Scale, this->More);
  }

  TETRALUX_INLINE void Add(Mask8 valid, Float8 red, Float8 green, Float8 blue, Float8 opacity)
  {
    this->Radiance::Add(valid, Fma(red, this->Scale[0], opacity * this->More[0]),
      Fma(green, this->Scale[1], opacity * this->More[1]),
      Fma(blue, this->Scale[2], opacity * this->More[2]), opacity);
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
