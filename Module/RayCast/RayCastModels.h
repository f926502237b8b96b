// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastModels_h
#define tetralux_RayCastModels_h

// The models that integrate the pieces of cells in closed form.

#include "RayCast/RayCastPieces.h"
#include "RayCast/RayCastRadiance.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Colours of a piece, weighted.
struct MixedColors
{
  Float8 C[3];
};

/// front, back: weights of the colours at both ends.
TETRALUX_INLINE MixedColors MixLinear(const Piece& piece, Float8 front, Float8 back)
{
  const auto mix = [&](int c)
  {
    return Fma(
      piece.GetColor(c, piece.X0, false), front, piece.GetColor(c, piece.X1, false) * back);
  };
  return { { mix(0), mix(1), mix(2) } };
}

/// bend: the weight of Piece::Bend on top.
TETRALUX_INLINE MixedColors MixCurved(const Piece& piece, Float8 front, Float8 back, Float8 bend)
{
  const auto mix = [&](int c)
  {
    return Fma(piece.GetColor(c, piece.X0, true), front,
      Fma(piece.GetColor(c, piece.X1, true), back, piece.Bend[c] * bend));
  };
  return { { mix(0), mix(1), mix(2) } };
}

/// The density-emitter model. RadianceT: Unlit or Lit.
template <class Real, class RadianceT>
class DensityEmitter : public PieceModel<Real, RadianceT, DensityEmitter<Real, RadianceT>>
{
public:
  using V = LanesOfReal<Real>;
  using PieceModel<Real, RadianceT, DensityEmitter>::PieceModel;

  TETRALUX_INLINE void Enter(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V z1)
  {
    this->Gathered.Enter(in, valid, cell, z0, z1);
  }

  TETRALUX_INLINE void AddPiece(const KernelInput& in, Mask8 contributes, const Piece& piece, V, V)
  {
    if (in.Curved)
    {
      Float8 bulge;
      const SegmentWeights w = IntegrateCurvedSegment(piece.D0, piece.D1, bulge);
      this->Add(contributes, MixCurved(piece, w.Front, w.Back, bulge * piece.GetBulgeOfBend()), w);
    }
    else
    {
      const SegmentWeights w = IntegrateSegment(piece.D0, piece.D1);
      this->Add(contributes, MixLinear(piece, w.Front, w.Back), w);
    }
  }

  TETRALUX_INLINE void AddConstant(Mask8 contributes, Float8 depth, const Float8 (&color)[3])
  {
    Float8 opacity, transmittance;
    IntegrateConstant(depth, opacity, transmittance);
    this->Gathered.Add(
      contributes, color[0] * opacity, color[1] * opacity, color[2] * opacity, opacity);
  }

private:
  TETRALUX_INLINE void Add(Mask8 contributes, const MixedColors& mixed, const SegmentWeights& w)
  {
    this->Gathered.Add(contributes, mixed.C[0], mixed.C[1], mixed.C[2], w.Front + w.Back);
  }
};

template <class Real>
using ClosedForm = DensityEmitter<Real, Unlit>;

template <class Real>
using LitClosedForm = DensityEmitter<Real, Lit>;

/// The optical depth of a ray, in any order.
struct DepthSum
{
  Float8 Depth = 0.f;

  DepthSum(const WorldRays&, Double8) {}

  TETRALUX_INLINE void Add(Mask8 contributes, Float8 depth)
  {
    this->Depth = this->Depth + Keep(contributes, depth);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput& in) const
  {
    return Float8(in.MaximumDepth) <= this->Depth;
  }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors) const
  {
    Float8 opacity, transmittance;
    IntegrateConstant(
      Min(this->Depth, Float8(static_cast<float>(LargestSingleDepth))), opacity, transmittance);
    for (int c = 0; c < 3; ++c)
    {
      Store(colors[c], Float8(in.Color[c]) * opacity);
    }
    Store(colors[3], opacity);
  }
};

/// The density-emitter model where the colour is the same wherever there is any attenuation, and
/// absorption alone: the optical depth of the whole ray decides.
template <class Real>
class OpticalDepth : public PieceModel<Real, DepthSum, OpticalDepth<Real>>
{
public:
  using V = LanesOfReal<Real>;
  using PieceModel<Real, DepthSum, OpticalDepth>::PieceModel;

  TETRALUX_INLINE void AddPiece(const KernelInput&, Mask8 contributes, const Piece& piece, V, V)
  {
    this->Gathered.Add(contributes, Float8(0.5f) * (piece.D0 + piece.D1));
  }

  TETRALUX_INLINE void AddConstant(Mask8 contributes, Float8 depth, const Float8 (&)[3])
  {
    this->Gathered.Add(contributes, depth);
  }
};

/// Emitted light that nothing attenuates, in any order.
struct EmissionSum
{
  Float8 Color[3] = { 0.f, 0.f, 0.f };

  EmissionSum(const WorldRays&, Double8) {}

  TETRALUX_INLINE void Add(Mask8 contributes, Float8 red, Float8 green, Float8 blue)
  {
    this->Color[0] = this->Color[0] + Keep(contributes, red);
    this->Color[1] = this->Color[1] + Keep(contributes, green);
    this->Color[2] = this->Color[2] + Keep(contributes, blue);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput&) const { return MaskFromBits(0); }

  void GetColors(const KernelInput&, ColorsOfLanes& colors) const
  {
    for (int c = 0; c < 3; ++c)
    {
      Store(colors[c], this->Color[c]);
    }
    Store(colors[3], Float8(0.f));
  }
};

/// Emission alone: the integral of attenuation x colour, a polynomial on each piece.
template <class Real>
class Emission : public PieceModel<Real, EmissionSum, Emission<Real>>
{
public:
  using V = LanesOfReal<Real>;
  using PieceModel<Real, EmissionSum, Emission>::PieceModel;

  TETRALUX_INLINE void AddPiece(const KernelInput& in, Mask8 contributes, const Piece& piece, V, V)
  {
    // The integrals of d0 + (d1 - d0) w times 1 - w, w and 4 w (1 - w), over w from 0 to 1.
    const Float8 front = Fma(Float8(1.f / 3), piece.D0, Float8(1.f / 6) * piece.D1);
    const Float8 back = Fma(Float8(1.f / 6), piece.D0, Float8(1.f / 3) * piece.D1);
    const Float8 bulge = Float8(1.f / 3) * (piece.D0 + piece.D1);
    const MixedColors mixed = in.Curved
      ? MixCurved(piece, front, back, bulge * piece.GetBulgeOfBend())
      : MixLinear(piece, front, back);
    this->Gathered.Add(contributes, mixed.C[0], mixed.C[1], mixed.C[2]);
  }

  TETRALUX_INLINE void AddConstant(Mask8 contributes, Float8 depth, const Float8 (&color)[3])
  {
    this->Gathered.Add(contributes, color[0] * depth, color[1] * depth, color[2] * depth);
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
