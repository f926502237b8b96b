// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TileCasting_h
#define tetralux_TileCasting_h

// How a model of samples is cast: S-triangles, blocks of slabs, vectors of rays (Knittel 1999,
// sections 2 and 3).

#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/MaskLanes.h"
#include "TriangleCaster/SamplePlaces.h"
#include "TriangleCaster/TileSpace.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Which samples of a vector neither a mask nor a hidden cell hides.
struct ShownSamples
{
  std::uint16_t Bits[SlabsOfBlock][MostCroppedParts]; ///< one of each ray, of up to 16
};

/// Finds them in slabs [begin, end) of the block that begins at slab start. Apart from CastBlock,
/// where calls would take the registers of all volumes.
TETRALUX_NOINLINE void FindShownSamples(const ImageKernelInput& in, const ImageRays& rays,
  const BlockPositions& positions, std::int32_t start, std::int32_t begin, std::int32_t end,
  ShownSamples& shown)
{
  for (std::int32_t slab = begin; slab < end; ++slab)
  {
    const Int8 n = slab;
    const Float8 position = static_cast<float>(slab - start);
    for (int p = 0; p < rays.PartCount; ++p)
    {
      const Float8 from =
        Select(LoadInt8(rays.First[p]) == n, LoadFloat8(rays.Begin[p]), Float8(0.f));
      const Float8 to = Select(LoadInt8(rays.Last[p]) == n, LoadFloat8(rays.End[p]), Float8(1.f));
      ImageSample place;
      PlaceSample(in, positions, position + Float8(0.5f) * (from + to), place);
      shown.Bits[slab - start][p] = static_cast<std::uint16_t>(Bits(FindShown(in, place)));
    }
  }
}

/// Samples are found one by one.
struct NoScalarsAhead
{
  static constexpr bool Exist = false;
  NoScalarsAhead(const ImageKernelInput&, const BlockPositions&, Mask8) {}
};

/// Casts the rays of a vector through the slabs of one block. Ahead: NoScalarsAhead, or
/// ScalarsAhead for a model that needs no more of a sample than its scalar.
template <class Value, class Model, class Ahead>
TETRALUX_NOINLINE void CastBlock(
  const ImageKernelInput& in, ImageRays& rays, std::int32_t block, ImageKernelCounts& counts)
{
  const std::int32_t start = block * SlabsOfBlock;
  const BlockPositions positions = FindPositions(in, rays, start);
  const Float8 stepLength = LoadFloat8(rays.StepLength);
  const Mask8 hasPart = LoadInt8(rays.HasPart) == Int8(-1);
  const std::int32_t begin = std::max(start, rays.FirstSlab);
  const std::int32_t end = std::min(start + SlabsOfBlock, rays.LastSlab + 1);
  ShownSamples shownSamples;
  if (in.Masked)
  {
    FindShownSamples(in, rays, positions, start, begin, end, shownSamples);
  }
  Model model(in, rays);
  Ahead ahead(in, positions, hasPart);
  for (std::int32_t slab = begin; slab < end; ++slab)
  {
    const bool inner = rays.InnerFirst <= slab && slab <= rays.InnerLast;
    for (int p = 0; p < rays.PartCount; ++p)
    {
      ImageSample sample;
      sample.Active = hasPart & model.GetOpen();
      if (!Any(sample.Active) && in.SkipPixels)
      {
        model.StoreTo(rays);
        rays.Ended = true;
        return;
      }
      Float8 from = 0.f;
      Float8 to = 1.f;
      sample.Begins = Int8(0) > Int8(0);
      if (!inner)
      {
        const Int8 n = slab;
        const Int8 first = LoadInt8(rays.First[p]);
        const Int8 last = LoadInt8(rays.Last[p]);
        sample.Active = AndNot(AndNot(sample.Active, first > n), n > last);
        if (!Any(sample.Active))
        {
          continue;
        }
        sample.Begins = first == n;
        from = Select(sample.Begins, LoadFloat8(rays.Begin[p]), Float8(0.f));
        to = Select(last == n, LoadFloat8(rays.End[p]), Float8(1.f));
      }
      const Float8 position = static_cast<float>(slab - start);
      const Float8 middle = Float8(0.5f) * (from + to);
      sample.Slab = slab;
      sample.Front = Float8(static_cast<float>(slab)) + from;
      sample.Middle = Float8(static_cast<float>(slab)) + middle;
      sample.Share = to - from;
      sample.Length = stepLength * sample.Share;
      if (in.Masked)
      {
        const Mask8 shown = MaskFromBits(shownSamples.Bits[slab - start][p]);
        if constexpr (Model::JoinsSamples)
        {
          model.Restart(AndNot(sample.Active, shown));
        }
        sample.Active = sample.Active & shown;
        if (!Any(sample.Active))
        {
          continue;
        }
      }
      counts.Samples += __builtin_popcount(Bits(sample.Active));
      if constexpr (Ahead::Exist)
      {
        if (inner)
        {
          const std::int32_t innerEnd = std::min(end, rays.InnerLast + 1);
          model.Add(in, sample, ahead.Get(in, slab - start, innerEnd - start));
          continue;
        }
      }
      if constexpr (Model::AtEnds)
      {
        PlaceSample(in, positions, position + to, sample);
        model.Add(in, sample,
          [&]()
          {
            ImageSample front = sample;
            PlaceSample(in, positions, position + from, front);
            return front;
          });
      }
      else
      {
        PlaceSample(in, positions, position + middle, sample);
        model.Add(in, sample);
      }
    }
  }
  model.StoreTo(rays);
  rays.Ended = !Any(hasPart & model.GetOpen()) || start + SlabsOfBlock > rays.LastSlab;
}

/// How many slabs of a block the rays of vectors go through.
inline std::int32_t CountSlabs(const ImageRays* rays, int count, std::int32_t block)
{
  std::int32_t first = NoSlab;
  std::int32_t last = -1;
  for (int v = 0; v < count; ++v)
  {
    first = std::min(first, rays[v].FirstSlab);
    last = std::max(last, rays[v].LastSlab);
  }
  const std::int32_t begin = std::max(block * SlabsOfBlock, first);
  const std::int32_t end = std::min((block + 1) * SlabsOfBlock, last + 1);
  return std::max(end - begin, 0);
}

/// Casts one S-triangle, or one tile: rays are set up.
template <class Value, class Model, class Ahead>
void CastTriangle(const ImageKernelInput& in, const std::vector<std::int32_t>& blocks,
  ImageRays* rays, int count, ImageKernelCounts& counts)
{
  for (const std::int32_t block : blocks)
  {
    const std::int32_t slabs = CountSlabs(rays, count, block);
    if (slabs == 0)
    {
      continue;
    }
    counts.Triangles += slabs;
    bool ended = true;
    for (int v = 0; v < count; ++v)
    {
      if (!(rays[v].Ended && in.SkipPixels))
      {
        CastBlock<Value, Model, Ahead>(in, rays[v], block, counts);
      }
      ended = ended && rays[v].Ended;
    }
    if (ended && in.EndTriangles)
    {
      return;
    }
  }
}

/// A block of slabs, and what no sample in it exceeds.
struct BoundedBlock
{
  float Bound;
  std::int32_t Block;

  /// The largest bound first.
  static TETRALUX_NOINLINE void Sort(std::vector<BoundedBlock>& blocks)
  {
    std::sort(blocks.begin(), blocks.end(),
      [](const BoundedBlock& a, const BoundedBlock& b)
      { return a.Bound > b.Bound || (a.Bound == b.Bound && a.Block < b.Block); });
  }
};

/// As CastTriangle, for models that do not depend on the order of slabs: blocks that may have the
/// best samples come first, so that others need not be cast.
template <class Value, class Model, class Ahead>
void CastBestFirst(const ImageKernelInput& in, const TileBeam& beam,
  const std::vector<std::int32_t>& blocks, ImageRays* rays, int count, ImageKernelCounts& counts)
{
  std::vector<BoundedBlock> order;
  for (const std::int32_t block : blocks)
  {
    float bound = std::numeric_limits<float>::infinity();
    if (in.Ranges)
    {
      const double begin = static_cast<double>(block) * SlabsOfBlock;
      double low[3], high[3];
      beam.FindBox(in, begin, begin + SlabsOfBlock, low, high);
      bound = Model::FindBound(in, in.Ranges->FindRange(low, high));
    }
    order.push_back({ bound, block });
  }
  BoundedBlock::Sort(order);
  for (const BoundedBlock& next : order)
  {
    bool settled = true;
    for (int v = 0; v < count; ++v)
    {
      if (!Model::IsSettled(rays[v], next.Bound))
      {
        settled = false;
        CastBlock<Value, Model, Ahead>(in, rays[v], next.Block, counts);
      }
    }
    if (settled)
    {
      return; // and so it is for what is bounded by less
    }
    counts.Triangles += CountSlabs(rays, count, next.Block);
  }
}

/// Stores the pixels of a vector; of rays that were not set up, if there is nothing to see.
inline void StorePixels(const ImageKernelInput& in, const ImageRays& rays, const PixelLanes& pixels)
{
  float color[4][LaneCount], front[LaneCount];
  for (int c = 0; c < 3; ++c)
  {
    Store(color[c], pixels.Color[c]);
  }
  Store(color[3], pixels.Opacity);
  Store(front, pixels.Front);
  for (int l = 0; l < LaneCount; ++l)
  {
    if (rays.X[l] < 0)
    {
      continue;
    }
    const std::int64_t pixel = static_cast<std::int64_t>(rays.Y[l]) * in.Width + rays.X[l];
    for (int c = 0; c < 4; ++c)
    {
      in.Colors[4 * pixel + c] = color[c][l];
    }
    const double depth = in.Slices.Origin + front[l] * in.Slices.Distance;
    in.Depths[pixel] = front[l] < 0.f ? -1.f : static_cast<float>(depth * rays.WorldLength[l]);
  }
}

/// Takes the pixels of a tile, or of one of its two S-triangles, into vectors of 4 x 2, so that the
/// rays of a vector stay close together. triangle: 0 or 1, or -1 for the tile. Returns the number
/// of vectors.
inline int TakePixels(const Tile& box, int triangle, ImageRays* rays)
{
  constexpr int Columns = 4;
  constexpr int Rows = LaneCount / Columns;
  int pixels = 0;
  for (int y = box.Y0; y < box.Y1; y += Rows)
  {
    for (int x = box.X0; x < box.X1; x += Columns)
    {
      for (int l = 0; l < LaneCount; ++l)
      {
        const int px = x + l % Columns;
        const int py = y + l / Columns;
        const bool inside = px < box.X1 && py < box.Y1;
        const int side = GetTriangleOfPixel(px - box.X0, py - box.Y0);
        if (inside && (triangle < 0 || side == triangle))
        {
          rays[pixels / LaneCount].X[pixels % LaneCount] = px;
          rays[pixels / LaneCount].Y[pixels % LaneCount] = py;
          ++pixels;
        }
      }
    }
  }
  const int count = (pixels + LaneCount - 1) / LaneCount;
  for (int l = pixels; l < count * LaneCount; ++l)
  {
    rays[l / LaneCount].X[l % LaneCount] = -1;
    rays[l / LaneCount].Y[l % LaneCount] = 0;
  }
  return count;
}

template <class Value, class Model, class Ahead = NoScalarsAhead>
void CastTile(const ImageKernelInput& in, const Tile& tile, ImageKernelCounts& counts)
{
  const int edge = std::min(in.TileSize, std::max(tile.X1 - tile.X0, tile.Y1 - tile.Y0));
  std::vector<ImageRays> rays((edge * edge + LaneCount - 1) / LaneCount);
  std::vector<std::int32_t> blocks;
  const std::int32_t blockCount = (in.Slices.Count + SlabsOfBlock - 1) / SlabsOfBlock;
  for (int y = tile.Y0; y < tile.Y1; y += in.TileSize)
  {
    for (int x = tile.X0; x < tile.X1; x += in.TileSize)
    {
      const Tile box{ x, y, std::min(x + in.TileSize, tile.X1),
        std::min(y + in.TileSize, tile.Y1) };
      blocks.clear();
      const TileBeam beam(in, box);
      std::int32_t begin = 0;
      std::int32_t end = blockCount;
      LimitBlocks(in, box, begin, end);
      FindVisibleBlocks(in, beam, begin, end, blocks);
      for (int triangle = in.Triangles ? 0 : -1; triangle < (in.Triangles ? 2 : 0); ++triangle)
      {
        const int count = TakePixels(box, triangle, rays.data());
        for (int v = 0; v < count; ++v)
        {
          rays[v].Clear();
          if (!blocks.empty() || Model::CountsEmptyRays)
          {
            SetUpRays(in, rays[v]);
            counts.Rays += __builtin_popcount(Bits(LoadInt8(rays[v].HasPart) == Int8(-1)));
          }
        }
        if constexpr (Model::InAnyOrder)
        {
          CastBestFirst<Value, Model, Ahead>(in, beam, blocks, rays.data(), count, counts);
        }
        else
        {
          CastTriangle<Value, Model, Ahead>(in, blocks, rays.data(), count, counts);
        }
        for (int v = 0; v < count; ++v)
        {
          StorePixels(in, rays[v], Model::GetPixels(in, rays[v]));
        }
      }
    }
  }
}

/// What choose returns for a number of the type of the volume's values.
template <class ChooseT>
ImageKernel ChooseType(const ImageKernelInput& in, const ChooseT& choose)
{
  // Branches differ by the type of a zero. NOLINTBEGIN(bugprone-branch-clone)
  switch (in.Type)
  {
    case ImageScalar::Int8:
      return choose(std::int8_t());
    case ImageScalar::UInt8:
      return choose(std::uint8_t());
    case ImageScalar::Int16:
      return choose(std::int16_t());
    case ImageScalar::UInt16:
      return choose(std::uint16_t());
    default:
      return choose(float());
  }
  // NOLINTEND(bugprone-branch-clone)
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
