// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TexelFormats_h
#define tetralux_TexelFormats_h

// How the channels of a table's texels are stored, and read back.

#include <cmath>
#include <cstdint>
#include <cstring>

namespace tetralux
{

/// The nearest of the equidistant values that an unsigned integer stands for, 0..Largest for 0..1.
template <class T, int Largest>
struct UNormChannel
{
  using Type = T;
  static T Encode(float value)
  {
    const float bounded = value < 1.f ? (value > 0.f ? value : 0.f) : 1.f;
    constexpr float Integers = 8388608.f; // 2^23, from where on floats are integers: the sum rounds
    return static_cast<T>((bounded * Largest + Integers) - Integers);
  }
  static float Decode(T bits) { return static_cast<float>(bits) / Largest; }
};

/// IEEE 754 binary16, rounded to nearest, ties to even; beyond its range the largest number.
struct HalfChannel
{
  using Type = std::uint16_t;
  static std::uint16_t Encode(float value)
  {
    // Both branches, and one chosen: compilers turn it into vector instructions.
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    const std::uint32_t sign = (bits >> 16) & 0x8000u;
    bits &= 0x7fffffffu;
    constexpr std::uint32_t LargestBits = 0x477fe000u; // 65504
    bits = bits < LargestBits ? bits : LargestBits;
    float size;
    std::memcpy(&size, &bits, sizeof(size));
    // Below 2^-14, where the last place of the sum is the smallest half: it rounds.
    const float sum = size + 0.5f;
    std::uint32_t small;
    std::memcpy(&small, &sum, sizeof(small));
    small -= 126u << 23;
    // Half of the last place that stays, ties to even.
    const std::uint32_t normal = (bits + 0xfffu + ((bits >> 13) & 1u) - (112u << 23)) >> 13;
    constexpr std::uint32_t SmallestNormal = 113u << 23; // 2^-14
    return static_cast<std::uint16_t>(sign | (bits < SmallestNormal ? small : normal));
  }
  static float Decode(std::uint16_t half)
  {
    // Exponents differ by 112; times a power of two, subnormal halves come out right.
    const std::uint32_t bits = static_cast<std::uint32_t>(half & 0x7fffu) << 13;
    float size;
    std::memcpy(&size, &bits, sizeof(size));
    size *= 5.192296858534828e33f; // 2^112
    return half & 0x8000u ? -size : size;
  }
};

struct FloatChannel
{
  using Type = float;
  static float Encode(float value) { return value; }
  static float Decode(float value) { return value; }
};

using UNorm8Channel = UNormChannel<std::uint8_t, 255>;
using UNorm16Channel = UNormChannel<std::uint16_t, 65535>;

} // namespace tetralux

#endif
