// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ShadowRays_h
#define tetralux_ShadowRays_h

// Which lights the hits of a packet see (Wald et al. 2007, section 7). Shadow rays start at the
// light, so that they share their origin as primary rays do, and end with their first hit.

#include "Isosurface/FrustumTraversal.h"
#include "Isosurface/IsosurfaceKernel.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// What is nearer than this to a hit does not block its light, in radii of the mesh: far above the
/// rounding of points, and below what pictures show.
constexpr double ShadowOffset = 1e-6;

/// The largest |u| or |v| of shadow rays from a positional light is 1; from a distant one it is
/// about the radius of the mesh's frame.
constexpr double ShadowLargest = 2;

/// Traces scratch.ShadowRays: rays that are blocked hit something.
TETRALUX_INLINE void TraceShadows(const IsosurfaceInput& in, const RayFrame& frame,
  IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  RayPacket& packet = scratch.ShadowRays;
  if (FitBounds(packet, GetPacketMargin(ShadowLargest)))
  {
    PacketTraversal<true>(in.Tree, frame, in.ShadowLimits, packet, counts.Shadow).Trace();
  }
}

/// A shadow ray that takes no part.
TETRALUX_INLINE void ClearShadowRay(RayPacket& packet, int ray)
{
  packet.Hit[ray] = -1;
  packet.Near[ray] = InfiniteKey;
  packet.Far[ray] = InfiniteKey;
  packet.U[ray] = packet.V[ray] = 0;
}

/// No frame: the ray takes no part.
constexpr std::int64_t NoSide = -1;

/// Which frame of a source each hit's shadow ray belongs to. None where the light does not shine on
/// the viewer's side of the surface: its shadow changes nothing there. Returns a bit for each frame
/// that has rays.
TETRALUX_INLINE unsigned FindSides(const IsosurfaceInput& in, const ShadowSource& source,
  const IsosurfaceScratch& scratch, std::int64_t (&sides)[RayPacket::MaximumRays])
{
  const RayPacket& rays = scratch.Rays;
  const RayFrame& frame = in.Frame;
  const double positional = source.Positional ? 1 : 0;
  const double perspective = frame.Parallel ? 0 : 1;
#pragma omp simd
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const double u = perspective * rays.U[i];
    const double v = perspective * rays.V[i];
    double way[3], size[3];
    double towards = 0, view = 0, steepness = 0;
    for (int a = 0; a < 3; ++a)
    {
      way[a] = source.Place[a] - positional * scratch.Points[a][i];
      size[a] = way[a] < 0 ? -way[a] : way[a];
      const double g = scratch.Gradients[a][i];
      towards += g * way[a];
      view += g * (frame.Axes[2][a] + u * frame.Axes[0][a] + v * frame.Axes[1][a]);
      steepness += g < 0 ? -g : g;
    }
    // What has no gradient faces the viewer.
    const bool faces = !(steepness > 0) | (view > 0 ? towards < 0 : towards > 0);
    const bool xIsLargest = (size[0] >= size[1]) & (size[0] >= size[2]);
    const bool yIsLargest = size[1] >= size[2];
    const double largest = xIsLargest ? way[0] : yIsLargest ? way[1] : way[2];
    // Rays run away from the light.
    const std::int64_t axis = xIsLargest ? 0 : yIsLargest ? 2 : 4;
    const std::int64_t side = axis + (largest < 0 ? 1 : 0);
    const bool takesPart = (rays.Hit[i] >= 0) & faces & (largest != 0);
    sides[i] = takesPart ? (source.Positional ? side : 0) : NoSide;
  }
  unsigned found = 0;
  for (const std::int64_t side : sides)
  {
    found |= side >= 0 ? 1u << side : 0u;
  }
  return found;
}

/// Fills the shadow rays of one frame.
TETRALUX_INLINE void FillShadowRays(const RayFrame& frame, std::int64_t side,
  const std::int64_t (&sides)[RayPacket::MaximumRays], IsosurfaceScratch& scratch)
{
  RayPacket& packet = scratch.ShadowRays;
  const bool parallel = frame.Parallel;
  const double(&m)[3][4] = frame.Rows;
#pragma omp simd
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const double x = scratch.Points[0][i], y = scratch.Points[1][i], z = scratch.Points[2][i];
    const double u = m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3];
    const double v = m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3];
    const double depth = m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3];
    const double nearer = depth - ShadowOffset;
    const double divisor = parallel ? 1 : depth;
    const double far = parallel ? -nearer : nearer > 0 ? 1 / nearer : InfiniteKey;
    const bool takesPart = sides[i] == side;
    packet.U[i] = takesPart ? u / divisor : 0;
    packet.V[i] = takesPart ? v / divisor : 0;
    packet.Far[i] = takesPart ? far : InfiniteKey;
    packet.Near[i] = InfiniteKey;
    packet.Hit[i] = -1;
  }
}

/// Takes from visible, 1 a ray at first, what does not come through from one source.
TETRALUX_NOINLINE void FindShadows(const IsosurfaceInput& in, const ShadowSource& source,
  IsosurfaceScratch& scratch, IsosurfaceCounts& counts, float* visible)
{
  std::int64_t sides[RayPacket::MaximumRays];
  const unsigned found = FindSides(in, source, scratch, sides);
  for (int i = 0; source.First && i < RayPacket::MaximumRays; ++i)
  {
    visible[i] = 1.f;
  }
  for (int side = 0; side < 6; ++side)
  {
    if ((found >> side & 1) == 0)
    {
      continue;
    }
    const RayFrame& frame = source.Frames[side];
    FillShadowRays(frame, side, sides, scratch);
    TraceShadows(in, frame, scratch, counts);
    const RayPacket& packet = scratch.ShadowRays;
    for (int i = 0; i < RayPacket::MaximumRays; ++i)
    {
      const float left = visible[i] - source.Share;
      visible[i] = packet.Hit[i] >= 0 ? (left > 0.f ? left : 0.f) : visible[i];
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
