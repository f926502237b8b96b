// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Lanes_h
#define tetralux_Lanes_h

// Vectors of LaneCount floats, doubles or 32-bit integers: what the packet kernels compute with.
// This header chooses an implementation by what the compiler compiles for: LanesAvx2.h for AVX2
// with FMA, LanesNeon.h for 64-bit ARM, LanesGeneric.h for every other processor. Each lives in a
// namespace of its own (TETRALUX_ISA), so that one library can hold the kernels of several
// instruction sets. What is compiled for AVX-512 uses those of LanesAvx512.h, or with a
// TETRALUX_LANE_COUNT of 16 those of LanesAvx512Wide.h, by the same names. InstructionSet.h tells
// which of them to call.
//
// Types
//
//   Int8, Float8, Double8   vectors; a scalar converts to a vector with that value in each lane
//   Mask8                   one truth value a lane
//   LanesOf<Real>::Type     Float8 or Double8
//
// Operations. No operation mixes lanes, so a ray's result does not depend on the rays beside it.
// All implementations return the same bits, unless it is said here that they don't. A result that
// is not a number has unspecified sign and payload.
//
//   m & n, m | n       of masks
//   AndNot(m, n)       m and not n
//   Bits(m)            one bit a lane, the first lane's lowest
//   MaskFromBits(b)    the mask of these bits
//   Any(m)             whether any lane is set
//   a + b, a - b       of Int8, Float8 and Double8; integers must not overflow
//   a * b              of the same
//   a / b, Sqrt(a)     of Float8 and Double8, rounded as IEEE 754 says
//   Abs(a)             of Float8 and Double8: clears the sign, that of a zero too
//   Fma(a, b, c)       a * b + c, rounded once. LanesGeneric.h rounds the product too, since a
//                      fused one without hardware for it is a slow call.
//   Min(a, b)          a < b ? a : b. So b if either is not a number, and b of two zeros.
//   Max(a, b)          a > b ? a : b, with the same consequences
//   a < b, a <= b      of Float8 and Double8; false if either is not a number
//   a == b             of all; false if either is not a number
//   a > b              of Int8
//   Select(m, a, b)    a where the mask is set, else b; bits are copied
//   Keep(m, a)         a where the mask is set, else +0; bits are copied
//   Ones(m)            1 where the mask is set, else 0
//   ShiftLeft(a, n)    of Int8, by n bits, as of an unsigned number; n may be a vector, 0..31 each
//   ShiftRight(a, n)   of Int8, by n bits, as of an unsigned number
//   ShiftRightSigned(a, n)
//                      of Int8, by n bits, copies of the sign moving in
//   RoundToInt(a)      the nearest integer, ties to even. Unspecified where a is not a number, and
//                      where Int8 does not hold it.
//   ToFloat, ToDouble  conversions, rounded as IEEE 754 says
//   FromBits, ToBits   an integer as the float with the same bits, and back
//   DifferenceOfProducts(a, b, c, d)
//                      a b - c d with an error below 1.5 units in the last place. Its sign is exact
//                      where no product underflows. Implementations may round differently.
//                      Unspecified: the sign of a zero, and the result where a product overflows or
//                      a factor is not finite.
//   LoadFloat8, LoadDouble8, LoadInt8, Store
//                      LaneCount consecutive values, at any alignment
//   StoreWhere(m, a, p)
//                      the 64-bit integer a in p[i] of the lanes where the mask is set
//   LoadRows(r, x, y, z, s)
//                      four consecutive doubles from r[i] of each lane, transposed. Rows are
//                      aligned to their size.
//   GatherRows         four consecutive values from base + 4 * index of each lane, transposed. Rows
//                      are aligned to their size. Indices are in 0..2^29 - 1.
//   GatherPairs        two consecutive integers from base + 2 * index of each lane, transposed.
//                      Indices are at least 0.
//   GatherWords        32 bits from base + index of each lane, which counts bytes, at any alignment
//   GatherNeighbors    two consecutive floats from base + index of each lane. Indices are at least
//                      0.
//   LookUp(t, index)   t[index] of each lane, of a table of LaneCount or of two times as many, of
//                      LanesAvx512Wide.h also of three and four times. Unspecified where an
//                      index is not in the table.
//   Lane(a, i)         one lane
//   Polynomial(x, c)   Horner's scheme, with Fma

#include "Simd/LaneCount.h"
#if defined(__AVX2__) && defined(__FMA__)
#if TETRALUX_LANE_COUNT == 16
#define TETRALUX_ISA isa_avx512_wide
#elif defined(__AVX512F__)
#define TETRALUX_ISA isa_avx512
#else
#define TETRALUX_ISA isa_avx2
#endif
#define TETRALUX_FUSED 1 // whether Fma rounds once
#elif defined(__aarch64__)
#define TETRALUX_ISA isa_neon
#define TETRALUX_FUSED 1
#else
#define TETRALUX_ISA isa_generic
#define TETRALUX_FUSED 0
#endif
// Else loops over lanes, and what sanitizers add, take minutes to compile in one function.
#if defined(__GNUC__) && TETRALUX_FUSED && !defined(__SANITIZE_ADDRESS__)
#define TETRALUX_INLINE inline __attribute__((always_inline))
#define TETRALUX_INLINE_LAMBDA __attribute__((always_inline))
#else
#define TETRALUX_INLINE inline
#define TETRALUX_INLINE_LAMBDA
#endif
#if defined(__GNUC__)
#define TETRALUX_NOINLINE __attribute__((noinline))
#else
#define TETRALUX_NOINLINE
#endif
#if TETRALUX_LANE_COUNT == 16
#include "Simd/LanesAvx512Wide.h"
#elif TETRALUX_FUSED && defined(__AVX512F__)
#include "Simd/LanesAvx512.h"
#elif defined(__aarch64__)
#include "Simd/LanesNeon.h"
#elif TETRALUX_FUSED
#include "Simd/LanesAvx2.h"
#else
#include "Simd/LanesGeneric.h"
#endif

namespace tetralux
{
namespace TETRALUX_ISA
{

/// The vector of a Real.
template <class Real>
struct LanesOf;
template <>
struct LanesOf<float>
{
  using Type = Float8;
};
template <>
struct LanesOf<double>
{
  using Type = Double8;
};

/// The first lane of some, of at least one.
TETRALUX_INLINE int FindFirstLane(unsigned bits) { return __builtin_ctz(bits); }

TETRALUX_INLINE Float8 ToFloat(Float8 a) { return a; }
TETRALUX_INLINE float Lane(Float8 a, int i)
{
  float v[LaneCount];
  Store(v, a);
  return v[i];
}
TETRALUX_INLINE double Lane(Double8 a, int i)
{
  double v[LaneCount];
  Store(v, a);
  return v[i];
}

/// Horner's scheme; c from the constant term up.
template <int N>
TETRALUX_INLINE Float8 Polynomial(Float8 x, const float (&c)[N])
{
  Float8 r = c[N - 1];
  for (int i = N - 2; i >= 0; --i)
  {
    r = Fma(r, x, Float8(c[i]));
  }
  return r;
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
