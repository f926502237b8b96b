// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LaneFunctions_h
#define tetralux_LaneFunctions_h

// Elementary functions of lanes, in single precision.

#include "Simd/Lanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{

/// 1 where a < b, else 0, of numbers that are not negative.
TETRALUX_INLINE Int8 IsSmaller(Int8 a, Int8 b) { return ShiftRight(a - b, 31); }

/// Up to this, a function of exp(-x) has no power of 2 to split off.
constexpr float MostOfShortExp = 0.346f; // ln(2) / 2

/// The same bits as those of ExpMinus, for x from 0 to MostOfShortExp.
TETRALUX_INLINE Float8 ShortExpMinus(Float8 x)
{
  static constexpr float c[] = { 1.f, -1.f, 1.f / 2, -1.f / 6, 1.f / 24, -1.f / 120, 1.f / 720,
    -1.f / 5040 };
  return Polynomial(x, c);
}

/// exp(-x) for x >= 0, relative error 2e-7; 0 from x = 87 (below the normal numbers).
TETRALUX_INLINE Float8 ExpMinus(Float8 x)
{
  const Float8 bounded = Min(x, Float8(87.f));
  const Int8 n = RoundToInt(bounded * Float8(1.44269504f)); // 1 / ln 2
  const Float8 nf = ToFloat(n);
  // ln 2 in two parts, the first short enough for n * part to be exact.
  Float8 r = Fma(nf, Float8(-0.693359375f), bounded);
  r = Fma(nf, Float8(2.12194440e-4f), r);
  const Float8 power = FromBits(ShiftLeft(Int8(127) - n, 23)); // 2^-n
  return Keep(x < Float8(87.f), ShortExpMinus(r) * power);
}

/// -ln(x) for normal numbers in 0..1, relative error 2e-7, near 1 too; 0 above 1.
TETRALUX_INLINE Float8 MinusLog(Float8 x)
{
  // x = 2^n m with m in 3/4..3/2. Read as an integer, a number is its exponent and its mantissa.
  constexpr float Mantissa = 8388608.f; // 2^23
  const Float8 one = 1.f;
  const Int8 bits = ToBits(x);
  const Int8 n = RoundToInt(ToFloat(bits - ToBits(one)) * Float8(1 / Mantissa));
  const Float8 m = FromBits(bits - ShiftLeft(n, 23));
  // ln(m) = 2 artanh(s).
  static constexpr float c[] = { 2.f, 2.f / 3, 2.f / 5, 2.f / 7, 2.f / 9 };
  const Float8 s = (m - one) / (m + one);
  const Float8 log = Fma(ToFloat(n), Float8(0.693147181f), s * Polynomial(s * s, c));
  return Max(Float8(0.f), Float8(0.f) - log);
}

/// -ln(1 - x) for x of 0 or more, relative error 3e-7, near 0 too; LargestDepth from x = 1 on.
constexpr float LargestDepth = 1e37f;
TETRALUX_INLINE Float8 MinusLogOfRest(Float8 x)
{
  // As MinusLog of 1 - x. Near 0 the difference is rounded, but 1 - m is not there.
  constexpr float Mantissa = 8388608.f; // 2^23
  const Float8 one = 1.f;
  const Float8 rest = Max(one - x, Float8(1e-30f)); // a normal number, whatever x is
  const Int8 bits = ToBits(rest);
  const Int8 n = RoundToInt(ToFloat(bits - ToBits(one)) * Float8(1 / Mantissa));
  const Float8 m = FromBits(bits - ShiftLeft(n, 23));
  static constexpr float c[] = { 2.f, 2.f / 3, 2.f / 5, 2.f / 7, 2.f / 9 };
  const Float8 difference = Select(n == Int8(0), x, one - m);
  const Float8 s = difference / (Select(n == Int8(0), rest, m) + one);
  const Float8 log = Fma(ToFloat(n), Float8(-0.693147181f), s * Polynomial(s * s, c));
  return Select(x < one, log, Float8(LargestDepth));
}

/// 1 - exp(-x) for x >= 0, relative error 3e-7, near 0 too; 1 from x = 87.
TETRALUX_INLINE Float8 OneMinusExp(Float8 x)
{
  // exp(-x) = 2^-n (1 - r q(r)), so 1 - exp(-x) = (1 - 2^-n) + 2^-n r q(r), where both are exact
  // for n = 0.
  static constexpr float q[] = { 1.f, -1.f / 2, 1.f / 6, -1.f / 24, 1.f / 120, -1.f / 720,
    1.f / 5040 };
  const Float8 bounded = Min(x, Float8(87.f));
  const Int8 n = RoundToInt(bounded * Float8(1.44269504f)); // 1 / ln 2
  const Float8 nf = ToFloat(n);
  Float8 r = Fma(nf, Float8(-0.693359375f), bounded);
  r = Fma(nf, Float8(2.12194440e-4f), r);
  const Float8 power = FromBits(ShiftLeft(Int8(127) - n, 23)); // 2^-n
  return Fma(power * r, Polynomial(r, q), Float8(1.f) - power);
}

/// The same bits as those of MinusLogOfRest up to MostOfShortLog, and of OneMinusExp up to
/// MostOfShortExp, where neither has to split off a power of 2. x is at least 0.
///@{
constexpr float MostOfShortLog = 0.25f;
TETRALUX_INLINE Float8 ShortMinusLogOfRest(Float8 x)
{
  static constexpr float c[] = { 2.f, 2.f / 3, 2.f / 5, 2.f / 7, 2.f / 9 };
  const Float8 one = 1.f;
  const Float8 s = x / ((one - x) + one);
  return s * Polynomial(s * s, c);
}
TETRALUX_INLINE Float8 ShortOneMinusExp(Float8 x)
{
  static constexpr float q[] = { 1.f, -1.f / 2, 1.f / 6, -1.f / 24, 1.f / 120, -1.f / 720,
    1.f / 5040 };
  return x * Polynomial(x, q);
}
///@}

/// x^power for x in 0..1 and a power of 0 or more; below 1e-30 as at 1e-30. Relative error 2e-7 for
/// each e-fold that the result is below 1.
TETRALUX_INLINE Float8 Power(Float8 x, Float8 power)
{
  constexpr float Smallest = 1e-30f;
  return ExpMinus(power * MinusLog(Max(Float8(Smallest), x)));
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
