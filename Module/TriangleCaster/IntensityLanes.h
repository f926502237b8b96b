// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntensityLanes_h
#define tetralux_IntensityLanes_h

// Lights by way of an IntensityMap, in lanes.

#include "Lighting/LaneLights.h"
#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/IntensityMap.h"
#include "TriangleCaster/VoxelLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// What the map has for gradients, as LaneFactors of Scale and Add.
class IntensityLanes
{
public:
  IntensityLanes(const ImageKernelInput& in, const LaneVector& gradient)
    : Entries(reinterpret_cast<const float*>(in.Intensities))
    , Shines(in.Lighting->Shines)
  {
    const Float8 x = Abs(gradient.C[0]), y = Abs(gradient.C[1]), z = Abs(gradient.C[2]);
    const Mask8 yIsLarger = x < y;
    const Mask8 zIsLargest = Select(yIsLarger, y, x) < z;
    // The largest component, and the two that follow it.
    const auto turn = [&](int a, int b, int c)
    { return Select(zIsLargest, gradient.C[c], Select(yIsLarger, gradient.C[b], gradient.C[a])); };
    const Float8 scale = Float8(1.f) / turn(0, 1, 2);
    this->U = ToPlace(turn(1, 2, 0) * scale);
    this->V = ToPlace(turn(2, 0, 1) * scale);
    const Int8 face = Select(zIsLargest, Int8(2), Ones(yIsLarger));
    this->Face = ShiftLeft(face, 2 * Bits);
    this->Known = Float8(0.f) < Max(Max(x, y), z);
  }

  TETRALUX_INLINE LaneFactors GetNearest() const
  {
    LaneFactors factors;
    this->Gather(this->GetIndex(RoundToInt(this->U), RoundToInt(this->V)), factors);
    return factors;
  }

  TETRALUX_INLINE LaneFactors Interpolate() const
  {
    constexpr float LastCell = IntensityMap::Size - 2;
    const auto cell = [](Float8 place)
    { return RoundToInt(Min(Max(place - Float8(0.5f), Float8(0.f)), Float8(LastCell))); };
    const Int8 u = cell(this->U), v = cell(this->V);
    const Float8 shareU = this->U - ToFloat(u), shareV = this->V - ToFloat(v);
    const Int8 index = this->GetIndex(u, v);
    LaneFactors row[2];
    for (int j = 0; j < 2; ++j)
    {
      LaneFactors first, second;
      const Int8 at = index + Int8(j * IntensityMap::Size);
      this->Gather(at, first);
      this->Gather(at + Int8(1), second);
      row[j] = Mix(first, second, shareU);
    }
    return Mix(row[0], row[1], shareV);
  }

private:
  static constexpr int Bits = 5;
  static_assert(1 << Bits == IntensityMap::Size);

  static TETRALUX_INLINE Float8 ToPlace(Float8 component)
  {
    constexpr float Last = IntensityMap::Size - 1;
    const Float8 place = Fma(component, Float8(0.5f * Last), Float8(0.5f * Last));
    // Also where it is not a number.
    return Min(Max(place, Float8(0.f)), Float8(Last));
  }

  TETRALUX_INLINE Int8 GetIndex(Int8 u, Int8 v) const
  {
    return Select(this->Known, this->Face + ShiftLeft(v, Bits) + u, Int8(IntensityMap::NoGradient));
  }

  TETRALUX_INLINE void Gather(Int8 index, LaneFactors& factors) const
  {
    const Int8 row = index + index;
    Float8 unused;
    GatherRows(
      this->Entries, row, factors.Scale.C[0], factors.Scale.C[1], factors.Scale.C[2], unused);
    if (this->Shines)
    {
      GatherRows(
        this->Entries, row + Int8(1), factors.Add.C[0], factors.Add.C[1], factors.Add.C[2], unused);
    }
    else
    {
      factors.Add = Broadcast({ 0.f, 0.f, 0.f });
    }
  }

  static TETRALUX_INLINE LaneVector Mix(const LaneVector& a, const LaneVector& b, Float8 t)
  {
    return Fma(b - a, t, a);
  }
  static TETRALUX_INLINE LaneFactors Mix(const LaneFactors& a, const LaneFactors& b, Float8 t)
  {
    return { Mix(a.Scale, b.Scale, t), Mix(a.Add, b.Add, t) };
  }

  const float* Entries;
  bool Shines;
  Float8 U, V; ///< 0..Size - 1
  Int8 Face;
  Mask8 Known;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
