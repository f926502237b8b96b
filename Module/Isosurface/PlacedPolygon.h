// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PlacedPolygon_h
#define tetralux_PlacedPolygon_h

#include "Isosurface/PolygonLimits.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A polygon that is prepared for the rays of a packet, or of several.
struct PlacedPolygon
{
  FramePolygon Polygon;
  std::int64_t Id;
  LimitedPart Part;
};

/// Chunks of a packet up to which their rays are tested at once: it takes as long to ask whether a
/// polygon covers the packet.
constexpr int FewChunks = 2;

/// Intersects the rays of a packet with a polygon. chunks: those it may hit, one bit each. Returns
/// whether any may have hit it.
template <bool AnyHit>
TETRALUX_INLINE bool HitPlaced(const TraceLimits& limits, const RayFrame& frame,
  const PlacedPolygon& placed, std::uint32_t chunks, RayPacket& packet, TraceCounts& counts)
{
  ++counts.Polygons;
  const Coverage coverage = chunks == 0       ? Coverage::None
    : __builtin_popcount(chunks) <= FewChunks ? Coverage::Some
                                              : Cover(placed.Polygon, packet);
  if (coverage == Coverage::None || placed.Part == LimitedPart::None)
  {
    ++counts.PolygonMisses;
    return false;
  }
  counts.PolygonCovers += coverage == Coverage::All;
  for (; chunks != 0; chunks &= chunks - 1)
  {
    const int chunk = __builtin_ctz(chunks);
    counts.RayPolygonTests += LaneCount;
    if (placed.Part == LimitedPart::Some)
    {
      HitChunkWithin<AnyHit>(limits, frame, placed.Polygon, placed.Id, packet, chunk);
    }
    else if (coverage == Coverage::All)
    {
      HitChunk<AnyHit, true>(placed.Polygon, placed.Id, packet, chunk);
    }
    else
    {
      HitChunk<AnyHit, false>(placed.Polygon, placed.Id, packet, chunk);
    }
  }
  return true;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
