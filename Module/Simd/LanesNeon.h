// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LanesNeon_h
#define tetralux_LanesNeon_h

// The lanes of Lanes.h for NEON, which every 64-bit ARM processor has: eight lanes in two registers
// of four, doubles in four of two. Only Lanes.h includes this; it says what each operation does.

#include "Simd/LaneCount.h"

#include <cstdint>
#include <cstring>

#include <arm_neon.h>

namespace tetralux
{
namespace TETRALUX_ISA
{

struct Mask8
{
  uint32x4_t lo, hi; // all bits of a lane set or clear
};
struct Int8
{
  int32x4_t lo, hi;
  Int8() = default;
  TETRALUX_INLINE Int8(int32x4_t a, int32x4_t b)
    : lo(a)
    , hi(b)
  {
  }
  TETRALUX_INLINE Int8(std::int32_t x)
    : lo(vdupq_n_s32(x))
    , hi(lo)
  {
  }
};
struct Float8
{
  float32x4_t lo, hi;
  Float8() = default;
  TETRALUX_INLINE Float8(float32x4_t a, float32x4_t b)
    : lo(a)
    , hi(b)
  {
  }
  TETRALUX_INLINE Float8(float x)
    : lo(vdupq_n_f32(x))
    , hi(lo)
  {
  }
};
struct Double8
{
  float64x2_t v[4];
  Double8() = default;
  TETRALUX_INLINE Double8(float64x2_t a, float64x2_t b, float64x2_t c, float64x2_t d)
    : v{ a, b, c, d }
  {
  }
  TETRALUX_INLINE Double8(double x)
    : v{ vdupq_n_f64(x), vdupq_n_f64(x), vdupq_n_f64(x), vdupq_n_f64(x) }
  {
  }
  template <class F>
  static TETRALUX_INLINE Double8 Each(F f)
  {
    return { f(0), f(1), f(2), f(3) };
  }
};

// Masks.
TETRALUX_INLINE Mask8 operator&(Mask8 a, Mask8 b)
{
  return { vandq_u32(a.lo, b.lo), vandq_u32(a.hi, b.hi) };
}
TETRALUX_INLINE Mask8 operator|(Mask8 a, Mask8 b)
{
  return { vorrq_u32(a.lo, b.lo), vorrq_u32(a.hi, b.hi) };
}
TETRALUX_INLINE Mask8 AndNot(Mask8 a, Mask8 b)
{
  return { vbicq_u32(a.lo, b.lo), vbicq_u32(a.hi, b.hi) };
}
/// The bit of each lane.
TETRALUX_INLINE Mask8 GetLaneBits()
{
  static constexpr std::uint32_t bits[] = { 1, 2, 4, 8, 16, 32, 64, 128 };
  return { vld1q_u32(bits), vld1q_u32(bits + 4) };
}
TETRALUX_INLINE unsigned Bits(Mask8 m)
{
  const Mask8 bits = m & GetLaneBits();
  return vaddvq_u32(vorrq_u32(bits.lo, bits.hi));
}
TETRALUX_INLINE Mask8 MaskFromBits(unsigned bits)
{
  const uint32x4_t all = vdupq_n_u32(bits);
  const Mask8 lane = GetLaneBits();
  return { vtstq_u32(all, lane.lo), vtstq_u32(all, lane.hi) };
}
TETRALUX_INLINE bool Any(Mask8 m) { return vmaxvq_u32(vorrq_u32(m.lo, m.hi)) != 0; }

// Integers.
TETRALUX_INLINE Int8 operator+(Int8 a, Int8 b)
{
  return { vaddq_s32(a.lo, b.lo), vaddq_s32(a.hi, b.hi) };
}
TETRALUX_INLINE Int8 operator-(Int8 a, Int8 b)
{
  return { vsubq_s32(a.lo, b.lo), vsubq_s32(a.hi, b.hi) };
}
TETRALUX_INLINE Int8 operator*(Int8 a, Int8 b)
{
  return { vmulq_s32(a.lo, b.lo), vmulq_s32(a.hi, b.hi) };
}
TETRALUX_INLINE Mask8 operator>(Int8 a, Int8 b)
{
  return { vcgtq_s32(a.lo, b.lo), vcgtq_s32(a.hi, b.hi) };
}
TETRALUX_INLINE Mask8 operator==(Int8 a, Int8 b)
{
  return { vceqq_s32(a.lo, b.lo), vceqq_s32(a.hi, b.hi) };
}
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, Int8 bits)
{
  return { vshlq_s32(a.lo, bits.lo), vshlq_s32(a.hi, bits.hi) };
}
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, int bits) { return ShiftLeft(a, Int8(bits)); }
/// NEON shifts to the right by negative numbers.
TETRALUX_INLINE Int8 ShiftRightSigned(Int8 a, int bits) { return ShiftLeft(a, Int8(-bits)); }
TETRALUX_INLINE Int8 ShiftRight(Int8 a, int bits)
{
  const int32x4_t right = vdupq_n_s32(-bits);
  return { vreinterpretq_s32_u32(vshlq_u32(vreinterpretq_u32_s32(a.lo), right)),
    vreinterpretq_s32_u32(vshlq_u32(vreinterpretq_u32_s32(a.hi), right)) };
}
TETRALUX_INLINE Int8 Ones(Mask8 m)
{
  return { vreinterpretq_s32_u32(vshrq_n_u32(m.lo, 31)),
    vreinterpretq_s32_u32(vshrq_n_u32(m.hi, 31)) };
}
TETRALUX_INLINE Int8 Select(Mask8 m, Int8 a, Int8 b)
{
  return { vbslq_s32(m.lo, a.lo, b.lo), vbslq_s32(m.hi, a.hi, b.hi) };
}
TETRALUX_INLINE void Store(std::int32_t* p, Int8 a)
{
  vst1q_s32(p, a.lo);
  vst1q_s32(p + 4, a.hi);
}
TETRALUX_INLINE Int8 LoadInt8(const std::int32_t* p) { return { vld1q_s32(p), vld1q_s32(p + 4) }; }

// Single precision.
TETRALUX_INLINE Float8 operator+(Float8 a, Float8 b)
{
  return { vaddq_f32(a.lo, b.lo), vaddq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Float8 operator-(Float8 a, Float8 b)
{
  return { vsubq_f32(a.lo, b.lo), vsubq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Float8 operator*(Float8 a, Float8 b)
{
  return { vmulq_f32(a.lo, b.lo), vmulq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Float8 operator/(Float8 a, Float8 b)
{
  return { vdivq_f32(a.lo, b.lo), vdivq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Float8 Fma(Float8 a, Float8 b, Float8 c)
{
  return { vfmaq_f32(c.lo, a.lo, b.lo), vfmaq_f32(c.hi, a.hi, b.hi) };
}
TETRALUX_INLINE Float8 Abs(Float8 a) { return { vabsq_f32(a.lo), vabsq_f32(a.hi) }; }
TETRALUX_INLINE Float8 Sqrt(Float8 a) { return { vsqrtq_f32(a.lo), vsqrtq_f32(a.hi) }; }
TETRALUX_INLINE Mask8 operator<(Float8 a, Float8 b)
{
  return { vcltq_f32(a.lo, b.lo), vcltq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Mask8 operator<=(Float8 a, Float8 b)
{
  return { vcleq_f32(a.lo, b.lo), vcleq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Mask8 operator==(Float8 a, Float8 b)
{
  return { vceqq_f32(a.lo, b.lo), vceqq_f32(a.hi, b.hi) };
}
TETRALUX_INLINE Float8 Select(Mask8 m, Float8 a, Float8 b)
{
  return { vbslq_f32(m.lo, a.lo, b.lo), vbslq_f32(m.hi, a.hi, b.hi) };
}
/// NEON's own minimum is another one where a number is none, and of two zeros.
TETRALUX_INLINE Float8 Min(Float8 a, Float8 b) { return Select(a < b, a, b); }
TETRALUX_INLINE Float8 Max(Float8 a, Float8 b) { return Select(b < a, a, b); }
TETRALUX_INLINE Float8 FromBits(Int8 a)
{
  return { vreinterpretq_f32_s32(a.lo), vreinterpretq_f32_s32(a.hi) };
}
TETRALUX_INLINE Int8 ToBits(Float8 a)
{
  return { vreinterpretq_s32_f32(a.lo), vreinterpretq_s32_f32(a.hi) };
}
TETRALUX_INLINE Float8 Keep(Mask8 m, Float8 a) { return FromBits(Select(m, ToBits(a), Int8(0))); }
TETRALUX_INLINE void Store(float* p, Float8 a)
{
  vst1q_f32(p, a.lo);
  vst1q_f32(p + 4, a.hi);
}
TETRALUX_INLINE Float8 LoadFloat8(const float* p) { return { vld1q_f32(p), vld1q_f32(p + 4) }; }
TETRALUX_INLINE Int8 RoundToInt(Float8 a) { return { vcvtnq_s32_f32(a.lo), vcvtnq_s32_f32(a.hi) }; }
TETRALUX_INLINE Float8 ToFloat(Int8 a) { return { vcvtq_f32_s32(a.lo), vcvtq_f32_s32(a.hi) }; }

// Double precision.
TETRALUX_INLINE Double8 operator+(Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vaddq_f64(a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 operator-(Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vsubq_f64(a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 operator*(Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vmulq_f64(a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 operator/(Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vdivq_f64(a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 Fma(Double8 a, Double8 b, Double8 c)
{
  return Double8::Each([&](int i) { return vfmaq_f64(c.v[i], a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 Abs(Double8 a)
{
  return Double8::Each([&](int i) { return vabsq_f64(a.v[i]); });
}
TETRALUX_INLINE Double8 Sqrt(Double8 a)
{
  return Double8::Each([&](int i) { return vsqrtq_f64(a.v[i]); });
}
/// The low halves of the eight 64-bit masks, in order.
TETRALUX_INLINE Mask8 NarrowMask(uint64x2_t a, uint64x2_t b, uint64x2_t c, uint64x2_t d)
{
  return { vuzp1q_u32(vreinterpretq_u32_u64(a), vreinterpretq_u32_u64(b)),
    vuzp1q_u32(vreinterpretq_u32_u64(c), vreinterpretq_u32_u64(d)) };
}
TETRALUX_INLINE Mask8 operator<(Double8 a, Double8 b)
{
  return NarrowMask(vcltq_f64(a.v[0], b.v[0]), vcltq_f64(a.v[1], b.v[1]), vcltq_f64(a.v[2], b.v[2]),
    vcltq_f64(a.v[3], b.v[3]));
}
TETRALUX_INLINE Mask8 operator<=(Double8 a, Double8 b)
{
  return NarrowMask(vcleq_f64(a.v[0], b.v[0]), vcleq_f64(a.v[1], b.v[1]), vcleq_f64(a.v[2], b.v[2]),
    vcleq_f64(a.v[3], b.v[3]));
}
TETRALUX_INLINE Mask8 operator==(Double8 a, Double8 b)
{
  return NarrowMask(vceqq_f64(a.v[0], b.v[0]), vceqq_f64(a.v[1], b.v[1]), vceqq_f64(a.v[2], b.v[2]),
    vceqq_f64(a.v[3], b.v[3]));
}
/// The masks of the two doubles of register i.
TETRALUX_INLINE uint64x2_t WidenMask(Mask8 m, int i)
{
  const uint32x4_t four = i < 2 ? m.lo : m.hi;
  const uint32x4_t twice = i % 2 == 0 ? vzip1q_u32(four, four) : vzip2q_u32(four, four);
  return vreinterpretq_u64_u32(twice);
}
TETRALUX_INLINE Double8 Select(Mask8 m, Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vbslq_f64(WidenMask(m, i), a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 Keep(Mask8 m, Double8 a) { return Select(m, a, Double8(0.)); }
TETRALUX_INLINE Double8 Min(Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vbslq_f64(vcltq_f64(a.v[i], b.v[i]), a.v[i], b.v[i]); });
}
TETRALUX_INLINE Double8 Max(Double8 a, Double8 b)
{
  return Double8::Each([&](int i) { return vbslq_f64(vcltq_f64(b.v[i], a.v[i]), a.v[i], b.v[i]); });
}
TETRALUX_INLINE void Store(double* p, Double8 a)
{
  for (int i = 0; i < 4; ++i)
  {
    vst1q_f64(p + 2 * i, a.v[i]);
  }
}
TETRALUX_INLINE void StoreWhere(Mask8 m, std::int64_t a, std::int64_t* p)
{
  for (int i = 0; i < 4; ++i)
  {
    vst1q_s64(p + 2 * i, vbslq_s64(WidenMask(m, i), vdupq_n_s64(a), vld1q_s64(p + 2 * i)));
  }
}
TETRALUX_INLINE Double8 LoadDouble8(const double* p)
{
  return Double8::Each([&](int i) { return vld1q_f64(p + 2 * i); });
}
TETRALUX_INLINE Float8 ToFloat(Double8 a)
{
  return { vcvt_high_f32_f64(vcvt_f32_f64(a.v[0]), a.v[1]),
    vcvt_high_f32_f64(vcvt_f32_f64(a.v[2]), a.v[3]) };
}
TETRALUX_INLINE Double8 ToDouble(Float8 a)
{
  return { vcvt_f64_f32(vget_low_f32(a.lo)), vcvt_high_f64_f32(a.lo),
    vcvt_f64_f32(vget_low_f32(a.hi)), vcvt_high_f64_f32(a.hi) };
}

// Kahan's algorithm (Jeannerod, Louvet, Muller, Further analysis of Kahan's algorithm, 2013).
TETRALUX_INLINE float32x4_t DifferenceOfProducts(
  float32x4_t a, float32x4_t b, float32x4_t c, float32x4_t d)
{
  const float32x4_t cd = vmulq_f32(c, d);
  const float32x4_t error = vfmsq_f32(cd, c, d);
  return vaddq_f32(vfmaq_f32(vnegq_f32(cd), a, b), error);
}
TETRALUX_INLINE Float8 DifferenceOfProducts(Float8 a, Float8 b, Float8 c, Float8 d)
{
  return { DifferenceOfProducts(a.lo, b.lo, c.lo, d.lo),
    DifferenceOfProducts(a.hi, b.hi, c.hi, d.hi) };
}
TETRALUX_INLINE Double8 DifferenceOfProducts(Double8 a, Double8 b, Double8 c, Double8 d)
{
  return Double8::Each(
    [&](int i)
    {
      const float64x2_t cd = vmulq_f64(c.v[i], d.v[i]);
      const float64x2_t error = vfmsq_f64(cd, c.v[i], d.v[i]);
      return vaddq_f64(vfmaq_f64(vnegq_f64(cd), a.v[i], b.v[i]), error);
    });
}

// Gathers, by single loads: NEON has no others.

/// Four rows of four, transposed.
TETRALUX_INLINE void TransposeRows(
  const float32x4_t (&row)[4], float32x4_t& x, float32x4_t& y, float32x4_t& z, float32x4_t& s)
{
  const auto pairs = [](float32x4_t a) { return vreinterpretq_f64_f32(a); };
  const auto singles = [](float64x2_t a) { return vreinterpretq_f32_f64(a); };
  const float64x2_t xz01 = pairs(vtrn1q_f32(row[0], row[1]));
  const float64x2_t ys01 = pairs(vtrn2q_f32(row[0], row[1]));
  const float64x2_t xz23 = pairs(vtrn1q_f32(row[2], row[3]));
  const float64x2_t ys23 = pairs(vtrn2q_f32(row[2], row[3]));
  x = singles(vtrn1q_f64(xz01, xz23));
  y = singles(vtrn1q_f64(ys01, ys23));
  z = singles(vtrn2q_f64(xz01, xz23));
  s = singles(vtrn2q_f64(ys01, ys23));
}
TETRALUX_INLINE void GatherRows(
  const float* base, Int8 index, Float8& x, Float8& y, Float8& z, Float8& s)
{
  std::int32_t i[LaneCount];
  Store(i, index);
  const auto row = [&](int lane) { return vld1q_f32(base + 4 * std::int64_t{ i[lane] }); };
  TransposeRows({ row(0), row(1), row(2), row(3) }, x.lo, y.lo, z.lo, s.lo);
  TransposeRows({ row(4), row(5), row(6), row(7) }, x.hi, y.hi, z.hi, s.hi);
}
TETRALUX_INLINE void LoadRows(
  const double* const (&row)[LaneCount], Double8& x, Double8& y, Double8& z, Double8& s)
{
  for (int i = 0; i < 4; ++i)
  {
    const double* a = row[2 * i];
    const double* b = row[2 * i + 1];
    const float64x2_t a0 = vld1q_f64(a), a1 = vld1q_f64(a + 2);
    const float64x2_t b0 = vld1q_f64(b), b1 = vld1q_f64(b + 2);
    x.v[i] = vtrn1q_f64(a0, b0);
    y.v[i] = vtrn2q_f64(a0, b0);
    z.v[i] = vtrn1q_f64(a1, b1);
    s.v[i] = vtrn2q_f64(a1, b1);
  }
}
TETRALUX_INLINE void GatherRows(
  const double* base, Int8 index, Double8& x, Double8& y, Double8& z, Double8& s)
{
  std::int32_t i[LaneCount];
  Store(i, index);
  const double* row[LaneCount];
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    row[lane] = base + 4 * std::int64_t{ i[lane] };
  }
  LoadRows(row, x, y, z, s);
}
TETRALUX_INLINE void GatherPairs(const std::int32_t* base, Int8 index, Int8& first, Int8& second)
{
  std::int32_t i[LaneCount];
  Store(i, index);
  const auto two = [&](int a, int b)
  {
    return vcombine_s32(
      vld1_s32(base + 2 * std::int64_t{ i[a] }), vld1_s32(base + 2 * std::int64_t{ i[b] }));
  };
  const int32x4_t p0 = two(0, 1), p1 = two(2, 3), p2 = two(4, 5), p3 = two(6, 7);
  first = { vuzp1q_s32(p0, p1), vuzp1q_s32(p2, p3) };
  second = { vuzp2q_s32(p0, p1), vuzp2q_s32(p2, p3) };
}
TETRALUX_INLINE Int8 GatherWords(const void* base, Int8 index)
{
  std::int32_t i[LaneCount], words[LaneCount];
  Store(i, index);
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    std::memcpy(
      &words[lane], static_cast<const char*>(base) + static_cast<std::uint32_t>(i[lane]), 4);
  }
  return LoadInt8(words);
}
TETRALUX_INLINE void GatherNeighbors(const float* base, Int8 index, Float8& first, Float8& second)
{
  std::int32_t i[LaneCount];
  Store(i, index);
  const auto two = [&](int a, int b)
  { return vcombine_f32(vld1_f32(base + i[a]), vld1_f32(base + i[b])); };
  const float32x4_t p0 = two(0, 1), p1 = two(2, 3), p2 = two(4, 5), p3 = two(6, 7);
  first = { vuzp1q_f32(p0, p1), vuzp1q_f32(p2, p3) };
  second = { vuzp2q_f32(p0, p1), vuzp2q_f32(p2, p3) };
}

/// Where the four bytes of each entry of a table lie.
TETRALUX_INLINE uint8x16_t FindBytes(int32x4_t index)
{
  return vreinterpretq_u8_s32(vmlaq_s32(vdupq_n_s32(0x03020100), index, vdupq_n_s32(0x04040404)));
}
TETRALUX_INLINE Float8 LookUp(const float (&table)[LaneCount], Int8 index)
{
  const uint8x16x2_t bytes = vld1q_u8_x2(reinterpret_cast<const std::uint8_t*>(table));
  const auto find = [&](int32x4_t i)
  { return vreinterpretq_f32_u8(vqtbl2q_u8(bytes, FindBytes(i))); };
  return { find(index.lo), find(index.hi) };
}
TETRALUX_INLINE Float8 LookUp(const float (&table)[2 * LaneCount], Int8 index)
{
  const uint8x16x4_t bytes = vld1q_u8_x4(reinterpret_cast<const std::uint8_t*>(table));
  const auto find = [&](int32x4_t i)
  { return vreinterpretq_f32_u8(vqtbl4q_u8(bytes, FindBytes(i))); };
  return { find(index.lo), find(index.hi) };
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
