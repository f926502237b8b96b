// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FrustumTraversal_h
#define tetralux_FrustumTraversal_h

// A packet goes through a hierarchy (Wald et al. 2007, section 5.2). The rays of a packet are
// points of a rectangle in u and v, so that the planes through its edges bound its frustum, and
// interval arithmetic with a node's box decides whether the packet misses it: one product and one
// maximum for each coordinate and plane, for all planes at once.

#include "Isosurface/FramePolygon.h"
#include "Isosurface/IsopolygonExtraction.h"
#include "Isosurface/PlacedPolygon.h"
#include "Isosurface/PolygonLanes.h"
#include "Isosurface/PolygonLimits.h"
#include "Isosurface/TraceInput.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Asks for the polygons of a leaf, before they are needed.
TETRALUX_INLINE void PrefetchPolygons(const TraceTree& tree, const MinMaxTree::Node& node)
{
  for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
  {
    __builtin_prefetch(tree.Polygons[i].X);
    __builtin_prefetch(tree.Polygons[i].Z);
  }
}

/// Planes that bound what a packet can hit, one a lane, in the mesh's frame.
class PacketFrustum
{
public:
  PacketFrustum(const RayFrame& frame, const RayBounds& packet, const TraceLimits& limits)
    : Limits(limits)
  {
    const double(&rows)[3][4] = frame.Rows;
    const double sides[4][2] = { { 1, packet.LowU }, { -1, packet.HighU }, { 1, packet.LowV },
      { -1, packet.HighV } };
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      this->SetPlane(lane, 0, 0, 0, 1); // keeps all
    }
    for (int side = 0; side < 4; ++side)
    {
      const double* row = rows[side / 2];
      const double sign = sides[side][0];
      const double bound = sides[side][1];
      double plane[4];
      for (int a = 0; a < 4; ++a)
      {
        const double along = frame.Parallel ? (a == 3 ? 1. : 0.) : rows[2][a];
        plane[a] = sign * (row[a] - bound * along);
      }
      this->SetPlane(side, plane[0], plane[1], plane[2], plane[3]);
    }
    // In this lane comes minus the least depth.
    this->SetPlane(NearLane, -rows[2][0], -rows[2][1], -rows[2][2], -rows[2][3]);
    if (!frame.Parallel)
    {
      this->SetPlane(5, rows[2][0], rows[2][1], rows[2][2], rows[2][3]);
    }
    // Any two of the limits: more of them cull polygons only.
    for (int p = 0; p < limits.NumberOfPlanes && p < 2; ++p)
    {
      const double(&plane)[4] = limits.Planes[p];
      this->SetPlane(6 + p, plane[0], plane[1], plane[2], plane[3]);
    }
  }

  /// Whether the packet misses a node. nearness: minus the least depth of its box.
  TETRALUX_INLINE bool Misses(const MinMaxTree::Node& node, float& nearness) const
  {
    Float8 most = LoadFloat8(this->One);
    for (int a = 0; a < 3; ++a)
    {
      const Float8 factor = LoadFloat8(this->Factors[a]);
      most = most + Max(factor * Float8(node.Lower[a]), factor * Float8(node.Upper[a]));
    }
    float values[LaneCount];
    Store(values, most);
    nearness = values[NearLane];
    constexpr unsigned Others = AllLanes & ~(1u << NearLane);
    return (Bits(most < Float8(0.f)) & Others) != 0 || nearness + this->Farthest < 0 ||
      (this->Limits.Cropping && IsCroppedAway(this->Limits, node.Lower, node.Upper));
  }

  /// key: the least one that may still change the packet.
  void SetFarthest(const RayFrame& frame, float key)
  {
    const double depth = frame.Parallel ? -static_cast<double>(key)
      : key > 0                         ? 1 / static_cast<double>(key)
                                        : InfiniteKey;
    this->Farthest = -RoundDown(-depth);
  }
  float GetFarthest() const { return this->Farthest; }

private:
  static constexpr int NearLane = 4;

  void SetPlane(int lane, double x, double y, double z, double one)
  {
    // Boxes are within -1..1, and single precision rounds four products and sums.
    constexpr double Rounding = 8. / (1 << 24);
    const double ax = x < 0 ? -x : x;
    const double ay = y < 0 ? -y : y;
    const double az = z < 0 ? -z : z;
    const double a1 = one < 0 ? -one : one;
    this->Factors[0][lane] = static_cast<float>(x);
    this->Factors[1][lane] = static_cast<float>(y);
    this->Factors[2][lane] = static_cast<float>(z);
    this->One[lane] = static_cast<float>(one + Rounding * (ax + ay + az + a1));
  }

  alignas(32) float Factors[3][LaneCount];
  alignas(32) float One[LaneCount];
  float Farthest = std::numeric_limits<float>::infinity(); ///< depth
  const TraceLimits& Limits;
};

/// Calls hit(polygons, ids, count) with the polygons of a leaf, at most LaneCount at a time.
/// Returns whether any call did.
template <class Hit>
TETRALUX_INLINE bool ForEachLeafBatch(
  const TraceTree& tree, const MinMaxTree::Node& node, TraceCounts& counts, const Hit& hit)
{
  std::int64_t ids[LaneCount];
  bool any = false;
  if (tree.Polygons)
  {
    PrefetchPolygons(tree, node);
    for (std::int32_t begin = 0; begin < node.Count; begin += LaneCount)
    {
      const std::int32_t first = node.First + begin;
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        ids[lane] = first + lane;
      }
      any |= hit(tree.Polygons + first, ids,
        node.Count - begin < LaneCount ? node.Count - begin : LaneCount);
    }
    return any;
  }
  Isopolygon polygons[LaneCount];
  int count = 0;
  for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
  {
    const std::int32_t cell = tree.LeafCells[i];
    ForEachIsopolygon(tree.Source, cell,
      [&](const Isopolygon& polygon)
      {
        ++counts.Extractions;
        polygons[count] = polygon;
        ids[count] = PackHit(cell, polygon.Surface);
        ++count;
        if (count == LaneCount)
        {
          any |= hit(polygons, ids, count);
          count = 0;
        }
      });
  }
  return (count > 0 && hit(polygons, ids, count)) || any;
}

/// The way of a packet through a tree.
class TreeWalk
{
public:
  TreeWalk(const TraceTree& tree, const RayFrame& frame, const TraceLimits& limits,
    const RayBounds& packet, TraceCounts& counts)
    : Frustum(frame, packet, limits)
    , Tree(tree)
    , Counts(counts)
  {
  }

  /// Calls hit(polygons, ids, count) with the polygons that the packet may hit, at most LaneCount
  /// at a time, leaf by leaf, nearer ones before those farther. After a leaf of which any call
  /// returned true it calls setFarthest(), which may move Frustum's farthest depth.
  template <class Hit, class SetFarthest>
  TETRALUX_INLINE void ForEachBatch(const Hit& hit, const SetFarthest& setFarthest)
  {
    this->ForEachLeaf(
      [&](const MinMaxTree::Node& node)
      {
        if (ForEachLeafBatch(this->Tree, node, this->Counts, hit))
        {
          setFarthest();
        }
      });
  }

  PacketFrustum Frustum;

private:
  struct StackEntry
  {
    std::int32_t Node;
    float Nearness;
  };

  /// Calls visit(node) with each leaf that the packet may hit anything in, nearer ones before those
  /// farther. visit may move Frustum's farthest depth.
  template <class Visit>
  TETRALUX_INLINE void ForEachLeaf(const Visit& visit)
  {
    ++this->Counts.Packets;
    StackEntry stack[MinMaxTree::MaximumDepth + 1];
    int depth = 0;
    std::int32_t id = 0;
    bool tested = true;
    float nearness = 0;
    if (!this->Tree.Nodes || !this->IsActive(0) || this->Misses(this->Tree.Nodes[0], nearness))
    {
      return;
    }
    for (;;)
    {
      const MinMaxTree::Node& node = this->Tree.Nodes[id];
      if (node.Count > 0)
      {
        if (tested || !this->Misses(node, nearness))
        {
          visit(node);
        }
      }
      else
      {
        // Down to the next node with two active children without any test.
        const std::int32_t first = id + 1;
        const std::int32_t second = node.First;
        const bool firstActive = this->IsActive(first);
        const bool secondActive = this->IsActive(second);
        if (firstActive != secondActive)
        {
          id = firstActive ? first : second;
          tested = false;
          continue;
        }
        if (firstActive)
        {
          float firstNearness, secondNearness;
          const bool hitsFirst = !this->Misses(this->Tree.Nodes[first], firstNearness);
          const bool hitsSecond = !this->Misses(this->Tree.Nodes[second], secondNearness);
          if (hitsFirst && hitsSecond)
          {
            const bool firstIsNear = firstNearness >= secondNearness;
            stack[depth++] = { firstIsNear ? second : first,
              firstIsNear ? secondNearness : firstNearness };
            const MinMaxTree::Node& later = this->Tree.Nodes[stack[depth - 1].Node];
            if (later.Count > 0 && this->Tree.Polygons)
            {
              PrefetchPolygons(this->Tree, later);
            }
          }
          if (hitsFirst || hitsSecond)
          {
            id = hitsFirst && (!hitsSecond || firstNearness >= secondNearness) ? first : second;
            tested = true;
            continue;
          }
        }
      }
      // What was hit since may hide what waits.
      do
      {
        if (depth == 0)
        {
          return;
        }
        --depth;
        id = stack[depth].Node;
        tested = true;
      } while (stack[depth].Nearness + this->Frustum.GetFarthest() < 0);
    }
  }

  TETRALUX_INLINE bool Misses(const MinMaxTree::Node& node, float& nearness)
  {
    ++this->Counts.NodeTests;
    const bool misses = this->Frustum.Misses(node, nearness);
    this->Counts.NodeMisses += misses;
    return misses;
  }

  /// Whether a node's range holds any of the values.
  TETRALUX_INLINE bool IsActive(std::int32_t id)
  {
    if (this->Tree.Polygons)
    {
      return true;
    }
    ++this->Counts.RangeTests;
    const MinMaxTree::Range range = this->Tree.Ranges[id];
    // The least value that is not below the range.
    int low = 0;
    int high = this->Tree.Source.NumberOfValues;
    while (low < high)
    {
      const int middle = (low + high) / 2;
      const bool below = this->Tree.ValueSteps[middle] < range.Least;
      low = below ? middle + 1 : low;
      high = below ? high : middle;
    }
    return low < this->Tree.Source.NumberOfValues && this->Tree.ValueSteps[low] <= range.Largest;
  }

  const TraceTree& Tree;
  TraceCounts& Counts;
};

/// The largest |u| and |v| within the bounds of a packet, at least 1.
TETRALUX_INLINE double GetLargest(const RayBounds& packet)
{
  const double bounds[4] = { packet.LowU, packet.HighU, packet.LowV, packet.HighV };
  double largest = 1;
  for (const double bound : bounds)
  {
    const double size = bound < 0 ? -bound : bound;
    largest = size > largest ? size : largest;
  }
  return largest;
}

/// A packet that is traced through a tree.
template <bool AnyHit>
class PacketTraversal
{
public:
  PacketTraversal(const TraceTree& tree, const RayFrame& frame, const TraceLimits& limits,
    RayPacket& packet, TraceCounts& counts)
    : Frame(frame)
    , Limits(limits)
    , Packet(packet)
    , Counts(counts)
    , Walk(tree, frame, limits, packet, counts)
    , Lanes(frame, packet, GetLargest(packet))
    , Margin(GetPacketMargin(GetLargest(packet)))
  {
    this->SetFarthest();
  }

  void Trace()
  {
    this->Walk.ForEachBatch([this](const Isopolygon* polygons, const std::int64_t* ids, int count)
      { return this->HitLanes(polygons, ids, count); },
      [this] { this->SetFarthest(); });
  }

private:
  TETRALUX_INLINE void SetFarthest()
  {
    this->LeastFar = GetLeastFar(this->Packet);
    this->Walk.Frustum.SetFarthest(this->Frame, this->LeastFar);
  }

  /// Intersects polygons, LaneCount at most. Returns whether any ray may have hit one.
  TETRALUX_NOINLINE bool HitLanes(const Isopolygon* polygons, const std::int64_t* ids, int count)
  {
    PlacedPolygon placed[LaneCount];
    std::uint32_t chunks[LaneCount];
    unsigned hit = 0;
    // Most polygons are hidden or small: where no chunk may hit one, its edges are not needed.
    for (unsigned rest = this->Lanes.PlaceCorners(polygons, count, this->LeastFar); rest != 0;
         rest &= rest - 1)
    {
      const int lane = __builtin_ctz(rest);
      FramePolygon& polygon = placed[lane].Polygon;
      this->Lanes.GetCorners(lane, polygon);
      chunks[lane] = FindChunks(this->Packet, this->Margin, polygon);
      hit |= chunks[lane] != 0 ? 1u << lane : 0u;
    }
    hit = hit != 0 ? hit & this->Lanes.PlaceEdges() : 0;
    const int missed = count - __builtin_popcount(hit);
    this->Counts.Polygons += missed;
    this->Counts.PolygonMisses += missed;
    bool changed = false;
    for (; hit != 0; hit &= hit - 1)
    {
      const int lane = __builtin_ctz(hit);
      PlacedPolygon& polygon = placed[lane];
      this->Lanes.GetEdges(lane, polygon.Polygon);
      polygon.Id = ids[lane];
      polygon.Part = FindLimitedPart(this->Limits, polygons[lane]);
      changed |= HitPlaced<AnyHit>(
        this->Limits, this->Frame, polygon, chunks[lane], this->Packet, this->Counts);
    }
    return changed;
  }

  const RayFrame& Frame;
  const TraceLimits& Limits;
  RayPacket& Packet;
  TraceCounts& Counts;
  TreeWalk Walk;
  PolygonLanes Lanes;
  float Margin;
  float LeastFar; ///< of the packet's rays
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
