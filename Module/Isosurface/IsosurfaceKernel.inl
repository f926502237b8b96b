// SPDX-License-Identifier: BSD-3-Clause

// Draws blocks of pixels: finds the nearest surface, its lights and its colour, then the next one
// behind it, as long as the ray is not opaque (Wald et al. 2007, section 7: depth peeling by the
// same packet with a least distance for each ray).

#include "Isosurface/BlockTraversal.h"
#include "Isosurface/HitPoints.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/OcclusionRays.h"
#include "Isosurface/PixelStore.h"
#include "Isosurface/PlacedTraversal.h"
#include "Isosurface/ShadowRays.h"
#include "Lighting/LaneLights.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Hits whose keys differ by less than this, as a share of them, are one: a ray through an edge or
/// a corner hits all polygons there. Thousand times the rounding of a key. Keys of parallel rays
/// are rounded as the mesh's radius is, too: they may be 0.
constexpr double LayerDistance = 1e-12;

/// The key at which opaque geometry ends a pixel's ray.
TETRALUX_INLINE double FindEnd(const IsosurfaceInput& in, int x, int y)
{
  if (!in.MaximumDistances)
  {
    return in.Frame.Parallel ? -InfiniteKey : 0;
  }
  const RayGrid& grid = *in.Grid;
  double squared = 0;
  for (int a = 0; a < 3; ++a)
  {
    const double d = grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a];
    squared += d * d;
  }
  const double distance = in.MaximumDistances[static_cast<std::int64_t>(y) * grid.Width + x];
  const double depth = distance / __builtin_sqrt(squared);
  return in.Frame.Parallel ? -depth : depth > 0 ? 1 / depth : InfiniteKey;
}

/// Fills the rays of a packet of the block.
TETRALUX_NOINLINE void StartPacket(const IsosurfaceInput& in, RayBlock& block, int p)
{
  RayPacket& packet = block.Rays[p];
  double* startFar = block.Pixels[p].StartFar;
  const int x0 = block.X0 + p % RayBlock::Packets * RayPacket::Edge;
  const int y0 = block.Y0 + p / RayBlock::Packets * RayPacket::Edge;
  const double end = in.Frame.Parallel ? -InfiniteKey : 0;
  const bool whole = x0 + RayPacket::Edge <= block.X1 && y0 + RayPacket::Edge <= block.Y1;
  packet.LowU = x0;
  packet.HighU = x0 + RayPacket::Edge - 1;
  packet.LowV = y0;
  packet.HighV = y0 + RayPacket::Edge - 1;
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    const int x = x0 + GetChunkColumn(chunk);
    const int y = y0 + GetChunkRow(chunk);
    const int first = chunk * LaneCount;
    for (int i = 0; i < LaneCount; ++i)
    {
      packet.U[first + i] = x + static_cast<double>(i % RayPacket::ChunkWidth);
      packet.V[first + i] = y + static_cast<double>(i / RayPacket::ChunkWidth);
      packet.Hit[first + i] = -1;
      packet.Near[first + i] = InfiniteKey;
      packet.Far[first + i] = end;
      startFar[first + i] = end;
    }
    packet.ChunkFar[chunk] = in.Frame.Parallel ? -std::numeric_limits<float>::infinity() : 0;
  }
  block.Started |= 1u << p;
  if (!whole || in.MaximumDistances)
  {
    for (int ray = 0; ray < RayPacket::MaximumRays; ++ray)
    {
      const int x = static_cast<int>(packet.U[ray]);
      const int y = static_cast<int>(packet.V[ray]);
      packet.Far[ray] = x < block.X1 && y < block.Y1 ? FindEnd(in, x, y) : InfiniteKey;
      startFar[ray] = packet.Far[ray];
    }
    UpdateChunksFar(packet);
  }
  block.Far[p] = GetLeastFar(packet);
}

TETRALUX_INLINE void ClearPixels(PacketPixels& pixels)
{
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    for (auto& channel : pixels.Colors)
    {
      channel[i] = 0;
    }
    pixels.Depths[i] = -1;
    pixels.WindowDepths[i] = 1;
  }
}

/// What the depth buffer holds of hits.
TETRALUX_INLINE Float8 FindWindowDepth(
  const IsosurfaceInput& in, const RayPacket& rays, int begin, Double8 key)
{
  const Double8 u = LoadDouble8(rays.U + begin);
  const Double8 v = LoadDouble8(rays.V + begin);
  const auto combine = [&](const double(&f)[4])
  { return Fma(Double8(f[0]), u, Fma(Double8(f[1]), v, Fma(Double8(f[2]), key, Double8(f[3])))); };
  const Double8 half = 0.5;
  return ToFloat(half + half * combine(in.DepthFactors) / combine(in.DivisorFactors));
}

/// Composites the hits of a layer below what is there. Returns their number.
TETRALUX_INLINE int CompositeChunk(const IsosurfaceInput& in, IsosurfaceScratch& scratch, int chunk)
{
  const RayPacket& rays = *scratch.Rays;
  const int begin = chunk * LaneCount;
  const unsigned bits = scratch.HitRays[chunk];
  const Mask8 hits = MaskFromBits(bits);
  const Int8 surface = Select(hits, LoadInt8(scratch.Surfaces + begin), Int8(0));
  Double8 length;
  const WorldRays world =
    MakeWorldRays(*in.Grid, LoadDouble8(rays.U + begin), LoadDouble8(rays.V + begin), &length);
  const Double8 key = LoadDouble8(rays.Far + begin);
  const Double8 distance = length * (in.Frame.Parallel ? Double8(0.) - key : Double8(1.) / key);
  Float8 color[3], opacity;
  if (in.ColorScalars)
  {
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Keep(hits, LoadFloat8(scratch.HitColors[c] + begin));
    }
    opacity = Keep(hits, LoadFloat8(scratch.HitColors[3] + begin));
  }
  else
  {
    GatherRows(in.SurfaceColors, surface, color[0], color[1], color[2], opacity);
  }
  if (in.Lighting)
  {
    const LaneLights lights(world, Double8(0.));
    LaneVector gradient = { { LoadFloat8(scratch.Gradients[0] + begin),
      LoadFloat8(scratch.Gradients[1] + begin), LoadFloat8(scratch.Gradients[2] + begin) } };
    gradient = LaneLights::ToWorld(*in.Lighting, gradient * LaneLights::GetScale(gradient));
    LaneFactors factors = lights.Find(*in.Lighting, gradient, distance,
      scratch.Visible ? scratch.Visible + begin : nullptr, RayPacket::MaximumRays);
    if (in.Occlusion)
    {
      factors.Scale = factors.Scale * LoadFloat8(scratch.Ambient + begin);
    }
    const LaneVector lit = factors.Apply({ { color[0], color[1], color[2] } });
    for (int c = 0; c < 3; ++c)
    {
      color[c] = Min(Max(Float8(0.f), lit.C[c]), Float8(1.f));
    }
  }
  const Float8 before = LoadFloat8(scratch.Pixels->Colors[3] + begin);
  const Float8 share = Keep(hits, (Float8(1.f) - before) * opacity);
  for (int c = 0; c < 3; ++c)
  {
    float* sum = scratch.Pixels->Colors[c] + begin;
    Store(sum, LoadFloat8(sum) + share * color[c]);
  }
  Store(scratch.Pixels->Colors[3] + begin, before + share);
  float* depth = scratch.Pixels->Depths + begin;
  const Float8 known = LoadFloat8(depth);
  // Depths of parallel rays may be negative: opacity tells whether there was a surface before.
  const Mask8 sets = hits & (Float8(0.f) < opacity) & (before <= Float8(0.f));
  Store(depth, Select(sets, ToFloat(distance), known));
  if (in.WindowDepths)
  {
    float* window = scratch.Pixels->WindowDepths + begin;
    const Mask8 opaque = hits & (Float8(1.f) <= opacity);
    Store(window, Select(opaque, FindWindowDepth(in, rays, begin, key), LoadFloat8(window)));
  }
  return __builtin_popcount(bits);
}

/// Sends the rays on that are not opaque yet. Returns whether there are any.
TETRALUX_INLINE bool StartNextLayer(const IsosurfaceInput& in, IsosurfaceScratch& scratch)
{
  RayPacket& packet = *scratch.Rays;
  const double(&row)[4] = in.Frame.Rows[2];
  const double radius =
    in.Frame.Parallel ? __builtin_sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]) : 0;
  bool any = false;
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const bool goesOn = packet.Hit[i] >= 0 && scratch.Pixels->Colors[3][i] < in.MaximumOpacity;
    const double key = packet.Far[i];
    packet.Near[i] =
      goesOn ? key - LayerDistance * ((key < 0 ? -key : key) + radius) : packet.Near[i];
    packet.Far[i] = goesOn ? scratch.Pixels->StartFar[i] : InfiniteKey;
    packet.Hit[i] = -1;
    any |= goesOn;
  }
  UpdateChunksFar(packet);
  return any;
}

TETRALUX_INLINE void CountLostRays(
  const IsosurfaceInput& in, const IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    const float opacity = scratch.Pixels->Colors[3][i];
    if (scratch.Rays->Hit[i] >= 0 && opacity < in.MaximumOpacity)
    {
      ++counts.LostRays;
      const double lost = 1 - static_cast<double>(opacity);
      counts.LostOpacity = lost > counts.LostOpacity ? lost : counts.LostOpacity;
    }
  }
}

/// Finds the rays that have hits. Returns their chunks, one bit each.
TETRALUX_INLINE std::uint32_t FindHitRays(IsosurfaceScratch& scratch)
{
  std::uint32_t chunks = 0;
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    unsigned rays = 0;
    for (int i = 0; i < LaneCount; ++i)
    {
      rays |= scratch.Rays->Hit[chunk * LaneCount + i] >= 0 ? 1u << i : 0u;
    }
    scratch.HitRays[chunk] = static_cast<std::uint8_t>(rays);
    chunks |= (rays != 0 ? 1u : 0u) << chunk;
  }
  return chunks;
}

/// Composites what a packet of the block hit in a layer. Returns whether its rays go on.
TETRALUX_NOINLINE bool DrawHits(
  const IsosurfaceInput& in, int p, int layer, IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  RayBlock& block = scratch.Block;
  scratch.Rays = block.Rays + p;
  scratch.Pixels = block.Pixels + p;
  const std::uint32_t chunks = FindHitRays(scratch);
  if (chunks == 0)
  {
    return false;
  }
  if ((block.Drawn >> p & 1) == 0)
  {
    ClearPixels(*scratch.Pixels);
    block.Drawn |= 1u << p;
  }
  for (std::uint32_t rest = chunks; rest != 0; rest &= rest - 1)
  {
    FindHitPoints(in, scratch, __builtin_ctz(rest));
  }
  for (int l = 0; l < in.NumberOfShadows; ++l)
  {
    const ShadowSource& source = in.Shadows[l];
    FindShadows(
      in, source, scratch, counts, scratch.Visible + source.Light * RayPacket::MaximumRays);
  }
  if (in.Occlusion)
  {
    FindOcclusion(in, chunks, scratch, counts);
  }
  for (std::uint32_t rest = chunks; rest != 0; rest &= rest - 1)
  {
    counts.Hits += CompositeChunk(in, scratch, __builtin_ctz(rest));
  }
  if (layer + 1 == in.MaximumLayers)
  {
    CountLostRays(in, scratch, counts);
    return false;
  }
  return StartNextLayer(in, scratch);
}

/// Finds and composites the surfaces of a block, one layer after the other.
void DrawLayers(const IsosurfaceInput& in, IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  RayBlock& block = scratch.Block;
  const auto start = [&](int p) { StartPacket(in, block, p); };
  bool goesOn = true;
  for (int layer = 0; goesOn && layer < in.MaximumLayers; ++layer)
  {
    BlockTraversal<decltype(start)>(in.Tree, in.Frame, in.Limits, block, start, counts.Primary)
      .Trace();
    goesOn = false;
    for (int p = 0; p < RayBlock::MaximumPackets; ++p)
    {
      const bool takesPart =
        (block.Started >> p & 1) != 0 && block.Far[p] < std::numeric_limits<float>::infinity();
      const bool next = takesPart && DrawHits(in, p, layer, scratch, counts);
      block.Far[p] = next ? GetLeastFar(block.Rays[p]) : std::numeric_limits<float>::infinity();
      goesOn |= next;
    }
  }
}

void DrawBlock(const IsosurfaceInput& in, int x0, int y0, int x1, int y1,
  IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  RayBlock& block = scratch.Block;
  block.X0 = x0;
  block.Y0 = y0;
  block.X1 = x1;
  block.Y1 = y1;
  block.Started = block.Drawn = 0;
  for (float& far : block.Far)
  {
    far = -std::numeric_limits<float>::infinity();
  }
  if (in.Tree.Nodes)
  {
    DrawLayers(in, scratch, counts);
  }
  for (int p = 0; p < RayBlock::MaximumPackets; ++p)
  {
    const int x = x0 + p % RayBlock::Packets * RayPacket::Edge;
    const int y = y0 + p / RayBlock::Packets * RayPacket::Edge;
    const int endX = x + RayPacket::Edge < x1 ? x + RayPacket::Edge : x1;
    const int endY = y + RayPacket::Edge < y1 ? y + RayPacket::Edge : y1;
    if ((block.Drawn >> p & 1) != 0)
    {
      scratch.Pixels = block.Pixels + p;
      StorePixels(in, x, y, endX, endY, scratch);
    }
    else
    {
      StoreEmptyPixels(in, x, y, endX, endY);
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
