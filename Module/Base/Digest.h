// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Digest_h
#define tetralux_Digest_h

#include "Base/Span.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace tetralux
{

/// 128 bits that tell arrays apart by their bits: not against someone who wants to deceive.
inline std::array<std::uint64_t, 2> MakeDigest(Span<const double> values)
{
  constexpr std::uint64_t FirstFactor = 0x9e3779b97f4a7c15;
  constexpr std::uint64_t SecondFactor = 0xc2b2ae3d27d4eb4f;
  const auto rotate = [](std::uint64_t x) { return (x << 31) | (x >> 33); };
  std::array<std::uint64_t, 2> state{ values.size(), ~values.size() };
  for (const double value : values)
  {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof(word));
    state[0] = rotate((state[0] ^ word) * FirstFactor);
    state[1] = rotate((state[1] + word) * SecondFactor);
  }
  return state;
}

} // namespace tetralux

#endif
