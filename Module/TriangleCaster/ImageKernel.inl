// SPDX-License-Identifier: BSD-3-Clause

// The triangle caster for one instruction set: S-triangles, blocks of slabs, vectors of rays
// (Knittel 1999, sections 2 and 3).

#include "TriangleCaster/ComponentsModel.h"
#include "TriangleCaster/CompositeModel.h"
#include "TriangleCaster/DependentModel.h"
#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/LabelModel.h"
#include "TriangleCaster/MaskLanes.h"
#include "TriangleCaster/SlabModel.h"
#include "TriangleCaster/TileSpace.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Finds the cells of a vector's samples. way: slabs from the start of the block.
TETRALUX_INLINE void PlaceSample(
  const ImageKernelInput& in, const BlockPositions& positions, Float8 way, ImageSample& sample)
{
  const std::int32_t strides[3] = { 1, in.Row, in.Slice };
  sample.Index = positions.Index;
  for (int a = 0; a < 3; ++a)
  {
    const Float8 x = Fma(positions.Step[a], way, positions.Base[a]);
    // The cell, and at its border either of two.
    const Int8 cell = RoundToInt(Min(Max(x - Float8(0.5f), positions.Low[a]), positions.High[a]));
    sample.Place[a] = x - ToFloat(cell);
    sample.Cell[a] = ToFloat(cell) - positions.Low[a];
    sample.Index = sample.Index + cell * Int8(strides[a]);
  }
}

/// Casts the rays of a vector through the slabs of one block.
template <class Value, class Model>
TETRALUX_NOINLINE void CastBlock(
  const ImageKernelInput& in, ImageRays& rays, std::int32_t block, ImageKernelCounts& counts)
{
  const std::int32_t start = block * SlabsOfBlock;
  const BlockPositions positions = FindPositions(in, rays, start);
  const Float8 stepLength = LoadFloat8(rays.StepLength);
  const Mask8 hasPart = LoadInt8(rays.HasPart) == Int8(-1);
  const std::int32_t begin = std::max(start, rays.FirstSlab);
  const std::int32_t end = std::min(start + SlabsOfBlock, rays.LastSlab + 1);
  Model model(in, rays);
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
        from = Select(first == n, LoadFloat8(rays.Begin[p]), Float8(0.f));
        to = Select(last == n, LoadFloat8(rays.End[p]), Float8(1.f));
      }
      const Float8 position = static_cast<float>(slab - start);
      sample.Front = Float8(static_cast<float>(slab)) + from;
      sample.Share = to - from;
      sample.Length = stepLength * sample.Share;
      const Float8 middle = position + Float8(0.5f) * (from + to);
      if (in.Masked)
      {
        // A sample of its own: what is not masked keeps its sample in registers.
        ImageSample place;
        PlaceSample(in, positions, middle, place);
        sample.Active = sample.Active & FindShown(in, place);
        if (!Any(sample.Active))
        {
          continue;
        }
      }
      counts.Samples += __builtin_popcount(Bits(sample.Active));
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
        PlaceSample(in, positions, middle, sample);
        model.Add(in, sample);
      }
    }
  }
  model.StoreTo(rays);
  rays.Ended = !Any(hasPart & model.GetOpen()) || start + SlabsOfBlock > rays.LastSlab;
}

/// Casts one S-triangle, or one tile: rays are set up.
template <class Value, class Model>
void CastTriangle(const ImageKernelInput& in, const std::vector<std::int32_t>& blocks,
  ImageRays* rays, int count, ImageKernelCounts& counts)
{
  std::int32_t first = NoSlab;
  std::int32_t last = -1;
  for (int v = 0; v < count; ++v)
  {
    first = std::min(first, rays[v].FirstSlab);
    last = std::max(last, rays[v].LastSlab);
  }
  for (const std::int32_t block : blocks)
  {
    const std::int32_t begin = std::max(block * SlabsOfBlock, first);
    const std::int32_t end = std::min((block + 1) * SlabsOfBlock, last + 1);
    if (begin >= end)
    {
      continue;
    }
    counts.Triangles += end - begin;
    bool ended = true;
    for (int v = 0; v < count; ++v)
    {
      if (!(rays[v].Ended && in.SkipPixels))
      {
        CastBlock<Value, Model>(in, rays[v], block, counts);
      }
      ended = ended && rays[v].Ended;
    }
    if (ended && in.EndTriangles)
    {
      return;
    }
  }
}

/// Stores the pixels of a vector; of rays that were not set up, if there is nothing to see.
template <class Model>
void StorePixels(const ImageKernelInput& in, const ImageRays& rays)
{
  for (int l = 0; l < LaneCount; ++l)
  {
    if (rays.X[l] < 0)
    {
      continue;
    }
    const std::int64_t pixel = static_cast<std::int64_t>(rays.Y[l]) * in.Width + rays.X[l];
    float color[4];
    Model::GetPixel(in, rays, l, color);
    std::copy(color, color + 4, in.Colors + 4 * pixel);
    const double depth = in.Slices.Origin + rays.Front[l] * in.Slices.Distance;
    in.Depths[pixel] = rays.Front[l] < 0.f ? -1.f : static_cast<float>(depth * rays.WorldLength[l]);
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
        const int side = px - box.X0 < py - box.Y0 ? 1 : 0;
        if (px < box.X1 && py < box.Y1 && (triangle < 0 || side == triangle))
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

template <class Value, class Model>
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
      FindVisibleBlocks(in, TileBeam(in, box), 0, blockCount, blocks);
      for (int triangle = in.Triangles ? 0 : -1; triangle < (in.Triangles ? 2 : 0); ++triangle)
      {
        const int count = TakePixels(box, triangle, rays.data());
        for (int v = 0; v < count; ++v)
        {
          rays[v].Clear();
          if (!blocks.empty())
          {
            SetUpRays(in, rays[v]);
          }
        }
        CastTriangle<Value, Model>(in, blocks, rays.data(), count, counts);
        for (int v = 0; v < count; ++v)
        {
          StorePixels<Model>(in, rays[v]);
        }
      }
    }
  }
}

/// The kernel of a model, with the fastest lookup for the transfer function.
template <class Value, template <class, class> class Model>
ImageKernel ChooseLookup(const ImageKernelInput& in)
{
  if (in.Transfer.Count <= LaneCount)
  {
    return &CastTile<Value, Model<Value, FewIntervals<LaneCount>>>;
  }
  if (in.Transfer.Count <= TransferLookup::MostFew)
  {
    return &CastTile<Value, Model<Value, FewIntervals<TransferLookup::MostFew>>>;
  }
  return &CastTile<Value, Model<Value, ManyIntervals>>;
}

template <class Value, class Gradients>
ImageKernel ChooseComponents(const ImageKernelInput& in)
{
  if (in.Labels)
  {
    return &CastTile<Value, LabelModel<Value, Gradients>>;
  }
  switch (in.Components)
  {
    case 2:
      return in.Dependent ? &CastTile<Value, DependentModel<Value, 2, Gradients>>
                          : &CastTile<Value, ComponentsModel<Value, 2, Gradients>>;
    case 3:
      return &CastTile<Value, ComponentsModel<Value, 3, Gradients>>;
    default:
      return in.Dependent ? &CastTile<Value, DependentModel<Value, 4, Gradients>>
                          : &CastTile<Value, ComponentsModel<Value, 4, Gradients>>;
  }
}

/// Whether anything depends on gradients.
inline bool UsesGradients(const ImageKernelInput& in)
{
  const auto usesThem = [](const ComponentLookup& part)
  { return part.Lighting || part.GradientTransfer.Count > 0; };
  return in.Lighting || in.GradientTransfer.Count > 0 ||
    (in.Labels && in.Labels->GradientTransfer.Count > 0) ||
    (in.Parts && std::any_of(in.Parts, in.Parts + in.Components, usesThem));
}

template <class Value>
ImageKernel ChooseModel(const ImageKernelInput& in)
{
  if (in.Slab.Texels)
  {
    return &CastTile<Value, SlabModel<Value>>;
  }
  if (in.Labels || in.Components > 1)
  {
    return UsesGradients(in) ? ChooseComponents<Value, GradientModel>(in)
                             : ChooseComponents<Value, NoGradients>(in);
  }
  return in.Lighting || in.GradientTransfer.Count > 0 ? ChooseLookup<Value, GradientComposite>(in)
                                                      : ChooseLookup<Value, PlainComposite>(in);
}

ImageKernel ChooseImageKernel(const ImageKernelInput& in)
{
  switch (in.Type)
  {
    case ImageScalar::Int8:
      return ChooseModel<std::int8_t>(in);
    case ImageScalar::UInt8:
      return ChooseModel<std::uint8_t>(in);
    case ImageScalar::Int16:
      return ChooseModel<std::int16_t>(in);
    case ImageScalar::UInt16:
      return ChooseModel<std::uint16_t>(in);
    default:
      return ChooseModel<float>(in);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
