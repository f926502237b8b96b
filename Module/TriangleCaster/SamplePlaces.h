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

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
