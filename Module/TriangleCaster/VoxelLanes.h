// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VoxelLanes_h
#define tetralux_VoxelLanes_h

// Values of a volume in lanes: two neighbours along x in one load, and eight of a cell
// interpolated.

#include "Simd/Lanes.h"

#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The value with this index of each lane, and the one behind it. Reads nothing outside of the
/// values, of which there are at least 4 if Value is a byte.
///@{
template <class Value>
struct Neighbors;

template <>
struct Neighbors<float>
{
  static TETRALUX_INLINE void Load(const void* values, Int8 index, Float8& a, Float8& b)
  {
    GatherNeighbors(static_cast<const float*>(values), index, a, b);
  }
};
template <>
struct Neighbors<std::uint16_t>
{
  static TETRALUX_INLINE void Load(const void* values, Int8 index, Float8& a, Float8& b)
  {
    const Int8 pair = GatherWords(values, ShiftLeft(index, 1));
    a = ToFloat(ShiftRight(ShiftLeft(pair, 16), 16));
    b = ToFloat(ShiftRight(pair, 16));
  }
};
template <>
struct Neighbors<std::int16_t>
{
  static TETRALUX_INLINE void Load(const void* values, Int8 index, Float8& a, Float8& b)
  {
    const Int8 pair = GatherWords(values, ShiftLeft(index, 1));
    a = ToFloat(ShiftRightSigned(ShiftLeft(pair, 16), 16));
    b = ToFloat(ShiftRightSigned(pair, 16));
  }
};

/// Two bytes as the highest ones of a word. The word ends with them, so that none behind the last
/// value is read; at the first two values it begins with the values instead.
TETRALUX_INLINE Int8 LoadBytes(const void* values, Int8 index)
{
  const Int8 before = index - Int8(2);
  const Int8 missing = Select(Int8(0) > before, Int8(0) - before, Int8(0));
  return ShiftLeft(GatherWords(values, before + missing), ShiftLeft(missing, 3));
}
template <>
struct Neighbors<std::uint8_t>
{
  static TETRALUX_INLINE void Load(const void* values, Int8 index, Float8& a, Float8& b)
  {
    const Int8 pair = LoadBytes(values, index);
    a = ToFloat(ShiftRight(ShiftLeft(pair, 8), 24));
    b = ToFloat(ShiftRight(pair, 24));
  }
};
template <>
struct Neighbors<std::int8_t>
{
  static TETRALUX_INLINE void Load(const void* values, Int8 index, Float8& a, Float8& b)
  {
    const Int8 pair = LoadBytes(values, index);
    a = ToFloat(ShiftRightSigned(ShiftLeft(pair, 8), 24));
    b = ToFloat(ShiftRightSigned(pair, 24));
  }
};
///@}

TETRALUX_INLINE Float8 Mix(Float8 a, Float8 b, Float8 t) { return Fma(t, b - a, a); }

/// Linear interpolation between the value with this index and the one behind it.
template <class Value>
TETRALUX_INLINE Float8 InterpolateRow(const void* values, Int8 index, Float8 w)
{
  Float8 a, b;
  Neighbors<Value>::Load(values, index, a, b);
  return Mix(a, b, w);
}

/// Trilinear interpolation in the cell whose first value has this index. w: where in the cell,
/// 0..1 along each axis. row, slice: values from one to the next.
template <class Value>
TETRALUX_INLINE Float8 Interpolate(
  const void* values, Int8 index, std::int32_t row, std::int32_t slice, const Float8 (&w)[3])
{
  const Int8 back = index + Int8(slice);
  const Float8 a = InterpolateRow<Value>(values, index, w[0]);
  const Float8 b = InterpolateRow<Value>(values, index + Int8(row), w[0]);
  const Float8 c = InterpolateRow<Value>(values, back, w[0]);
  const Float8 d = InterpolateRow<Value>(values, back + Int8(row), w[0]);
  return Mix(Mix(a, b, w[1]), Mix(c, d, w[1]), w[2]);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
