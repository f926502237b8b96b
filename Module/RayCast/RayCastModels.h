// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastModels_h
#define tetralux_RayCastModels_h

// What the rays of a packet gather: one class for each way of integrating (Integrator). Each has
//
//   AddPoints  a cell through which the scalar runs linearly from s0 at z0 to s1 at z1,
//   AddCell    a cell of constant scalar from z0 to z1,
//   IsDone     the rays that nothing more can change,
//   GetColors  red, green, blue and opacity of each ray in the end,
//   NeedsLength  whether a cell that the ray passes in no length adds nothing; rounding makes such
//              cells, and a surface between their scalars must not be lost,
//   First      the distance (z) of each ray's first contribution, infinity where there is none.

#include "Integral/SegmentIntegral.h"
#include "Optics/SurfaceShading.h"
#include "RayCast/RayCastFrame.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Largest optical depth of a segment that is told from opaque; keeps products finite.
constexpr float LargestDepth = 1e30f;

using ColorsOfLanes = float[4][LaneCount];

/// A single precision number in the precision of the geometry.
template <class V>
TETRALUX_INLINE V ToPrecision(Float8 x)
{
  if constexpr (sizeof(V) == sizeof(Float8))
  {
    return x;
  }
  else
  {
    return ToDouble(x);
  }
}

TETRALUX_INLINE Double8 Widen(Float8 x) { return ToDouble(x); }
TETRALUX_INLINE Double8 Widen(Double8 x) { return x; }

TETRALUX_INLINE Float8 LoadLanes(const float* p) { return LoadFloat8(p); }
TETRALUX_INLINE Double8 LoadLanes(const double* p) { return LoadDouble8(p); }

/// A part of a cell on which attenuation and colour are linear.
struct Piece
{
  Float8 D0, D1;             ///< attenuation at its ends times its length, at most LargestDepth
  Float8 X0, X1;             ///< scalar at its ends, relative to the reference of the interval
  Float8 Color[3], Slope[3]; ///< colour at the reference, and its slope

  TETRALUX_INLINE Float8 GetFront(int c) const
  {
    return Fma(this->Slope[c], this->X0, this->Color[c]);
  }
  TETRALUX_INLINE Float8 GetBack(int c) const
  {
    return Fma(this->Slope[c], this->X1, this->Color[c]);
  }
};

/// Cuts a cell whose scalar runs linearly from s0 at z0 to s1 at z1 at the nodes of the transfer
/// function: add(contributes, z, piece) for each piece in which any ray is attenuated. interval:
/// where in the function each ray's last scalar was.
template <class Real, class V, class AddT>
TETRALUX_INLINE void CutAtNodes(
  const KernelInput& in, Int8& interval, Mask8 valid, V z0, V s0, V z1, V s1, AddT add)
{
  // A scalar that is not a number spoils the whole cell: it contributes nothing.
  const V ds = s1 - s0;
  valid = valid & (ds == ds);
  const auto* table = in.Intervals;
  while (Any(valid))
  {
    // Neighbouring rays are mostly in the same interval: one load for all of them.
    const unsigned bits = Bits(valid);
    std::int32_t indices[LaneCount];
    Store(indices, interval);
    int leader = 0;
    while (!((bits >> leader) & 1u))
    {
      ++leader;
    }
    const bool uniform = !Any(AndNot(valid, interval == Int8(indices[leader])));
    Piece piece;
    Float8 lo, hi, reference, attenuation, attenuationSlope;
    if (uniform)
    {
      const IntervalTable::Interval& t = table[indices[leader]];
      lo = t.Lo;
      hi = t.Hi;
      reference = t.Reference;
      attenuation = t.Attenuation;
      attenuationSlope = t.AttenuationSlope;
      for (int c = 0; c < 3; ++c)
      {
        piece.Color[c] = t.Color[c];
        piece.Slope[c] = t.ColorSlope[c];
      }
    }
    else
    {
      const Int8 row = interval + interval + interval;
      const auto* rows = reinterpret_cast<const float*>(table);
      Float8 unused;
      GatherRows(rows, row, lo, hi, reference, attenuation);
      GatherRows(
        rows, row + Int8(1), attenuationSlope, piece.Color[0], piece.Color[1], piece.Color[2]);
      GatherRows(rows, row + Int8(2), piece.Slope[0], piece.Slope[1], piece.Slope[2], unused);
    }
    const V bottom = ToPrecision<V>(lo);
    const V head = ToPrecision<V>(hi);
    const V origin = ToPrecision<V>(reference);

    // The interval left from the last cell is mostly still the right one, else one of the next. A
    // constant scalar at a node belongs to the interval above it, whatever was seen before; compared
    // as the node was rounded.
    const Float8 f0 = ToFloat(s0);
    const Float8 f1 = ToFloat(s1);
    const Mask8 below = valid & (f0 < lo);
    const Mask8 above = valid & ((hi < f0) | ((hi == f0) & (f0 <= f1)));
    if (Any(below | above))
    {
      interval = interval + Ones(above) - Ones(below);
      continue;
    }

    const Mask8 last = (lo <= f1) & (f1 <= hi);
    const Mask8 more = AndNot(valid, last);
    V z = z1;
    V s = s1;
    if (Any(more))
    {
      s = Min(Max(s1, bottom), head);
      z = Select(last, z1, Fma((s - s0) / (s1 - s0), z1 - z0, z0));
    }
    V x[2] = { s0, s };
    if constexpr (sizeof(Real) > sizeof(float))
    {
      // What was compared as rounded may lie just outside of the interval, where the slope of one
      // only a few roundings wide leads far.
      x[0] = Min(Max(s0, bottom), head);
      x[1] = Min(Max(s, bottom), head);
    }
    piece.X0 = ToFloat(x[0] - origin);
    piece.X1 = ToFloat(x[1] - origin);
    const Float8 length = Keep(valid, ToFloat(z - z0));
    const Float8 zero = 0.f;
    const Float8 largest = LargestDepth;
    // Rounding may leave an attenuation just below zero where the function comes down to it.
    piece.D0 = Max(zero, Min(Fma(attenuationSlope, piece.X0, attenuation) * length, largest));
    piece.D1 = Max(zero, Min(Fma(attenuationSlope, piece.X1, attenuation) * length, largest));
    const Mask8 contributes = valid & (zero < piece.D0 + piece.D1);
    if (Any(contributes))
    {
      add(contributes, z0, piece);
    }
    if (!Any(more))
    {
      return;
    }
    const Mask8 rising = more & (s0 < s1);
    interval = interval + Ones(rising) - Ones(AndNot(more, rising));
    z0 = z;
    s0 = s;
    valid = more;
  }
}

/// Attenuation over the length of a cell of constant scalar, and its colour.
template <class V>
TETRALUX_INLINE Float8 LoadCell(
  const KernelInput& in, V z0, V z1, Int8 cell, Float8& red, Float8& green, Float8& blue)
{
  Float8 attenuation;
  GatherRows(reinterpret_cast<const float*>(in.CellValues), cell, attenuation, red, green, blue);
  return Min(attenuation * ToFloat(z1 - z0), Float8(LargestDepth));
}

template <class Real>
using LanesOfReal = typename LanesOf<Real>::Type;

/// Light that is attenuated by what is in front of it, composited front to back. The opacity is what
/// adds up, not the transmittance what is multiplied: segments too thin for 1 - opacity to differ
/// from 1 in single precision still count, however many there are.
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

  TETRALUX_INLINE void GetColors(ColorsOfLanes& colors) const
  {
    Store(colors[0], this->Red);
    Store(colors[1], this->Green);
    Store(colors[2], this->Blue);
    Store(colors[3], this->Opacity);
  }
};

template <class Real>
struct FirstContribution
{
  using V = LanesOfReal<Real>;
  V Distance = std::numeric_limits<Real>::infinity();

  TETRALUX_INLINE void Add(Mask8 contributes, V z)
  {
    this->Distance = Select(contributes, Min(this->Distance, z), this->Distance);
  }
};

/// Light where the rays of a packet are, ray by ray: lights are many kinds of branches.
class LaneLights
{
public:
  LaneLights(const WorldRays& rays, Double8 start)
    : Rays(rays)
    , Start(start)
  {
  }

  /// scale and add: LightFactors of the rays that are valid, in their cells at distance z.
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

/// Radiance of what shines by itself: lights make no difference.
struct Unlit : Radiance
{
  Unlit(const WorldRays&, Double8) {}

  template <class V>
  TETRALUX_INLINE void Enter(const KernelInput&, Mask8, Int8, V, V)
  {
  }
};

/// Radiance of what lights shine on: those of the middle of what a ray meets of a cell, for all of
/// it. The gradient is the same anyway, and so are the directions of distant lights and of one at the
/// viewer. Nothing is clamped, so that what a segment adds stays linear in the light.
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

/// The density-emitter model in closed form. RadianceT: Unlit or Lit.
template <class Real, class RadianceT>
class DensityEmitter
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = true;
  FirstContribution<Real> First;

  DensityEmitter(const WorldRays& rays, Double8 start)
    : Gathered(rays, start)
  {
  }

  TETRALUX_INLINE void AddPoints(
    const KernelInput& in, Mask8 valid, Int8 cell, V z0, V s0, V z1, V s1)
  {
    this->Gathered.Enter(in, valid, cell, z0, z1);
    CutAtNodes<Real>(in, this->Interval, valid, z0, s0, z1, s1,
      [this](Mask8 contributes, V z, const Piece& piece)
      {
        const SegmentWeights w = IntegrateSegment(piece.D0, piece.D1);
        const auto mix = [&](int c)
        { return Fma(piece.GetFront(c), w.Front, piece.GetBack(c) * w.Back); };
        this->Gathered.Add(contributes, mix(0), mix(1), mix(2), w.Front + w.Back);
        this->First.Add(contributes, z);
      });
  }

  TETRALUX_INLINE void AddCell(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V z1)
  {
    Float8 red, green, blue;
    const Float8 depth = LoadCell(in, z0, z1, cell, red, green, blue);
    const Mask8 contributes = valid & (Float8(0.f) < depth);
    if (!Any(contributes))
    {
      return;
    }
    Float8 opacity, transmittance;
    IntegrateConstant(depth, opacity, transmittance);
    this->Gathered.Add(contributes, red * opacity, green * opacity, blue * opacity, opacity);
    this->First.Add(contributes, z0);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput& in) const { return this->Gathered.IsDone(in); }

  void GetColors(const KernelInput&, ColorsOfLanes& colors) { this->Gathered.GetColors(colors); }

private:
  RadianceT Gathered;
  Int8 Interval = 0;
};

template <class Real>
using ClosedForm = DensityEmitter<Real, Unlit>;

template <class Real>
using LitClosedForm = DensityEmitter<Real, Lit>;

/// The density-emitter model where the colour is the same wherever there is any attenuation, and
/// absorption alone: the optical depth of the whole ray decides, in any order.
template <class Real>
class OpticalDepth
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = true;
  FirstContribution<Real> First;

  OpticalDepth(const WorldRays&, Double8) {}

  TETRALUX_INLINE void AddPoints(const KernelInput& in, Mask8 valid, Int8, V z0, V s0, V z1, V s1)
  {
    CutAtNodes<Real>(in, this->Interval, valid, z0, s0, z1, s1,
      [this](Mask8 contributes, V z, const Piece& piece)
      { this->Add(contributes, z, Float8(0.5f) * (piece.D0 + piece.D1)); });
  }

  TETRALUX_INLINE void AddCell(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V z1)
  {
    Float8 red, green, blue;
    const Float8 depth = LoadCell(in, z0, z1, cell, red, green, blue);
    this->Add(valid & (Float8(0.f) < depth), z0, depth);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput& in) const
  {
    return Float8(in.MaximumDepth) <= this->Depth;
  }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors)
  {
    Float8 opacity, transmittance;
    IntegrateConstant(Min(this->Depth, Float8(LargestDepth)), opacity, transmittance);
    for (int c = 0; c < 3; ++c)
    {
      Store(colors[c], Float8(in.Color[c]) * opacity);
    }
    Store(colors[3], opacity);
  }

private:
  TETRALUX_INLINE void Add(Mask8 contributes, V z, Float8 depth)
  {
    this->Depth = this->Depth + Keep(contributes, depth);
    this->First.Add(contributes, z);
  }

  Float8 Depth = 0.f;
  Int8 Interval = 0;
};

/// Emission alone: the integral of attenuation x colour, a polynomial on each piece.
template <class Real>
class Emission
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = true;
  FirstContribution<Real> First;

  Emission(const WorldRays&, Double8) {}

  TETRALUX_INLINE void AddPoints(const KernelInput& in, Mask8 valid, Int8, V z0, V s0, V z1, V s1)
  {
    CutAtNodes<Real>(in, this->Interval, valid, z0, s0, z1, s1,
      [this](Mask8 contributes, V z, const Piece& piece)
      {
        // The integral of (d0 + (d1 - d0) w) (c0 + (c1 - c0) w) over w from 0 to 1.
        const Float8 front = Fma(Float8(1.f / 3), piece.D0, Float8(1.f / 6) * piece.D1);
        const Float8 back = Fma(Float8(1.f / 6), piece.D0, Float8(1.f / 3) * piece.D1);
        const auto mix = [&](int c)
        { return Fma(piece.GetFront(c), front, piece.GetBack(c) * back); };
        this->Add(contributes, z, mix(0), mix(1), mix(2));
      });
  }

  TETRALUX_INLINE void AddCell(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V z1)
  {
    Float8 red, green, blue;
    const Float8 depth = LoadCell(in, z0, z1, cell, red, green, blue);
    this->Add(valid & (Float8(0.f) < depth), z0, red * depth, green * depth, blue * depth);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput&) const { return MaskFromBits(0); }

  void GetColors(const KernelInput&, ColorsOfLanes& colors)
  {
    Store(colors[0], this->Red);
    Store(colors[1], this->Green);
    Store(colors[2], this->Blue);
    Store(colors[3], Float8(0.f));
  }

private:
  TETRALUX_INLINE void Add(Mask8 contributes, V z, Float8 red, Float8 green, Float8 blue)
  {
    this->Red = this->Red + Keep(contributes, red);
    this->Green = this->Green + Keep(contributes, green);
    this->Blue = this->Blue + Keep(contributes, blue);
    this->First.Add(contributes, z);
  }

  Float8 Red = 0.f, Green = 0.f, Blue = 0.f;
  Int8 Interval = 0;
};

/// The largest scalar along the ray.
template <class Real>
class Maximum
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = true;
  FirstContribution<Real> First;

  Maximum(const WorldRays&, Double8) {}

  TETRALUX_INLINE void AddPoints(const KernelInput&, Mask8 valid, Int8, V z0, V s0, V z1, V s1)
  {
    const V ds = s1 - s0; // not a number where a scalar of the cell is none
    const Mask8 rising = s0 < s1;
    this->Add(valid & (ds == ds), Select(rising, z1, z0), Select(rising, s1, s0));
  }

  TETRALUX_INLINE void AddCell(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V)
  {
    Float8 scalar, red, green, blue;
    GatherRows(reinterpret_cast<const float*>(in.CellValues), cell, scalar, red, green, blue);
    this->Add(valid & (scalar == scalar), z0, ToPrecision<V>(scalar));
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput&) const { return MaskFromBits(0); }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors)
  {
    Real largest[LaneCount], distance[LaneCount];
    Store(largest, this->Largest);
    Store(distance, this->First.Distance);
    for (int i = 0; i < LaneCount; ++i)
    {
      float color[4] = { 0, 0, 0, 0 };
      if (largest[i] > -std::numeric_limits<Real>::infinity())
      {
        LookUp(in, static_cast<float>(largest[i]), color);
      }
      if (color[3] == 0)
      {
        distance[i] = std::numeric_limits<Real>::infinity();
      }
      for (int c = 0; c < 4; ++c)
      {
        colors[c][i] = color[c];
      }
    }
    this->First.Distance = LoadLanes(distance);
  }

private:
  TETRALUX_INLINE void Add(Mask8 valid, V z, V s)
  {
    const Mask8 larger = valid & (this->Largest < s);
    this->Largest = Select(larger, s, this->Largest);
    this->First.Distance = Select(larger, z, this->First.Distance);
  }

  /// Premultiplied colour and opacity at a scalar; at a step the value from larger scalars.
  static void LookUp(const KernelInput& in, float s, float (&color)[4])
  {
    int first = 0;
    for (int count = in.NumberOfIntervals; count > 1;)
    {
      const int half = count / 2;
      const bool above = in.Intervals[first + half].Lo <= s;
      first += above ? half : 0;
      count = above ? count - half : half;
    }
    const IntervalTable::Interval& t = in.Intervals[first];
    const float x = s - t.Reference;
    color[3] = std::min(1.f, std::max(0.f, t.Attenuation + t.AttenuationSlope * x));
    for (int c = 0; c < 3; ++c)
    {
      color[c] = color[3] * (t.Color[c] + t.ColorSlope[c] * x);
    }
  }

  V Largest = -std::numeric_limits<Real>::infinity();
};

/// Surfaces of constant scalar, composited front to back. A surface is crossed where the scalar
/// comes from below its value to it or above, or back: once, also where it lies in a face.
///
/// Where several faces are passed in no distance, next to a vertex or an edge, rounding makes the
/// scalar go to and fro. So a crossing waits until the ray is beyond the rounding of distances, and
/// one back through the same surface takes it away.
template <class Real>
class Isosurfaces
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = false;
  FirstContribution<Real> First;

  Isosurfaces(const WorldRays& rays, Double8 start)
    : Lights(rays, start)
  {
  }

  TETRALUX_INLINE void AddPoints(
    const KernelInput& in, Mask8 valid, Int8 cell, V z0, V s0, V z1, V s1)
  {
    const V ds = s1 - s0;
    valid = valid & (ds == ds);
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
      const V z = Fma((value - s0) / ds, z1 - z0, z0);
      this->Cross(in, valid, up, cell, z);
      this->Index = this->Index + Ones(up) - Ones(down);
      this->LoadNeighbors(in, below, above);
    }
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput& in) const { return this->Gathered.IsDone(in); }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors)
  {
    this->Settle(in, this->IsWaiting());
    this->Gathered.GetColors(colors);
  }

private:
  /// The values of the surfaces below and above the scalar; infinite where there is none.
  TETRALUX_INLINE void LoadNeighbors(const KernelInput& in, Float8& below, Float8& above) const
  {
    Int8 first, second;
    GatherPairs(
      reinterpret_cast<const std::int32_t*>(in.SurfaceNeighbors), this->Index, first, second);
    below = FromBits(first);
    above = FromBits(second);
  }

  TETRALUX_INLINE Mask8 IsWaiting() const { return this->WaitingSurface > Int8(-1); }

  // Surfaces are crossed seldom: calls keep the step of a packet short.

  /// Upwards through the surface above the scalar, or downwards through the one below.
  TETRALUX_NOINLINE void Cross(const KernelInput& in, Mask8 valid, Mask8 up, Int8 cell, V z)
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
    this->WaitingCell = Select(valid, cell, this->WaitingCell);
    this->WaitingDistance = Select(valid, z, this->WaitingDistance);
  }

  /// Composites the crossings that wait.
  TETRALUX_NOINLINE void Settle(const KernelInput& in, Mask8 lanes)
  {
    const Int8 surface = Select(lanes, this->WaitingSurface, Int8(0));
    Float8 color[3], opacity;
    GatherRows(in.SurfaceColors, surface, color[0], color[1], color[2], opacity);
    if (in.Shading)
    {
      Float8 scale[3], add[3];
      this->Lights.Find(in, lanes, this->WaitingCell, this->WaitingDistance, scale, add);
      for (int c = 0; c < 3; ++c)
      {
        color[c] = Min(Max(Float8(0.f), Fma(color[c], scale[c], add[c])), Float8(1.f));
      }
    }
    this->Gathered.Add(lanes, color[0] * opacity, color[1] * opacity, color[2] * opacity, opacity);
    this->First.Add(lanes & (Float8(0.f) < opacity), this->WaitingDistance);
    this->WaitingSurface = Select(lanes, Int8(-1), this->WaitingSurface);
  }

  LaneLights Lights;
  Radiance Gathered;
  Int8 Index = 0;           ///< number of surfaces whose value is at most the last scalar
  Int8 WaitingSurface = -1; ///< of the crossing that waits; -1: none does
  Int8 WaitingCell = 0;
  V WaitingDistance = Real(0);
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
