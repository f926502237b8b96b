// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastVaryingLight_h
#define tetralux_RayCastVaryingLight_h

// The density-emitter model under light that varies on a ray's way through a cell.
//
// The way is cut into parts on which light is nearly a parabola, see RayCastLightParts.h. On a
// piece of the transfer function attenuation is linear, and colour linear or a parabola. Where a
// piece and a part overlap the lit colour is taken for a parabola, too: linear between both ends,
// plus a bulge
// 4 w (1 - w) times what the middle is off from that. The linear part has the weights of
// SegmentIntegral.h, which are exact; the bulge has FindBulgeShare.

#include "Integral/SegmentIntegral.h"
#include "RayCast/RayCastLightParts.h"
#include "RayCast/RayCastPieces.h"
#include "RayCast/RayCastRadiance.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

template <class Real>
class VaryingLight : public PieceModel<Real, Unlit, VaryingLight<Real>>
{
public:
  using V = LanesOfReal<Real>;

  static constexpr bool NeedsGradients = true;

  VaryingLight(const WorldRays& rays, Double8 start)
    : PieceModel<Real, Unlit, VaryingLight>(rays, start)
    , Parts(rays, start)
  {
  }

  /// A cell from one face to the other, with the gradients on them, before what limits keep of it.
  TETRALUX_INLINE void EnterCell(
    V near, V far, const LaneVector& nearGradient, const LaneVector& farGradient)
  {
    this->Near = near;
    this->InverseLength = V(Real(1)) / (far - near);
    this->Parts.Enter(Widen(near), Widen(far - near), nearGradient, farGradient);
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
    const Float8 cellBegin = ToFloat((from - this->Near) * this->InverseLength);
    const Float8 cellLength = ToFloat((to - from) * this->InverseLength);
    Float8 begin = 0.f;  // as a share of the piece
    Float8 hidden = 0.f; // opacity of the piece up to there
    Mask8 rest = contributes;
    while (Any(rest))
    {
      const Float8 cellShare = Fma(begin, cellLength, cellBegin);
      const Float8 front = Fma(slope, begin, d0);
      const Float8 remains = one - begin;
      const Float8 twiceDepth = (front + d1) * remains;
      const Float8 weight = (one - this->Gathered.Opacity) * Min(one, Float8(0.5f) * twiceDepth);
      // Up to the end of the part of light, and no further than the weights of thin segments reach.
      const Float8 root = Sqrt(Max(Float8(0.f), Fma(front, front, Float8(2 * ThinDepth) * slope)));
      const Mask8 thick = Float8(2 * ThinDepth) < twiceDepth;
      const Float8 thin = Select(thick, begin + Float8(2 * ThinDepth) / (front + root), one);
      const Mask8 ended = rest &
        ((this->Parts.GetEnd() <= cellShare + Float8(Nearly)) | (this->Parts.GetWeight() < weight));
      if (Any(ended))
      {
        this->Parts.Begin(*in.Lighting, ended, cellShare, weight, Fma(thin, cellLength, cellBegin));
      }
      const Float8 ofPart = (this->Parts.GetEnd() - cellBegin) / cellLength;
      const Float8 end = Min(thin, Max(begin, ofPart)); // one where the cell has no length
      const Mask8 last = one <= end;
      const Float8 length = end - begin;
      const Float8 frontDepth = front * length;
      const Float8 backDepth = Select(last, d1, Fma(slope, end, d0)) * length;
      const SegmentWeights w = IntegrateThinSegment(frontDepth, backDepth);
      const Float8 ofBulge = FindBulgeShare(frontDepth, backDepth) * (w.Front + w.Back);
      this->AddPart(in.Curved, rest, piece, w, ofBulge, begin, end, cellBegin, cellLength);
      hidden = Fma(one - hidden, w.Front + w.Back, hidden);
      begin = end;
      rest = AndNot(rest, last | (Float8(Opaque) < hidden));
    }
  }

private:
  /// Shares of a cell that are nearer than this are one.
  static constexpr float Nearly = ShortestLightPart / 2;

  /// Opacity behind which single precision keeps nothing.
  static constexpr float Opaque = 1 - 1.f / (1 << 24);

  /// Adds what of a piece is between two shares of it.
  TETRALUX_INLINE void AddPart(bool curved, Mask8 valid, const Piece& piece,
    const SegmentWeights& w, Float8 ofBulge, Float8 begin, Float8 end, Float8 cellBegin,
    Float8 cellLength)
  {
    const Float8 middle = Float8(0.5f) * (begin + end);
    const auto find = [&](Float8 share)
    {
      const Float8 x = Fma(piece.X1 - piece.X0, share, piece.X0);
      const LaneVector color = { { piece.GetColor(0, x, curved), piece.GetColor(1, x, curved),
        piece.GetColor(2, x, curved) } };
      return this->Parts.At(Fma(share, cellLength, cellBegin)).Apply(color);
    };
    const LaneVector front = find(begin);
    const LaneVector back = find(end);
    const LaneVector between = find(middle);
    const auto mix = [&](int c)
    {
      const Float8 bulge = between.C[c] - Float8(0.5f) * (front.C[c] + back.C[c]);
      return Fma(front.C[c], w.Front, Fma(back.C[c], w.Back, bulge * ofBulge));
    };
    this->Gathered.Add(valid, mix(0), mix(1), mix(2), w.Front + w.Back);
  }

  V Near = Real(0), InverseLength = Real(0); ///< of the cell
  LightParts Parts;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
