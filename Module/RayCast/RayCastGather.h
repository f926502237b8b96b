// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastGather_h
#define tetralux_RayCastGather_h

// What the rays of a packet gather. A model is a class for each way of integrating (Integrator):
//
//   AddPoints    adds a cell through which the scalar runs linearly from s0 at z0 to s1 at z1
//   AddCell      adds a cell of constant scalar from z0 to z1
//   IsDone       tells the rays that nothing more can change
//   GetColors    returns red, green, blue and opacity of each ray, at its end
//   NeedsLength  whether a cell adds nothing if the ray has no length in it. Rounding makes such
//                cells, and a surface between their scalars must not be lost.
//   NeedsGradients  whether the gradients on a cell's faces are told before it is added:
//   EnterCell    the distances z of both faces, and the gradients there
//   NeedsComponents  whether several scalars on a cell's faces are told before it is added:
//   EnterComponents  the distances z of both faces, and the scalars there
//   First        distance z to the ray's first contribution, or infinity

#include "RayCast/RayCastFrame.h"

#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

using ColorsOfLanes = float[4][LaneCount];

template <class Real>
using LanesOfReal = typename LanesOf<Real>::Type;

/// Converts single precision to the precision of the geometry.
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

/// Several scalars in each lane.
struct ComponentLanes
{
  Double8 S[MostComponents];
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

/// What models share. Sum is what is added up along a ray, with IsDone and GetColors. Derived has
///
///   AddSegment  AddPoints for scalars that are numbers
template <class Real, class Sum, class Derived>
class GatheredModel
{
public:
  using V = LanesOfReal<Real>;
  static constexpr bool NeedsLength = true;
  static constexpr bool NeedsGradients = false;
  static constexpr bool NeedsComponents = false;
  FirstContribution<Real> First;

  GatheredModel(const WorldRays& rays, Double8 start)
    : Gathered(rays, start)
  {
  }

  TETRALUX_INLINE void AddPoints(
    const KernelInput& in, Mask8 valid, Int8 cell, V z0, V s0, V z1, V s1)
  {
    // A scalar that is not a number spoils the whole cell: it contributes nothing.
    const V ds = s1 - s0;
    this->GetDerived().AddSegment(in, valid & (ds == ds), cell, z0, s0, z1, s1);
  }

  TETRALUX_INLINE Mask8 IsDone(const KernelInput& in) const { return this->Gathered.IsDone(in); }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors)
  {
    this->Gathered.GetColors(in, colors);
  }

protected:
  TETRALUX_INLINE Derived& GetDerived() { return static_cast<Derived&>(*this); }

  Sum Gathered;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
