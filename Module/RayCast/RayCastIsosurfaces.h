// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastIsosurfaces_h
#define tetralux_RayCastIsosurfaces_h

// Surfaces of constant scalar.

#include "RayCast/RayCastRadiance.h"

#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Composites surfaces of constant scalar front to back. A ray crosses a surface where the scalar
/// changes from below the value to at least the value, or back. So it crosses a surface in a face
/// once.
///
/// Next to a vertex or an edge a ray passes several faces at nearly one distance, and rounding
/// makes the scalar go back and forth. So a crossing waits until the ray is farther than distances
/// are rounded by. A crossing back through the same surface before that cancels it.
template <class Real>
class Isosurfaces : public GatheredModel<Real, Unlit, Isosurfaces<Real>>
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = false;
  static constexpr bool NeedsGradients = true;

  Isosurfaces(const WorldRays& rays, Double8 start)
    : GatheredModel<Real, Unlit, Isosurfaces>(rays, start)
    , Lights(rays, start)
  {
  }

  /// Where surfaces are lit.
  TETRALUX_INLINE void EnterCell(
    V near, V far, const LaneVector& nearGradient, const LaneVector& farGradient)
  {
    this->Near = near;
    this->Far = far;
    this->NearGradient = nearGradient;
    this->FarGradient = farGradient;
  }

  TETRALUX_INLINE void AddSegment(const KernelInput& in, Mask8 valid, Int8, V z0, V s0, V z1, V s1)
  {
    const Mask8 settled = valid & this->IsWaiting() &
      (this->WaitingDistance + V(static_cast<Real>(in.DistanceRounding)) < z0);
    if (Any(settled))
    {
      this->Settle(in, settled);
    }

    Float8 below, above;
    for (;;)
    {
      this->LoadNeighbors(in, below, above);
      const Mask8 up = valid & (ToPrecision<V>(above) <= s0);
      const Mask8 down = valid & (s0 < ToPrecision<V>(below));
      if (!Any(up | down))
      {
        break;
      }
      this->Index = this->Index + Ones(up) - Ones(down);
    }
    for (;;)
    {
      const V lower = ToPrecision<V>(below);
      const V upper = ToPrecision<V>(above);
      const Mask8 up = valid & (upper <= s1);
      const Mask8 down = valid & (s1 < lower);
      valid = up | down;
      if (!Any(valid))
      {
        return;
      }
      const V value = Select(up, upper, lower);
      const V z = Fma((value - s0) / (s1 - s0), z1 - z0, z0);
      this->Cross(in, valid, up, z);
      this->Index = this->Index + Ones(up) - Ones(down);
      this->LoadNeighbors(in, below, above);
    }
  }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors)
  {
    this->Settle(in, this->IsWaiting());
    this->Gathered.GetColors(in, colors);
  }

private:
  /// The values of the surfaces below and above the scalar; infinite where there is none.
  TETRALUX_INLINE void LoadNeighbors(const KernelInput& in, Float8& below, Float8& above) const
  {
    TETRALUX_CHECK(AreBelow(MaskFromBits(AllLanes), this->Index, in.NumberOfSurfaces + 1));
    Int8 first, second;
    GatherPairs(
      reinterpret_cast<const std::int32_t*>(in.SurfaceNeighbors), this->Index, first, second);
    below = FromBits(first);
    above = FromBits(second);
  }

  TETRALUX_INLINE Mask8 IsWaiting() const { return this->WaitingSurface > Int8(-1); }

  // Surfaces are crossed seldom: calls keep the step of a packet short.

  /// Upwards through the surface above the scalar, or downwards through the one below.
  TETRALUX_NOINLINE void Cross(const KernelInput& in, Mask8 valid, Mask8 up, V z)
  {
    const Int8 surface = this->Index - Ones(AndNot(valid, up));
    const Mask8 back = valid & (this->WaitingSurface == surface) &
      (Abs(z - this->WaitingDistance) <= V(static_cast<Real>(in.DistanceRounding)));
    const Mask8 settled = AndNot(valid & this->IsWaiting(), back);
    if (Any(settled))
    {
      this->Settle(in, settled);
    }
    this->WaitingSurface = Select(valid, Select(back, Int8(-1), surface), this->WaitingSurface);
    if (in.Lighting)
    {
      const V share = (z - this->Near) / (this->Far - this->Near);
      const Float8 inside = Min(Max(Float8(0.f), ToFloat(share)), Float8(1.f));
      this->WaitingGradient =
        Select(valid, Fma(this->FarGradient - this->NearGradient, inside, this->NearGradient),
          this->WaitingGradient);
    }
    this->WaitingDistance = Select(valid, z, this->WaitingDistance);
  }

  /// Composites the crossings that wait.
  TETRALUX_NOINLINE void Settle(const KernelInput& in, Mask8 lanes)
  {
    const Int8 surface = Select(lanes, this->WaitingSurface, Int8(0));
    TETRALUX_CHECK(AreBelow(lanes, surface, in.NumberOfSurfaces));
    Float8 color[3], opacity;
    GatherRows(in.SurfaceColors, surface, color[0], color[1], color[2], opacity);
    if (in.Lighting)
    {
      const Float8 scale = LaneLights::GetScale(this->WaitingGradient);
      const LaneFactors factors = this->Lights.Find(*in.Lighting,
        LaneLights::ToWorld(*in.Lighting, this->WaitingGradient * scale),
        Widen(this->WaitingDistance));
      const LaneVector lit = factors.Apply({ { color[0], color[1], color[2] } });
      for (int c = 0; c < 3; ++c)
      {
        color[c] = Min(Max(Float8(0.f), lit.C[c]), Float8(1.f));
      }
    }
    this->Gathered.Add(lanes, color[0] * opacity, color[1] * opacity, color[2] * opacity, opacity);
    this->First.Add(lanes & (Float8(0.f) < opacity), this->WaitingDistance);
    this->WaitingSurface = Select(lanes, Int8(-1), this->WaitingSurface);
  }

  LaneLights Lights;
  Int8 Index = 0;           ///< number of surfaces whose value is at most the last scalar
  Int8 WaitingSurface = -1; ///< of the crossing that waits; -1: none does
  V WaitingDistance = Real(0);
  LaneVector WaitingGradient = { { 0.f, 0.f, 0.f } };

  // The cell.
  V Near = Real(0), Far = Real(0);
  LaneVector NearGradient, FarGradient;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
