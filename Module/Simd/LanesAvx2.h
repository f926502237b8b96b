// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LanesAvx2_h
#define tetralux_LanesAvx2_h

// The lanes of Lanes.h for AVX2 with FMA. Only Lanes.h includes this; it says what each operation
// does.

#include "Simd/Lanes256.h"

#include <cstdint>

#include <immintrin.h>

namespace tetralux
{
namespace TETRALUX_ISA
{

struct Mask8
{
  __m256i v; // all bits of a lane set or clear
};
struct Double8
{
  __m256d lo, hi;
  Double8() = default;
  TETRALUX_INLINE Double8(__m256d a, __m256d b)
    : lo(a)
    , hi(b)
  {
  }
  TETRALUX_INLINE Double8(double x)
    : lo(_mm256_set1_pd(x))
    , hi(lo)
  {
  }
};

// Masks.
TETRALUX_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return { _mm256_and_si256(a.v, b.v) }; }
TETRALUX_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return { _mm256_or_si256(a.v, b.v) }; }
TETRALUX_INLINE Mask8 AndNot(Mask8 a, Mask8 b) { return { _mm256_andnot_si256(b.v, a.v) }; }
TETRALUX_INLINE unsigned Bits(Mask8 m)
{
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(m.v)));
}
TETRALUX_INLINE Mask8 MaskFromBits(unsigned bits)
{
  const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  return { _mm256_cmpeq_epi32(
    _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lane), lane) };
}
TETRALUX_INLINE bool Any(Mask8 m) { return !_mm256_testz_si256(m.v, m.v); }

// Integers.
TETRALUX_INLINE Mask8 operator>(Int8 a, Int8 b) { return { _mm256_cmpgt_epi32(a.v, b.v) }; }
TETRALUX_INLINE Mask8 operator==(Int8 a, Int8 b) { return { _mm256_cmpeq_epi32(a.v, b.v) }; }
TETRALUX_INLINE Int8 Ones(Mask8 m) { return Int8(_mm256_srli_epi32(m.v, 31)); }
TETRALUX_INLINE Int8 Select(Mask8 m, Int8 a, Int8 b)
{
  return Int8(_mm256_blendv_epi8(b.v, a.v, m.v));
}

// Single precision.
TETRALUX_INLINE Mask8 operator<(Float8 a, Float8 b)
{
  return { _mm256_castps_si256(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)) };
}
TETRALUX_INLINE Mask8 operator<=(Float8 a, Float8 b)
{
  return { _mm256_castps_si256(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)) };
}
TETRALUX_INLINE Mask8 operator==(Float8 a, Float8 b)
{
  return { _mm256_castps_si256(_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)) };
}
TETRALUX_INLINE Float8 Select(Mask8 m, Float8 a, Float8 b)
{
  return Float8(_mm256_blendv_ps(b.v, a.v, _mm256_castsi256_ps(m.v)));
}
TETRALUX_INLINE Float8 Keep(Mask8 m, Float8 a)
{
  return Float8(_mm256_and_ps(_mm256_castsi256_ps(m.v), a.v));
}

// Double precision.
TETRALUX_INLINE Double8 operator+(Double8 a, Double8 b)
{
  return { _mm256_add_pd(a.lo, b.lo), _mm256_add_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 operator-(Double8 a, Double8 b)
{
  return { _mm256_sub_pd(a.lo, b.lo), _mm256_sub_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 operator*(Double8 a, Double8 b)
{
  return { _mm256_mul_pd(a.lo, b.lo), _mm256_mul_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 operator/(Double8 a, Double8 b)
{
  return { _mm256_div_pd(a.lo, b.lo), _mm256_div_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 Fma(Double8 a, Double8 b, Double8 c)
{
  return { _mm256_fmadd_pd(a.lo, b.lo, c.lo), _mm256_fmadd_pd(a.hi, b.hi, c.hi) };
}
TETRALUX_INLINE Double8 Min(Double8 a, Double8 b)
{
  return { _mm256_min_pd(a.lo, b.lo), _mm256_min_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 Max(Double8 a, Double8 b)
{
  return { _mm256_max_pd(a.lo, b.lo), _mm256_max_pd(a.hi, b.hi) };
}
TETRALUX_INLINE Double8 Abs(Double8 a)
{
  const __m256d sign = _mm256_set1_pd(-0.);
  return { _mm256_andnot_pd(sign, a.lo), _mm256_andnot_pd(sign, a.hi) };
}
TETRALUX_INLINE Double8 Sqrt(Double8 a) { return { _mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi) }; }
TETRALUX_INLINE Mask8 NarrowMask(__m256d lo, __m256d hi)
{
  // The low halves of the eight 64-bit masks, in order.
  const __m256 even =
    _mm256_shuffle_ps(_mm256_castpd_ps(lo), _mm256_castpd_ps(hi), _MM_SHUFFLE(2, 0, 2, 0));
  return { _mm256_permute4x64_epi64(_mm256_castps_si256(even), _MM_SHUFFLE(3, 1, 2, 0)) };
}
TETRALUX_INLINE Mask8 operator<(Double8 a, Double8 b)
{
  return NarrowMask(_mm256_cmp_pd(a.lo, b.lo, _CMP_LT_OQ), _mm256_cmp_pd(a.hi, b.hi, _CMP_LT_OQ));
}
TETRALUX_INLINE Mask8 operator<=(Double8 a, Double8 b)
{
  return NarrowMask(_mm256_cmp_pd(a.lo, b.lo, _CMP_LE_OQ), _mm256_cmp_pd(a.hi, b.hi, _CMP_LE_OQ));
}
TETRALUX_INLINE Mask8 operator==(Double8 a, Double8 b)
{
  return NarrowMask(_mm256_cmp_pd(a.lo, b.lo, _CMP_EQ_OQ), _mm256_cmp_pd(a.hi, b.hi, _CMP_EQ_OQ));
}
TETRALUX_INLINE void WidenMask(Mask8 m, __m256d& lo, __m256d& hi)
{
  lo = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_castsi256_si128(m.v)));
  hi = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_extracti128_si256(m.v, 1)));
}
TETRALUX_INLINE Double8 Select(Mask8 m, Double8 a, Double8 b)
{
  __m256d lo, hi;
  WidenMask(m, lo, hi);
  return { _mm256_blendv_pd(b.lo, a.lo, lo), _mm256_blendv_pd(b.hi, a.hi, hi) };
}
TETRALUX_INLINE Double8 Keep(Mask8 m, Double8 a)
{
  __m256d lo, hi;
  WidenMask(m, lo, hi);
  return { _mm256_and_pd(lo, a.lo), _mm256_and_pd(hi, a.hi) };
}
TETRALUX_INLINE void Store(double* p, Double8 a)
{
  _mm256_storeu_pd(p, a.lo);
  _mm256_storeu_pd(p + 4, a.hi);
}
TETRALUX_INLINE void StoreWhere(Mask8 m, std::int64_t a, std::int64_t* p)
{
  __m256d lo, hi;
  WidenMask(m, lo, hi);
  auto* words = reinterpret_cast<long long*>(p);
  _mm256_maskstore_epi64(words, _mm256_castpd_si256(lo), _mm256_set1_epi64x(a));
  _mm256_maskstore_epi64(words + 4, _mm256_castpd_si256(hi), _mm256_set1_epi64x(a));
}
TETRALUX_INLINE Double8 LoadDouble8(const double* p)
{
  return { _mm256_loadu_pd(p), _mm256_loadu_pd(p + 4) };
}
TETRALUX_INLINE Float8 ToFloat(Double8 a)
{
  return Float8(_mm256_set_m128(_mm256_cvtpd_ps(a.hi), _mm256_cvtpd_ps(a.lo)));
}
TETRALUX_INLINE Double8 ToDouble(Float8 a)
{
  return { _mm256_cvtps_pd(_mm256_castps256_ps128(a.v)),
    _mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1)) };
}

// Kahan's algorithm, as in Lanes256.h.
TETRALUX_INLINE Double8 DifferenceOfProducts(Double8 a, Double8 b, Double8 c, Double8 d)
{
  const Double8 cd = c * d;
  const Double8 error = { _mm256_fnmadd_pd(c.lo, d.lo, cd.lo),
    _mm256_fnmadd_pd(c.hi, d.hi, cd.hi) };
  const Double8 difference = { _mm256_fmsub_pd(a.lo, b.lo, cd.lo),
    _mm256_fmsub_pd(a.hi, b.hi, cd.hi) };
  return difference + error;
}

TETRALUX_INLINE void TransposeRows(
  const double* const row[4], __m256d& x, __m256d& y, __m256d& z, __m256d& s)
{
  const __m256d r0 = _mm256_load_pd(row[0]), r1 = _mm256_load_pd(row[1]);
  const __m256d r2 = _mm256_load_pd(row[2]), r3 = _mm256_load_pd(row[3]);
  const __m256d t0 = _mm256_unpacklo_pd(r0, r1), t1 = _mm256_unpackhi_pd(r0, r1);
  const __m256d t2 = _mm256_unpacklo_pd(r2, r3), t3 = _mm256_unpackhi_pd(r2, r3);
  x = _mm256_permute2f128_pd(t0, t2, 0x20);
  y = _mm256_permute2f128_pd(t1, t3, 0x20);
  z = _mm256_permute2f128_pd(t0, t2, 0x31);
  s = _mm256_permute2f128_pd(t1, t3, 0x31);
}
TETRALUX_INLINE void LoadRows(
  const double* const (&row)[LaneCount], Double8& x, Double8& y, Double8& z, Double8& s)
{
  TransposeRows(row, x.lo, y.lo, z.lo, s.lo);
  TransposeRows(row + 4, x.hi, y.hi, z.hi, s.hi);
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
  const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), index.v);
  const __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + LaneCount), index.v);
  // Bit 3 of an index, as the sign.
  return Float8(_mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32(index.v, 28))));
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
