// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LanesGeneric_h
#define tetralux_LanesGeneric_h

// The lanes of Lanes.h as plain loops, for any processor. Only Lanes.h includes this; it says what
// each operation does.

#include "Simd/LaneCount.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace tetralux
{
namespace TETRALUX_ISA
{

template <class T>
struct Lanes
{
  T v[LaneCount];
  Lanes() = default;
  TETRALUX_INLINE Lanes(T x)
  {
    for (T& lane : this->v)
    {
      lane = x;
    }
  }
  template <class F>
  static TETRALUX_INLINE Lanes Each(F f)
  {
    Lanes r;
    for (int i = 0; i < LaneCount; ++i)
    {
      r.v[i] = f(i);
    }
    return r;
  }
};
using Int8 = Lanes<std::int32_t>;
using Float8 = Lanes<float>;
using Double8 = Lanes<double>;
struct Mask8
{
  std::int32_t v[LaneCount]; // -1 or 0
  template <class F>
  static TETRALUX_INLINE Mask8 Each(F f)
  {
    Mask8 r;
    for (int i = 0; i < LaneCount; ++i)
    {
      r.v[i] = f(i) ? -1 : 0;
    }
    return r;
  }
};

TETRALUX_INLINE Mask8 operator&(Mask8 a, Mask8 b)
{
  return Mask8::Each([&](int i) { return a.v[i] & b.v[i]; });
}
TETRALUX_INLINE Mask8 operator|(Mask8 a, Mask8 b)
{
  return Mask8::Each([&](int i) { return a.v[i] | b.v[i]; });
}
TETRALUX_INLINE Mask8 AndNot(Mask8 a, Mask8 b)
{
  return Mask8::Each([&](int i) { return a.v[i] & ~b.v[i]; });
}
TETRALUX_INLINE unsigned Bits(Mask8 m)
{
  unsigned bits = 0;
  for (int i = 0; i < LaneCount; ++i)
  {
    bits |= static_cast<unsigned>(m.v[i] & 1) << i;
  }
  return bits;
}
TETRALUX_INLINE Mask8 MaskFromBits(unsigned bits)
{
  return Mask8::Each([&](int i) { return (bits >> i) & 1u; });
}
TETRALUX_INLINE bool Any(Mask8 m) { return Bits(m) != 0; }

template <class T>
TETRALUX_INLINE Lanes<T> operator+(Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] + b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> operator-(Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] - b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> operator*(Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] * b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> operator/(Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] / b.v[i]; });
}
template <class T>
TETRALUX_INLINE Mask8 operator<(Lanes<T> a, Lanes<T> b)
{
  return Mask8::Each([&](int i) { return a.v[i] < b.v[i]; });
}
template <class T>
TETRALUX_INLINE Mask8 operator>(Lanes<T> a, Lanes<T> b)
{
  return Mask8::Each([&](int i) { return a.v[i] > b.v[i]; });
}
template <class T>
TETRALUX_INLINE Mask8 operator<=(Lanes<T> a, Lanes<T> b)
{
  return Mask8::Each([&](int i) { return a.v[i] <= b.v[i]; });
}
template <class T>
TETRALUX_INLINE Mask8 operator==(Lanes<T> a, Lanes<T> b)
{
  return Mask8::Each([&](int i) { return a.v[i] == b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> Select(Mask8 m, Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return m.v[i] ? a.v[i] : b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> Keep(Mask8 m, Lanes<T> a)
{
  return Lanes<T>::Each([&](int i) { return m.v[i] ? a.v[i] : T(0); });
}
template <class T>
TETRALUX_INLINE Lanes<T> Min(Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> Max(Lanes<T> a, Lanes<T> b)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
template <class T>
TETRALUX_INLINE Lanes<T> Abs(Lanes<T> a)
{
  return Lanes<T>::Each([&](int i) { return std::fabs(a.v[i]); });
}
template <class T>
TETRALUX_INLINE Lanes<T> Sqrt(Lanes<T> a)
{
  return Lanes<T>::Each([&](int i) { return std::sqrt(a.v[i]); });
}
template <class T>
TETRALUX_INLINE void Store(T* p, Lanes<T> a)
{
  std::memcpy(p, a.v, sizeof(a.v));
}
template <class T>
TETRALUX_INLINE Lanes<T> Fma(Lanes<T> a, Lanes<T> b, Lanes<T> c)
{
  return Lanes<T>::Each([&](int i) { return a.v[i] * b.v[i] + c.v[i]; });
}
TETRALUX_INLINE Int8 LoadInt8(const std::int32_t* p)
{
  return Int8::Each([&](int i) { return p[i]; });
}
TETRALUX_INLINE Float8 LoadFloat8(const float* p)
{
  return Float8::Each([&](int i) { return p[i]; });
}
TETRALUX_INLINE Double8 LoadDouble8(const double* p)
{
  return Double8::Each([&](int i) { return p[i]; });
}
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, int bits)
{
  return Int8::Each(
    [&](int i) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v[i]) << bits); });
}
TETRALUX_INLINE Int8 ShiftLeft(Int8 a, Int8 bits)
{
  return Int8::Each([&](int i)
    { return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v[i]) << bits.v[i]); });
}
TETRALUX_INLINE Int8 ShiftRight(Int8 a, int bits)
{
  return Int8::Each(
    [&](int i) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v[i]) >> bits); });
}
TETRALUX_INLINE Int8 ShiftRightSigned(Int8 a, int bits)
{
  return Int8::Each([&](int i) { return a.v[i] >> bits; });
}
TETRALUX_INLINE Int8 Ones(Mask8 m)
{
  return Int8::Each([&](int i) { return m.v[i] & 1; });
}
TETRALUX_INLINE Int8 RoundToInt(Float8 a)
{
  return Int8::Each([&](int i) { return static_cast<std::int32_t>(std::nearbyint(a.v[i])); });
}
TETRALUX_INLINE Float8 ToFloat(Int8 a)
{
  return Float8::Each([&](int i) { return static_cast<float>(a.v[i]); });
}
TETRALUX_INLINE Int8 ToBits(Float8 a)
{
  Int8 r;
  std::memcpy(r.v, a.v, sizeof(r.v));
  return r;
}
TETRALUX_INLINE Float8 FromBits(Int8 a)
{
  Float8 r;
  std::memcpy(r.v, a.v, sizeof(r.v));
  return r;
}
TETRALUX_INLINE Float8 ToFloat(Double8 a)
{
  return Float8::Each([&](int i) { return static_cast<float>(a.v[i]); });
}
TETRALUX_INLINE Double8 ToDouble(Float8 a)
{
  return Double8::Each([&](int i) { return static_cast<double>(a.v[i]); });
}

// The products of two floats are exact in double. For doubles Kahan's algorithm, as in LanesAvx2.h.
TETRALUX_INLINE Float8 DifferenceOfProducts(Float8 a, Float8 b, Float8 c, Float8 d)
{
  return Float8::Each(
    [&](int i)
    {
      return static_cast<float>(
        static_cast<double>(a.v[i]) * b.v[i] - static_cast<double>(c.v[i]) * d.v[i]);
    });
}
TETRALUX_INLINE Double8 DifferenceOfProducts(Double8 a, Double8 b, Double8 c, Double8 d)
{
  return Double8::Each(
    [&](int i)
    {
      const double cd = c.v[i] * d.v[i];
      const double error = std::fma(-c.v[i], d.v[i], cd);
      return std::fma(a.v[i], b.v[i], -cd) + error;
    });
}

TETRALUX_INLINE void LoadRows(
  const double* const (&row)[LaneCount], Double8& x, Double8& y, Double8& z, Double8& s)
{
  for (int i = 0; i < LaneCount; ++i)
  {
    x.v[i] = row[i][0];
    y.v[i] = row[i][1];
    z.v[i] = row[i][2];
    s.v[i] = row[i][3];
  }
}
TETRALUX_INLINE void StoreWhere(Mask8 m, std::int64_t a, std::int64_t* p)
{
  const unsigned bits = Bits(m);
  for (int i = 0; i < LaneCount; ++i)
  {
    p[i] = (bits >> i & 1) != 0 ? a : p[i];
  }
}
template <class T>
TETRALUX_INLINE void GatherRows(
  const T* base, Int8 index, Lanes<T>& x, Lanes<T>& y, Lanes<T>& z, Lanes<T>& s)
{
  for (int i = 0; i < LaneCount; ++i)
  {
    const T* row = base + 4 * std::int64_t{ index.v[i] };
    x.v[i] = row[0];
    y.v[i] = row[1];
    z.v[i] = row[2];
    s.v[i] = row[3];
  }
}
TETRALUX_INLINE void GatherPairs(const std::int32_t* base, Int8 index, Int8& first, Int8& second)
{
  for (int i = 0; i < LaneCount; ++i)
  {
    const std::int32_t* pair = base + 2 * std::int64_t{ index.v[i] };
    first.v[i] = pair[0];
    second.v[i] = pair[1];
  }
}
TETRALUX_INLINE Int8 GatherWords(const void* base, Int8 index)
{
  Int8 words;
  for (int i = 0; i < LaneCount; ++i)
  {
    std::memcpy(
      &words.v[i], static_cast<const char*>(base) + static_cast<std::uint32_t>(index.v[i]), 4);
  }
  return words;
}
TETRALUX_INLINE void GatherNeighbors(const float* base, Int8 index, Float8& first, Float8& second)
{
  for (int i = 0; i < LaneCount; ++i)
  {
    const float* pair = base + index.v[i];
    first.v[i] = pair[0];
    second.v[i] = pair[1];
  }
}

template <int N>
TETRALUX_INLINE Float8 LookUp(const float (&table)[N], Int8 index)
{
  return Float8::Each([&](int i) { return table[index.v[i]]; });
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
