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

/// Whether a light shines on a hit from the viewer's side: else its shadow changes nothing.
TETRALUX_INLINE bool FacesLight(
  const IsosurfaceInput& in, const IsosurfaceScratch& scratch, int ray, const double (&toLight)[3])
{
  const RayFrame& frame = in.Frame;
  double towards = 0;
  double view = 0;
  bool any = false;
  for (int a = 0; a < 3; ++a)
  {
    const double g = scratch.Gradients[a][ray];
    any |= g != 0;
    towards += g * toLight[a];
    view += g *
      (frame.Axes[2][a] +
        (frame.Parallel
            ? 0
            : scratch.Rays.U[ray] * frame.Axes[0][a] + scratch.Rays.V[ray] * frame.Axes[1][a]));
  }
  return !any || (view > 0 ? towards < 0 : towards > 0);
}

/// Takes from visible, 1 a ray at first, what does not come through from one source. chunks: those
/// with hits, one bit each.
TETRALUX_NOINLINE void FindShadows(const IsosurfaceInput& in, const ShadowSource& source,
  std::uint32_t chunks, IsosurfaceScratch& scratch, IsosurfaceCounts& counts, float* visible)
{
  const RayPacket& rays = scratch.Rays;
  RayPacket& packet = scratch.ShadowRays;
  std::int8_t side[RayPacket::MaximumRays]; // which frame a ray belongs to, or -1
  unsigned sides = 0;
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    visible[i] = source.First ? 1.f : visible[i];
    side[i] = -1;
    if ((chunks >> (i / LaneCount) & 1) == 0 || rays.Hit[i] < 0)
    {
      continue;
    }
    double way[3];
    for (int a = 0; a < 3; ++a)
    {
      way[a] = source.Place[a] - (source.Positional ? scratch.Points[a][i] : 0);
    }
    if (!FacesLight(in, scratch, i, way))
    {
      continue;
    }
    int axis = 0;
    if (source.Positional)
    {
      const double ax = way[0] < 0 ? -way[0] : way[0];
      const double ay = way[1] < 0 ? -way[1] : way[1];
      const double az = way[2] < 0 ? -way[2] : way[2];
      axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
      if (!(way[axis] < 0) && !(way[axis] > 0))
      {
        continue; // at the light
      }
      axis = 2 * axis + (way[axis] < 0); // rays run away from the light
    }
    side[i] = static_cast<std::int8_t>(axis);
    sides |= 1u << axis;
  }
  for (int s = 0; s < 6; ++s)
  {
    if ((sides >> s & 1) == 0)
    {
      continue;
    }
    const RayFrame& frame = source.Frames[s];
    for (int i = 0; i < RayPacket::MaximumRays; ++i)
    {
      ClearShadowRay(packet, i);
      if (side[i] != s)
      {
        continue;
      }
      const double point[3] = { scratch.Points[0][i], scratch.Points[1][i], scratch.Points[2][i] };
      double placed[3];
      Transform(frame, point, placed);
      const double nearer = placed[2] - ShadowOffset;
      packet.U[i] = frame.Parallel ? placed[0] : placed[0] / placed[2];
      packet.V[i] = frame.Parallel ? placed[1] : placed[1] / placed[2];
      packet.Far[i] = frame.Parallel ? -nearer : nearer > 0 ? 1 / nearer : InfiniteKey;
    }
    TraceShadows(in, frame, scratch, counts);
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
