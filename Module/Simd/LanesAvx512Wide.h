// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LanesAvx512Wide_h
#define tetralux_LanesAvx512Wide_h

// The lanes of Lanes.h for AVX-512, 16 of them. Only Lanes.h includes this; it says what each
// operation does. Results are the same bits as those of LanesAvx2.h.

#include "Simd/LaneCount.h"

#include <cstdint>

#include <immintrin.h>

namespace tetralux
{
namespace TETRALUX_ISA
{

struct Mask8
{
  __mmask16 v;
};
struct Int8
{
  __m512i v;
  Int8() = default;
  TETRALUX_INLINE explicit Int8(__m512i x)
    : v(x)
  {
  }
  TETRALUX_INLINE Int8(std::int32_t x)
    : v(_mm512_set1_epi32(x))
  {
  }
};
struct Float8
{
  __m512 v;
  Float8() = default;
  TETRALUX_INLINE explicit Float8(__m512 x)
    : v(x)
  {
  }
  TETRALUX_INLINE Float8(float x)
    : v(_mm512_set1_ps(x))
  {
  }
};
struct Double8
{
  __m512d lo, hi;
  Double8() = default;
  TETRALUX_INLINE Double8(__m512d a, __m512d b)
    : lo(a)
    , hi(b)
  {
  }
  TETRALUX_INLINE Double8(double x)
    : lo(_mm512_set1_pd(x))
    , hi(lo)
  {
  }
};

// Masks.
TETRALUX_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return { _kand_mask16(a.v, b.v) }; }
TETRALUX_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return { _kor_mask16(a.v, b.v) }; }
TETRALUX_INLINE Mask8 AndNot(Mask8 a, Mask8 b) { return { _kandn_mask16(b.v, a.v) }; }
TETRALUX_INLINE unsigned Bits(Mask8 m) { return _cvtmask16_u32(m.v); }
TETRALUX_INLINE Mask8 MaskFromBits(unsigned bits) { return { _cvtu32_mask16(bits) }; }
TETRALUX_INLINE bool Any(Mask8 m) { return m.v != 0; }
/// Those of the first and of the second eight lanes.
///@{
TETRALUX_INLINE __mmask8 GetLow(Mask8 m) { return static_cast<__mmask8>(m.v); }
TETRALUX_INLINE __mmask8 GetHigh(Mask8 m) { return static_cast<__mmask8>(m.v >> 8); }
///@}

// Integers.
TETRALUX_INLINE Int8 operator+(Int8 a, Int8 b) { return Int8(_mm512_add_epi32(a.v, b.v)); }
TETRALUX_INLINE Int8 operator-(Int8 a, Int8 b) { return Int8(_mm512_sub_epi32(a.v, b.v)); }
TETRALUX_INLINE Mask8 operator>(Int8 a, Int8 b) { return { _mm512_cmpgt_epi32_mask(a.v, b.v) }; }
TETRALUX_INLINE Mask8 operator==(Int8 a, Int8 b) { return { _mm512_cmpeq_epi32_mask(a.v, b.v) }; }
TETRALUX_INLINE Int8 operator*(Int8 a, Int8 b) { return Int8(_mm512_mullo_epi32(a.v, b.v)); }
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, int bits) { return Int8(_mm512_slli_epi32(a.v, bits)); }
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, Int8 bits) { return Int8(_mm512_sllv_epi32(a.v, bits.v)); }
TETRALUX_INLINE Int8 ShiftRight(Int8 a, int bits) { return Int8(_mm512_srli_epi32(a.v, bits)); }
TETRALUX_INLINE Int8 ShiftRightSigned(Int8 a, int bits)
{
  return Int8(_mm512_srai_epi32(a.v, bits));
}
TETRALUX_INLINE Int8 Ones(Mask8 m) { return Int8(_mm512_maskz_set1_epi32(m.v, 1)); }
TETRALUX_INLINE Int8 Select(Mask8 m, Int8 a, Int8 b)
{
  return Int8(_mm512_mask_blend_epi32(m.v, b.v, a.v));
}
TETRALUX_INLINE void Store(std::int32_t* p, Int8 a) { _mm512_storeu_si512(p, a.v); }
TETRALUX_INLINE Int8 LoadInt8(const std::int32_t* p) { return Int8(_mm512_loadu_si512(p)); }

// Single precision.
TETRALUX_INLINE Float8 operator+(Float8 a, Float8 b) { return Float8(_mm512_add_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 operator-(Float8 a, Float8 b) { return Float8(_mm512_sub_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 operator*(Float8 a, Float8 b) { return Float8(_mm512_mul_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 operator/(Float8 a, Float8 b) { return Float8(_mm512_div_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 Fma(Float8 a, Float8 b, Float8 c)
{
  return Float8(_mm512_fmadd_ps(a.v, b.v, c.v));
}
TETRALUX_INLINE Float8 Min(Float8 a, Float8 b) { return Float8(_mm512_min_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 Max(Float8 a, Float8 b) { return Float8(_mm512_max_ps(a.v, b.v)); }
TETRALUX_INLINE Float8 Abs(Float8 a) { return Float8(_mm512_andnot_ps(_mm512_set1_ps(-0.f), a.v)); }
TETRALUX_INLINE Float8 Sqrt(Float8 a) { return Float8(_mm512_sqrt_ps(a.v)); }
TETRALUX_INLINE Mask8 operator<(Float8 a, Float8 b)
{
  return { _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ) };
}
TETRALUX_INLINE Mask8 operator<=(Float8 a, Float8 b)
{
  return { _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ) };
}
TETRALUX_INLINE Mask8 operator==(Float8 a, Float8 b)
{
  return { _mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ) };
}
TETRALUX_INLINE Float8 Select(Mask8 m, Float8 a, Float8 b)
{
  return Float8(_mm512_mask_blend_ps(m.v, b.v, a.v));
}
TETRALUX_INLINE Float8 Keep(Mask8 m, Float8 a) { return Float8(_mm512_maskz_mov_ps(m.v, a.v)); }
TETRALUX_INLINE void Store(float* p, Float8 a) { _mm512_storeu_ps(p, a.v); }
TETRALUX_INLINE Float8 LoadFloat8(const float* p) { return Float8(_mm512_loadu_ps(p)); }
TETRALUX_INLINE Int8 RoundToInt(Float8 a) { return Int8(_mm512_cvtps_epi32(a.v)); }
TETRALUX_INLINE Float8 ToFloat(Int8 a) { return Float8(_mm512_cvtepi32_ps(a.v)); }
TETRALUX_INLINE Float8 FromBits(Int8 a) { return Float8(_mm512_castsi512_ps(a.v)); }
TETRALUX_INLINE Int8 ToBits(Float8 a) { return Int8(_mm512_castps_si512(a.v)); }

// Double precision.
TETRALUX_INLINE Double8 operator+(Double8 a, Double8 b)
{
  return { _mm512_add_pd(a.lo, b.lo), _mm512_add_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 operator-(Double8 a, Double8 b)
{
  return { _mm512_sub_pd(a.lo, b.lo), _mm512_sub_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 operator*(Double8 a, Double8 b)
{
  return { _mm512_mul_pd(a.lo, b.lo), _mm512_mul_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 operator/(Double8 a, Double8 b)
{
  return { _mm512_div_pd(a.lo, b.lo), _mm512_div_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 Fma(Double8 a, Double8 b, Double8 c)
{
  return { _mm512_fmadd_pd(a.lo, b.lo, c.lo), _mm512_fmadd_pd(a.hi, b.hi, c.hi) };
}
TETRALUX_INLINE Double8 Min(Double8 a, Double8 b)
{
  return { _mm512_min_pd(a.lo, b.lo), _mm512_min_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 Max(Double8 a, Double8 b)
{
  return { _mm512_max_pd(a.lo, b.lo), _mm512_max_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 Abs(Double8 a)
{
  const __m512d sign = _mm512_set1_pd(-0.);
  return { _mm512_andnot_pd(sign, a.lo), _mm512_andnot_pd(sign, a.hi) };
}
TETRALUX_INLINE Double8 Sqrt(Double8 a) { return { _mm512_sqrt_pd(a.lo), _mm512_sqrt_pd(a.hi) }; }
TETRALUX_INLINE Mask8 JoinMasks(__mmask8 lo, __mmask8 hi)
{
  return { static_cast<__mmask16>(lo | hi << 8) };
}
TETRALUX_INLINE Mask8 operator<(Double8 a, Double8 b)
{
  return JoinMasks(
    _mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LT_OQ), _mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LT_OQ));
}
TETRALUX_INLINE Mask8 operator<=(Double8 a, Double8 b)
{
  return JoinMasks(
    _mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LE_OQ), _mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LE_OQ));
}
TETRALUX_INLINE Mask8 operator==(Double8 a, Double8 b)
{
  return JoinMasks(
    _mm512_cmp_pd_mask(a.lo, b.lo, _CMP_EQ_OQ), _mm512_cmp_pd_mask(a.hi, b.hi, _CMP_EQ_OQ));
}
TETRALUX_INLINE Double8 Select(Mask8 m, Double8 a, Double8 b)
{
  return { _mm512_mask_blend_pd(GetLow(m), b.lo, a.lo),
    _mm512_mask_blend_pd(GetHigh(m), b.hi, a.hi) };
}
TETRALUX_INLINE Double8 Keep(Mask8 m, Double8 a)
{
  return { _mm512_maskz_mov_pd(GetLow(m), a.lo), _mm512_maskz_mov_pd(GetHigh(m), a.hi) };
}
TETRALUX_INLINE void Store(double* p, Double8 a)
{
  _mm512_storeu_pd(p, a.lo);
  _mm512_storeu_pd(p + 8, a.hi);
}
TETRALUX_INLINE void StoreWhere(Mask8 m, std::int64_t a, std::int64_t* p)
{
  _mm512_mask_storeu_epi64(p, GetLow(m), _mm512_set1_epi64(a));
  _mm512_mask_storeu_epi64(p + 8, GetHigh(m), _mm512_set1_epi64(a));
}
TETRALUX_INLINE Double8 LoadDouble8(const double* p)
{
  return { _mm512_loadu_pd(p), _mm512_loadu_pd(p + 8) };
}
TETRALUX_INLINE Float8 ToFloat(Double8 a)
{
  return Float8(
    _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.lo)), _mm512_cvtpd_ps(a.hi), 1));
}
TETRALUX_INLINE Double8 ToDouble(Float8 a)
{
  return { _mm512_cvtps_pd(_mm512_castps512_ps256(a.v)),
    _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1)) };
}

// Kahan's algorithm, as in Lanes256.h.
TETRALUX_INLINE Float8 DifferenceOfProducts(Float8 a, Float8 b, Float8 c, Float8 d)
{
  const __m512 cd = _mm512_mul_ps(c.v, d.v);
  const __m512 error = _mm512_fnmadd_ps(c.v, d.v, cd);
  return Float8(_mm512_add_ps(_mm512_fmsub_ps(a.v, b.v, cd), error));
}
TETRALUX_INLINE Double8 DifferenceOfProducts(Double8 a, Double8 b, Double8 c, Double8 d)
{
  const Double8 cd = c * d;
  const Double8 error = { _mm512_fnmadd_pd(c.lo, d.lo, cd.lo),
    _mm512_fnmadd_pd(c.hi, d.hi, cd.hi) };
  const Double8 difference = { _mm512_fmsub_pd(a.lo, b.lo, cd.lo),
    _mm512_fmsub_pd(a.hi, b.hi, cd.hi) };
  return difference + error;
}

// Gathers. A row or pair comes by one load: by the processor's own instructions a step of the ray
// caster takes a third longer. Those gather what is left.

TETRALUX_INLINE __m256i GetLow(Int8 a) { return _mm512_castsi512_si256(a.v); }
TETRALUX_INLINE __m256i GetHigh(Int8 a) { return _mm512_extracti32x8_epi32(a.v, 1); }

/// The first and the second numbers of 16 pairs.
TETRALUX_INLINE void SplitPairs(__m512 lo, __m512 hi, __m512& first, __m512& second)
{
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  first = _mm512_permutex2var_ps(lo, even, hi);
  second = _mm512_permutex2var_ps(lo, _mm512_add_epi32(even, _mm512_set1_epi32(1)), hi);
}

/// Indices, or offsets, taken out of their register two at a time: in memory the processor would
/// wait for the store.
TETRALUX_INLINE void ExtractIndices(__m512i index, std::uint64_t (&i)[LaneCount])
{
  const __m128i q[4] = { _mm512_castsi512_si128(index), _mm512_extracti32x4_epi32(index, 1),
    _mm512_extracti32x4_epi32(index, 2), _mm512_extracti32x4_epi32(index, 3) };
  for (int k = 0; k < 4; ++k)
  {
    const auto lo = static_cast<std::uint64_t>(_mm_cvtsi128_si64(q[k]));
    const auto hi = static_cast<std::uint64_t>(_mm_extract_epi64(q[k], 1));
    i[4 * k] = static_cast<std::uint32_t>(lo);
    i[4 * k + 1] = lo >> 32;
    i[4 * k + 2] = static_cast<std::uint32_t>(hi);
    i[4 * k + 3] = hi >> 32;
  }
}

TETRALUX_INLINE void GatherRows(
  const float* base, Int8 index, Float8& x, Float8& y, Float8& z, Float8& s)
{
  std::uint64_t i[LaneCount];
  ExtractIndices(ShiftLeft(index, 1).v, i);
  const auto at = [&](int lane) { return _mm_load_ps(base + 2 * i[lane]); };
  const auto row = [&](int a)
  {
    const __m512 r = _mm512_insertf32x4(_mm512_castps128_ps512(at(a)), at(a + 4), 1);
    return _mm512_insertf32x4(_mm512_insertf32x4(r, at(a + 8), 2), at(a + 12), 3);
  };
  const __m512 r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
  const __m512 t0 = _mm512_unpacklo_ps(r0, r1), t1 = _mm512_unpackhi_ps(r0, r1);
  const __m512 t2 = _mm512_unpacklo_ps(r2, r3), t3 = _mm512_unpackhi_ps(r2, r3);
  x.v = _mm512_shuffle_ps(t0, t2, _MM_SHUFFLE(1, 0, 1, 0));
  y.v = _mm512_shuffle_ps(t0, t2, _MM_SHUFFLE(3, 2, 3, 2));
  z.v = _mm512_shuffle_ps(t1, t3, _MM_SHUFFLE(1, 0, 1, 0));
  s.v = _mm512_shuffle_ps(t1, t3, _MM_SHUFFLE(3, 2, 3, 2));
}
TETRALUX_INLINE void LoadRows(
  const double* const (&row)[LaneCount], Double8& x, Double8& y, Double8& z, Double8& s)
{
  double columns[4][LaneCount];
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    for (int i = 0; i < 4; ++i)
    {
      columns[i][lane] = row[lane][i];
    }
  }
  x = LoadDouble8(columns[0]);
  y = LoadDouble8(columns[1]);
  z = LoadDouble8(columns[2]);
  s = LoadDouble8(columns[3]);
}
TETRALUX_INLINE void GatherRows(
  const double* base, Int8 index, Double8& x, Double8& y, Double8& z, Double8& s)
{
  const Int8 i = ShiftLeft(index, 2);
  const auto gather = [&](const double* column)
  {
    return Double8(
      _mm512_i32gather_pd(GetLow(i), column, 8), _mm512_i32gather_pd(GetHigh(i), column, 8));
  };
  x = gather(base);
  y = gather(base + 1);
  z = gather(base + 2);
  s = gather(base + 3);
}
TETRALUX_INLINE void GatherPairs(const std::int32_t* base, Int8 index, Int8& first, Int8& second)
{
  std::uint64_t i[LaneCount];
  ExtractIndices(index.v, i);
  const auto* pairs = reinterpret_cast<const double*>(base);
  const auto two = [&](int a)
  { return _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(pairs + i[a]), pairs + i[a + 1])); };
  const auto eight = [&](int a)
  {
    const __m512 r = _mm512_insertf32x4(_mm512_castps128_ps512(two(a)), two(a + 4), 1);
    return _mm512_insertf32x4(_mm512_insertf32x4(r, two(a + 8), 2), two(a + 12), 3);
  };
  const __m512 lo = eight(0), hi = eight(2);
  first.v = _mm512_castps_si512(_mm512_shuffle_ps(lo, hi, _MM_SHUFFLE(2, 0, 2, 0)));
  second.v = _mm512_castps_si512(_mm512_shuffle_ps(lo, hi, _MM_SHUFFLE(3, 1, 3, 1)));
}
TETRALUX_INLINE Int8 GatherWords(const void* base, Int8 index)
{
  // The instruction takes offsets as signed: they count from the middle of all that there are.
  constexpr std::uintptr_t Middle = 0x80000000;
  const auto* middle =
    reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(base) + Middle);
  const __m512i offset = _mm512_xor_si512(index.v, _mm512_set1_epi32(static_cast<int>(Middle)));
  return Int8(_mm512_i32gather_epi32(offset, middle, 1));
}
TETRALUX_INLINE void GatherNeighbors(const float* base, Int8 index, Float8& first, Float8& second)
{
  const __m512 lo = _mm512_castpd_ps(_mm512_i32gather_pd(GetLow(index), base, 4));
  const __m512 hi = _mm512_castpd_ps(_mm512_i32gather_pd(GetHigh(index), base, 4));
  SplitPairs(lo, hi, first.v, second.v);
}

TETRALUX_INLINE Float8 LookUp(const float (&table)[LaneCount], Int8 index)
{
  return Float8(_mm512_permutexvar_ps(index.v, _mm512_loadu_ps(table)));
}
TETRALUX_INLINE Float8 LookUp(const float (&table)[2 * LaneCount], Int8 index)
{
  return Float8(
    _mm512_permutex2var_ps(_mm512_loadu_ps(table), index.v, _mm512_loadu_ps(table + LaneCount)));
}
TETRALUX_INLINE Float8 LookUp(const float (&table)[3 * LaneCount], Int8 index)
{
  const __m512 lower = LookUp(reinterpret_cast<const float(&)[2 * LaneCount]>(table), index).v;
  const __mmask16 upper = _mm512_test_epi32_mask(index.v, _mm512_set1_epi32(2 * LaneCount));
  return Float8(
    _mm512_mask_permutexvar_ps(lower, upper, index.v, _mm512_loadu_ps(table + 2 * LaneCount)));
}
TETRALUX_INLINE Float8 LookUp(const float (&table)[4 * LaneCount], Int8 index)
{
  const auto half = [&](const float* p)
  { return _mm512_permutex2var_ps(_mm512_loadu_ps(p), index.v, _mm512_loadu_ps(p + LaneCount)); };
  const __mmask16 upper = _mm512_test_epi32_mask(index.v, _mm512_set1_epi32(2 * LaneCount));
  return Float8(_mm512_mask_blend_ps(upper, half(table), half(table + 2 * LaneCount)));
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
