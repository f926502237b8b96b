// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PolygonBlock_h
#define tetralux_PolygonBlock_h

// The isopolygons before a block of packets. The block goes through the hierarchy as one large
// packet, and each polygon is prepared once for all packets of the block. That pays where polygons
// are larger than some pixels, so that a polygon is met by several packets. It gives up to skip
// what nearer polygons hide, which pays where there are more polygons than pixels.

#include "Isosurface/FrustumTraversal.h"
#include "Isosurface/IsosurfaceKernel.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Gathers the polygons that rays of a block may hit. bounds: of the block's rays.
TETRALUX_NOINLINE void GatherPolygons(const TraceTree& tree, const RayFrame& frame,
  const TraceLimits& limits, const RayPacket& bounds, BlockMemory& block, TraceCounts& counts)
{
  const double largest = GetLargest(bounds);
  const float margin = GetPacketMargin(largest);
  block.Count = 0;
  TreeWalk(tree, frame, limits, bounds, counts)
    .Walk(
      [&](const MinMaxTree::Node& node)
      {
        PrefetchPolygons(tree, node);
        if (block.Count + node.Count + LaneCount > block.Capacity)
        {
          block.Grow(block, block.Count + node.Count + LaneCount);
        }
        auto* polygons = static_cast<PlacedPolygon*>(block.Polygons);
        for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
        {
          const Isopolygon& polygon = tree.Polygons[i];
          PlacedPolygon& placed = polygons[block.Count];
          placed.Part = FindLimitedPart(limits, polygon);
          if (placed.Part == LimitedPart::None ||
            !Place(frame, bounds, largest, margin, polygon, placed.Polygon))
          {
            ++counts.Polygons;
            ++counts.PolygonMisses;
            continue;
          }
          placed.Id = i;
          block.LowU[block.Count] = placed.Polygon.LowU;
          block.HighU[block.Count] = placed.Polygon.HighU;
          block.LowV[block.Count] = placed.Polygon.LowV;
          block.HighV[block.Count] = placed.Polygon.HighV;
          ++block.Count;
        }
      });
  // What is read beyond the last one misses.
  for (int i = block.Count; i < block.Count + LaneCount && i < block.Capacity; ++i)
  {
    block.LowU[i] = std::numeric_limits<float>::infinity();
  }
}

/// Intersects the rays of a packet with the polygons of its block.
template <bool AnyHit>
TETRALUX_INLINE void HitBlock(const TraceLimits& limits, const RayFrame& frame,
  const BlockMemory& block, RayPacket& packet, TraceCounts& counts)
{
  ++counts.Packets;
  const auto* polygons = static_cast<const PlacedPolygon*>(block.Polygons);
  const Float8 lowU = static_cast<float>(packet.LowU), highU = static_cast<float>(packet.HighU);
  const Float8 lowV = static_cast<float>(packet.LowV), highV = static_cast<float>(packet.HighV);
  for (int first = 0; first < block.Count; first += LaneCount)
  {
    const Mask8 may = (LoadFloat8(block.LowU + first) <= highU) &
      (lowU <= LoadFloat8(block.HighU + first)) & (LoadFloat8(block.LowV + first) <= highV) &
      (lowV <= LoadFloat8(block.HighV + first));
    for (unsigned bits = static_cast<unsigned>(Bits(may)); bits != 0; bits &= bits - 1)
    {
      HitPlaced<AnyHit>(limits, frame, polygons[first + __builtin_ctz(bits)], packet, counts);
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
