// SPDX-License-Identifier: BSD-3-Clause

// The triangle caster for one instruction set: S-triangles, blocks of slabs, vectors of rays
// (Knittel 1999, sections 2 and 3).

#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/TransferLanes.h"
#include "TriangleCaster/VoxelLanes.h"

#include "Simd/LaneFunctions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The compositing buffer of one vector (section 3.2), in registers.
struct CompositingBuffer
{
  Float8 Color[3];
  Float8 Translucency;
  Float8 Front;

  explicit CompositingBuffer(const ImageRays& rays)
    : Translucency(LoadFloat8(rays.Translucency))
    , Front(LoadFloat8(rays.Front))
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = LoadFloat8(rays.Color[c]);
    }
  }
  void StoreTo(ImageRays& rays) const
  {
    for (int c = 0; c < 3; ++c)
    {
      Store(rays.Color[c], this->Color[c]);
    }
    Store(rays.Translucency, this->Translucency);
    Store(rays.Front, this->Front);
  }
  /// Equation 5.
  TETRALUX_INLINE void Add(Float8 opacity, const Float8 (&color)[3])
  {
    const Float8 share = this->Translucency * opacity;
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = Fma(share, color[c], this->Color[c]);
    }
    this->Translucency = this->Translucency - share;
  }
};

/// Classifies samples and composites them. x: their scalars, as the intervals map them. position:
/// slab positions of where they begin. length: of their steps, in unit distances.
template <class Intervals>
TETRALUX_INLINE void Composite(const ImageKernelInput& in, Float8 x, Mask8 active, Float8 position,
  Float8 length, CompositingBuffer& buffer)
{
  const Intervals intervals(in.Transfer, x);
  const Float8 zero = 0.f;
  const Float8 scalarOpacity = intervals.GetOpacity();
  // False where the scalar is not a number.
  const Mask8 visible = active & (zero < scalarOpacity);
  if (!Any(visible))
  {
    return;
  }
  const Float8 depth =
    (in.Power ? MinusLogOfRest(Max(scalarOpacity, zero)) : scalarOpacity) * length;
  const Float8 opacity = Keep(visible, OneMinusExp(Max(depth, zero)));
  Float8 color[3];
  intervals.GetColor(color);
  for (Float8& channel : color)
  {
    channel = Keep(visible, channel);
  }
  buffer.Front = Select((zero < opacity) & (buffer.Front < zero), position, buffer.Front);
  buffer.Add(opacity, color);
}

/// Casts the rays of a vector through the slabs [begin, end) of one block.
template <class Value, class Intervals>
TETRALUX_NOINLINE void CastBlock(const ImageKernelInput& in, ImageRays& rays, std::int32_t begin,
  std::int32_t end, ImageKernelCounts& counts)
{
  // The same positions whatever the slabs that are skipped.
  const std::int32_t block = begin / SlabsOfBlock * SlabsOfBlock;
  const BlockPositions positions = FindPositions(in, rays, block);
  const Float8 stepLength = LoadFloat8(rays.StepLength);
  const Mask8 hasPart = LoadInt8(rays.HasPart) == Int8(-1);
  const Float8 threshold = in.Threshold;
  CompositingBuffer buffer(rays);
  for (std::int32_t slab = std::max(begin, rays.FirstSlab); slab < end && slab <= rays.LastSlab;
       ++slab)
  {
    const bool inner = rays.InnerFirst <= slab && slab <= rays.InnerLast;
    for (int p = 0; p < rays.PartCount; ++p)
    {
      Mask8 active = hasPart & (threshold <= buffer.Translucency);
      if (!Any(active) && in.SkipPixels)
      {
        buffer.StoreTo(rays);
        rays.Ended = true;
        return;
      }
      Float8 from = 0.f;
      Float8 middle = 0.5f;
      Float8 width = 1.f;
      if (!inner)
      {
        const Int8 n = slab;
        const Int8 first = LoadInt8(rays.First[p]);
        const Int8 last = LoadInt8(rays.Last[p]);
        active = AndNot(AndNot(active, first > n), n > last);
        if (!Any(active))
        {
          continue;
        }
        from = Select(first == n, LoadFloat8(rays.Begin[p]), Float8(0.f));
        const Float8 to = Select(last == n, LoadFloat8(rays.End[p]), Float8(1.f));
        middle = Float8(0.5f) * (from + to);
        width = to - from;
      }
      const Float8 way = Float8(static_cast<float>(slab - block)) + middle;
      Int8 index = positions.Index;
      Float8 w[3];
      const std::int32_t strides[3] = { 1, in.Row, in.Slice };
      for (int a = 0; a < 3; ++a)
      {
        const Float8 x = Fma(positions.Step[a], way, positions.Base[a]);
        // The cell, and at its border either of two.
        const Int8 cell =
          RoundToInt(Min(Max(x - Float8(0.5f), positions.Low[a]), positions.High[a]));
        w[a] = x - ToFloat(cell);
        index = index + cell * Int8(strides[a]);
      }
      const Float8 value = Interpolate<Value>(in.Values, index, in.Row, in.Slice, w);
      counts.Samples += __builtin_popcount(Bits(active));
      Composite<Intervals>(in, Fma(value, Float8(in.ValueScale), Float8(in.ValueOffset)), active,
        Float8(static_cast<float>(slab)) + from, stepLength * width, buffer);
    }
  }
  buffer.StoreTo(rays);
  rays.Ended = !Any((LoadInt8(rays.HasPart) == Int8(-1)) & (threshold <= buffer.Translucency)) ||
    end > rays.LastSlab;
}

/// Whether what an S-triangle sees between two slab positions is empty.
bool IsEmpty(const ImageKernelInput& in, const Tile& box, double begin, double end)
{
  const SlicePlanes& slices = in.Slices;
  double low[3], high[3];
  std::fill(low, low + 3, std::numeric_limits<double>::infinity());
  std::fill(high, high + 3, -std::numeric_limits<double>::infinity());
  const bool planes = slices.Shape == SliceShape::Planes;
  // Positions are linear over the pixels and along Direction: corners bound them.
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 4; ++corner)
  {
    const double i = (corner & 1) != 0 ? box.X1 - 1 : box.X0;
    const double j = (corner & 2) != 0 ? box.Y1 - 1 : box.Y0;
    double way[3];
    for (int a = 0; a < 3; ++a)
    {
      way[a] = in.WorldDirection[a].At(i, j);
    }
    const double normal =
      way[0] * slices.Normal[0] + way[1] * slices.Normal[1] + way[2] * slices.Normal[2];
    // No direction between is shorter than its part along the normal.
    longest = std::max(longest, planes ? normal : std::hypot(way[0], way[1], way[2]));
    shortest = std::min(shortest, normal);
  }
  const double near = (slices.Origin + begin * slices.Distance) / longest;
  const double far = (slices.Origin + end * slices.Distance) / shortest;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double i = (corner & 1) != 0 ? box.X1 - 1 : box.X0;
    const double j = (corner & 2) != 0 ? box.Y1 - 1 : box.Y0;
    for (int a = 0; a < 3; ++a)
    {
      const double start = in.Start[a].At(i, j);
      const double direction = in.Direction[a].At(i, j);
      const double x0 = start + near * direction;
      const double x1 = start + far * direction;
      low[a] = std::min({ low[a], x0, x1 });
      high[a] = std::max({ high[a], x0, x1 });
    }
  }
  return in.Space->IsEmpty(low, high);
}

/// Casts one S-triangle, or one tile: rays are set up.
template <class Value, class Intervals>
void CastTriangle(const ImageKernelInput& in, const Tile& box, ImageRays* rays, int count,
  ImageKernelCounts& counts)
{
  std::int32_t first = NoSlab;
  std::int32_t last = -1;
  for (int v = 0; v < count; ++v)
  {
    first = std::min(first, rays[v].FirstSlab);
    last = std::max(last, rays[v].LastSlab);
  }
  for (std::int32_t begin = first; begin <= last;)
  {
    const std::int32_t end = std::min(begin / SlabsOfBlock * SlabsOfBlock + SlabsOfBlock, last + 1);
    if (in.Space && IsEmpty(in, box, begin, end))
    {
      counts.SkippedSlices += end - begin;
      begin = end;
      continue;
    }
    counts.Triangles += end - begin;
    bool ended = true;
    for (int v = 0; v < count; ++v)
    {
      if (!(rays[v].Ended && in.SkipPixels))
      {
        CastBlock<Value, Intervals>(in, rays[v], begin, end, counts);
      }
      ended = ended && rays[v].Ended;
    }
    if (ended && in.EndTriangles)
    {
      return;
    }
    begin = end;
  }
}

void StorePixels(const ImageKernelInput& in, const ImageRays& rays)
{
  for (int l = 0; l < LaneCount; ++l)
  {
    if (rays.X[l] < 0)
    {
      continue;
    }
    const std::int64_t pixel = static_cast<std::int64_t>(rays.Y[l]) * in.Width + rays.X[l];
    float* color = in.Colors + 4 * pixel;
    for (int c = 0; c < 3; ++c)
    {
      color[c] = rays.Color[c][l];
    }
    color[3] = 1.f - rays.Translucency[l];
    const double depth = in.Slices.Origin + rays.Front[l] * in.Slices.Distance;
    in.Depths[pixel] = rays.Front[l] < 0.f ? -1.f : static_cast<float>(depth * rays.WorldLength[l]);
  }
}

/// Pixels of a tile in vectors of 4 x 2, so that the rays of a vector stay close together. Calls
/// add(x, y) for each.
template <class AddT>
void ForEachPixel(const Tile& box, const AddT& add)
{
  constexpr int Columns = 4;
  constexpr int Rows = LaneCount / Columns;
  for (int y = box.Y0; y < box.Y1; y += Rows)
  {
    for (int x = box.X0; x < box.X1; x += Columns)
    {
      for (int l = 0; l < LaneCount; ++l)
      {
        const int px = x + l % Columns;
        const int py = y + l / Columns;
        if (px < box.X1 && py < box.Y1)
        {
          add(px, py);
        }
      }
    }
  }
}

template <class Value, class Intervals>
void CastTile(const ImageKernelInput& in, const Tile& tile, ImageKernelCounts& counts)
{
  const int edge = std::min(in.TileSize, std::max(tile.X1 - tile.X0, tile.Y1 - tile.Y0));
  std::vector<ImageRays> rays((edge * edge + LaneCount - 1) / LaneCount);
  for (int y = tile.Y0; y < tile.Y1; y += in.TileSize)
  {
    for (int x = tile.X0; x < tile.X1; x += in.TileSize)
    {
      const Tile box{ x, y, std::min(x + in.TileSize, tile.X1),
        std::min(y + in.TileSize, tile.Y1) };
      for (int triangle = 0; triangle < (in.Triangles ? 2 : 1); ++triangle)
      {
        int pixels = 0;
        ForEachPixel(box,
          [&](int px, int py)
          {
            const bool upper = px - x < py - y;
            if (in.Triangles && upper != (triangle == 1))
            {
              return;
            }
            rays[pixels / LaneCount].X[pixels % LaneCount] = px;
            rays[pixels / LaneCount].Y[pixels % LaneCount] = py;
            ++pixels;
          });
        const int count = (pixels + LaneCount - 1) / LaneCount;
        for (int l = pixels; l < count * LaneCount; ++l)
        {
          rays[l / LaneCount].X[l % LaneCount] = -1;
          rays[l / LaneCount].Y[l % LaneCount] = 0;
        }
        for (int v = 0; v < count; ++v)
        {
          SetUpRays(in, rays[v]);
        }
        CastTriangle<Value, Intervals>(in, box, rays.data(), count, counts);
        for (int v = 0; v < count; ++v)
        {
          StorePixels(in, rays[v]);
        }
      }
    }
  }
}

template <class Value>
void CastImage(const ImageKernelInput& in, const Tile& tile, ImageKernelCounts& counts)
{
  if (in.Transfer.Count <= LaneCount)
  {
    CastTile<Value, FewIntervals<LaneCount>>(in, tile, counts);
  }
  else if (in.Transfer.Count <= TransferLookup::MostFew)
  {
    CastTile<Value, FewIntervals<TransferLookup::MostFew>>(in, tile, counts);
  }
  else
  {
    CastTile<Value, ManyIntervals>(in, tile, counts);
  }
}

ImageKernel ChooseImageKernel(ImageScalar type)
{
  switch (type)
  {
    case ImageScalar::Int8:
      return &CastImage<std::int8_t>;
    case ImageScalar::UInt8:
      return &CastImage<std::uint8_t>;
    case ImageScalar::Int16:
      return &CastImage<std::int16_t>;
    case ImageScalar::UInt16:
      return &CastImage<std::uint16_t>;
    default:
      return &CastImage<float>;
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
