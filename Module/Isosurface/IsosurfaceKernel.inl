// SPDX-License-Identifier: BSD-3-Clause

// Draws packets of pixels: finds the nearest surface, its lights and its colour, then the next one
// behind it, as long as the ray is not opaque (Wald et al. 2007, section 7: depth peeling by the
// same packet with a least distance for each ray).

#include "Isosurface/FrustumTraversal.h"
#include "Isosurface/HitPoints.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/ShadowRays.h"
#include "Lighting/LaneLights.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Hits whose keys differ by less than this, as a share of them, are one: a ray through an edge or
/// a corner hits all polygons there. Thousand times the rounding of a key.
constexpr double LayerDistance = 1e-12;

/// Fills the rays of a packet.
TETRALUX_INLINE void StartRays(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, IsosurfaceScratch& scratch)
{
  RayPacket& packet = scratch.Rays;
  const RayGrid& grid = *in.Grid;
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const int x = x0 + GetPacketColumn(i);
    const int y = y0 + GetPacketRow(i);
    packet.U[i] = x;
    packet.V[i] = y;
    packet.Hit[i] = -1;
    packet.Near[i] = InfiniteKey;
    double far = InfiniteKey;
    if (x < x1 && y < y1)
    {
      far = in.Frame.Parallel ? -InfiniteKey : 0;
      if (in.MaximumDistances)
      {
        double squared = 0;
        for (int a = 0; a < 3; ++a)
        {
          const double d =
            grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a];
          squared += d * d;
        }
        const double depth = in.MaximumDistances[static_cast<std::int64_t>(y) * grid.Width + x] /
          __builtin_sqrt(squared);
        far = in.Frame.Parallel ? -depth : depth > 0 ? 1 / depth : InfiniteKey;
      }
    }
    packet.Far[i] = scratch.StartFar[i] = far;
  }
}

/// Composites the hits of a layer below what is there.
TETRALUX_INLINE void CompositeChunk(
  const IsosurfaceInput& in, IsosurfaceScratch& scratch, int chunk, bool first)
{
  const RayPacket& rays = scratch.Rays;
  const int begin = chunk * LaneCount;
  unsigned bits = 0;
  for (int i = 0; i < LaneCount; ++i)
  {
    bits |= rays.Hit[begin + i] >= 0 ? 1u << i : 0u;
  }
  if (bits == 0)
  {
    return;
  }
  const Mask8 hits = MaskFromBits(bits);
  const Int8 surface = Select(hits, LoadInt8(scratch.Surfaces + begin), Int8(0));
  Float8 color[3], opacity;
  GatherRows(in.SurfaceColors, surface, color[0], color[1], color[2], opacity);
  if (in.Lighting)
  {
    const WorldRays world =
      MakeWorldRays(*in.Grid, LoadDouble8(rays.U + begin), LoadDouble8(rays.V + begin));
    const LaneLights lights(world, Double8(0.));
    LaneVector gradient = { { LoadFloat8(scratch.Gradients[0] + begin),
      LoadFloat8(scratch.Gradients[1] + begin), LoadFloat8(scratch.Gradients[2] + begin) } };
    gradient = LaneLights::ToWorld(*in.Lighting, gradient * LaneLights::GetScale(gradient));
    const LaneFactors factors =
      lights.Find(*in.Lighting, gradient, ToDouble(LoadFloat8(scratch.Distances + begin)),
        scratch.Visible ? scratch.Visible + begin : nullptr, RayPacket::MaximumRays);
    const LaneVector lit = factors.Apply({ { color[0], color[1], color[2] } });
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Min(Max(Float8(0.f), lit.C[c]), Float8(1.f));
    }
  }
  const Float8 before = LoadFloat8(scratch.Colors[3] + begin);
  const Float8 share = Keep(hits, (Float8(1.f) - before) * opacity);
  for (int c = 0; c < 3; ++c)
  {
    float* sum = scratch.Colors[c] + begin;
    Store(sum, LoadFloat8(sum) + share * color[c]);
  }
  Store(scratch.Colors[3] + begin, before + share);
  float* depth = scratch.Depths + begin;
  const Float8 known = LoadFloat8(depth);
  const Mask8 sets = hits & (Float8(0.f) < opacity) & (first ? hits : known < Float8(0.f));
  Store(depth, Select(sets, LoadFloat8(scratch.Distances + begin), known));
}

/// Sends the rays on that are not opaque yet. Returns whether there are any.
TETRALUX_INLINE bool StartNextLayer(const IsosurfaceInput& in, IsosurfaceScratch& scratch)
{
  RayPacket& packet = scratch.Rays;
  bool any = false;
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const bool goesOn = packet.Hit[i] >= 0 && scratch.Colors[3][i] < in.MaximumOpacity;
    const double key = packet.Far[i];
    packet.Near[i] = goesOn ? key - LayerDistance * (key < 0 ? -key : key) : packet.Near[i];
    packet.Far[i] = goesOn ? scratch.StartFar[i] : InfiniteKey;
    packet.Hit[i] = -1;
    any |= goesOn;
  }
  return any;
}

TETRALUX_INLINE void CountLostRays(
  const IsosurfaceInput& in, const IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const float opacity = scratch.Colors[3][i];
    if (scratch.Rays.Hit[i] >= 0 && opacity < in.MaximumOpacity)
    {
      ++counts.LostRays;
      const double lost = 1 - static_cast<double>(opacity);
      counts.LostOpacity = lost > counts.LostOpacity ? lost : counts.LostOpacity;
    }
  }
}

void DrawPacket(const IsosurfaceInput& in, int x0, int y0, int x1, int y1,
  IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  RayPacket& packet = scratch.Rays;
  StartRays(in, x0, y0, x1, y1, scratch);
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    for (auto& channel : scratch.Colors)
    {
      channel[i] = 0;
    }
    scratch.Depths[i] = -1;
  }
  const double largest = x1 > y1 ? x1 : y1;
  bool any = true;
  for (int layer = 0; any && layer < in.MaximumLayers; ++layer)
  {
    if (!FitBounds(packet, GetPacketMargin(largest)))
    {
      break;
    }
    PacketTraversal<false>(in.Tree, in.Frame, in.Limits, packet, counts.Primary).Trace();
    any = false;
    std::int64_t hits = 0;
    for (int i = 0; i < RayPacket::MaximumRays; ++i)
    {
      hits += packet.Hit[i] >= 0;
    }
    if (hits == 0)
    {
      break;
    }
    counts.Hits += hits;
    for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
    {
      FindHitPoints(in, scratch, chunk);
    }
    for (int l = 0; l < in.NumberOfShadows; ++l)
    {
      const ShadowSource& source = in.Shadows[l];
      FindShadows(
        in, source, scratch, counts, scratch.Visible + source.Light * RayPacket::MaximumRays);
    }
    for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
    {
      CompositeChunk(in, scratch, chunk, layer == 0);
    }
    if (layer + 1 == in.MaximumLayers)
    {
      CountLostRays(in, scratch, counts);
    }
    any = StartNextLayer(in, scratch);
  }
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const int x = x0 + GetPacketColumn(i);
    const int y = y0 + GetPacketRow(i);
    if (x < x1 && y < y1)
    {
      const std::int64_t pixel = static_cast<std::int64_t>(y) * in.Grid->Width + x;
      for (int c = 0; c < 4; ++c)
      {
        in.Colors[4 * pixel + c] = scratch.Colors[c][i];
      }
      in.Depths[pixel] = scratch.Depths[i];
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
