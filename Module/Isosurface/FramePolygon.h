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
  double U[4], V[4], One[4]; ///< edge functions; 0 or more inside
  double Key[3];             ///< of the plane: factors of u, v and 1
  double LowKey, HighKey;    ///< of the corners
  double Tolerance;          ///< largest rounding error of an edge function
  float LowU, HighU, LowV, HighV;
  double BoxLowU, BoxHighU, BoxLowV, BoxHighV; ///< the same, but for BoxRounding
};

enum class Coverage
{
  None,
  Some,
  All ///< of the packet's rays, whatever their limits
};

/// What an edge function is rounded by, in squares of the largest coordinate: four products of two
/// rounded coordinates each, and three sums, with a factor of two to spare.
constexpr double EdgeRounding = 16. / (1ll << 53);

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

/// What a division rounds u and v of a corner by, as a share of the largest |u| and |v|, with a
/// factor of four to spare.
constexpr double BoxRounding = 4. / (1ll << 53);

/// Polygons whose box is smaller than this, as a share of the largest |u| and |v|, have an area and
/// edge functions below EdgeRounding: its square root, and less. Which way they turn is not known.
constexpr double TinyBox = 1. / (1 << 26);

/// Whether there is no whole number from low to high.
TETRALUX_INLINE bool IsBetweenPixels(double low, double high)
{
  return __builtin_floor(high) < low;
}

/// Corners of a polygon in a RayFrame.
struct FrameCorners
{
  double X[4], Y[4], Depth[4];
  double W[4]; ///< what u and v are divided by: depths, or 1 for parallel rays
  bool Tiny;   ///< by TinyBox
};

/// Finds where a polygon is for the rays within the bounds of a packet: keys and bounds of corners.
/// Returns whether any ray may hit it. largest: largest |u| and |v| of the packet, at least 1.
TETRALUX_INLINE bool PlaceCorners(const RayFrame& frame, const RayPacket& packet, double largest,
  float margin, const Isopolygon& polygon, FrameCorners& corners, FramePolygon& result)
{
  double(&x)[4] = corners.X;
  double(&y)[4] = corners.Y;
  double(&d)[4] = corners.Depth;
  double(&w)[4] = corners.W;
#pragma omp simd simdlen(4)
  for (int i = 0; i < 4; ++i)
  {
    const double px = polygon.X[i], py = polygon.Y[i], pz = polygon.Z[i];
    const double(&m)[3][4] = frame.Rows;
    x[i] = m[0][0] * px + m[0][1] * py + m[0][2] * pz + m[0][3];
    y[i] = m[1][0] * px + m[1][1] * py + m[1][2] * pz + m[1][3];
    d[i] = m[2][0] * px + m[2][1] * py + m[2][2] * pz + m[2][3];
  }
  const double nearest = LeastOf(d);
  const double farthest = LargestOf(d);
  bool allBefore = true;
  corners.Tiny = false;
  if (frame.Parallel)
  {
    for (double& one : w)
    {
      one = 1;
    }
    result.LowKey = -farthest;
    result.HighKey = -nearest;
  }
  else
  {
    if (!(farthest > 0))
    {
      return false;
    }
    for (int i = 0; i < 4; ++i)
    {
      w[i] = d[i];
    }
    allBefore = nearest > 0;
    result.LowKey = 1 / farthest;
    result.HighKey = allBefore ? 1 / nearest : InfiniteKey;
  }

  if (allBefore)
  {
    double u[4], v[4];
#pragma omp simd simdlen(4)
    for (int i = 0; i < 4; ++i)
    {
      u[i] = x[i] / w[i];
      v[i] = y[i] / w[i];
    }
    const double lowU = LeastOf(u), highU = LargestOf(u);
    const double lowV = LeastOf(v), highV = LargestOf(v);
    if (lowU > packet.HighU + margin || highU < packet.LowU - margin ||
      lowV > packet.HighV + margin || highV < packet.LowV - margin)
    {
      return false;
    }
    result.LowU = static_cast<float>(lowU) - margin;
    result.HighU = static_cast<float>(highU) + margin;
    result.LowV = static_cast<float>(lowV) - margin;
    result.HighV = static_cast<float>(highV) + margin;
    corners.Tiny = highU - lowU < TinyBox * largest && highV - lowV < TinyBox * largest;
    result.BoxLowU = lowU - BoxRounding * largest;
    result.BoxHighU = highU + BoxRounding * largest;
    result.BoxLowV = lowV - BoxRounding * largest;
    result.BoxHighV = highV + BoxRounding * largest;
    if (frame.Pixels &&
      (IsBetweenPixels(result.BoxLowU, result.BoxHighU) ||
        IsBetweenPixels(result.BoxLowV, result.BoxHighV)))
    {
      return false;
    }
  }
  else
  {
    result.LowU = result.LowV = -std::numeric_limits<float>::infinity();
    result.HighU = result.HighV = std::numeric_limits<float>::infinity();
    result.BoxLowU = result.BoxLowV = -InfiniteKey;
    result.BoxHighU = result.BoxHighV = InfiniteKey;
  }

  return true;
}

/// Finds the edges and the plane of a polygon whose corners are placed. Returns whether any ray may
/// hit it.
TETRALUX_INLINE bool PlaceEdges(
  const RayFrame& frame, double largest, const FrameCorners& corners, FramePolygon& result)
{
  const double(&x)[4] = corners.X;
  const double(&y)[4] = corners.Y;
  const double(&d)[4] = corners.Depth;
  const double(&w)[4] = corners.W;
  // Edge i runs from corner i to the next one.
  const double nextX[4] = { x[1], x[2], x[3], x[0] };
  const double nextY[4] = { y[1], y[2], y[3], y[0] };
  const double nextW[4] = { w[1], w[2], w[3], w[0] };
  double sizes[4];
#pragma omp simd simdlen(4)
  for (int i = 0; i < 4; ++i)
  {
    result.U[i] = y[i] * nextW[i] - nextY[i] * w[i];
    result.V[i] = w[i] * nextX[i] - nextW[i] * x[i];
    result.One[i] = x[i] * nextY[i] - nextX[i] * y[i];
    const double ax = x[i] < 0 ? -x[i] : x[i];
    const double ay = y[i] < 0 ? -y[i] : y[i];
    const double aw = (w[i] < 0 ? -w[i] : w[i]) * largest;
    const double axy = ax > ay ? ax : ay;
    sizes[i] = axy > aw ? axy : aw;
  }
  const double size = LargestOf(sizes);
  result.Tolerance = EdgeRounding * size * size;
  double normal[3] = { result.U[0], result.V[0], result.One[0] };
  for (int i = 1; i < 4; ++i)
  {
    normal[0] += result.U[i];
    normal[1] += result.V[i];
    normal[2] += result.One[i];
  }
  // Six times the volume between the polygon and the origin; of parallel rays twice its area.
  double volume = 0;
  for (int i = 0; i < 4; ++i)
  {
    volume += 0.25 * (normal[0] * x[i] + normal[1] * y[i] + normal[2] * w[i]);
  }
  // Of parallel rays relative to the first corner, where nothing cancels.
  double across[3] = { 0, 0, 0 };
  if (frame.Parallel)
  {
    for (int i = 1; i < 3; ++i)
    {
      const double ux = x[i] - x[0], uy = y[i] - y[0], ud = d[i] - d[0];
      const double vx = x[i + 1] - x[0], vy = y[i + 1] - y[0], vd = d[i + 1] - d[0];
      across[0] += uy * vd - ud * vy;
      across[1] += ud * vx - ux * vd;
      across[2] += ux * vy - uy * vx;
    }
  }
  if (volume == 0 || (frame.Parallel && across[2] == 0))
  {
    if (!corners.Tiny)
    {
      return false; // seen from its edge
    }
    // It closes the gap between its neighbours.
    result.Key[0] = result.Key[1] = 0;
    result.Key[2] = result.LowKey;
  }
  else if (frame.Parallel)
  {
    result.Key[0] = across[0] / across[2];
    result.Key[1] = across[1] / across[2];
    result.Key[2] = -d[0] - (result.Key[0] * x[0] + result.Key[1] * y[0]);
  }
  else
  {
    for (int a = 0; a < 3; ++a)
    {
      result.Key[a] = normal[a] / volume;
    }
  }
  if (volume < 0)
  {
    for (int i = 0; i < 4; ++i)
    {
      result.U[i] = -result.U[i];
      result.V[i] = -result.V[i];
      result.One[i] = -result.One[i];
    }
  }

  return true;
}

/// Both.
TETRALUX_INLINE bool Place(const RayFrame& frame, const RayPacket& packet, double largest,
  float margin, const Isopolygon& polygon, FramePolygon& result)
{
  FrameCorners corners;
  return PlaceCorners(frame, packet, largest, margin, polygon, corners, result) &&
    PlaceEdges(frame, largest, corners, result);
}

/// Which rays within the bounds of a packet a polygon covers, their limits left aside: none where
/// all are outside of one edge, all where they are inside of each.
TETRALUX_INLINE Coverage Cover(const FramePolygon& result, const RayPacket& packet)
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
  const bool covers = result.BoxLowU <= packet.LowU && packet.HighU <= result.BoxHighU &&
    result.BoxLowV <= packet.LowV && packet.HighV <= result.BoxHighV && LeastOf(least) >= 0;
  return covers ? Coverage::All : Coverage::Some;
}

/// The chunks of a packet that a polygon may hit, one bit each.
TETRALUX_INLINE std::uint32_t FindChunks(const RayPacket& packet, const FramePolygon& polygon)
{
  static_assert(RayPacket::MaximumChunks == 32, "one bit a chunk");
  const Float8 lowU = polygon.LowU, highU = polygon.HighU;
  const Float8 lowV = polygon.LowV, highV = polygon.HighV;
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
  const double* us = packet.U + first;
  const double* vs = packet.V + first;
  const double* near = packet.Near + first;
  double* far = packet.Far + first;
  std::int64_t* hit = packet.Hit + first;
  const double outside = -polygon.Tolerance;
#pragma omp simd
  for (int i = 0; i < LaneCount; ++i)
  {
    const double u = us[i];
    const double v = vs[i];
    double key = polygon.Key[0] * u + polygon.Key[1] * v + polygon.Key[2];
    key = key < polygon.LowKey ? polygon.LowKey : key;
    key = key > polygon.HighKey ? polygon.HighKey : key;
    bool inside = (far[i] < key) & (key < near[i]);
    if (!Covered)
    {
      const double e0 = polygon.U[0] * u + polygon.V[0] * v + polygon.One[0];
      const double e1 = polygon.U[1] * u + polygon.V[1] * v + polygon.One[1];
      const double e2 = polygon.U[2] * u + polygon.V[2] * v + polygon.One[2];
      const double e3 = polygon.U[3] * u + polygon.V[3] * v + polygon.One[3];
      const double e01 = e0 < e1 ? e0 : e1;
      const double e23 = e2 < e3 ? e2 : e3;
      inside &= (e01 < e23 ? e01 : e23) >= outside;
      // All edges of a polygon that is smaller than the tolerance pass it.
      inside &= (polygon.BoxLowU <= u) & (u <= polygon.BoxHighU);
      inside &= (polygon.BoxLowV <= v) & (v <= polygon.BoxHighV);
    }
    far[i] = inside ? (AnyHit ? InfiniteKey : key) : far[i];
    hit[i] = inside ? id : hit[i];
  }
  UpdateChunkFar(packet, chunk);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
