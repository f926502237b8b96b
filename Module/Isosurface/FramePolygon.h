// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FramePolygon_h
#define tetralux_FramePolygon_h

// An isopolygon as the rays of a frame see it, and its intersection with them (Wald et al. 2007,
// sections 4.2 and 4.3). In a frame an edge and the rays' common origin span a plane, so the
// half-space of an edge is linear in u and v: a ray costs two products and two sums an edge.
//
// No ray passes between two polygons that share an edge. The corners on it are the same bits, the
// edge functions of both are each other's negative, bit by bit, and a ray counts as inside down to
// minus the largest rounding error of an edge function.

#include "Isosurface/Isopolygon.h"
#include "Isosurface/PacketRays.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

struct FramePolygon
{
  double U[4], V[4], One[4];       ///< edge functions; 0 or more inside
  double Key[3];                   ///< of the plane: factors of u, v and 1
  double LowKey, HighKey;          ///< of the corners
  double Tolerance;                ///< largest rounding error of an edge function
  double LowU, HighU, LowV, HighV; ///< bounds, rounded outward
};

enum class Coverage
{
  None,
  Some,
  All ///< of the packet's rays, whatever their limits
};

TETRALUX_INLINE double LeastOf(const double (&v)[4])
{
  const double a = v[0] < v[1] ? v[0] : v[1];
  const double b = v[2] < v[3] ? v[2] : v[3];
  return a < b ? a : b;
}

TETRALUX_INLINE double LargestOf(const double (&v)[4])
{
  const double a = v[0] > v[1] ? v[0] : v[1];
  const double b = v[2] > v[3] ? v[2] : v[3];
  return a > b ? a : b;
}

/// Which rays within the bounds of a packet a polygon covers, their limits left aside: none where
/// all are outside of one edge, all where they are inside of each.
TETRALUX_INLINE Coverage Cover(const FramePolygon& result, const RayBounds& packet)
{
  double most[4], least[4];
#pragma omp simd simdlen(4)
  for (int i = 0; i < 4; ++i)
  {
    const double u0 = result.U[i] * packet.LowU, u1 = result.U[i] * packet.HighU;
    const double v0 = result.V[i] * packet.LowV, v1 = result.V[i] * packet.HighV;
    most[i] = result.One[i] + (u0 > u1 ? u0 : u1) + (v0 > v1 ? v0 : v1);
    least[i] = result.One[i] + (u0 < u1 ? u0 : u1) + (v0 < v1 ? v0 : v1);
  }
  if (LeastOf(most) < -result.Tolerance)
  {
    return Coverage::None;
  }
  // A polygon that is smaller than the tolerance covers nothing, though its edges may round so.
  const bool covers = result.LowU <= packet.LowU && packet.HighU <= result.HighU &&
    result.LowV <= packet.LowV && packet.HighV <= result.HighV && LeastOf(least) >= 0;
  return covers ? Coverage::All : Coverage::Some;
}

/// The chunks of a packet that a polygon may hit, one bit each. margin: what single precision
/// rounds u and v by.
TETRALUX_INLINE std::uint32_t FindChunks(
  const RayPacket& packet, float margin, const FramePolygon& polygon)
{
  static_assert(RayPacket::MaximumChunks == 32, "one bit a chunk");
  const Float8 lowU = static_cast<float>(polygon.LowU) - margin;
  const Float8 highU = static_cast<float>(polygon.HighU) + margin;
  const Float8 lowV = static_cast<float>(polygon.LowV) - margin;
  const Float8 highV = static_cast<float>(polygon.HighV) + margin;
  const Float8 key = -RoundDown(-polygon.HighKey);
  std::uint32_t chunks = 0;
  for (int first = 0; first < RayPacket::MaximumChunks; first += LaneCount)
  {
    const Mask8 may = (LoadFloat8(packet.ChunkLowU + first) <= highU) &
      (lowU <= LoadFloat8(packet.ChunkHighU + first)) &
      (LoadFloat8(packet.ChunkLowV + first) <= highV) &
      (lowV <= LoadFloat8(packet.ChunkHighV + first)) & (LoadFloat8(packet.ChunkFar + first) < key);
    chunks |= static_cast<std::uint32_t>(Bits(may)) << first;
  }
  return chunks;
}

/// Intersects a chunk's rays with a polygon. AnyHit: a ray is done with its first hit. Covered: the
/// edges need no test.
template <bool AnyHit, bool Covered>
TETRALUX_INLINE void HitChunk(
  const FramePolygon& polygon, std::int64_t id, RayPacket& packet, int chunk)
{
  const int first = chunk * LaneCount;
  const Double8 u = LoadDouble8(packet.U + first);
  const Double8 v = LoadDouble8(packet.V + first);
  const Double8 far = LoadDouble8(packet.Far + first);
  const auto combine = [&](double a, double b, double c)
  { return Double8(a) * u + Double8(b) * v + Double8(c); };
  const Double8 key =
    Min(Max(combine(polygon.Key[0], polygon.Key[1], polygon.Key[2]), Double8(polygon.LowKey)),
      Double8(polygon.HighKey));
  Mask8 inside = (far < key) & (key < LoadDouble8(packet.Near + first));
  if (!Covered)
  {
    Double8 least = combine(polygon.U[0], polygon.V[0], polygon.One[0]);
    for (int i = 1; i < 4; ++i)
    {
      least = Min(combine(polygon.U[i], polygon.V[i], polygon.One[i]), least);
    }
    inside = inside & (Double8(-polygon.Tolerance) <= least);
    // All edges of a polygon that is smaller than the tolerance pass it.
    inside = inside & (Double8(polygon.LowU) <= u) & (u <= Double8(polygon.HighU));
    inside = inside & (Double8(polygon.LowV) <= v) & (v <= Double8(polygon.HighV));
  }
  if (!Any(inside))
  {
    return;
  }
  Store(packet.Far + first, Select(inside, AnyHit ? Double8(InfiniteKey) : key, far));
  StoreWhere(inside, id, packet.Hit + first);
  UpdateChunkFar(packet, chunk);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
