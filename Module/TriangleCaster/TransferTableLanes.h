// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferTableLanes_h
#define tetralux_TransferTableLanes_h

// A table of colour and opacity over scalar and gradient length, in lanes.

#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/VoxelLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Which entry along one axis is at or before a position, at most last - 1, and how far that is.
TETRALUX_INLINE Int8 FindCell(Float8 position, float last, Float8& share)
{
  const Float8 inside = Min(Max(position, Float8(0.f)), Float8(last));
  const Int8 cell = RoundToInt(Min(Max(inside - Float8(0.5f), Float8(0.f)), Float8(last - 1.f)));
  share = inside - ToFloat(cell);
  return cell;
}

/// Colour and opacity.
struct LaneEntry
{
  Float8 C[4];
};

/// The entry for scalars at x among the intervals of the transfer function, and gradient lengths.
TETRALUX_NOINLINE LaneEntry LookUpTable(const TransferTableLookup& table, Float8 x, Float8 length)
{
  Float8 u, v;
  const Int8 column =
    FindCell(Fma(x, Float8(table.ColumnScale), Float8(table.ColumnOffset)), table.LastColumn, u);
  const Int8 row =
    FindCell(Fma(length, Float8(table.RowScale), Float8(table.RowOffset)), table.LastRow, v);
  const Int8 first = row * Int8(table.Columns) + column;
  const auto* entries = reinterpret_cast<const float*>(table.Entries);
  Float8 corner[2][2][4];
  for (int j = 0; j < 2; ++j)
  {
    for (int i = 0; i < 2; ++i)
    {
      Float8(&c)[4] = corner[j][i];
      GatherRows(entries, first + Int8(j * table.Columns + i), c[0], c[1], c[2], c[3]);
    }
  }
  const auto mix = [&](int c)
  {
    return Mix(
      Mix(corner[0][0][c], corner[0][1][c], u), Mix(corner[1][0][c], corner[1][1][c], u), v);
  };
  // Rounding may lead below 0 beside an entry of 0.
  return { { mix(0), mix(1), mix(2), Max(Float8(0.f), mix(3)) } };
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
