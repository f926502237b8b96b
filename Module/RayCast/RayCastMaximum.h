// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastMaximum_h
#define tetralux_RayCastMaximum_h

// Maximum intensity projection.

#include "Integral/ColorLookup.h"
#include "RayCast/RayCastGather.h"

#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The largest scalar along the ray.
template <class Real>
struct LargestScalar
{
  LanesOfReal<Real> Scalar = -std::numeric_limits<Real>::infinity();

  LargestScalar(const WorldRays&, Double8) {}

  TETRALUX_INLINE Mask8 IsDone(const KernelInput&) const { return MaskFromBits(0); }
};

/// Colour and opacity at the largest scalar along the ray. First is where that scalar is.
template <class Real>
class Maximum : public GatheredModel<Real, LargestScalar<Real>, Maximum<Real>>
{
public:
  using V = LanesOfReal<Real>;
  using GatheredModel<Real, LargestScalar<Real>, Maximum>::GatheredModel;

  TETRALUX_INLINE void AddSegment(const KernelInput&, Mask8 valid, Int8, V z0, V s0, V z1, V s1)
  {
    const Mask8 rising = s0 < s1;
    this->Add(valid, Select(rising, z1, z0), Select(rising, s1, s0));
  }

  TETRALUX_INLINE void AddCell(const KernelInput& in, Mask8 valid, Int8 cell, V z0, V)
  {
    TETRALUX_CHECK(AreBelow(MaskFromBits(AllLanes), cell, in.NumberOfCells));
    Float8 scalar, red, green, blue;
    GatherRows(reinterpret_cast<const float*>(in.CellValues), cell, scalar, red, green, blue);
    this->Add(valid & (scalar == scalar), z0, ToPrecision<V>(scalar));
  }

  void GetColors(const KernelInput& in, ColorsOfLanes& colors)
  {
    Real largest[LaneCount], distance[LaneCount];
    Store(largest, this->Gathered.Scalar);
    Store(distance, this->First.Distance);
    for (int i = 0; i < LaneCount; ++i)
    {
      float color[4] = { 0, 0, 0, 0 };
      if (largest[i] > -std::numeric_limits<Real>::infinity())
      {
        LookUpColor(in.Intervals, in.NumberOfIntervals, static_cast<float>(largest[i]), color);
      }
      if (color[3] == 0)
      {
        distance[i] = std::numeric_limits<Real>::infinity();
      }
      for (int c = 0; c < 4; ++c)
      {
        colors[c][i] = c < 3 ? color[3] * color[c] : color[3];
      }
    }
    this->First.Distance = LoadLanes(distance);
  }

private:
  TETRALUX_INLINE void Add(Mask8 valid, V z, V s)
  {
    const Mask8 larger = valid & (this->Gathered.Scalar < s);
    this->Gathered.Scalar = Select(larger, s, this->Gathered.Scalar);
    this->First.Distance = Select(larger, z, this->First.Distance);
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
