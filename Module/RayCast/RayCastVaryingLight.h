// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastVaryingLight_h
#define tetralux_RayCastVaryingLight_h

// The density-emitter model under light that varies on a ray's way through a cell.
//
// On a part of LightAlongRay light is a parabola, on a piece of the transfer function colour and
// attenuation are linear. Where a piece and a part overlap the lit colour is taken for a parabola,
// too: linear between both ends, plus a bulge 4 w (1 - w) times what the middle is off from that. The
// linear part has the weights of SegmentIntegral.h, which are exact; the bulge has FindBulgeShare.

#include "Integral/SegmentIntegral.h"
#include "Optics/LightAlongRay.h"
#include "RayCast/RayCastLight.h"
#include "RayCast/RayCastPieces.h"

#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A colour, linear on a piece.
struct ColorOfLanes
{
  Float8 Channel[3];
};

/// Light factors that are parabolas over the share of a cell.
class PartsOfLight
{
public:
  explicit PartsOfLight(const WorldRays& rays)
    : Rays(rays)
  {
  }

  /// The next cell of the rays, between two distances in the world.
  TETRALUX_INLINE void Enter(Int8 cell, Double8 front, Double8 back)
  {
    this->Cell = cell;
    this->Front = front;
    this->Back = back;
    this->Entered = 0;
    this->End = -1.f;
  }

  /// The share of the cell where each ray's part ends; below 0 before the first part.
  TETRALUX_INLINE Float8 GetEnd() const { return this->End; }

  /// Goes on to the parts of some rays that begin at shares of the cell. Ray by ray, since lights
  /// are mostly branches.
  TETRALUX_NOINLINE void Begin(const KernelInput& in, Mask8 lanes, Float8 share)
  {
    this->EnterCells(in, lanes);
    float begins[LaneCount], ends[LaneCount], inverses[LaneCount];
    float values[NumberOfSamples][NumberOfFactors][LaneCount];
    Store(begins, share);
    Store(ends, this->End);
    Store(inverses, this->InverseLength);
    const unsigned bits = Bits(lanes);
    for (int i = 0; i < LaneCount; ++i)
    {
      if (!((bits >> i) & 1u))
      {
        continue;
      }
      const LightAlongRay& light = this->Lights[i];
      const double begin = begins[i];
      const double end = light.FindEnd(begin);
      for (int k = 0; k < NumberOfSamples; ++k)
      {
        const LightFactors factors = light.At(begin + LightSamples[k] * (end - begin));
        for (int c = 0; c < 3; ++c)
        {
          values[k][c][i] = factors.Scale[c];
          values[k][3 + c][i] = factors.Add[c];
        }
      }
      ends[i] = end < 1 ? static_cast<float>(end) : BeyondCell;
      inverses[i] = static_cast<float>(1 / (end - begin));
    }
    this->Origin = Select(lanes, share, this->Origin);
    this->End = LoadFloat8(ends);
    this->InverseLength = LoadFloat8(inverses);
    // Newton's form, from the middle.
    constexpr auto Reach = static_cast<float>(LightSamples[2] - LightSamples[1]);
    for (int f = 0; f < NumberOfFactors; ++f)
    {
      const Float8 first = LoadFloat8(values[0][f]);
      const Float8 middle = LoadFloat8(values[1][f]);
      const Float8 last = LoadFloat8(values[2][f]);
      const Float8 slope = (last - first) * Float8(0.5f / Reach);
      const Float8 bend = ((first - middle) + (last - middle)) * Float8(0.5f / (Reach * Reach));
      this->Middle[f] = Select(lanes, middle, this->Middle[f]);
      this->Slope[f] = Select(lanes, slope, this->Slope[f]);
      this->Bend[f] = Select(lanes, bend, this->Bend[f]);
    }
  }

  /// A colour as it is lit at a share of the cell in the current part.
  TETRALUX_INLINE ColorOfLanes Apply(Float8 share, const ColorOfLanes& color) const
  {
    const Float8 x = Fma(share - this->Origin, this->InverseLength, Float8(-0.5f));
    ColorOfLanes lit;
    for (int c = 0; c < 3; ++c)
    {
      lit.Channel[c] = Fma(color.Channel[c], this->Find(c, x), this->Find(3 + c, x));
    }
    return lit;
  }

private:
  static constexpr int NumberOfSamples = 3;
  static constexpr int NumberOfFactors = 6; ///< LightFactors
  static constexpr float BeyondCell = 2.f;  ///< the end of the last part: no share comes there

  TETRALUX_INLINE Float8 Find(int factor, Float8 x) const
  {
    return Fma(Fma(this->Bend[factor], x, this->Slope[factor]), x, this->Middle[factor]);
  }

  /// Finds the light of those rays that have none in their cell.
  void EnterCells(const KernelInput& in, Mask8 lanes)
  {
    const unsigned bits = Bits(lanes) & ~this->Entered;
    if (bits == 0)
    {
      return;
    }
    this->Entered |= bits;
    std::int32_t cells[LaneCount];
    double fronts[LaneCount], backs[LaneCount], origins[3][LaneCount], directions[3][LaneCount];
    Store(cells, this->Cell);
    Store(fronts, this->Front);
    Store(backs, this->Back);
    for (int a = 0; a < 3; ++a)
    {
      Store(origins[a], this->Rays.Origin[a]);
      Store(directions[a], this->Rays.Direction[a]);
    }
    for (int i = 0; i < LaneCount; ++i)
    {
      if (!((bits >> i) & 1u))
      {
        continue;
      }
      double front[3], back[3], direction[3];
      for (int a = 0; a < 3; ++a)
      {
        direction[a] = directions[a][i];
        front[a] = origins[a][i] + fronts[i] * direction[a];
        back[a] = origins[a][i] + backs[i] * direction[a];
      }
      this->Lights[i] = LightAlongRay(*in.Shading, cells[i], front, back, direction);
    }
  }

  WorldRays Rays;
  Int8 Cell = 0;
  Double8 Front = 0., Back = 0.;
  unsigned Entered = 0; ///< lanes whose light is that of their cell
  LightAlongRay Lights[LaneCount];

  // The parts, x = (share - Origin) InverseLength - 1/2 from one end to the other.
  Float8 Origin = 0.f, End = -1.f, InverseLength = 0.f;
  Float8 Middle[NumberOfFactors], Slope[NumberOfFactors], Bend[NumberOfFactors];
};

template <class Real>
class VaryingLight : public PieceModel<Real, Unlit, VaryingLight<Real>>
{
public:
  using V = LanesOfReal<Real>;

  VaryingLight(const WorldRays& rays, Double8 start)
    : PieceModel<Real, Unlit, VaryingLight>(rays, start)
    , Start(start)
    , Parts(rays)
  {
  }

  TETRALUX_INLINE void Enter(const KernelInput&, Mask8, Int8 cell, V z0, V z1)
  {
    this->Z0 = z0;
    this->InverseLength = V(Real(1)) / (z1 - z0);
    this->Parts.Enter(cell, this->Start + Widen(z0), this->Start + Widen(z1));
  }

  /// Called seldom beside the steps of a packet, and long: not inlined.
  TETRALUX_NOINLINE void AddPiece(
    const KernelInput& in, Mask8 contributes, const Piece& piece, V from, V to)
  {
    // Squares of depths must be finite; the colour is all from the front end long before.
    const Float8 largest = 1e18f;
    const Float8 d0 = Min(piece.D0, largest);
    const Float8 d1 = Min(piece.D1, largest);
    const Float8 slope = d1 - d0;
    const Float8 one = 1.f;
    const Float8 cellBegin = ToFloat((from - this->Z0) * this->InverseLength);
    const Float8 cellLength = ToFloat((to - from) * this->InverseLength);
    Float8 begin = 0.f;  // as a share of the piece
    Float8 hidden = 0.f; // opacity of the piece up to there
    Mask8 rest = contributes;
    while (Any(rest))
    {
      const Float8 cellShare = Fma(begin, cellLength, cellBegin);
      const Mask8 ended = rest & (this->Parts.GetEnd() <= cellShare + Float8(Nearly));
      if (Any(ended))
      {
        this->Parts.Begin(in, ended, cellShare);
      }
      // Up to the end of the part, and no further than the weights of thin segments reach.
      const Float8 front = Fma(slope, begin, d0);
      const Float8 root = Sqrt(Max(Float8(0.f), Fma(front, front, Float8(2 * ThinDepth) * slope)));
      const Float8 remains = one - begin;
      const Mask8 thick = Float8(2 * ThinDepth) < (front + d1) * remains;
      const Float8 thin = Select(thick, begin + Float8(2 * ThinDepth) / (front + root), one);
      const Float8 ofPart = (this->Parts.GetEnd() - cellBegin) / cellLength;
      const Float8 end = Min(thin, Max(begin, ofPart)); // one where the cell has no length
      const Mask8 last = one <= end;
      const Float8 length = end - begin;
      const Float8 frontDepth = front * length;
      const Float8 backDepth = Select(last, d1, Fma(slope, end, d0)) * length;
      const SegmentWeights w = IntegrateThinSegment(frontDepth, backDepth);
      const Float8 ofBulge = FindBulgeShare(frontDepth, backDepth) * (w.Front + w.Back);
      this->AddPart(rest, piece, w, ofBulge, begin, end, cellBegin, cellLength);
      hidden = Fma(one - hidden, w.Front + w.Back, hidden);
      begin = end;
      rest = AndNot(rest, last | (Float8(Opaque) < hidden));
    }
  }

private:
  /// Shares of a cell that are nearer than this are one: twice the shortest part.
  static constexpr float Nearly = 1.f / (1 << 21);

  /// Opacity behind which single precision keeps nothing.
  static constexpr float Opaque = 1 - 1.f / (1 << 24);

  /// Adds what of a piece is between two shares of it.
  TETRALUX_INLINE void AddPart(Mask8 valid, const Piece& piece, const SegmentWeights& w,
    Float8 ofBulge, Float8 begin, Float8 end, Float8 cellBegin, Float8 cellLength)
  {
    const Float8 middle = Float8(0.5f) * (begin + end);
    const auto find = [&](Float8 share)
    {
      ColorOfLanes color;
      const Float8 x = Fma(piece.X1 - piece.X0, share, piece.X0);
      for (int c = 0; c < 3; ++c)
      {
        color.Channel[c] = Fma(piece.Slope[c], x, piece.Color[c]);
      }
      return this->Parts.Apply(Fma(share, cellLength, cellBegin), color);
    };
    const ColorOfLanes front = find(begin);
    const ColorOfLanes back = find(end);
    const ColorOfLanes between = find(middle);
    const auto mix = [&](int c)
    {
      const Float8 bulge = between.Channel[c] - Float8(0.5f) * (front.Channel[c] + back.Channel[c]);
      return Fma(front.Channel[c], w.Front, Fma(back.Channel[c], w.Back, bulge * ofBulge));
    };
    this->Gathered.Add(valid, mix(0), mix(1), mix(2), w.Front + w.Back);
  }

  Double8 Start; ///< distance of z = 0 along the rays
  V Z0 = Real(0), InverseLength = Real(0);
  PartsOfLight Parts;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
