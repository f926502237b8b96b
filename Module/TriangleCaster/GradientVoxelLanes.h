// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientVoxelLanes_h
#define tetralux_GradientVoxelLanes_h

// Gradients that are stored at the points of a volume (GradientVoxels), in lanes.

#include "Lighting/LaneLights.h"
#include "TriangleCaster/ImageSample.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The words at the points of the cells that a vector's samples are in.
class GradientCell
{
public:
  TETRALUX_INLINE void Load(const ImageKernelInput& in, const ImageSample& sample)
  {
    const Int8 back = sample.Index + Int8(in.Slice);
    LoadRow(in.GradientWords, sample.Index, this->Words[0][0]);
    LoadRow(in.GradientWords, sample.Index + Int8(in.Row), this->Words[0][1]);
    LoadRow(in.GradientWords, back, this->Words[1][0]);
    LoadRow(in.GradientWords, back + Int8(in.Row), this->Words[1][1]);
  }

  /// The value at a place of the cell, 0..1 along each axis.
  TETRALUX_INLINE Float8 GetValue(const Float8 (&w)[3]) const
  {
    return this->Interpolate(w, [](Int8 word) { return ToFloat(ShiftRight(word, 24)); });
  }

  /// The gradient there, in values for a step to the next point along each axis.
  TETRALUX_NOINLINE LaneVector GetGradient(const ImageKernelInput& in, const Float8 (&w)[3]) const
  {
    const auto x = [](Int8 word) { return ToFloat(ShiftRightSigned(ShiftLeft(word, 24), 24)); };
    const auto y = [](Int8 word) { return ToFloat(ShiftRightSigned(ShiftLeft(word, 16), 24)); };
    const auto z = [](Int8 word) { return ToFloat(ShiftRightSigned(ShiftLeft(word, 8), 24)); };
    const LaneVector components = { { this->Interpolate(w, x), this->Interpolate(w, y),
      this->Interpolate(w, z) } };
    return components * Float8(in.GradientWordScale);
  }

private:
  static TETRALUX_INLINE void LoadRow(const float* words, Int8 index, Int8 (&row)[2])
  {
    Float8 first, second;
    GatherNeighbors(words, index, first, second);
    row[0] = ToBits(first);
    row[1] = ToBits(second);
  }

  template <class Take>
  TETRALUX_INLINE Float8 Interpolate(const Float8 (&w)[3], const Take& take) const
  {
    const auto row = [&](const Int8(&words)[2])
    { return Mix(take(words[0]), take(words[1]), w[0]); };
    const auto face = [&](const Int8(&words)[2][2])
    { return Mix(row(words[0]), row(words[1]), w[1]); };
    return Mix(face(this->Words[0]), face(this->Words[1]), w[2]);
  }

  Int8 Words[2][2][2]; ///< along z, y and x
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
