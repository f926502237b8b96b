// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Digest_h
#define tetralux_Digest_h

#include <array>
#include <cstdint>
#include <cstring>

namespace tetralux
{

/// 128 bits that tell data apart by content: not against someone who wants to deceive.
using Digest = std::array<std::uint64_t, 2>;

/// Makes a digest: two independent multiplicative hashes of 64-bit words.
class Digester
{
public:
  void Add(std::uint64_t word)
  {
    constexpr std::uint64_t FirstFactor = 0x9e3779b97f4a7c15;
    constexpr std::uint64_t SecondFactor = 0xc2b2ae3d27d4eb4f;
    this->State[0] = Rotate((this->State[0] ^ word) * FirstFactor);
    this->State[1] = Rotate((this->State[1] + word) * SecondFactor);
  }

  void Add(const void* bytes, std::size_t size)
  {
    this->Add(size);
    const auto* next = static_cast<const unsigned char*>(bytes);
    std::uint64_t word = 0;
    for (; size >= sizeof(word); size -= sizeof(word))
    {
      std::memcpy(&word, next, sizeof(word));
      next += sizeof(word);
      this->Add(word);
    }
    if (size > 0)
    {
      word = 0;
      std::memcpy(&word, next, size);
      this->Add(word);
    }
  }

  const Digest& Get() const { return this->State; }

private:
  static std::uint64_t Rotate(std::uint64_t x) { return (x << 31) | (x >> 33); }

  Digest State{ 0x243f6a8885a308d3, 0x13198a2e03707344 };
};

} // namespace tetralux

#endif
