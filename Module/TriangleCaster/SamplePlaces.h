// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SamplePlaces_h
#define tetralux_SamplePlaces_h

// Where the samples of a vector are in the volume.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"

#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The cells of a vector's samples along one axis, seen from those of positions. way: slabs from
/// the start of the block. place: where in the cell, 0..1.
TETRALUX_INLINE Int8 PlaceAlong(
  const BlockPositions& positions, int axis, Float8 way, Float8& place)
{
  const Float8 x = Fma(positions.Step[axis], way, positions.Base[axis]);
  // The cell, and at its border either of two.
  const Int8 cell =
    RoundToInt(Min(Max(x - Float8(0.5f), positions.Low[axis]), positions.High[axis]));
  place = x - ToFloat(cell);
  return cell;
}

/// Finds the cells of a vector's samples.
TETRALUX_INLINE void PlaceSample(
  const ImageKernelInput& in, const BlockPositions& positions, Float8 way, ImageSample& sample)
{
  const std::int32_t strides[3] = { 1, in.Row, in.Slice };
  sample.Index = positions.Index;
  for (int a = 0; a < 3; ++a)
  {
    const Int8 cell = PlaceAlong(positions, a, way, sample.Place[a]);
    sample.Cell[a] = ToFloat(cell) - positions.Low[a];
    sample.Index = sample.Index + cell * Int8(strides[a]);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
