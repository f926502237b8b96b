// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PlacedTraversal_h
#define tetralux_PlacedTraversal_h

// Packets go through a PlacedTree. It is made once for all packets of a frame, which pays where
// several of them meet a polygon. Its boxes are rectangles of u and v that fit the polygons, so
// that one comparison tests a node, with all bounds at once.

#include "Isosurface/FrustumTraversal.h"
#include "Isosurface/PlacedTree.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Lane of PlacedBounds.
constexpr int KeyLane = 4;

/// How far beside the rays of a frame a polygon is that none of them hits, as a share of the
/// largest |u| and |v|: far above the rounding of corners, and little for a polygon too many.
constexpr double BesideRounding = 1e-6;

TETRALUX_INLINE void SetNoBounds(PlacedBounds& bounds)
{
  Store(bounds.Values, Float8(std::numeric_limits<float>::infinity()));
}

/// Whether all corners of a polygon are beyond one side of the rays within bounds.
TETRALUX_INLINE bool IsBeside(
  const RayFrame& frame, const RayBounds& bounds, double largest, const Isopolygon& polygon)
{
  const double rounding = BesideRounding * largest;
  const double low[2] = { bounds.LowU - rounding, bounds.LowV - rounding };
  const double high[2] = { bounds.HighU + rounding, bounds.HighV + rounding };
  bool below[2] = { true, true };
  bool above[2] = { true, true };
  for (int i = 0; i < 4; ++i)
  {
    const double corner[3] = { polygon.X[i], polygon.Y[i], polygon.Z[i] };
    double placed[3];
    Transform(frame, corner, placed);
    for (int a = 0; a < 2; ++a)
    {
      below[a] = below[a] && placed[a] < low[a] * placed[2];
      above[a] = above[a] && placed[a] > high[a] * placed[2];
    }
  }
  return below[0] || below[1] || above[0] || above[1];
}

/// Fills the leaves of a PlacedTree among the nodes from first up to but without end. bounds: of
/// all rays of the frame; LowU, LowV, HighU and HighV.
void PlaceLeaves(const TraceTree& tree, const RayFrame& frame, const TraceLimits& limits,
  const double (&boundsOfRays)[4], std::int32_t first, std::int32_t end, const PlacedTree& result)
{
  static_assert(sizeof(PlacedPolygon) <= PlacedPolygonBytes, "room for a polygon");
  const RayBounds bounds = { boundsOfRays[0], boundsOfRays[2], boundsOfRays[1], boundsOfRays[3] };
  const double largest = GetLargest(bounds);
  const float margin = GetPacketMargin(largest);
  const PacketFrustum frustum(frame, bounds, limits);
  auto* polygons = static_cast<PlacedPolygon*>(result.Polygons);
  PolygonLanes lanes(frame, bounds, largest);
  for (std::int32_t id = first; id < end; ++id)
  {
    const MinMaxTree::Node& node = tree.Nodes[id];
    if (node.Count == 0)
    {
      continue;
    }
    PlacedBounds& all = result.Nodes[id];
    SetNoBounds(all);
    float nearness;
    const bool misses = frustum.Misses(node, nearness);
    for (std::int32_t begin = 0; begin < node.Count; begin += LaneCount)
    {
      const std::int32_t firstPolygon = node.First + begin;
      const int count = node.Count - begin < LaneCount ? node.Count - begin : LaneCount;
      for (int lane = 0; lane < count; ++lane)
      {
        SetNoBounds(result.Bounds[firstPolygon + lane]);
      }
      unsigned found =
        misses ? 0 : lanes.PlaceCorners(tree.Polygons + firstPolygon, count, -InfiniteKey);
      found = found != 0 ? found & lanes.PlaceEdges() : 0;
      for (; found != 0; found &= found - 1)
      {
        const int lane = __builtin_ctz(found);
        const std::int32_t i = firstPolygon + lane;
        const Isopolygon& polygon = tree.Polygons[i];
        PlacedPolygon& placed = polygons[i];
        lanes.GetCorners(lane, placed.Polygon);
        lanes.GetEdges(lane, placed.Polygon);
        // A polygon that is not wholly before the origin of the rays has no bounds.
        if (placed.Polygon.HighKey == InfiniteKey && IsBeside(frame, bounds, largest, polygon))
        {
          continue;
        }
        placed.Part = FindLimitedPart(limits, polygon);
        if (placed.Part == LimitedPart::None)
        {
          continue;
        }
        placed.Id = i;
        const float values[8] = { static_cast<float>(placed.Polygon.LowU) - margin,
          static_cast<float>(placed.Polygon.LowV) - margin,
          -static_cast<float>(placed.Polygon.HighU) - margin,
          -static_cast<float>(placed.Polygon.HighV) - margin, RoundDown(-placed.Polygon.HighKey), 0,
          0, 0 };
        Store(result.Bounds[i].Values, LoadFloat8(values));
        Store(all.Values, Min(LoadFloat8(all.Values), LoadFloat8(values)));
      }
    }
  }
}

/// What of a PlacedTree a packet may hit, in the order of PlacedBounds.
class PlacedQuery
{
public:
  /// key: the least one that may still change the packet.
  PlacedQuery(const RayPacket& packet, float key)
    : Values{ static_cast<float>(packet.HighU), static_cast<float>(packet.HighV),
      -static_cast<float>(packet.LowU), -static_cast<float>(packet.LowV), -key, 0, 0, 0 }
  {
  }

  void SetFarthest(float key) { this->Values[KeyLane] = -key; }

  TETRALUX_INLINE bool MayHit(const PlacedBounds& bounds) const
  {
    return Bits(LoadFloat8(bounds.Values) <= LoadFloat8(this->Values)) == AllLanes;
  }

private:
  alignas(32) float Values[LaneCount];
};

/// Calls visit(node) with each leaf that a query may hit anything in, nearer ones first. visit
/// returns whether to go on, and may move the query's farthest key.
template <class Visit>
TETRALUX_INLINE void WalkPlaced(const TraceTree& tree, const PlacedTree& placed,
  const PlacedQuery& query, TraceCounts& counts, const Visit& visit)
{
  std::int32_t stack[MinMaxTree::MaximumDepth + 1];
  int depth = 0;
  std::int32_t id = 0;
  for (;;)
  {
    ++counts.NodeTests;
    if (query.MayHit(placed.Nodes[id]))
    {
      const MinMaxTree::Node& node = tree.Nodes[id];
      if (node.Count == 0)
      {
        const std::int32_t first = id + 1;
        const std::int32_t second = node.First;
        const bool firstIsNear =
          placed.Nodes[first].Values[KeyLane] <= placed.Nodes[second].Values[KeyLane];
        stack[depth++] = firstIsNear ? second : first;
        id = firstIsNear ? first : second;
        continue;
      }
      if (!visit(node))
      {
        return;
      }
    }
    else
    {
      ++counts.NodeMisses;
    }
    if (depth == 0)
    {
      return;
    }
    id = stack[--depth];
  }
}

/// Intersects the rays of a packet with the polygons of a PlacedTree.
template <bool AnyHit>
TETRALUX_INLINE void TracePlaced(const TraceTree& tree, const RayFrame& frame,
  const TraceLimits& limits, const PlacedTree& placed, RayPacket& packet, TraceCounts& counts)
{
  ++counts.Packets;
  const auto* polygons = static_cast<const PlacedPolygon*>(placed.Polygons);
  const float margin = GetPacketMargin(GetLargest(packet));
  PlacedQuery query(packet, GetLeastFar(packet));
  WalkPlaced(tree, placed, query, counts,
    [&](const MinMaxTree::Node& node)
    {
      bool changed = false;
      for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
      {
        if (query.MayHit(placed.Bounds[i]))
        {
          const PlacedPolygon& polygon = polygons[i];
          changed |= HitPlaced<AnyHit>(
            limits, frame, polygon, FindChunks(packet, margin, polygon.Polygon), packet, counts);
        }
        else
        {
          ++counts.Polygons;
          ++counts.PolygonMisses;
        }
      }
      if (changed)
      {
        query.SetFarthest(GetLeastFar(packet));
      }
      return true;
    });
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
