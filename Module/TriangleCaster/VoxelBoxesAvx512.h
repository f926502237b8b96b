// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VoxelBoxesAvx512_h
#define tetralux_VoxelBoxesAvx512_h

// Values of samples ahead of their compositing, 16 lanes by AVX-512 with VBMI. The rays of a vector
// are close together: where all their cells of a slab are within a box of 256 bytes, it is loaded
// row by row, and each lane takes its voxels by permutes of bytes in place of gathers.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/SamplePlaces.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <immintrin.h>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Voxels of a box: rows of 8 bytes, an even number of them in a slice.
template <int NumberOfRows, int NumberOfSlices>
struct VoxelBox
{
  static constexpr int RowBytes = 8;
  static constexpr int Rows = NumberOfRows;
  static constexpr int Slices = NumberOfSlices;
  static constexpr int SliceBytes = RowBytes * Rows;
  static constexpr int Bytes = SliceBytes * Slices;
  static_assert(Rows % 2 == 0, "rows are loaded by two");
  static_assert(Bytes <= 256, "an index is a byte");
  static constexpr int Registers = Bytes <= 128 ? 2 : 4;

  __m512i Voxels[Registers];

  /// at: the first voxel. row, slice: bytes from one to the next.
  TETRALUX_INLINE void Load(const char* at, std::int64_t row, std::int64_t slice)
  {
    for (int r = 0; r < Registers; ++r)
    {
      const auto quarter = [&](int q) { return LoadRows(at, row, slice, 4 * r + q); };
      this->Voxels[r] =
        _mm512_inserti32x8(_mm512_castsi256_si512(_mm256_set_m128i(quarter(1), quarter(0))),
          _mm256_set_m128i(quarter(3), quarter(2)), 1);
    }
  }

  /// The bytes with these indices.
  TETRALUX_INLINE Int8 LookUp(__m512i index) const
  {
    const __m512i low = _mm512_permutex2var_epi8(this->Voxels[0], index, this->Voxels[1]);
    if constexpr (Registers == 2)
    {
      return Int8(low);
    }
    else
    {
      const __m512i high = _mm512_permutex2var_epi8(this->Voxels[2], index, this->Voxels[3]);
      return Int8(_mm512_mask_blend_epi8(_mm512_movepi8_mask(index), low, high));
    }
  }

private:
  /// Two rows of those that are counted through all slices; 0 behind them.
  static TETRALUX_INLINE __m128i LoadRows(
    const char* at, std::int64_t row, std::int64_t slice, int pair)
  {
    const int z = 2 * pair / Rows;
    if (z >= Slices)
    {
      return _mm_setzero_si128();
    }
    const char* first = at + z * slice + 2 * pair % Rows * row;
    double low, high;
    std::memcpy(&low, first, RowBytes);
    std::memcpy(&high, first + row, RowBytes);
    return _mm_castpd_si128(_mm_set_pd(high, low));
  }
};

/// What holds the cells of a vector where pixels are closer than voxels, and where they are as far
/// apart.
///@{
using SmallBox = VoxelBox<4, 4>;
using LargeBox = VoxelBox<6, 5>;
///@}

/// Four bytes for each lane: those that come so many bytes behind its index.
TETRALUX_INLINE __m512i SpreadBytes(Int8 index, int first, int second, int third, int fourth)
{
  const __m512i lowest = _mm512_set4_epi32(0x0c0c0c0c, 0x08080808, 0x04040404, 0);
  const std::int32_t bytes = first | second << 8 | third << 16 | fourth << 24;
  return _mm512_add_epi8(_mm512_shuffle_epi8(index.v, lowest), _mm512_set1_epi32(bytes));
}

/// The highest bits of a lane as a number of type Value.
template <class Value>
TETRALUX_INLINE Float8 TakeHighest(Int8 a)
{
  constexpr int Rest = 32 - 8 * static_cast<int>(sizeof(Value));
  return ToFloat(std::is_signed_v<Value> ? ShiftRightSigned(a, Rest) : ShiftRight(a, Rest));
}

/// Interpolation along x in two neighbouring rows of a box. index: where in the box each lane's
/// first value is, in bytes. w: 0..1.
template <class Value, int Slice, class Box>
TETRALUX_INLINE void MixRows(const Box& box, Int8 index, Float8 w, Float8& first, Float8& second)
{
  constexpr int A = Slice * Box::SliceBytes;
  constexpr int B = A + Box::RowBytes;
  if constexpr (sizeof(Value) == 1)
  {
    const Int8 both = box.LookUp(SpreadBytes(index, A, A + 1, B, B + 1));
    first =
      Mix(TakeHighest<Value>(ShiftLeft(both, 24)), TakeHighest<Value>(ShiftLeft(both, 16)), w);
    second = Mix(TakeHighest<Value>(ShiftLeft(both, 8)), TakeHighest<Value>(both), w);
  }
  else
  {
    const auto mix = [&](int at)
    {
      const Int8 pair = box.LookUp(SpreadBytes(index, at, at + 1, at + 2, at + 3));
      return Mix(TakeHighest<Value>(ShiftLeft(pair, 16)), TakeHighest<Value>(pair), w);
    };
    first = mix(A);
    second = mix(B);
  }
}

/// The cells that the rays of a vector may meet in the slabs of a block: a lane for each slab.
struct CellBounds
{
  static_assert(LaneCount == SlabsOfBlock, "a lane for each slab");

  /// Seen from a cell that one of the rays is near.
  ///@{
  Float8 Low[3], High[3];
  Float8 Corner[3]; ///< of the cells that the rays are near, a lane for each ray
  ///@}
  float Reference[3]; ///< that cell
  Mask8 Valid;

  /// hasPart: the rays that count.
  TETRALUX_INLINE CellBounds(
    const ImageKernelInput& in, const BlockPositions& positions, Mask8 hasPart)
  {
    // Far above the rounding of positions, which are within MostStep slabs of their cells.
    constexpr float Margin = 1e-3f;  // points
    constexpr float MostStep = 16.f; // points a slab
    const Float8 middle(_mm512_setr_ps(0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f, 8.5f, 9.5f,
      10.5f, 11.5f, 12.5f, 13.5f, 14.5f, 15.5f));
    const auto least = [&](Float8 x) { return _mm512_mask_reduce_min_ps(hasPart.v, x.v); };
    const auto most = [&](Float8 x) { return _mm512_mask_reduce_max_ps(hasPart.v, x.v); };
    const int lane = Any(hasPart) ? __builtin_ctz(Bits(hasPart)) : 0;
    bool valid = true;
    for (int a = 0; a < 3; ++a)
    {
      const float reference = -Lane(positions.Low[a], lane);
      this->Reference[a] = reference;
      this->Corner[a] = (Float8(0.f) - positions.Low[a]) - Float8(reference);
      const Float8 base = this->Corner[a] + positions.Base[a];
      const float leastStep = least(positions.Step[a]);
      const float mostStep = most(positions.Step[a]);
      valid = valid && leastStep >= -MostStep && mostStep <= MostStep;
      // As PlaceSample finds them.
      const auto getCell = [&](Float8 x)
      {
        const Float8 cell(_mm512_roundscale_ps(x.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
        const float last = static_cast<float>(in.LastCell[a]);
        return Min(Max(cell, Float8(-reference)), Float8(last - reference));
      };
      this->Low[a] = getCell(Fma(middle, Float8(leastStep), Float8(least(base) - Margin)));
      this->High[a] = getCell(Fma(middle, Float8(mostStep), Float8(most(base) + Margin)));
    }
    this->Valid = MaskFromBits(valid ? AllLanes : 0);
  }
};

/// The boxes of a vector in the slabs of a block.
template <class Value, class Box>
class VoxelBoxes
{
public:
  TETRALUX_INLINE void Place(const ImageKernelInput& in, const CellBounds& cells)
  {
    constexpr int Size[3] = { Box::RowBytes / ValueBytes, Box::Rows, Box::Slices };
    const std::int32_t strides[3] = { 1, in.Row, in.Slice };
    Mask8 fits = cells.Valid;
    Int8 first = 0;
    Int8 local = 0;
    this->Corner = 0;
    for (int a = 0; a < 3; ++a)
    {
      const auto lastBegin = static_cast<float>(in.LastCell[a] + 2 - Size[a]);
      const Float8 begin = Min(cells.Low[a], Float8(lastBegin - cells.Reference[a]));
      fits = fits & (Float8(-cells.Reference[a]) <= begin) &
        (cells.High[a] <= begin + Float8(static_cast<float>(Size[a] - 2)));
      const Int8 cell = RoundToInt(begin);
      const Int8 reference = static_cast<std::int32_t>(cells.Reference[a]);
      first = first + (cell + reference) * Int8(strides[a]);
      local = local + cell * Int8(Steps[a]);
      this->Corner = this->Corner + RoundToInt(cells.Corner[a]) * Int8(Steps[a]);
    }
    this->Fits = Bits(fits);
    Store(this->First, first);
    Store(this->Local, local);
  }

  /// Slabs that have one, a bit each.
  unsigned GetSlabs() const { return this->Fits; }

  /// The values in the middle of a slab that has one.
  TETRALUX_INLINE Float8 Interpolate(
    const ImageKernelInput& in, const BlockPositions& positions, std::int32_t slab) const
  {
    const Float8 way = static_cast<float>(slab) + 0.5f;
    Float8 w[3];
    Int8 index = this->Corner - Int8(this->Local[slab]);
    for (int a = 0; a < 3; ++a)
    {
      index = index + PlaceAlong(positions, a, way, w[a]) * Int8(Steps[a]);
    }
    constexpr std::int64_t Bytes = ValueBytes;
    const std::int64_t first = static_cast<std::uint32_t>(this->First[slab]);
    Box box;
    box.Load(static_cast<const char*>(in.Values) + first * Bytes, in.Row * Bytes, in.Slice * Bytes);
    Float8 a, b, c, d;
    MixRows<Value, 0>(box, index, w[0], a, b);
    MixRows<Value, 1>(box, index, w[0], c, d);
    return Mix(Mix(a, b, w[1]), Mix(c, d, w[1]), w[2]);
  }

private:
  static constexpr int ValueBytes = sizeof(Value);
  static constexpr int Steps[3] = { ValueBytes, Box::RowBytes, Box::SliceBytes };

  std::int32_t First[LaneCount]; ///< value of the box in each slab
  std::int32_t Local[LaneCount]; ///< where that is, in bytes of boxes
  Int8 Corner;                   ///< the same of the cell that each ray is near
  unsigned Fits = 0;
};

/// Values of cells that no box holds, by single loads. Gathers take as long, and more places of the
/// processor's window of instructions.
template <class Value>
class SingleLoads
{
public:
  /// index: of each cell's first value.
  TETRALUX_INLINE SingleLoads(const ImageKernelInput& in, Int8 index)
    : Values(static_cast<const char*>(in.Values))
  {
    Store(reinterpret_cast<std::int32_t*>(this->Index), index);
    // The compiler would rather take them out of the vector, by twice as many instructions.
    __asm__("" : "+m"(this->Index));
  }

  /// Trilinear interpolation. w: 0..1 along each axis.
  TETRALUX_INLINE Float8 Interpolate(const ImageKernelInput& in, const Float8 (&w)[3]) const
  {
    const std::int64_t row = in.Row;
    const std::int64_t back = in.Slice;
    const Float8 a = this->MixRow(0, w[0]);
    const Float8 b = this->MixRow(row, w[0]);
    const Float8 c = this->MixRow(back, w[0]);
    const Float8 d = this->MixRow(back + row, w[0]);
    return Mix(Mix(a, b, w[1]), Mix(c, d, w[1]), w[2]);
  }

private:
  static constexpr std::int64_t Bytes = sizeof(Value);

  /// Between the values so far behind the cells' first ones, and the next.
  TETRALUX_INLINE Float8 MixRow(std::int64_t offset, Float8 w) const
  {
    const char* row = this->Values + offset * Bytes;
    if constexpr (Bytes == 1)
    {
      const Int8 pairs(
        _mm512_cvtepu16_epi32(_mm256_set_m128i(this->LoadEight(row, 8), this->LoadEight(row, 0))));
      return Mix(
        TakeHighest<Value>(ShiftLeft(pairs, 24)), TakeHighest<Value>(ShiftLeft(pairs, 16)), w);
    }
    else if constexpr (Bytes == 2)
    {
      const Int8 pairs(Join(this->LoadFour(row, 0), this->LoadFour(row, 4), this->LoadFour(row, 8),
        this->LoadFour(row, 12)));
      return Mix(TakeHighest<Value>(ShiftLeft(pairs, 16)), TakeHighest<Value>(pairs), w);
    }
    else
    {
      const auto eight = [&](int lane)
      {
        return _mm512_castsi512_ps(Join(this->LoadTwo(row, lane), this->LoadTwo(row, lane + 2),
          this->LoadTwo(row, lane + 4), this->LoadTwo(row, lane + 6)));
      };
      Float8 a, b;
      SplitPairs(eight(0), eight(8), a.v, b.v);
      return Mix(a, b, w);
    }
  }

  static TETRALUX_INLINE __m512i Join(__m128i a, __m128i b, __m128i c, __m128i d)
  {
    return _mm512_inserti32x8(
      _mm512_castsi256_si512(_mm256_set_m128i(b, a)), _mm256_set_m128i(d, c), 1);
  }

  /// Two values of a lane.
  template <class Pair>
  TETRALUX_INLINE Pair LoadPair(const char* row, int lane) const
  {
    Pair pair;
    std::memcpy(&pair, row + this->Index[lane] * Bytes, sizeof(pair));
    return pair;
  }
  /// Those of lanes from one on.
  ///@{
  TETRALUX_INLINE __m128i LoadEight(const char* row, int lane) const
  {
    const auto load = [&](int l) { return int{ this->LoadPair<std::uint16_t>(row, lane + l) }; };
    __m128i eight = _mm_cvtsi32_si128(load(0));
    eight = _mm_insert_epi16(eight, load(1), 1);
    eight = _mm_insert_epi16(eight, load(2), 2);
    eight = _mm_insert_epi16(eight, load(3), 3);
    eight = _mm_insert_epi16(eight, load(4), 4);
    eight = _mm_insert_epi16(eight, load(5), 5);
    eight = _mm_insert_epi16(eight, load(6), 6);
    return _mm_insert_epi16(eight, load(7), 7);
  }
  TETRALUX_INLINE __m128i LoadFour(const char* row, int lane) const
  {
    const auto load = [&](int l) { return this->LoadPair<std::int32_t>(row, lane + l); };
    __m128i four = _mm_cvtsi32_si128(load(0));
    four = _mm_insert_epi32(four, load(1), 1);
    four = _mm_insert_epi32(four, load(2), 2);
    return _mm_insert_epi32(four, load(3), 3);
  }
  TETRALUX_INLINE __m128i LoadTwo(const char* row, int lane) const
  {
    return _mm_castpd_si128(
      _mm_set_pd(this->LoadPair<double>(row, lane + 1), this->LoadPair<double>(row, lane)));
  }
  ///@}

  const char* Values;
  alignas(64) std::uint32_t Index[LaneCount];
};

/// Values in the middle of slabs, from the smallest boxes that have them.
template <class Value>
class BoxedValues
{
public:
  TETRALUX_NOINLINE BoxedValues(
    const ImageKernelInput& in, const BlockPositions& positions, Mask8 hasPart)
  {
    const CellBounds cells(in, positions, hasPart);
    this->Small.Place(in, cells);
    if (this->Small.GetSlabs() != AllLanes)
    {
      this->Large.Place(in, cells);
    }
  }

  /// Returns whether the cells are in a box, and the values if so.
  TETRALUX_INLINE bool Find(const ImageKernelInput& in, const BlockPositions& positions,
    std::int32_t slab, Float8& values) const
  {
    if ((this->Small.GetSlabs() >> slab & 1u) != 0)
    {
      values = this->Small.Interpolate(in, positions, slab);
      return true;
    }
    if ((this->Large.GetSlabs() >> slab & 1u) != 0)
    {
      values = this->Large.Interpolate(in, positions, slab);
      return true;
    }
    return false;
  }

private:
  VoxelBoxes<Value, SmallBox> Small;
  VoxelBoxes<Value, LargeBox> Large;
};

/// Voxels of four bytes have no boxes.
template <>
class BoxedValues<float>
{
public:
  BoxedValues(const ImageKernelInput&, const BlockPositions&, Mask8) {}
  static bool Find(const ImageKernelInput&, const BlockPositions&, std::int32_t, Float8&)
  {
    return false;
  }
};

/// The scalars of the samples in the middle of slabs, found some slabs ahead.
template <class Value>
class ScalarsAhead
{
public:
  static constexpr bool Exist = true;

  /// For the rays of a vector in a block of slabs.
  TETRALUX_INLINE ScalarsAhead(
    const ImageKernelInput& in, const BlockPositions& positions, Mask8 hasPart)
    : Positions(positions)
    , Boxes(in, positions, hasPart)
  {
  }

  /// Those of a slab of the block. end: the first one whose samples are not in the middle.
  TETRALUX_INLINE Float8 Get(const ImageKernelInput& in, std::int32_t slab, std::int32_t end)
  {
    if (slab >= this->End)
    {
      this->Begin = slab;
      this->End = std::min(slab + SlabsAhead, end);
      this->Find(in);
    }
    return LoadFloat8(this->Scalars[slab - this->Begin]);
  }

private:
  /// Few, since rays may end before.
  static constexpr int SlabsAhead = 8;

  TETRALUX_NOINLINE void Find(const ImageKernelInput& in)
  {
    for (std::int32_t slab = this->Begin; slab < this->End; ++slab)
    {
      Float8 value;
      if (!this->Boxes.Find(in, this->Positions, slab, value))
      {
        ImageSample sample;
        PlaceSample(in, this->Positions, Float8(static_cast<float>(slab) + 0.5f), sample);
        value = SingleLoads<Value>(in, sample.Index).Interpolate(in, sample.Place);
      }
      Store(this->Scalars[slab - this->Begin], FindScalar(in, value));
    }
  }

  const BlockPositions& Positions;
  BoxedValues<Value> Boxes;
  std::int32_t Begin = 0;
  std::int32_t End = 0;
  float Scalars[SlabsAhead][LaneCount];
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
