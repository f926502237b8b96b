// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BlockTraversal_h
#define tetralux_BlockTraversal_h

// A block of primary rays goes through a hierarchy. Its rays are pixels, so that the bounds of a
// polygon name the chunks that it may hit, and a polygon between pixels is left out. A larger block
// shares nodes and polygons among more rays; what a packet's nearest hits hide is left out packet
// by packet.

#include "Isosurface/FrustumTraversal.h"
#include "Isosurface/RayBlock.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The largest whole number that is not above x. Where |x| is above 2^51, off by 2 at most.
TETRALUX_INLINE Double8 Floor(Double8 x)
{
  const Double8 shift = 6755399441055744.; // 1.5 * 2^52: a sum with it has no fraction
  const Double8 rounded = (x + shift) - shift;
  return rounded - Select(x < rounded, Double8(1.), Double8(0.));
}

/// The bounds of the pixels of a block.
TETRALUX_INLINE RayBounds GetBounds(const RayBlock& block)
{
  return { static_cast<double>(block.X0), block.X1 - 1., static_cast<double>(block.Y0),
    block.Y1 - 1. };
}

/// A block of rays that is traced through a tree. start(p) fills the rays of packet p of the block,
/// and its Far.
template <class Start>
class BlockTraversal
{
public:
  BlockTraversal(const TraceTree& tree, const RayFrame& frame, const TraceLimits& limits,
    RayBlock& block, const Start& start, TraceCounts& counts)
    : Frame(frame)
    , Limits(limits)
    , Block(block)
    , StartPacket(start)
    , Counts(counts)
    , Bounds(GetBounds(block))
    , Walk(tree, frame, limits, this->Bounds, counts)
    , Lanes(frame, this->Bounds, GetLargest(this->Bounds))
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
    float least = this->Block.Far[0];
    for (int p = 1; p < RayBlock::MaximumPackets; ++p)
    {
      least = this->Block.Far[p] < least ? this->Block.Far[p] : least;
    }
    this->LeastFar = least;
    this->Walk.Frustum.SetFarthest(this->Frame, least);
  }

  /// Intersects polygons, LaneCount at most. Returns whether any ray may have hit one.
  TETRALUX_NOINLINE bool HitLanes(const Isopolygon* polygons, const std::int64_t* ids, int count)
  {
    unsigned hit = this->Lanes.PlaceCorners(polygons, count, this->LeastFar);
    hit = hit != 0 ? hit & this->FindPixels() : 0;
    for (unsigned rest = hit; rest != 0; rest &= rest - 1)
    {
      const unsigned lane = rest & -rest;
      hit &= this->IsHidden(__builtin_ctz(rest)) ? ~lane : ~0u;
    }
    hit = hit != 0 ? hit & this->Lanes.PlaceEdges() : 0;
    const int missed = count - __builtin_popcount(hit);
    this->Counts.Polygons += missed;
    this->Counts.PolygonMisses += missed;
    bool changed = false;
    for (; hit != 0; hit &= hit - 1)
    {
      const int lane = __builtin_ctz(hit);
      PlacedPolygon polygon;
      this->Lanes.GetCorners(lane, polygon.Polygon);
      this->Lanes.GetEdges(lane, polygon.Polygon);
      polygon.Id = ids[lane];
      polygon.Part = FindLimitedPart(this->Limits, polygons[lane]);
      changed |= this->HitPackets(polygon, lane);
    }
    return changed;
  }

  /// Finds the pixels of the block that are within the bounds of each polygon. Returns the polygons
  /// that have any, one bit each.
  TETRALUX_INLINE unsigned FindPixels()
  {
    const Double8 none = 0.;
    const Double8 x0 = this->Block.X0, y0 = this->Block.Y0;
    const Double8 lastX = this->Block.X1 - this->Block.X0 - 1.;
    const Double8 lastY = this->Block.Y1 - this->Block.Y0 - 1.;
    const Double8 firstPixelX = Max(none - Floor(none - this->Lanes.GetLowU()) - x0, none);
    const Double8 firstPixelY = Max(none - Floor(none - this->Lanes.GetLowV()) - y0, none);
    const Double8 lastPixelX = Min(Floor(this->Lanes.GetHighU()) - x0, lastX);
    const Double8 lastPixelY = Min(Floor(this->Lanes.GetHighV()) - y0, lastY);
    Store(this->FirstX, ToPixels(Min(firstPixelX, lastX)));
    Store(this->FirstY, ToPixels(Min(firstPixelY, lastY)));
    Store(this->LastX, ToPixels(Max(lastPixelX, none)));
    Store(this->LastY, ToPixels(Max(lastPixelY, none)));
    return Bits((firstPixelX <= lastPixelX) & (firstPixelY <= lastPixelY));
  }

  TETRALUX_INLINE static Int8 ToPixels(Double8 whole) { return RoundToInt(ToFloat(whole)); }

  /// The packets of the block that have pixels within the bounds of a polygon.
  struct PacketRange
  {
    unsigned FirstX, LastX, FirstY, LastY;
  };
  TETRALUX_INLINE PacketRange GetPackets(int lane) const
  {
    constexpr unsigned Edge = RayPacket::Edge;
    return { static_cast<unsigned>(this->FirstX[lane]) / Edge,
      static_cast<unsigned>(this->LastX[lane]) / Edge,
      static_cast<unsigned>(this->FirstY[lane]) / Edge,
      static_cast<unsigned>(this->LastY[lane]) / Edge };
  }

  /// Whether all packets within the bounds of a polygon have nearer hits.
  TETRALUX_INLINE bool IsHidden(int lane) const
  {
    const float key = -RoundDown(-this->Lanes.GetHighKey(lane));
    const PacketRange packets = this->GetPackets(lane);
    for (unsigned y = packets.FirstY; y <= packets.LastY; ++y)
    {
      for (unsigned x = packets.FirstX; x <= packets.LastX; ++x)
      {
        if (this->Block.Far[y * RayBlock::Packets + x] < key)
        {
          return false;
        }
      }
    }
    return true;
  }

  /// The chunks of a packet that have pixels within the bounds of a polygon, one bit each.
  TETRALUX_INLINE std::uint32_t FindPixelChunks(int lane, int packetX, int packetY) const
  {
    static_assert(RayPacket::Edge / RayPacket::ChunkWidth == 4, "chunks in a row");
    static_assert(RayPacket::MaximumChunks == 32, "one bit a chunk");
    constexpr int Edge = RayPacket::Edge;
    const int x0 = this->FirstX[lane] - packetX * Edge;
    const int x1 = this->LastX[lane] - packetX * Edge;
    const int y0 = this->FirstY[lane] - packetY * Edge;
    const int y1 = this->LastY[lane] - packetY * Edge;
    const int firstColumn = x0 < 0 ? 0 : x0 / RayPacket::ChunkWidth;
    const int lastColumn = (x1 < Edge ? x1 : Edge - 1) / RayPacket::ChunkWidth;
    const int firstRow = y0 < 0 ? 0 : y0 / RayPacket::ChunkHeight;
    const int lastRow = (y1 < Edge ? y1 : Edge - 1) / RayPacket::ChunkHeight;
    const std::uint32_t columns = (2u << lastColumn) - (1u << firstColumn);
    const std::uint32_t rows = 0x11111111u & (~0u << 4 * firstRow) & (~0u >> (28 - 4 * lastRow));
    return rows * columns;
  }

  /// Intersects all packets with a polygon. Returns whether any ray may have hit it.
  TETRALUX_INLINE bool HitPackets(const PlacedPolygon& polygon, int lane)
  {
    const float key = -RoundDown(-polygon.Polygon.HighKey);
    bool changed = false;
    const PacketRange packets = this->GetPackets(lane);
    for (unsigned y = packets.FirstY; y <= packets.LastY; ++y)
    {
      for (unsigned x = packets.FirstX; x <= packets.LastX; ++x)
      {
        const int p = static_cast<int>(y * RayBlock::Packets + x);
        if (key <= this->Block.Far[p])
        {
          continue;
        }
        if ((this->Block.Started >> p & 1) == 0)
        {
          this->StartPacket(p);
        }
        RayPacket& packet = this->Block.Rays[p];
        std::uint32_t chunks = 0;
        for (std::uint32_t rest =
               this->FindPixelChunks(lane, static_cast<int>(x), static_cast<int>(y));
             rest != 0; rest &= rest - 1)
        {
          chunks |= packet.ChunkFar[__builtin_ctz(rest)] < key ? rest & -rest : 0u;
        }
        if (HitPlaced<false>(this->Limits, this->Frame, polygon, chunks, packet, this->Counts))
        {
          this->Block.Far[p] = GetLeastFar(packet);
          changed = true;
        }
      }
    }
    return changed;
  }

  const RayFrame& Frame;
  const TraceLimits& Limits;
  RayBlock& Block;
  const Start& StartPacket;
  TraceCounts& Counts;
  RayBounds Bounds;
  TreeWalk Walk;
  PolygonLanes Lanes;
  float LeastFar; ///< of the block

  // The pixels of the block that are within the bounds of each polygon.
  std::int32_t FirstX[LaneCount], LastX[LaneCount], FirstY[LaneCount], LastY[LaneCount];
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
