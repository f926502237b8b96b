// SPDX-License-Identifier: BSD-3-Clause

// The triangle caster for one instruction set: one component, without labels.

#include "TriangleCaster/AdditiveModel.h"
#include "TriangleCaster/AverageModel.h"
#include "TriangleCaster/CompositeModel.h"
#include "TriangleCaster/ImageIsosurfaceModel.h"
#include "TriangleCaster/ImageSlice.h"
#include "TriangleCaster/MaximumModel.h"
#include "TriangleCaster/SlabModel.h"
#include "TriangleCaster/TileCasting.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Casts the pixels of a tile for ImageBlend::Slice.
template <class Value>
void CastSlice(const ImageKernelInput& in, const Tile& tile, ImageKernelCounts& counts)
{
  constexpr int Rows = 2; // of a vector
  std::vector<ImageRays> rays(Rows * (tile.X1 - tile.X0) / LaneCount + 1);
  for (int y = tile.Y0; y < tile.Y1; y += Rows)
  {
    const Tile strip{ tile.X0, y, tile.X1, std::min(y + Rows, tile.Y1) };
    const int count = TakePixels(strip, -1, rays.data());
    for (int v = 0; v < count; ++v)
    {
      rays[v].Clear();
      SetUpRays(in, rays[v]);
      counts.Rays += __builtin_popcount(Bits(LoadInt8(rays[v].HasPart) == Int8(-1)));
      StorePixels(in, rays[v], GetSlicePixels<Value>(in, rays[v], counts.Samples));
    }
  }
}

/// The kernel of a model that does more than look samples up, so that the fastest lookup of few
/// intervals is not worth a kernel.
template <class Value, template <class, class> class Model>
ImageKernel ChooseLookup(const ImageKernelInput& in)
{
  return in.Transfer.Count <= TransferLookup::MostFew
    ? &CastTile<Value, Model<Value, FewIntervals<TransferLookup::MostFew>>>
    : &CastTile<Value, Model<Value, ManyIntervals>>;
}

/// The kernel of a model, with the fastest lookup for the transfer function.
template <class Value, template <class, class> class Model>
ImageKernel ChooseFastestLookup(const ImageKernelInput& in)
{
  if (in.Transfer.Count <= LaneCount)
  {
    return &CastTile<Value, Model<Value, FewIntervals<LaneCount>>>;
  }
  return ChooseLookup<Value, Model>(in);
}

template <class Value>
ImageKernel ChooseModel(const ImageKernelInput& in)
{
  switch (in.Blend)
  {
    case ImageBlend::MaximumIntensity:
      return &CastTile<Value, MaximumModel<Value>>;
    case ImageBlend::MinimumIntensity:
      return &CastTile<Value, MinimumModel<Value>>;
    case ImageBlend::AverageIntensity:
      return ChooseLookup<Value, AverageModel>(in);
    case ImageBlend::Additive:
      return ChooseLookup<Value, AdditiveModel>(in);
    case ImageBlend::Isosurfaces:
      return in.Lighting ? &CastTile<Value, ImageIsosurfaceModel<Value, GradientModel<true>>>
                         : &CastTile<Value, ImageIsosurfaceModel<Value, NoGradients>>;
    case ImageBlend::Slice:
      return &CastSlice<Value>;
    default:
      if (in.Slab.Texels)
      {
        return &CastTile<Value, SlabModel<Value>>;
      }
      if (in.GradientWords || in.Intensities || in.Table.Entries)
      {
        return ChooseLookup<Value, PreparedComposite>(in);
      }
      return in.Lighting || in.GradientTransfer.Count > 0
        ? ChooseFastestLookup<Value, GradientComposite>(in)
        : ChooseFastestLookup<Value, PlainComposite>(in);
  }
}

ImageKernel ChooseImageKernel(const ImageKernelInput& in)
{
  return ChooseType(in, [&](auto value) { return ChooseModel<decltype(value)>(in); });
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
