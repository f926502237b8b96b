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

/// The rays of a tile, as far as it takes to bound them.
struct TileBeam
{
  double Start[4][3], Direction[4][3]; ///< of the rays at its corners, coordinates of the volume
  double Longest, Shortest;            ///< bounds of the depth that a Direction gains

  TileBeam(const ImageKernelInput& in, const Tile& box)
    : Longest(0)
    , Shortest(std::numeric_limits<double>::infinity())
  {
    const SlicePlanes& slices = in.Slices;
    for (int corner = 0; corner < 4; ++corner)
    {
      const double i = (corner & 1) != 0 ? box.X1 - 1 : box.X0;
      const double j = (corner & 2) != 0 ? box.Y1 - 1 : box.Y0;
      double way[3];
      for (int a = 0; a < 3; ++a)
      {
        this->Start[corner][a] = in.Start[a].At(i, j);
        this->Direction[corner][a] = in.Direction[a].At(i, j);
        way[a] = in.WorldDirection[a].At(i, j);
      }
      const double normal =
        way[0] * slices.Normal[0] + way[1] * slices.Normal[1] + way[2] * slices.Normal[2];
      // No direction between corners is longer than the longest, or shorter than its part along
      // the normal.
      this->Longest = std::max(this->Longest, slices.GetDepthOfDirection(way));
      this->Shortest = std::min(this->Shortest, normal);
    }
  }

  /// Bounds what is between two slab positions, in coordinates of the volume. Positions are linear
  /// over pixels and along rays, so the corners bound them.
  void FindBox(
    const ImageKernelInput& in, double begin, double end, double (&low)[3], double (&high)[3]) const
  {
    const SlicePlanes& slices = in.Slices;
    const double ways[2] = { (slices.Origin + begin * slices.Distance) / this->Longest,
      (slices.Origin + end * slices.Distance) / this->Shortest };
    for (int a = 0; a < 3; ++a)
    {
      double least = std::numeric_limits<double>::infinity();
      double most = -least;
      for (int corner = 0; corner < 4; ++corner)
      {
        for (const double way : ways)
        {
          const double x = this->Start[corner][a] + way * this->Direction[corner][a];
          least = x < least ? x : least;
          most = x > most ? x : most;
        }
      }
      low[a] = least;
      high[a] = most;
    }
  }

  /// Whether it meets nothing that contributes between two slab positions, and within reach of
  /// them.
  bool IsEmpty(const ImageKernelInput& in, double begin, double end) const
  {
    double low[3], high[3];
    this->FindBox(in, std::max(begin - in.SpaceReach, 0.), end + in.SpaceReach, low, high);
    return in.Space->IsEmpty(low, high);
  }
};

/// Appends the blocks of slabs within [begin, end) that are not empty, in order. Halves what is not
/// empty, so that a large empty space costs one query.
inline void FindVisibleBlocks(const ImageKernelInput& in, const TileBeam& beam, std::int32_t begin,
  std::int32_t end, std::vector<std::int32_t>& blocks)
{
  if (begin >= end ||
    (in.Space &&
      beam.IsEmpty(
        in, static_cast<double>(begin) * SlabsOfBlock, static_cast<double>(end) * SlabsOfBlock)))
  {
    return;
  }
  if (end - begin == 1)
  {
    blocks.push_back(begin);
    return;
  }
  const std::int32_t middle = begin + (end - begin) / 2;
  FindVisibleBlocks(in, beam, begin, middle, blocks);
  FindVisibleBlocks(in, beam, middle, end, blocks);
}

/// The blocks of slabs between the front and the back of the hulls in a tile: [begin, end).
inline void LimitBlocks(
  const ImageKernelInput& in, const Tile& box, std::int32_t& begin, std::int32_t& end)
{
  if (!in.Hulls)
  {
    return;
  }
  // Far above the rounding of depths, and far below a slab that matters.
  constexpr double Margin = 1e-6;
  const int tile = box.Y0 / in.TileSize * in.Hulls->Tiles.GetColumns() + box.X0 / in.TileSize;
  DepthRange range = in.Hulls->Triangles[2 * tile];
  range.Add(in.Hulls->Triangles[2 * tile + 1].Front, in.Hulls->Triangles[2 * tile + 1].Back);
  const double blockDepth = in.Slices.Distance * SlabsOfBlock;
  const double first = (range.Front - in.Slices.Origin) / blockDepth - Margin;
  const double last = (range.Back - in.Slices.Origin) / blockDepth + Margin;
  if (range.IsEmpty() || !(last >= 0) || !(first < end))
  {
    end = begin;
    return;
  }
  begin = std::max(begin, static_cast<std::int32_t>(std::max(first, 0.)));
  end = last < end ? static_cast<std::int32_t>(last) + 1 : end;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
