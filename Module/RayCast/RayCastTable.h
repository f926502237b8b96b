// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastTable_h
#define tetralux_RayCastTable_h

// The density-emitter model by lookups in a pre-integration table (Weiler et al. 2003, section
// 3.3), interpolated as PreIntegrationTable::Lookup defines.

#include "RayCast/RayCastRadiance.h"

#include <array>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Places of lookups along an axis of a table, each between a texel and the next one.
struct TexelPlace
{
  Int8 Index;
  Float8 Share;

  TETRALUX_INLINE TexelPlace(Float8 coordinate, int size)
  {
    // Rounds to the texel below, or to either neighbour if the place is on a texel.
    const Int8 below = RoundToInt(coordinate - Float8(0.5f));
    const Int8 last = size - 2;
    this->Index = Select(below > last, last, below);
    this->Share = coordinate - ToFloat(this->Index);
  }
};

/// For scalars at points. In a cell of constant scalar the closed form costs less than a lookup.
template <class Real, class RadianceT>
class TableLookup : public GatheredModel<Real, RadianceT, TableLookup<Real, RadianceT>>
{
public:
  using V = LanesOfReal<Real>;
  using GatheredModel<Real, RadianceT, TableLookup>::GatheredModel;

  TETRALUX_INLINE void AddSegment(
    const KernelInput& in, Mask8 valid, Int8 cell, V z0, V s0, V z1, V s1)
  {
    if (!Any(valid))
    {
      return;
    }
    const KernelTable& table = *in.Table;
    const TexelPlace front(this->GetCoordinate(table, valid, ToFloat(s0)), table.ScalarSize);
    const TexelPlace back(this->GetCoordinate(table, valid, ToFloat(s1)), table.ScalarSize);
    const TexelPlace length(
      GetLengthCoordinate(table, Keep(valid, ToFloat(z1 - z0))), table.LengthSize);

    // Of all lanes, since all are loaded.
    TETRALUX_CHECK(AreBelow(MaskFromBits(AllLanes), front.Index, table.ScalarSize - 1) &&
      AreBelow(MaskFromBits(AllLanes), back.Index, table.ScalarSize - 1) &&
      AreBelow(MaskFromBits(AllLanes), length.Index, table.LengthSize - 1));
    const Int8 size = table.ScalarSize;
    std::array<Float8, 4> slices[2];
    for (int k = 0; k < 2; ++k)
    {
      const Int8 row = ((length.Index + Int8(k)) * size + back.Index) * size + front.Index;
      const std::array<Float8, 4> row0 = LoadRow(table, row, front.Share);
      const std::array<Float8, 4> row1 = LoadRow(table, row + size, front.Share);
      slices[k] = Mix(back.Share, row0, row1);
    }
    const std::array<Float8, 4> rgba = Mix(length.Share, slices[0], slices[1]);
    const Mask8 contributes = valid & (Float8(0.f) < rgba[3]);
    this->Gathered.Enter(in, contributes, cell, z0, z1);
    this->Gathered.Add(contributes, rgba[0], rgba[1], rgba[2], rgba[3]);
    this->First.Add(contributes, z0);
  }

private:
  /// Returns coordinates along the scalars. Keeps each ray's interval, since the next scalar is
  /// mostly in the same one.
  TETRALUX_INLINE Float8 GetCoordinate(const KernelTable& table, Mask8 valid, Float8 x)
  {
    const auto* rows = reinterpret_cast<const float*>(table.Axis);
    Float8 lo, hi, coordinate, slope;
    if (table.AxisSize == 1)
    {
      lo = table.Axis->Lo;
      hi = table.Axis->Hi;
      coordinate = table.Axis->Coordinate;
      slope = table.Axis->Slope;
    }
    else
    {
      const Int8 last = table.AxisSize - 1;
      for (;;)
      {
        TETRALUX_CHECK(AreBelow(MaskFromBits(AllLanes), this->Interval, table.AxisSize));
        GatherRows(rows, this->Interval, lo, hi, coordinate, slope);
        const Mask8 up = valid & (hi <= x) & (last > this->Interval);
        const Mask8 down = valid & (x < lo) & (this->Interval > Int8(0));
        if (!Any(up | down))
        {
          break;
        }
        this->Interval = this->Interval + Ones(up) - Ones(down);
      }
    }
    const Float8 inside = Min(Max(lo, x), hi);
    return Min(
      Fma(slope, inside - lo, coordinate), Float8(static_cast<float>(table.ScalarSize - 1)));
  }

  static TETRALUX_INLINE Float8 GetLengthCoordinate(const KernelTable& table, Float8 length)
  {
    const Float8 y = Max(Float8(0.f), length * Float8(table.InverseDelta));
    const Float8 last = static_cast<float>(table.LengthSize - 1);
    if (!table.Logarithmic)
    {
      return Min(y, last);
    }
    const Float8 one = 1.f;
    const Float8 steps = static_cast<float>(table.StepsPerDoubling);
    const Float8 bits = ToFloat(ToBits(Max(y, one)) - ToBits(one));
    constexpr float Mantissa = 8388608.f; // 2^23
    return Min(Fma(steps, Min(y, one), bits * (steps / Float8(Mantissa))), last);
  }

  static TETRALUX_INLINE std::array<Float8, 4> Mix(
    Float8 t, const std::array<Float8, 4>& from, const std::array<Float8, 4>& to)
  {
    return { Fma(t, to[0] - from[0], from[0]), Fma(t, to[1] - from[1], from[1]),
      Fma(t, to[2] - from[2], from[2]), Fma(t, to[3] - from[3], from[3]) };
  }

  /// Between two texels next to each other along the front scalar.
  static TETRALUX_INLINE std::array<Float8, 4> LoadRow(
    const KernelTable& table, Int8 texel, Float8 share)
  {
    std::array<Float8, 4> a, b;
    GatherRows(table.Texels, texel, a[0], a[1], a[2], a[3]);
    GatherRows(table.Texels, texel + Int8(1), b[0], b[1], b[2], b[3]);
    return Mix(share, a, b);
  }

  Int8 Interval = 0; ///< of the axis, where each ray's last scalar was
};

template <class Real>
using Table = TableLookup<Real, Unlit>;

template <class Real>
using LitTable = TableLookup<Real, Lit>;

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
