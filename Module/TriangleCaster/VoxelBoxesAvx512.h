// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VoxelBoxesAvx512_h
#define tetralux_VoxelBoxesAvx512_h

// Values of samples ahead of their compositing, 16 lanes by AVX-512 with VBMI. The rays of a vector
// are close together: where all their cells of a slab are within a box of 128 bytes, it is loaded
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

/// Voxels of a box: rows of 8 bytes, 4 of them in a slice, 4 slices.
struct VoxelBox
{
  static constexpr int RowBytes = 8;
  static constexpr int Rows = 4;
  static constexpr int Slices = 4;
  static constexpr int SliceBytes = RowBytes * Rows;

  __m512i Front, Back; ///< two slices each

  /// at: the first voxel. row, slice: bytes from one to the next.
  TETRALUX_INLINE void Load(const char* at, std::int64_t row, std::int64_t slice)
  {
    this->Front = LoadSlices(at, row, slice);
    this->Back = LoadSlices(at + 2 * slice, row, slice);
  }

  /// The bytes with these indices, of two slices.
  TETRALUX_INLINE Int8 LookUp(__m512i index) const
  {
    return Int8(_mm512_permutex2var_epi8(this->Front, index, this->Back));
  }

private:
  static TETRALUX_INLINE __m128i LoadTwoRows(const char* at, std::int64_t row)
  {
    double first, second;
    std::memcpy(&first, at, RowBytes);
    std::memcpy(&second, at + row, RowBytes);
    return _mm_castpd_si128(_mm_set_pd(second, first));
  }
  static TETRALUX_INLINE __m256i LoadSlice(const char* at, std::int64_t row)
  {
    return _mm256_set_m128i(LoadTwoRows(at + 2 * row, row), LoadTwoRows(at, row));
  }
  static TETRALUX_INLINE __m512i LoadSlices(const char* at, std::int64_t row, std::int64_t slice)
  {
    return _mm512_inserti32x8(
      _mm512_castsi256_si512(LoadSlice(at, row)), LoadSlice(at + slice, row), 1);
  }
};

/// The four bytes from each lane's on.
TETRALUX_INLINE __m512i SpreadBytes(Int8 index, std::int32_t bytes)
{
  const __m512i lowest = _mm512_set4_epi32(0x0c0c0c0c, 0x08080808, 0x04040404, 0);
  return _mm512_add_epi8(_mm512_shuffle_epi8(index.v, lowest), _mm512_set1_epi32(bytes));
}

/// Interpolation along x in two neighbouring rows of a box. index: where in the box each lane's
/// first value is, in bytes. w: 0..1.
///@{
template <class Value>
struct BoxRows;

template <class Value>
struct ByteRows
{
  /// first: of the four bytes, 0 or 2.
  template <int First>
  static TETRALUX_INLINE Float8 MixRow(Int8 bytes, Float8 w)
  {
    const auto get = [&](int bits)
    {
      const Int8 high = ShiftLeft(bytes, bits);
      return ToFloat(
        std::is_signed<Value>::value ? ShiftRightSigned(high, 24) : ShiftRight(high, 24));
    };
    const Float8 a = get(24 - 8 * First);
    const Float8 b = get(16 - 8 * First);
    return Mix(a, b, w);
  }
  template <int Slice>
  static TETRALUX_INLINE void Mix2(
    const VoxelBox& box, Int8 index, Float8 w, Float8& first, Float8& second)
  {
    constexpr std::int32_t Offset = 0x01010101 * Slice * VoxelBox::SliceBytes;
    constexpr std::int32_t Bytes = 0x00000100 + 0x01010000 * VoxelBox::RowBytes + 0x01000000;
    const Int8 bytes = box.LookUp(SpreadBytes(index, Bytes + Offset));
    first = MixRow<0>(bytes, w);
    second = MixRow<2>(bytes, w);
  }
};
template <>
struct BoxRows<std::int8_t> : ByteRows<std::int8_t>
{
};
template <>
struct BoxRows<std::uint8_t> : ByteRows<std::uint8_t>
{
};

template <class Value>
struct WordRows
{
  static TETRALUX_INLINE Float8 MixRow(Int8 words, Float8 w)
  {
    const auto get = [](Int8 high)
    {
      return ToFloat(
        std::is_signed<Value>::value ? ShiftRightSigned(high, 16) : ShiftRight(high, 16));
    };
    return Mix(get(ShiftLeft(words, 16)), get(words), w);
  }
  template <int Slice>
  static TETRALUX_INLINE void Mix2(
    const VoxelBox& box, Int8 index, Float8 w, Float8& first, Float8& second)
  {
    constexpr std::int32_t Offset = 0x01010101 * Slice * VoxelBox::SliceBytes;
    constexpr std::int32_t Bytes = 0x03020100;
    constexpr std::int32_t Next = 0x01010101 * VoxelBox::RowBytes;
    first = MixRow(box.LookUp(SpreadBytes(index, Bytes + Offset)), w);
    second = MixRow(box.LookUp(SpreadBytes(index, Bytes + Offset + Next)), w);
  }
};
template <>
struct BoxRows<std::int16_t> : WordRows<std::int16_t>
{
};
template <>
struct BoxRows<std::uint16_t> : WordRows<std::uint16_t>
{
};
///@}

/// The boxes of a vector in the slabs of a block: a lane for each slab.
template <class Value>
class VoxelBoxes
{
public:
  static constexpr int Width = VoxelBox::RowBytes / static_cast<int>(sizeof(Value));
  static_assert(LaneCount == SlabsOfBlock, "a lane for each slab");

  /// hasPart: the rays that go through the block.
  TETRALUX_NOINLINE VoxelBoxes(
    const ImageKernelInput& in, const BlockPositions& positions, Mask8 hasPart)
  {
    constexpr int Size[3] = { Width, VoxelBox::Rows, VoxelBox::Slices };
    constexpr int Bytes[3] = { static_cast<int>(sizeof(Value)), VoxelBox::RowBytes,
      VoxelBox::SliceBytes };
    // Far above the rounding of positions, which are within MostStep slabs of their cells.
    constexpr float Margin = 1e-3f;
    constexpr float MostStep = 16.f; // points
    const std::int32_t strides[3] = { 1, in.Row, in.Slice };
    const Float8 middle(_mm512_setr_ps(0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f, 8.5f, 9.5f,
      10.5f, 11.5f, 12.5f, 13.5f, 14.5f, 15.5f));
    const int lane = hasPart.v == 0 ? 0 : __builtin_ctz(hasPart.v);
    Mask8 fits = MaskFromBits(AllLanes);
    Int8 first = 0;
    Int8 local = 0;
    this->Corner = 0;
    for (int a = 0; a < 3; ++a)
    {
      // Seen from the cell that one ray is near.
      const float last = static_cast<float>(in.LastCell[a]);
      const float reference = -Lane(positions.Low[a], lane);
      const Float8 corner = (Float8(0.f) - positions.Low[a]) - Float8(reference);
      const Float8 base = corner + positions.Base[a];
      const auto least = [&](Float8 x) { return _mm512_mask_reduce_min_ps(hasPart.v, x.v); };
      const auto most = [&](Float8 x) { return _mm512_mask_reduce_max_ps(hasPart.v, x.v); };
      const float leastStep = least(positions.Step[a]);
      const float mostStep = most(positions.Step[a]);
      // Cells of the volume, as PlaceSample has them.
      const auto getCell = [&](Float8 x)
      {
        const Float8 cell(_mm512_roundscale_ps(x.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
        return Min(Max(cell, Float8(-reference)), Float8(last - reference));
      };
      const Float8 low = getCell(Fma(middle, Float8(leastStep), Float8(least(base) - Margin)));
      const Float8 high = getCell(Fma(middle, Float8(mostStep), Float8(most(base) + Margin)));
      const float start = last + 2.f - static_cast<float>(Size[a]) - reference;
      const Float8 begin = Min(low, Float8(start));
      fits = fits & (Float8(-reference) <= begin) &
        (high <= begin + Float8(static_cast<float>(Size[a] - 2)));
      if (!(leastStep >= -MostStep && mostStep <= MostStep))
      {
        fits = MaskFromBits(0);
      }
      const Int8 cell = RoundToInt(begin);
      first = first + (cell + Int8(static_cast<std::int32_t>(reference))) * Int8(strides[a]);
      local = local + cell * Int8(Bytes[a]);
      this->Corner = this->Corner + RoundToInt(corner) * Int8(Bytes[a]);
    }
    this->Fits = Bits(fits);
    Store(this->First, first);
    Store(this->Local, local);
  }

  /// Whether a slab of the block has one.
  TETRALUX_INLINE bool Has(std::int32_t slab) const { return (this->Fits >> slab & 1u) != 0; }

  /// The values in the middle of a slab that has one.
  TETRALUX_INLINE Float8 Interpolate(
    const ImageKernelInput& in, const BlockPositions& positions, std::int32_t slab) const
  {
    constexpr int Bytes[3] = { static_cast<int>(sizeof(Value)), VoxelBox::RowBytes,
      VoxelBox::SliceBytes };
    const Float8 way = static_cast<float>(slab) + 0.5f;
    Float8 w[3];
    Int8 index = this->Corner - Int8(this->Local[slab]);
    for (int a = 0; a < 3; ++a)
    {
      index = index + PlaceAlong(positions, a, way, w[a]) * Int8(Bytes[a]);
    }
    const std::int64_t size = sizeof(Value);
    VoxelBox box;
    box.Load(static_cast<const char*>(in.Values) +
        static_cast<std::int64_t>(static_cast<std::uint32_t>(this->First[slab])) * size,
      in.Row * size, in.Slice * size);
    Float8 a, b, c, d;
    BoxRows<Value>::template Mix2<0>(box, index, w[0], a, b);
    BoxRows<Value>::template Mix2<1>(box, index, w[0], c, d);
    return Mix(Mix(a, b, w[1]), Mix(c, d, w[1]), w[2]);
  }

private:
  std::int32_t First[LaneCount]; ///< value of the box in each slab
  std::int32_t Local[LaneCount]; ///< where that is, in bytes of boxes
  Int8 Corner;                   ///< the same of the cell that each ray is near
  unsigned Fits;
};

/// Voxels of four bytes have none.
struct NoVoxelBoxes
{
  NoVoxelBoxes(const ImageKernelInput&, const BlockPositions&, Mask8) {}
  static constexpr bool Has(std::int32_t) { return false; }
  static Float8 Interpolate(const ImageKernelInput&, const BlockPositions&, std::int32_t)
  {
    return 0.f;
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
  static constexpr int SlabsAhead = 4;

  TETRALUX_NOINLINE void Find(const ImageKernelInput& in)
  {
    for (std::int32_t slab = this->Begin; slab < this->End; ++slab)
    {
      Float8 value;
      if (this->Boxes.Has(slab))
      {
        value = this->Boxes.Interpolate(in, this->Positions, slab);
      }
      else
      {
        ImageSample sample;
        PlaceSample(in, this->Positions, Float8(static_cast<float>(slab) + 0.5f), sample);
        value = sample.GetValue<Value>(in);
      }
      Store(this->Scalars[slab - this->Begin], FindScalar(in, value));
    }
  }

  const BlockPositions& Positions;
  std::conditional_t<std::is_same_v<Value, float>, NoVoxelBoxes, VoxelBoxes<Value>> Boxes;
  std::int32_t Begin = 0;
  std::int32_t End = 0;
  float Scalars[SlabsAhead][LaneCount];
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
