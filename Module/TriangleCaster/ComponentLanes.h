// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComponentLanes_h
#define tetralux_ComponentLanes_h

// Values of points that have several, one beside the other: two neighbouring points in as few loads
// as their bytes need.

#include "TriangleCaster/VoxelLanes.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The element of this type that begins at a byte of a word.
template <class Value>
TETRALUX_INLINE Float8 Extract(Int8 word, int byte)
{
  constexpr int Bits = 8 * sizeof(Value);
  const Int8 high = ShiftLeft(word, 32 - Bits - 8 * byte);
  if constexpr (std::is_signed_v<Value>)
  {
    return ToFloat(ShiftRightSigned(high, 32 - Bits));
  }
  else
  {
    return ToFloat(ShiftRight(high, 32 - Bits));
  }
}

/// The word at an element of a pair of points that have N values each, as near to it as reads
/// nothing else. first: index of the pair's first value. Returns the byte that the element is at.
template <class Value, int N>
constexpr int FindWord(int element)
{
  constexpr int Size = sizeof(Value);
  constexpr int Last = 2 * N * Size - 4;
  return std::min(element * Size / 4 * 4, Last);
}
template <class Value>
TETRALUX_INLINE Int8 LoadWord(const void* values, Int8 first, int offset)
{
  const Int8 at = ShiftLeft(first, sizeof(Value) == 2 ? 1 : 0);
  return GatherWords(static_cast<const char*>(values) + offset, at);
}

/// All values of the point with this index in each lane, and those of the point behind it. A point
/// has at least two.
template <class Value, int N>
TETRALUX_INLINE void LoadPoints(const void* values, Int8 point, Float8 (&a)[N], Float8 (&b)[N])
{
  const Int8 first = point * Int8(N);
  Float8 pair[2 * N];
  if constexpr (std::is_same_v<Value, float>)
  {
    for (int k = 0; k < N; ++k)
    {
      GatherNeighbors(
        static_cast<const float*>(values) + 2 * k, first, pair[2 * k], pair[2 * k + 1]);
    }
  }
  else
  {
    int loaded = -1;
    Int8 word = 0;
    for (int e = 0; e < 2 * N; ++e)
    {
      const int offset = FindWord<Value, N>(e);
      if (offset != loaded)
      {
        word = LoadWord<Value>(values, first, offset);
        loaded = offset;
      }
      pair[e] = Extract<Value>(word, e * static_cast<int>(sizeof(Value)) - offset);
    }
  }
  for (int c = 0; c < N; ++c)
  {
    a[c] = pair[c];
    b[c] = pair[N + c];
  }
}

/// Component C of points that have N values, as a type of values: its indices are those of points.
template <class Value, int N, int C>
struct Component;

template <class Value, int N, int C>
struct Neighbors<Component<Value, N, C>>
{
  static TETRALUX_INLINE void Load(const void* values, Int8 point, Float8& a, Float8& b)
  {
    const Int8 first = point * Int8(N);
    if constexpr (std::is_same_v<Value, float>)
    {
      // With what is between both.
      Float8 unused;
      const auto* at = static_cast<const float*>(values) + C;
      GatherNeighbors(at, first, a, unused);
      GatherNeighbors(at + N - 1, first, unused, b);
    }
    else
    {
      constexpr int Size = sizeof(Value);
      constexpr int OfA = FindWord<Value, N>(C);
      constexpr int OfB = FindWord<Value, N>(N + C);
      const Int8 word = LoadWord<Value>(values, first, OfA);
      a = Extract<Value>(word, C * Size - OfA);
      b = Extract<Value>(
        OfA == OfB ? word : LoadWord<Value>(values, first, OfB), (N + C) * Size - OfB);
    }
  }
};

/// Trilinear interpolation of all values in the cell whose first point has this index. As
/// Interpolate.
template <class Value, int N>
TETRALUX_INLINE void InterpolatePoints(const void* values, Int8 point, std::int32_t row,
  std::int32_t slice, const Float8 (&w)[3], Float8 (&value)[N])
{
  Float8 rows[4][N];
  for (int r = 0; r < 4; ++r)
  {
    Float8 a[N], b[N];
    const std::int32_t offset = ((r & 1) != 0 ? row : 0) + ((r & 2) != 0 ? slice : 0);
    LoadPoints<Value>(values, point + Int8(offset), a, b);
    for (int c = 0; c < N; ++c)
    {
      rows[r][c] = Mix(a[c], b[c], w[0]);
    }
  }
  for (int c = 0; c < N; ++c)
  {
    value[c] = Mix(Mix(rows[0][c], rows[1][c], w[1]), Mix(rows[2][c], rows[3][c], w[1]), w[2]);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
