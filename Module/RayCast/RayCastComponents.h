// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastComponents_h
#define tetralux_RayCastComponents_h

// The density-emitter model of several scalars, each with a function of its own, see
// ComponentFunctions.h. In double precision.
//
// A cell is cut where any of the scalars meets a node of its function. On such a piece every
// attenuation and every colour is linear along the ray. With w from 0 to 1 along the piece, depths
// d_j(w) = attenuation of scalar j times the piece's length, and D0 and D1 their sums at its ends,
//
//   T(w) = D0 w + (D1 - D0) w^2 / 2          optical depth up to w,
//   E(w) = sum of d_j(w) c_j(w)              a parabola,
//
// and the radiance is the integral of E(w) exp(-T(w)). With E in Bernstein's form it is
// E(0) I0 + E' I1 + E(1) I2, where I0, I1, I2 are the integrals of (1 - w)^2, 2 w (1 - w) and w^2
// times exp(-T). Pieces above ThinDepth are cut to it, from the front on, and the integrals are
// Gauss's sums of five points, whose error is then below the rounding of single precision.

#include "Integral/SegmentIntegral.h"
#include "RayCast/RayCastGather.h"
#include "RayCast/RayCastIntervals.h"
#include "RayCast/RayCastRadiance.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The integrals of (1 - w)^2, 2 w (1 - w) and w^2 times exp(-T(w)) over a thin piece.
struct ParabolaWeights
{
  Float8 Front = 0.f, Middle = 0.f, Back = 0.f;
};

/// d0 and d1 are at least 0, and their mean is at most ThinDepth; above that any number.
TETRALUX_INLINE ParabolaWeights IntegrateThinParabola(Float8 d0, Float8 d1)
{
  static constexpr int Points = 5;
  static constexpr float Positions[Points] = { 0.0469100770306680f, 0.230765344947158f, 0.5f,
    0.769234655052842f, 0.953089922969332f };
  static constexpr float Weights[Points] = { 0.118463442528095f, 0.239314335249683f,
    0.284444444444444f, 0.239314335249683f, 0.118463442528095f };
  ParabolaWeights sums;
  for (int i = 0; i < Points; ++i)
  {
    const float w = Positions[i];
    // Both factors are positive: nothing is subtracted.
    const Float8 depth = Fma(d0, Float8(w - 0.5f * w * w), d1 * Float8(0.5f * w * w));
    const Float8 value = Float8(Weights[i]) * ExpMinus(depth);
    sums.Front = Fma(value, Float8((1 - w) * (1 - w)), sums.Front);
    sums.Middle = Fma(value, Float8(2 * w * (1 - w)), sums.Middle);
    sums.Back = Fma(value, Float8(w * w), sums.Back);
  }
  return sums;
}

/// One of the scalars along a cell, and the interval of its function that it is in.
struct ComponentPath
{
  Double8 Front, Slope; ///< where the cell is entered, and from there to where it is left
  Float8 End;           ///< where it is left
  Mask8 Rising;

  // The interval.
  Float8 Lo, Hi, Reference, Attenuation, AttenuationSlope;
  Float8 Color[3], ColorSlope[3];

  /// Where the scalar leaves the interval, as a share of the cell; 1 or more where it does not.
  Double8 Exit;

  TETRALUX_INLINE void Load(const IntervalTable::Interval* table, Int8 interval)
  {
    const Int8 row = FindIntervalRow(interval);
    const auto* rows = reinterpret_cast<const float*>(table);
    Float8 unused;
    GatherRows(rows, row, this->Lo, this->Hi, this->Reference, this->Attenuation);
    GatherRows(
      rows, row + Int8(1), this->AttenuationSlope, this->Color[0], this->Color[1], this->Color[2]);
    GatherRows(
      rows, row + Int8(2), this->ColorSlope[0], this->ColorSlope[1], this->ColorSlope[2], unused);
  }

  TETRALUX_INLINE void FindExit()
  {
    const Float8 bound = Select(this->Rising, this->Hi, this->Lo);
    const Mask8 leaves =
      (this->Rising & (bound < this->End)) | AndNot(this->End < bound, this->Rising);
    this->Exit =
      Select(leaves, (ToDouble(bound) - this->Front) / this->Slope, Double8(2.)); // never met
  }

  /// The scalar at a share of the cell, relative to the reference of the interval.
  TETRALUX_INLINE Float8 At(Double8 share) const
  {
    const Double8 x = Fma(this->Slope, share, this->Front);
    const Double8 inside = Min(Max(x, ToDouble(this->Lo)), ToDouble(this->Hi));
    return ToFloat(inside - ToDouble(this->Reference));
  }

  TETRALUX_INLINE Float8 GetColor(int c, Float8 x) const
  {
    return Fma(this->ColorSlope[c], x, this->Color[c]);
  }
};

class Components : public GatheredModel<double, Unlit, Components>
{
public:
  static constexpr bool NeedsComponents = true;
  using GatheredModel<double, Unlit, Components>::GatheredModel;

  /// A cell from one face to the other, before what limits keep of it.
  TETRALUX_INLINE void EnterComponents(
    Double8 z0, Double8 z1, const ComponentLanes& before, const ComponentLanes& after)
  {
    // A ray passes an inverted cell from its far side to its near side.
    const Mask8 backward = z1 < z0;
    this->Near = Min(z0, z1);
    this->Far = Max(z0, z1);
    for (int k = 0; k < MostComponents; ++k)
    {
      this->NearScalars.S[k] = Select(backward, after.S[k], before.S[k]);
      this->FarScalars.S[k] = Select(backward, before.S[k], after.S[k]);
    }
  }

  /// Long, and called once for each step of a packet: not inlined.
  TETRALUX_NOINLINE void AddSegment(
    const KernelInput& in, Mask8 valid, Int8, Double8 z0, Double8, Double8 z1, Double8)
  {
    const KernelComponents& components = *in.Components;
    this->FindPaths(components, valid, z0, z1);
    const Double8 one = 1.;
    const Double8 length = z1 - z0;
    Double8 begin = 0.;
    Mask8 rest = valid;
    while (Any(rest))
    {
      Double8 end = one;
      for (int k = 0; k < components.Count; ++k)
      {
        end = Min(end, Max(begin, this->Paths[k].Exit));
      }
      const Float8 share = this->AddPiece(
        components, rest, begin, end, ToFloat((end - begin) * length), Fma(begin, length, z0));
      const Mask8 cut = share < Float8(1.f);
      const Mask8 crossing = AndNot(rest, cut);
      for (int k = 0; k < components.Count; ++k)
      {
        this->Cross(components, k, crossing, end);
      }
      rest = AndNot(rest, AndNot(one <= end, cut) | this->Gathered.IsDone(in));
      begin = Select(cut, Fma(end - begin, ToDouble(share), begin), end);
    }
  }

private:
  /// The scalars from one distance to another, each in the interval where it begins.
  TETRALUX_INLINE void FindPaths(
    const KernelComponents& components, Mask8 valid, Double8 z0, Double8 z1)
  {
    const Double8 inverse = Double8(1.) / (this->Far - this->Near);
    const Double8 first = (z0 - this->Near) * inverse;
    const Double8 last = Select(z1 == this->Far, Double8(1.), (z1 - this->Near) * inverse);
    for (int k = 0; k < components.Count; ++k)
    {
      ComponentPath& path = this->Paths[k];
      const Double8 slope = this->FarScalars.S[k] - this->NearScalars.S[k];
      path.Front = Fma(slope, first, this->NearScalars.S[k]);
      const Double8 end = Fma(slope, last, this->NearScalars.S[k]);
      path.Slope = end - path.Front;
      path.End = ToFloat(end);
      path.Rising = Double8(0.) < path.Slope;
      // Scalars are compared in single precision, to which the nodes were rounded. A scalar at a
      // node is in the interval that it goes into, and one that stays there in the one above.
      const Float8 front = ToFloat(path.Front);
      const Mask8 falling = path.Slope < Double8(0.);
      while (true)
      {
        path.Load(components.Intervals[k], this->Intervals[k]);
        const Mask8 below = valid & ((front < path.Lo) | (falling & (front == path.Lo)));
        const Mask8 above =
          AndNot(valid, below | (front < path.Hi) | (falling & (front == path.Hi)));
        if (!Any(below | above))
        {
          break;
        }
        this->Intervals[k] = this->Intervals[k] + Ones(above) - Ones(below);
      }
      path.FindExit();
    }
  }

  /// Moves a scalar into the next interval of its function, if it left the one that it was in.
  TETRALUX_INLINE void Cross(const KernelComponents& components, int k, Mask8 crossing, Double8 end)
  {
    ComponentPath& path = this->Paths[k];
    const Mask8 left = crossing & (path.Exit <= end);
    if (Any(left))
    {
      this->Intervals[k] =
        this->Intervals[k] + Ones(left & path.Rising) - Ones(AndNot(left, path.Rising));
      path.Load(components.Intervals[k], this->Intervals[k]);
      path.FindExit();
    }
  }

  /// Adds what is between two shares of a cell, up to ThinDepth. length: of that, z: where it
  /// begins. Returns the share of it that was added.
  TETRALUX_INLINE Float8 AddPiece(const KernelComponents& components, Mask8 rest, Double8 begin,
    Double8 end, Float8 length, Double8 z)
  {
    // Squares of depths must be finite; the colour is all from the front end long before.
    const Float8 largest = 1e18f;
    const Float8 zero = 0.f;
    const Float8 one = 1.f;
    Float8 x0[MostComponents], x1[MostComponents], d0[MostComponents], d1[MostComponents];
    Float8 front = 0.f, back = 0.f;
    for (int k = 0; k < components.Count; ++k)
    {
      const ComponentPath& path = this->Paths[k];
      x0[k] = path.At(begin);
      x1[k] = path.At(end);
      // Rounding may leave an attenuation just below zero where the function comes down to it.
      d0[k] = Max(zero, Min(Fma(path.AttenuationSlope, x0[k], path.Attenuation) * length, largest));
      d1[k] = Max(zero, Min(Fma(path.AttenuationSlope, x1[k], path.Attenuation) * length, largest));
      front = front + d0[k];
      back = back + d1[k];
    }
    const Float8 slope = back - front;
    const Float8 root = Sqrt(Max(zero, Fma(front, front, Float8(2 * ThinDepth) * slope)));
    const Mask8 thick = Float8(2 * ThinDepth) < front + back;
    const Float8 share = Select(thick, Min(one, Float8(2 * ThinDepth) / (front + root)), one);
    const Mask8 contributes = rest & (zero < front + back);
    if (!Any(contributes))
    {
      return share;
    }

    LaneVector e0 = { { zero, zero, zero } }, middle = e0, e1 = e0;
    LaneVector c0 = e0, c1 = e0; // sums of colours, of dependent scalars
    for (int k = 0; k < components.Count; ++k)
    {
      const ComponentPath& path = this->Paths[k];
      const Float8 frontDepth = d0[k] * share;
      const Float8 backDepth = Fma(d1[k] - d0[k], share, d0[k]) * share;
      for (int c = 0; c < 3; ++c)
      {
        const Float8 frontColor = path.GetColor(c, x0[k]);
        const Float8 backColor = Fma(path.GetColor(c, x1[k]) - frontColor, share, frontColor);
        c0.C[c] = c0.C[c] + frontColor;
        c1.C[c] = c1.C[c] + backColor;
        e0.C[c] = Fma(frontDepth, frontColor, e0.C[c]);
        e1.C[c] = Fma(backDepth, backColor, e1.C[c]);
        middle.C[c] = Fma(frontDepth, backColor, Fma(backDepth, frontColor, middle.C[c]));
      }
    }
    const Float8 thinFront = front * share;
    const Float8 thinBack = Fma(slope, share, front) * share;
    if (components.Dependent)
    {
      for (int c = 0; c < 3; ++c)
      {
        e0.C[c] = thinFront * c0.C[c];
        e1.C[c] = thinBack * c1.C[c];
        middle.C[c] = Fma(thinFront, c1.C[c], thinBack * c0.C[c]);
      }
    }
    const ParabolaWeights w = IntegrateThinParabola(thinFront, thinBack);
    const auto mix = [&](int c)
    { return Fma(e0.C[c], w.Front, Fma(Float8(0.5f) * middle.C[c], w.Middle, e1.C[c] * w.Back)); };
    Float8 opacity, transmittance;
    IntegrateConstant(Float8(0.5f) * (thinFront + thinBack), opacity, transmittance);
    this->Gathered.Add(contributes, mix(0), mix(1), mix(2), opacity);
    this->First.Add(contributes, z);
    return share;
  }

  Double8 Near = 0., Far = 0.; ///< of the cell
  ComponentLanes NearScalars, FarScalars;
  ComponentPath Paths[MostComponents];
  Int8 Intervals[MostComponents] = { 0, 0, 0, 0 }; ///< of each function, where the scalars are
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
