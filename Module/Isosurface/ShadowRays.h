// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ShadowRays_h
#define tetralux_ShadowRays_h

// Which lights the hits of a packet see (Wald et al. 2007, section 7). Shadow rays start at the
// light, so that they share their origin as primary rays do, and end with their first hit.

#include "Isosurface/FrustumTraversal.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/PlacedTraversal.h"

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

/// Traces scratch.ShadowRays: rays that are blocked hit something. placed: of the frame; nullptr:
/// there is none.
TETRALUX_INLINE void TraceShadows(const IsosurfaceInput& in, const RayFrame& frame,
  const PlacedTree* placed, IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  RayPacket& packet = scratch.ShadowRays;
  if (!FitBounds(packet, GetPacketMargin(ShadowLargest)))
  {
    return;
  }
  if (placed)
  {
    TracePlaced<true>(in.Tree, frame, in.ShadowLimits, *placed, packet, counts.Shadow);
  }
  else
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

/// The hits whose shadow rays belong to each frame of a source, one bit a ray.
struct ShadowSides
{
  std::uint8_t Rays[6][RayPacket::MaximumChunks];
};

/// Finds them. A hit belongs to none where the light does not shine on the viewer's side of the
/// surface: its shadow changes nothing there. Returns a bit for each frame that has rays.
TETRALUX_INLINE unsigned FindSides(const IsosurfaceInput& in, const ShadowSource& source,
  const IsosurfaceScratch& scratch, ShadowSides& sides)
{
  const RayFrame& frame = in.Frame;
  const Double8 none = 0.;
  const Double8 positional = source.Positional ? 1. : 0.;
  const Double8 perspective = frame.Parallel ? 0. : 1.;
  unsigned found = 0;
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    const int first = chunk * LaneCount;
    unsigned rays[6] = { 0, 0, 0, 0, 0, 0 };
    if (scratch.HitRays[chunk] != 0)
    {
      const Double8 u = perspective * LoadDouble8(scratch.Rays->U + first);
      const Double8 v = perspective * LoadDouble8(scratch.Rays->V + first);
      Double8 way[3], size[3];
      Double8 towards = 0., view = 0., steepness = 0.;
      for (int a = 0; a < 3; ++a)
      {
        way[a] = Double8(source.Place[a]) - positional * LoadDouble8(scratch.Points[a] + first);
        size[a] = Abs(way[a]);
        const Double8 g = ToDouble(LoadFloat8(scratch.Gradients[a] + first));
        towards = towards + g * way[a];
        view = view +
          g *
            (Double8(frame.Axes[2][a]) + u * Double8(frame.Axes[0][a]) +
              v * Double8(frame.Axes[1][a]));
        steepness = steepness + Abs(g);
      }
      // What has no gradient faces the viewer.
      const unsigned behind = Bits(none < view);
      const unsigned faces = (~Bits(none < steepness)) | (behind & Bits(towards < none)) |
        (~behind & Bits(none < towards));
      const unsigned takesPart = scratch.HitRays[chunk] & faces;
      const unsigned x = Bits(size[1] <= size[0]) & Bits(size[2] <= size[0]);
      const unsigned y = ~x & Bits(size[2] <= size[1]);
      const unsigned largest[3] = { x, y, ~(x | y) };
      for (int a = 0; a < 3; ++a)
      {
        // Rays run away from the light.
        const unsigned own = takesPart & largest[a] & Bits(none < size[a]);
        const unsigned negative = Bits(way[a] < none);
        rays[source.Positional ? 2 * a : 0] |= own & (source.Positional ? ~negative : AllLanes);
        rays[source.Positional ? 2 * a + 1 : 0] |= own & (source.Positional ? negative : 0u);
      }
    }
    for (int side = 0; side < 6; ++side)
    {
      sides.Rays[side][chunk] = static_cast<std::uint8_t>(rays[side]);
      found |= rays[side] != 0 ? 1u << side : 0u;
    }
  }
  return found;
}

/// Fills the shadow rays of one frame.
TETRALUX_INLINE void FillShadowRays(const RayFrame& frame,
  const std::uint8_t (&rays)[RayPacket::MaximumChunks], IsosurfaceScratch& scratch)
{
  RayPacket& packet = scratch.ShadowRays;
  const Double8 never = InfiniteKey;
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    const int first = chunk * LaneCount;
    Double8 u = 0., v = 0., far = never;
    if (rays[chunk] != 0)
    {
      Double8 placed[3];
      for (int r = 0; r < 3; ++r)
      {
        const double(&row)[4] = frame.Rows[r];
        placed[r] = Double8(row[0]) * LoadDouble8(scratch.Points[0] + first) +
          Double8(row[1]) * LoadDouble8(scratch.Points[1] + first) +
          Double8(row[2]) * LoadDouble8(scratch.Points[2] + first) + Double8(row[3]);
      }
      const Double8 nearer = placed[2] - Double8(ShadowOffset);
      const Mask8 takesPart = MaskFromBits(rays[chunk]);
      if (frame.Parallel)
      {
        u = placed[0];
        v = placed[1];
        far = Double8(0.) - nearer;
      }
      else
      {
        u = placed[0] / placed[2];
        v = placed[1] / placed[2];
        far = Select(Double8(0.) < nearer, Double8(1.) / nearer, never);
      }
      u = Keep(takesPart, u);
      v = Keep(takesPart, v);
      far = Select(takesPart, far, never);
    }
    Store(packet.U + first, u);
    Store(packet.V + first, v);
    Store(packet.Far + first, far);
    Store(packet.Near + first, never);
    for (int i = first; i < first + LaneCount; ++i)
    {
      packet.Hit[i] = -1;
    }
  }
}

/// Takes from visible, 1 a ray at first, what does not come through from one source.
TETRALUX_NOINLINE void FindShadows(const IsosurfaceInput& in, const ShadowSource& source,
  IsosurfaceScratch& scratch, IsosurfaceCounts& counts, float* visible)
{
  ShadowSides sides;
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
    FillShadowRays(frame, sides.Rays[side], scratch);
    TraceShadows(in, frame, source.Placed[side], scratch, counts);
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
