// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastPieces_h
#define tetralux_RayCastPieces_h

// Cells cut into the parts on which the transfer function is linear, and what models share that
// integrate those.

#include "Integral/SegmentIntegral.h"
#include "RayCast/RayCastGather.h"
#include "RayCast/RayCastIntervals.h"

#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Part of a cell on which attenuation is linear, and colour linear or a parabola.
struct Piece
{
  Float8 D0, D1; ///< attenuation at its ends times its length, at most LargestSingleDepth
  Float8 X0, X1; ///< scalar at its ends, relative to the reference of the interval
  Float8 Color[3], Slope[3]; ///< colour at the reference, and its slope there
  Float8 Bend[3];            ///< of KernelInput::Curved

  /// A channel at a scalar relative to the reference.
  TETRALUX_INLINE Float8 GetColor(int c, Float8 x, bool curved) const
  {
    const Float8 slope = curved ? Fma(this->Bend[c], x, this->Slope[c]) : this->Slope[c];
    return Fma(slope, x, this->Color[c]);
  }

  /// How far a channel bulges from the line between both ends, per Bend: by 4 w (1 - w) times this,
  /// with w from 0 to 1 along the piece.
  TETRALUX_INLINE Float8 GetBulgeOfBend() const
  {
    // What has a bend is at most 2 wide; beyond the nodes products would overflow.
    const Float8 width = this->X1 - this->X0;
    return Float8(-0.25f) * Min(width * width, Float8(4.f));
  }
};

/// The intervals of the transfer function where rays are. They change where a cell is cut, which is
/// rare, and are looked up then.
struct CurrentIntervals
{
  Int8 Number = 0;
  IntervalLanes Lanes{}; ///< at first none that a scalar is in

  CurrentIntervals()
  {
    this->Lanes.Lo = std::numeric_limits<float>::infinity();
    this->Lanes.Hi = -std::numeric_limits<float>::infinity();
  }

  TETRALUX_INLINE void Set(const KernelInput& in, Int8 number)
  {
    this->Number = number;
    this->Lanes = LoadInterval(in, number);
  }
};

/// What is left of cells: the scalar runs linearly from S0 at Z0 to S1 at Z1.
template <class V>
struct RestOfCells
{
  Mask8 Valid; ///< rays that have some left
  V Z0, S0, Z1, S1;
};

/// The interval in which a scalar runs that begins at f0, towards f1. Apart, since it is rarely far
/// from the last cell's.
TETRALUX_NOINLINE Int8 FindIntervalOfCell(const KernelInput& in, Float8 f0, Float8 f1)
{
  return FindInterval(in, [&](Float8 end) { return (end < f0) | ((end == f0) & (f0 <= f1)); });
}

/// Takes the next piece of what is left of cells: up to where its interval ends. Calls
/// add(contributes, piece, from, to) if it attenuates any ray, between two distances z. current:
/// where each ray's last scalar is; updated.
template <class Real, class V, class AddT>
TETRALUX_INLINE void TakePiece(
  const KernelInput& in, CurrentIntervals& current, RestOfCells<V>& rest, AddT add)
{
  const Mask8 valid = rest.Valid;
  const V z0 = rest.Z0;
  const V s0 = rest.S0;
  const V z1 = rest.Z1;
  const V s1 = rest.S1;
  TETRALUX_CHECK(AreBelow(valid, current.Number, in.NumberOfIntervals));
  Piece piece;
  const IntervalLanes& t = current.Lanes;
  for (int c = 0; c < 3; ++c)
  {
    piece.Color[c] = t.Color[c];
    piece.Slope[c] = t.ColorSlope[c];
    piece.Bend[c] = t.ColorBend[c];
  }
  const V bottom = ToPrecision<V>(t.Lo);
  const V head = ToPrecision<V>(t.Hi);
  const V origin = ToPrecision<V>(t.Reference);

  // The interval of the last cell is mostly still right, or a neighbour is. A constant scalar at
  // a node belongs to the interval above it, whichever came before. Scalars are compared in
  // single precision, to which the nodes were rounded.
  const Float8 f0 = ToFloat(s0);
  const Float8 f1 = ToFloat(s1);
  const Mask8 inside = (t.Lo <= Min(f0, f1)) & (Max(f0, f1) < t.Hi);
  V z = z1;
  V s = s1;
  Mask8 more = AndNot(valid, inside);
  const bool cut = Any(more);
  if (cut)
  {
    const Mask8 below = valid & (f0 < t.Lo);
    const Mask8 above = valid & ((t.Hi < f0) | ((t.Hi == f0) & (f0 <= f1)));
    const Mask8 elsewhere = below | above;
    if (Any(elsewhere))
    {
      current.Set(in, Select(elsewhere, FindIntervalOfCell(in, f0, f1), current.Number));
      return;
    }
    const Mask8 last = (t.Lo <= f1) & (f1 <= t.Hi);
    more = AndNot(valid, last);
    s = Min(Max(s1, bottom), head);
    V share = (s - s0) / (s1 - s0);
    if constexpr (sizeof(Real) > sizeof(float))
    {
      // What was compared as rounded may lie just outside of the interval, on the side of s1.
      // Its end then is in front of z0.
      share = Max(V(Real(0)), share);
    }
    z = Select(last, z1, Fma(share, z1 - z0, z0));
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
  const Float8 largest = static_cast<float>(LargestSingleDepth);
  // Rounding may leave an attenuation just below zero where the function comes down to it.
  piece.D0 = Max(zero, Min(Fma(t.AttenuationSlope, piece.X0, t.Attenuation) * length, largest));
  piece.D1 = Max(zero, Min(Fma(t.AttenuationSlope, piece.X1, t.Attenuation) * length, largest));
  const Mask8 contributes = valid & (zero < piece.D0 + piece.D1);
  if (Any(contributes))
  {
    add(contributes, piece, z0, z);
  }
  if (cut && Any(more))
  {
    const Mask8 rising = more & (s0 < s1);
    current.Set(in, current.Number + Ones(rising) - Ones(AndNot(more, rising)));
  }
  rest.Valid = more;
  rest.Z0 = z;
  rest.S0 = s;
}

/// Returns the optical depth of a cell of constant scalar, and its colour.
template <class V>
TETRALUX_INLINE Float8 LoadCell(const KernelInput& in, V z0, V z1, Int8 cell, Float8 (&color)[3])
{
  TETRALUX_CHECK(AreBelow(MaskFromBits(AllLanes), cell, in.NumberOfCells));
  Float8 attenuation;
  GatherRows(
    reinterpret_cast<const float*>(in.CellValues), cell, attenuation, color[0], color[1], color[2]);
  // In this order a length that is not a number stays one, and contributes nothing.
  return Min(Float8(static_cast<float>(LargestSingleDepth)), attenuation * ToFloat(z1 - z0));
}

/// A model that integrates pieces. Derived has
///
///   Enter        prepares for what is added next, from z0 to z1 in a cell
///   AddPiece     adds a piece, between two distances z
///   AddConstant  adds a cell of constant scalar, by its optical depth and colour
///
/// the last two for the rays that contribute.
template <class Real, class Sum, class Derived>
class PieceModel : public GatheredModel<Real, Sum, Derived>
{
public:
  using V = LanesOfReal<Real>;
  using GatheredModel<Real, Sum, Derived>::GatheredModel;

  TETRALUX_INLINE void AddSegment(
    const KernelInput& in, Mask8 valid, Int8 cell, V z0, V s0, V z1, V s1)
  {
    this->GetDerived().Enter(in, valid, cell, z0, z1);
    if (!Any(valid))
    {
      return;
    }
    RestOfCells<V> rest{ valid, z0, s0, z1, s1 };
    this->AddNext(in, rest);
    if (Any(rest.Valid))
    {
      this->AddRest(in, rest);
    }
  }

  TETRALUX_INLINE void AddCell(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V z1)
  {
    Float8 color[3];
    const Float8 depth = LoadCell(in, z0, z1, cell, color);
    const Mask8 contributes = valid & (Float8(0.f) < depth);
    if (Any(contributes))
    {
      this->GetDerived().AddConstant(contributes, depth, color);
      this->First.Add(contributes, z0);
    }
  }

  TETRALUX_INLINE void Enter(const KernelInput&, Mask8, Int8, V, V) {}

private:
  TETRALUX_INLINE void AddNext(const KernelInput& in, RestOfCells<V>& rest)
  {
    TakePiece<Real>(in, this->Current, rest,
      [&](Mask8 contributes, const Piece& piece, V from, V to) TETRALUX_INLINE_LAMBDA
      {
        this->GetDerived().AddPiece(in, contributes, piece, from, to);
        this->First.Add(contributes, from);
      });
  }

  /// Apart, so that what most cells need stays short.
  TETRALUX_NOINLINE void AddRest(const KernelInput& in, RestOfCells<V> rest)
  {
    while (Any(rest.Valid))
    {
      this->AddNext(in, rest);
    }
  }

  CurrentIntervals Current; ///< where each ray's last scalar was
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
