// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TileSpace_h
#define tetralux_TileSpace_h

// Which slabs of a tile meet anything visible.

#include "TriangleCaster/ImageRays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Whether what an S-triangle sees between two slab positions is empty.
bool IsEmpty(const ImageKernelInput& in, const Tile& box, double begin, double end)
{
  const SlicePlanes& slices = in.Slices;
  double low[3], high[3];
  std::fill(low, low + 3, std::numeric_limits<double>::infinity());
  std::fill(high, high + 3, -std::numeric_limits<double>::infinity());
  const bool planes = slices.Shape == SliceShape::Planes;
  // Positions are linear over the pixels and along Direction: corners bound them.
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 4; ++corner)
  {
    const double i = (corner & 1) != 0 ? box.X1 - 1 : box.X0;
    const double j = (corner & 2) != 0 ? box.Y1 - 1 : box.Y0;
    double way[3];
    for (int a = 0; a < 3; ++a)
    {
      way[a] = in.WorldDirection[a].At(i, j);
    }
    const double normal =
      way[0] * slices.Normal[0] + way[1] * slices.Normal[1] + way[2] * slices.Normal[2];
    // No direction between is shorter than its part along the normal.
    longest = std::max(longest, planes ? normal : std::hypot(way[0], way[1], way[2]));
    shortest = std::min(shortest, normal);
  }
  const double near = (slices.Origin + begin * slices.Distance) / longest;
  const double far = (slices.Origin + end * slices.Distance) / shortest;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double i = (corner & 1) != 0 ? box.X1 - 1 : box.X0;
    const double j = (corner & 2) != 0 ? box.Y1 - 1 : box.Y0;
    for (int a = 0; a < 3; ++a)
    {
      const double start = in.Start[a].At(i, j);
      const double direction = in.Direction[a].At(i, j);
      const double x0 = start + near * direction;
      const double x1 = start + far * direction;
      low[a] = std::min({ low[a], x0, x1 });
      high[a] = std::max({ high[a], x0, x1 });
    }
  }
  return in.Space->IsEmpty(low, high);
}

/// Appends the blocks of slabs within [begin, end) that are not empty, in order. Halves what is not
/// empty, so that a large empty space costs one query.
inline void FindVisibleBlocks(const ImageKernelInput& in, const Tile& box, std::int32_t begin,
  std::int32_t end, std::vector<std::int32_t>& blocks)
{
  if (begin >= end ||
    (in.Space &&
      IsEmpty(in, box, static_cast<double>(begin) * SlabsOfBlock,
        static_cast<double>(end) * SlabsOfBlock)))
  {
    return;
  }
  if (end - begin == 1)
  {
    blocks.push_back(begin);
    return;
  }
  const std::int32_t middle = begin + (end - begin) / 2;
  FindVisibleBlocks(in, box, begin, middle, blocks);
  FindVisibleBlocks(in, box, middle, end, blocks);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
