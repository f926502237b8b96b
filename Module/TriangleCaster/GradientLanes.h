// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientLanes_h
#define tetralux_GradientLanes_h

// Gradients of a volume in lanes: central differences at the points of a cell, one-sided ones at
// the border of the volume, interpolated trilinearly as its values are.

#include "Lighting/LaneLights.h"
#include "TriangleCaster/ImageSample.h"

#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// What the differences along one axis of a cell are made of.
struct AxisDifferences
{
  Int8 Before; ///< from the cell's first point to the one before it, if there is one
  Int8 Behind; ///< from the cell's first point to the one behind its second, if there is one
  Float8 OfFirst, OfSecond; ///< 1 over the points between those of a difference

  AxisDifferences(const ImageSample& sample, int axis, std::int32_t stride, std::int32_t lastCell)
  {
    const Mask8 hasBefore = Float8(0.f) < sample.Cell[axis];
    const Mask8 hasBehind = sample.Cell[axis] < Float8(static_cast<float>(lastCell));
    this->Before = Select(hasBefore, Int8(-stride), Int8(0));
    this->Behind = Select(hasBehind, Int8(2 * stride), Int8(stride));
    this->OfFirst = Select(hasBefore, Float8(0.5f), Float8(1.f));
    this->OfSecond = Select(hasBehind, Float8(0.5f), Float8(1.f));
  }
};

/// The gradient at a sample, in values for a step to the next point along each axis.
template <class Value>
TETRALUX_NOINLINE LaneVector FindGradient(const ImageKernelInput& in, const ImageSample& sample)
{
  const Float8(&w)[3] = sample.Place;
  const void* values = in.Values;
  const AxisDifferences x(sample, 0, 1, in.LastCell[0]);
  const AxisDifferences y(sample, 1, in.Row, in.LastCell[1]);
  const AxisDifferences z(sample, 2, in.Slice, in.LastCell[2]);
  const auto row = [&](Int8 index) { return InterpolateRow<Value>(values, index, w[0]); };
  const Int8 corner[2][2] = { { sample.Index, sample.Index + Int8(in.Row) },
    { sample.Index + Int8(in.Slice), sample.Index + Int8(in.Slice) + Int8(in.Row) } };
  Float8 inner[2][2], along[2][2]; // values of a row, and differences along it
  for (int k = 0; k < 2; ++k)
  {
    for (int j = 0; j < 2; ++j)
    {
      Float8 first, second, before, behind, unused;
      Neighbors<Value>::Load(values, corner[k][j], first, second);
      Neighbors<Value>::Load(values, corner[k][j] + x.Before, before, unused);
      Neighbors<Value>::Load(values, corner[k][j] + x.Behind - Int8(1), unused, behind);
      inner[k][j] = Mix(first, second, w[0]);
      along[k][j] = Mix((second - before) * x.OfFirst, (behind - first) * x.OfSecond, w[0]);
    }
  }
  Float8 dy[2], dz[2];
  for (int k = 0; k < 2; ++k)
  {
    const Float8 before = row(corner[k][0] + y.Before);
    const Float8 behind = row(corner[k][0] + y.Behind);
    dy[k] = Mix((inner[k][1] - before) * y.OfFirst, (behind - inner[k][0]) * y.OfSecond, w[1]);
  }
  for (int j = 0; j < 2; ++j)
  {
    const Float8 before = row(corner[0][j] + z.Before);
    const Float8 behind = row(corner[0][j] + z.Behind);
    dz[j] = Mix((inner[1][j] - before) * z.OfFirst, (behind - inner[0][j]) * z.OfSecond, w[2]);
  }
  const LaneVector gradient = {
    { Mix(Mix(along[0][0], along[0][1], w[1]), Mix(along[1][0], along[1][1], w[1]), w[2]),
      Mix(dy[0], dy[1], w[2]), Mix(dz[0], dz[1], w[1]) }
  };
  // Beside what is not a number there is no gradient.
  const Float8 largest = std::numeric_limits<float>::max();
  LaneVector finite;
  for (int a = 0; a < 3; ++a)
  {
    finite.C[a] = Keep(Abs(gradient.C[a]) <= largest, gradient.C[a]);
  }
  return finite;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
