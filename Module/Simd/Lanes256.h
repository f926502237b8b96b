// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Lanes256_h
#define tetralux_Lanes256_h

// Integers and floats of eight lanes in registers of 256 bits: what LanesAvx2.h and LanesAvx512.h
// share. What makes or takes masks is theirs, and doubles.

#include "Simd/LaneCount.h"

#include <cstdint>
#include <cstring>

#include <immintrin.h>

namespace tetralux
{
namespace TETRALUX_ISA
{

struct Int8
{
  __m256i v;
  Int8() = default;
  TETRALUX_INLINE explicit Int8(__m256i x)
    : v(x)
  {
  }
  TETRALUX_INLINE Int8(std::int32_t x)
    : v(_mm256_set1_epi32(x))
  {
  }
};
struct Float8
{
  __m256 v;
  Float8() = default;
  TETRALUX_INLINE explicit Float8(__m256 x)
    : v(x)
  {
  }
  TETRALUX_INLINE Float8(float x)
    : v(_mm256_set1_ps(x))
  {
  }
};

// Integers.
TETRALUX_INLINE Int8 operator+(Int8 a, Int8 b) { return Int8(_mm256_add_epi32(a.v, b.v)); }
TETRALUX_INLINE Int8 operator-(Int8 a, Int8 b) { return Int8(_mm256_sub_epi32(a.v, b.v)); }
TETRALUX_INLINE Int8 operator*(Int8 a, Int8 b) { return Int8(_mm256_mullo_epi32(a.v, b.v)); }
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, int bits) { return Int8(_mm256_slli_epi32(a.v, bits)); }
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, Int8 bits) { return Int8(_mm256_sllv_epi32(a.v, bits.v)); }
TETRALUX_INLINE Int8 ShiftRight(Int8 a, int bits) { return Int8(_mm256_srli_epi32(a.v, bits)); }
TETRALUX_INLINE Int8 ShiftRightSigned(Int8 a, int bits)
{
  return Int8(_mm256_srai_epi32(a.v, bits));
}
TETRALUX_INLINE void Store(std::int32_t* p, Int8 a)
{
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v);
}
TETRALUX_INLINE Int8 LoadInt8(const std::int32_t* p)
{
  return Int8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
}

// Single precision.
TETRALUX_INLINE Float8 operator+(Float8 a, Float8 b) { return Float8(_mm256_add_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 operator-(Float8 a, Float8 b) { return Float8(_mm256_sub_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 operator*(Float8 a, Float8 b) { return Float8(_mm256_mul_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 operator/(Float8 a, Float8 b) { return Float8(_mm256_div_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 Fma(Float8 a, Float8 b, Float8 c)
{
  return Float8(_mm256_fmadd_ps(a.v, b.v, c.v));
}
TETRALUX_INLINE Float8 Min(Float8 a, Float8 b) { return Float8(_mm256_min_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 Max(Float8 a, Float8 b) { return Float8(_mm256_max_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 Abs(Float8 a) { return Float8(_mm256_andnot_ps(_mm256_set1_ps(-0.f), a.v)); }
TETRALUX_INLINE Float8 Sqrt(Float8 a) { return Float8(_mm256_sqrt_ps(a.v)); }
TETRALUX_INLINE void Store(float* p, Float8 a) { _mm256_storeu_ps(p, a.v); }
TETRALUX_INLINE Float8 LoadFloat8(const float* p) { return Float8(_mm256_loadu_ps(p)); }
TETRALUX_INLINE Int8 RoundToInt(Float8 a) { return Int8(_mm256_cvtps_epi32(a.v)); }
TETRALUX_INLINE Float8 ToFloat(Int8 a) { return Float8(_mm256_cvtepi32_ps(a.v)); }
TETRALUX_INLINE Float8 FromBits(Int8 a) { return Float8(_mm256_castsi256_ps(a.v)); }
TETRALUX_INLINE Int8 ToBits(Float8 a) { return Int8(_mm256_castps_si256(a.v)); }

// Kahan's algorithm (Jeannerod, Louvet, Muller, Further analysis of Kahan's algorithm, 2013).
TETRALUX_INLINE Float8 DifferenceOfProducts(Float8 a, Float8 b, Float8 c, Float8 d)
{
  const __m256 cd = _mm256_mul_ps(c.v, d.v);
  const __m256 error = _mm256_fnmadd_ps(c.v, d.v, cd);
  return Float8(_mm256_add_ps(_mm256_fmsub_ps(a.v, b.v, cd), error));
}

// Gathers. Indices below 2^29 let four times an index fit 32 bits. Extending that to an address and
// scaling it by 8 are free.

/// Keeps indices in memory, so that they are loaded one by one. The compiler would rather take them
/// out of the vector, by twice as many instructions.
TETRALUX_INLINE void KeepInMemory(std::uint32_t (&indices)[LaneCount])
{
  __asm__("" : "+m"(indices));
}

TETRALUX_INLINE void GatherRows(
  const float* base, Int8 index, Float8& x, Float8& y, Float8& z, Float8& s)
{
  alignas(32) std::uint32_t i[LaneCount];
  Store(reinterpret_cast<std::int32_t*>(i), ShiftLeft(index, 1));
  KeepInMemory(i);
  const auto at = [&](int lane)
  { return reinterpret_cast<const float*>(reinterpret_cast<const double*>(base) + i[lane]); };
  const auto row = [&](int a, int b) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(at(a))), _mm_load_ps(at(b)), 1);
  };
  const __m256 r0 = row(0, 4), r1 = row(1, 5), r2 = row(2, 6), r3 = row(3, 7);
  const __m256 t0 = _mm256_unpacklo_ps(r0, r1), t1 = _mm256_unpackhi_ps(r0, r1);
  const __m256 t2 = _mm256_unpacklo_ps(r2, r3), t3 = _mm256_unpackhi_ps(r2, r3);
  x.v = _mm256_shuffle_ps(t0, t2, _MM_SHUFFLE(1, 0, 1, 0));
  y.v = _mm256_shuffle_ps(t0, t2, _MM_SHUFFLE(3, 2, 3, 2));
  z.v = _mm256_shuffle_ps(t1, t3, _MM_SHUFFLE(1, 0, 1, 0));
  s.v = _mm256_shuffle_ps(t1, t3, _MM_SHUFFLE(3, 2, 3, 2));
}
/// The rows of base at the indices, for LoadRows.
TETRALUX_INLINE void FindRows(const double* base, Int8 index, const double* (&row)[LaneCount])
{
  alignas(32) std::uint32_t i[LaneCount];
  Store(reinterpret_cast<std::int32_t*>(i), ShiftLeft(index, 2));
  KeepInMemory(i);
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    row[lane] = base + i[lane];
  }
}
TETRALUX_INLINE void GatherPairs(const std::int32_t* base, Int8 index, Int8& first, Int8& second)
{
  alignas(32) std::uint32_t i[LaneCount];
  Store(reinterpret_cast<std::int32_t*>(i), index);
  KeepInMemory(i);
  const auto* pairs = reinterpret_cast<const double*>(base);
  const auto two = [&](int a, int b)
  { return _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(pairs + i[a]), pairs + i[b])); };
  const __m256 lo = _mm256_insertf128_ps(_mm256_castps128_ps256(two(0, 1)), two(4, 5), 1);
  const __m256 hi = _mm256_insertf128_ps(_mm256_castps128_ps256(two(2, 3)), two(6, 7), 1);
  first.v = _mm256_castps_si256(_mm256_shuffle_ps(lo, hi, _MM_SHUFFLE(2, 0, 2, 0)));
  second.v = _mm256_castps_si256(_mm256_shuffle_ps(lo, hi, _MM_SHUFFLE(3, 1, 3, 1)));
}

// Functions, since large files of kernels no longer inline lambdas of this size.
TETRALUX_INLINE std::int32_t LoadWord(const void* base, std::uint32_t offset)
{
  std::int32_t word;
  std::memcpy(&word, static_cast<const char*>(base) + offset, sizeof(word));
  return word;
}
TETRALUX_INLINE __m128i LoadFourWords(const void* base, const std::uint32_t* offsets)
{
  const __m128i a =
    _mm_insert_epi32(_mm_cvtsi32_si128(LoadWord(base, offsets[0])), LoadWord(base, offsets[1]), 1);
  return _mm_insert_epi32(
    _mm_insert_epi32(a, LoadWord(base, offsets[2]), 2), LoadWord(base, offsets[3]), 3);
}
TETRALUX_INLINE Int8 GatherWords(const void* base, Int8 index)
{
  alignas(32) std::uint32_t i[LaneCount];
  Store(reinterpret_cast<std::int32_t*>(i), index);
  KeepInMemory(i);
  return Int8(_mm256_set_m128i(LoadFourWords(base, i + 4), LoadFourWords(base, i)));
}
TETRALUX_INLINE void GatherNeighbors(const float* base, Int8 index, Float8& first, Float8& second)
{
  alignas(32) std::uint32_t i[LaneCount];
  Store(reinterpret_cast<std::int32_t*>(i), index);
  KeepInMemory(i);
  // Pairs are aligned as one float is.
  const auto at = [&](int lane)
  {
    double pair;
    std::memcpy(&pair, base + i[lane], sizeof(pair));
    return pair;
  };
  const auto two = [&](int a, int b) { return _mm_castpd_ps(_mm_set_pd(at(b), at(a))); };
  const __m256 lo = _mm256_insertf128_ps(_mm256_castps128_ps256(two(0, 1)), two(4, 5), 1);
  const __m256 hi = _mm256_insertf128_ps(_mm256_castps128_ps256(two(2, 3)), two(6, 7), 1);
  first.v = _mm256_shuffle_ps(lo, hi, _MM_SHUFFLE(2, 0, 2, 0));
  second.v = _mm256_shuffle_ps(lo, hi, _MM_SHUFFLE(3, 1, 3, 1));
}

TETRALUX_INLINE Float8 LookUp(const float (&table)[LaneCount], Int8 index)
{
  return Float8(_mm256_permutevar8x32_ps(_mm256_loadu_ps(table), index.v));
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
