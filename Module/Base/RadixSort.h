// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RadixSort_h
#define tetralux_RadixSort_h

#include "Base/CountingSort.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <omp.h>

namespace tetralux
{

/// A number whose order as an unsigned integer is that of the floats, from the negative ones to the
/// positive ones.
inline std::uint32_t GetSortableBits(float value)
{
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

/// Something with a key of 32 bits.
struct KeyedItem
{
  std::uint32_t Key;
  std::int32_t Item;
};

/// Sorts by ascending keys; items of equal keys stay in their order. Three passes over eleven bits
/// each, those that all keys have in common left out. Parallel, the same result for any number of
/// threads. buffer: memory that is kept for the next call.
inline void SortByKey(std::vector<KeyedItem>& items, std::vector<KeyedItem>& buffer)
{
  constexpr int Bits = 11;
  constexpr std::uint32_t NumberOfDigits = 1U << Bits;
  // Fewer than so many are counted in less time than a thread takes to start.
  constexpr std::int64_t SmallestPart = 1 << 14;
  const std::int64_t size = static_cast<std::int64_t>(items.size());
  const int numberOfParts =
    static_cast<int>(std::clamp<std::int64_t>(size / SmallestPart, 1, omp_get_max_threads()));
  buffer.resize(items.size());
  std::vector<std::array<std::int64_t, NumberOfDigits>> positions(numberOfParts);
  for (int shift = 0; shift < 32; shift += Bits)
  {
    const auto getDigit = [shift](const KeyedItem& item)
    { return (item.Key >> shift) & (NumberOfDigits - 1); };
    ForEachPart(numberOfParts, size,
      [&](int part, std::int64_t begin, std::int64_t end)
      {
        positions[part].fill(0);
        for (std::int64_t i = begin; i < end; ++i)
        {
          ++positions[part][getDigit(items[i])];
        }
      });
    std::int64_t position = 0;
    bool common = false;
    for (std::uint32_t digit = 0; digit < NumberOfDigits; ++digit)
    {
      const std::int64_t before = position;
      for (auto& ofPart : positions)
      {
        position += std::exchange(ofPart[digit], position);
      }
      common = common || position - before == size;
    }
    if (common)
    {
      continue;
    }
    ForEachPart(numberOfParts, size,
      [&](int part, std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          buffer[positions[part][getDigit(items[i])]++] = items[i];
        }
      });
    items.swap(buffer);
  }
}

} // namespace tetralux

#endif
