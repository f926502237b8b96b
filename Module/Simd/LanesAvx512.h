// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LanesAvx512_h
#define tetralux_LanesAvx512_h

// The lanes of Lanes.h for AVX-512, eight of them: masks have registers of their own, and doubles
// fill one. Only Lanes.h includes this; it says what each operation does. Results are the same bits
// as those of LanesAvx2.h.

#include "Simd/Lanes256.h"

#include <cstdint>

#include <immintrin.h>

namespace tetralux
{
namespace TETRALUX_ISA
{

struct Mask8
{
  __mmask8 v;
};
struct Double8
{
  __m512d v;
  Double8() = default;
  TETRALUX_INLINE explicit Double8(__m512d x)
    : v(x)
  {
  }
  TETRALUX_INLINE Double8(double x)
    : v(_mm512_set1_pd(x))
  {
  }
};

// Masks.
TETRALUX_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return { _kand_mask8(a.v, b.v) }; }
TETRALUX_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return { _kor_mask8(a.v, b.v) }; }
TETRALUX_INLINE Mask8 AndNot(Mask8 a, Mask8 b) { return { _kandn_mask8(b.v, a.v) }; }
TETRALUX_INLINE unsigned Bits(Mask8 m) { return _cvtmask8_u32(m.v); }
TETRALUX_INLINE Mask8 MaskFromBits(unsigned bits) { return { _cvtu32_mask8(bits) }; }
TETRALUX_INLINE bool Any(Mask8 m) { return m.v != 0; }

// Integers.
TETRALUX_INLINE Mask8 operator>(Int8 a, Int8 b) { return { _mm256_cmpgt_epi32_mask(a.v, b.v) }; }
TETRALUX_INLINE Mask8 operator==(Int8 a, Int8 b) { return { _mm256_cmpeq_epi32_mask(a.v, b.v) }; }
TETRALUX_INLINE Int8 Ones(Mask8 m) { return Int8(_mm256_maskz_set1_epi32(m.v, 1)); }
TETRALUX_INLINE Int8 Select(Mask8 m, Int8 a, Int8 b)
{
  return Int8(_mm256_mask_blend_epi32(m.v, b.v, a.v));
}

// Single precision.
TETRALUX_INLINE Mask8 operator<(Float8 a, Float8 b)
{
  return { _mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ) };
}
TETRALUX_INLINE Mask8 operator<=(Float8 a, Float8 b)
{
  return { _mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ) };
}
TETRALUX_INLINE Mask8 operator==(Float8 a, Float8 b)
{
  return { _mm256_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ) };
}
TETRALUX_INLINE Float8 Select(Mask8 m, Float8 a, Float8 b)
{
  return Float8(_mm256_mask_blend_ps(m.v, b.v, a.v));
}
TETRALUX_INLINE Float8 Keep(Mask8 m, Float8 a) { return Float8(_mm256_maskz_mov_ps(m.v, a.v)); }

// Double precision.
TETRALUX_INLINE Double8 operator+(Double8 a, Double8 b) { return Double8(_mm512_add_pd(a.v, b.v)); }
TETRALUX_INLINE Double8 operator-(Double8 a, Double8 b) { return Double8(_mm512_sub_pd(a.v, b.v)); }
TETRALUX_INLINE Double8 operator*(Double8 a, Double8 b) { return Double8(_mm512_mul_pd(a.v, b.v)); }
TETRALUX_INLINE Double8 operator/(Double8 a, Double8 b) { return Double8(_mm512_div_pd(a.v, b.v)); }
TETRALUX_INLINE Double8 Fma(Double8 a, Double8 b, Double8 c)
{
  return Double8(_mm512_fmadd_pd(a.v, b.v, c.v));
}
TETRALUX_INLINE Double8 Min(Double8 a, Double8 b) { return Double8(_mm512_min_pd(a.v, b.v)); }
TETRALUX_INLINE Double8 Max(Double8 a, Double8 b) { return Double8(_mm512_max_pd(a.v, b.v)); }
TETRALUX_INLINE Double8 Abs(Double8 a)
{
  return Double8(_mm512_andnot_pd(_mm512_set1_pd(-0.), a.v));
}
TETRALUX_INLINE Double8 Sqrt(Double8 a) { return Double8(_mm512_sqrt_pd(a.v)); }
TETRALUX_INLINE Mask8 operator<(Double8 a, Double8 b)
{
  return { _mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ) };
}
TETRALUX_INLINE Mask8 operator<=(Double8 a, Double8 b)
{
  return { _mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ) };
}
TETRALUX_INLINE Mask8 operator==(Double8 a, Double8 b)
{
  return { _mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ) };
}
TETRALUX_INLINE Double8 Select(Mask8 m, Double8 a, Double8 b)
{
  return Double8(_mm512_mask_blend_pd(m.v, b.v, a.v));
}
TETRALUX_INLINE Double8 Keep(Mask8 m, Double8 a) { return Double8(_mm512_maskz_mov_pd(m.v, a.v)); }
TETRALUX_INLINE void Store(double* p, Double8 a) { _mm512_storeu_pd(p, a.v); }
TETRALUX_INLINE void StoreWhere(Mask8 m, std::int64_t a, std::int64_t* p)
{
  _mm512_mask_storeu_epi64(p, m.v, _mm512_set1_epi64(a));
}
TETRALUX_INLINE Double8 LoadDouble8(const double* p) { return Double8(_mm512_loadu_pd(p)); }
TETRALUX_INLINE Float8 ToFloat(Double8 a) { return Float8(_mm512_cvtpd_ps(a.v)); }
TETRALUX_INLINE Double8 ToDouble(Float8 a) { return Double8(_mm512_cvtps_pd(a.v)); }

// Kahan's algorithm, as in Lanes256.h.
TETRALUX_INLINE Double8 DifferenceOfProducts(Double8 a, Double8 b, Double8 c, Double8 d)
{
  const __m512d cd = _mm512_mul_pd(c.v, d.v);
  const __m512d error = _mm512_fnmadd_pd(c.v, d.v, cd);
  return Double8(_mm512_add_pd(_mm512_fmsub_pd(a.v, b.v, cd), error));
}

TETRALUX_INLINE void LoadRows(
  const double* const (&row)[LaneCount], Double8& x, Double8& y, Double8& z, Double8& s)
{
  const auto two = [&](int a, int b)
  {
    return _mm512_insertf64x4(
      _mm512_castpd256_pd512(_mm256_load_pd(row[a])), _mm256_load_pd(row[b]), 1);
  };
  const __m512d r0 = two(0, 4), r1 = two(1, 5), r2 = two(2, 6), r3 = two(3, 7);
  const __m512d t0 = _mm512_unpacklo_pd(r0, r1), t1 = _mm512_unpackhi_pd(r0, r1);
  const __m512d t2 = _mm512_unpacklo_pd(r2, r3), t3 = _mm512_unpackhi_pd(r2, r3);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  x.v = _mm512_permutex2var_pd(t0, low, t2);
  y.v = _mm512_permutex2var_pd(t1, low, t3);
  z.v = _mm512_permutex2var_pd(t0, high, t2);
  s.v = _mm512_permutex2var_pd(t1, high, t3);
}
TETRALUX_INLINE void GatherRows(
  const double* base, Int8 index, Double8& x, Double8& y, Double8& z, Double8& s)
{
  const double* row[LaneCount];
  FindRows(base, index, row);
  LoadRows(row, x, y, z, s);
}

TETRALUX_INLINE Float8 LookUp(const float (&table)[2 * LaneCount], Int8 index)
{
  return Float8(
    _mm256_permutex2var_ps(_mm256_loadu_ps(table), index.v, _mm256_loadu_ps(table + LaneCount)));
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
