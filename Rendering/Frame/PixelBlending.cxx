// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/PixelBlending.h"

namespace tetralux
{
namespace
{

/// Written so that compilers make vectors of it, as are the loops below.
inline float ToUnit(float value)
{
  value = value > 0 ? value : 0;
  return value < 1 ? value : 1;
}

/// Of depths below 1, by two halves of 16 bits: vectors have no conversion to 32 bits without a
/// sign. Each step is exact.
inline std::uint32_t ToFixedDepth(float depth)
{
  constexpr float Half = 65536;
  const float scaled = Half * (depth > 0 ? depth : 0);
  const auto high = static_cast<int>(scaled);
  const auto low = static_cast<int>(Half * (scaled - static_cast<float>(high)));
  return static_cast<std::uint32_t>(high) << 16 | static_cast<std::uint32_t>(low);
}

} // namespace

void BlendColors(const float* __restrict colors, std::uint32_t* __restrict pixels, int count)
{
  for (int k = 0; k < count; ++k)
  {
    const auto before = static_cast<int>(pixels[k]);
    const float alpha = ToUnit(colors[4 * k + 3]);
    const float rest = 1 - alpha;
    const auto blend = [rest](float added, int channel)
    {
      const float sum = 255.f * added + rest * static_cast<float>(channel) + 0.5f;
      return static_cast<std::uint32_t>(static_cast<int>(sum < 255.f ? sum : 255.f));
    };
    pixels[k] = blend(ToUnit(colors[4 * k]), before & 255) |
      blend(ToUnit(colors[4 * k + 1]), (before >> 8) & 255) << 8 |
      blend(ToUnit(colors[4 * k + 2]), (before >> 16) & 255) << 16 |
      blend(alpha, (before >> 24) & 255) << 24;
  }
}

void PutOpaque(const std::uint8_t* __restrict bytes, const float* __restrict depths,
  std::uint32_t* __restrict pixels, std::uint32_t* __restrict pixelDepths, int count)
{
  for (int k = 0; k < count; ++k)
  {
    const std::uint32_t color = static_cast<std::uint32_t>(bytes[4 * k]) |
      static_cast<std::uint32_t>(bytes[4 * k + 1]) << 8 |
      static_cast<std::uint32_t>(bytes[4 * k + 2]) << 16 |
      static_cast<std::uint32_t>(bytes[4 * k + 3]) << 24;
    const std::uint32_t depth = ToFixedDepth(depths[k] < 1 ? depths[k] : 0);
    const bool seen = depths[k] < 1 && depth <= pixelDepths[k];
    pixels[k] = seen ? color : pixels[k];
    pixelDepths[k] = seen ? depth : pixelDepths[k];
  }
}

void PutDepths(const float* __restrict depths, std::uint32_t* __restrict pixelDepths, int count)
{
  for (int k = 0; k < count; ++k)
  {
    const std::uint32_t depth = ToFixedDepth(depths[k] < 1 ? depths[k] : 0);
    pixelDepths[k] = depths[k] < 1 && depth < pixelDepths[k] ? depth : pixelDepths[k];
  }
}

} // namespace tetralux
