// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/PreIntegrationTable.h"

#include "Base/Check.h"
#include "PreIntegration/TexelFormats.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace tetralux
{
namespace
{

template <class Channel>
void Decode(const std::uint8_t* texel, float rgba[4])
{
  typename Channel::Type channels[4];
  std::memcpy(channels, texel, sizeof(channels));
  for (int c = 0; c < 4; ++c)
  {
    rgba[c] = Channel::Decode(channels[c]);
  }
}

/// From 4 KB on, memory comes from the system page by page; a table is many of them, and in large
/// ones its first use takes half the time.
constexpr std::size_t LargePage = std::size_t{ 1 } << 21;

constexpr std::size_t CacheLine = 64;

std::size_t GetAlignment(std::size_t bytes) { return bytes >= LargePage ? LargePage : CacheLine; }

} // namespace

std::size_t GetTexelSize(TexelFormat format)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return 4;
    case TexelFormat::UNorm16:
    case TexelFormat::Half:
      return 8;
    case TexelFormat::Float:
      break;
  }
  return 16;
}

float ScalarAxisMap::GetCoordinate(float x) const
{
  const auto found = std::find_if(this->Intervals.begin(), this->Intervals.end() - 1,
    [x](const Interval& interval) { return x < interval.Hi; });
  const float inside = std::min(std::max(found->Lo, x), found->Hi); // Lo where x is not a number
  const float coordinate = found->Coordinate + found->Slope * (inside - found->Lo);
  return std::min(coordinate, static_cast<float>(this->GetSize() - 1));
}

double LengthAxisMap::GetLength(int texel) const
{
  if (this->Scale == LengthScale::Linear)
  {
    return texel * this->Delta;
  }
  const int steps = this->StepsPerDoubling;
  const int doublings = std::max(texel / steps - 1, 0);
  const double share = static_cast<double>(texel - doublings * steps) / steps;
  return std::ldexp(share * this->Delta, doublings);
}

float LengthAxisMap::GetCoordinate(float length) const
{
  const float y = length > 0 ? length * this->InverseDelta : 0.f;
  const float last = static_cast<float>(this->Size - 1);
  if (this->Scale == LengthScale::Linear)
  {
    return std::min(y, last);
  }
  const float one = 1.f;
  const float above = std::max(y, one);
  std::int32_t bits, bitsOfOne;
  std::memcpy(&bits, &above, sizeof(bits));
  std::memcpy(&bitsOfOne, &one, sizeof(bitsOfOne));
  const float steps = static_cast<float>(this->StepsPerDoubling);
  constexpr float mantissa = 8388608.f; // 2^23
  return std::min(
    steps * std::min(y, one) + static_cast<float>(bits - bitsOfOne) * (steps / mantissa), last);
}

void TexelBuffer::Deleter::operator()(std::uint8_t* data) const { std::free(data); }

void TexelBuffer::Resize(std::size_t bytes)
{
  if (bytes == this->Size)
  {
    return;
  }
  this->Data.reset();
  this->Size = 0;
  if (bytes > 0)
  {
    const std::size_t alignment = GetAlignment(bytes);
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    this->Data.reset(static_cast<std::uint8_t*>(std::aligned_alloc(alignment, rounded)));
    if (!this->Data)
    {
      throw std::bad_alloc();
    }
#ifdef __linux__
    if (alignment == LargePage)
    {
      madvise(this->Data.get(), rounded, MADV_HUGEPAGE); // where refused, small pages do as well
    }
#endif
  }
  this->Size = bytes;
}

void PreIntegrationTable::GetTexel(int front, int back, int length, float rgba[4]) const
{
  TETRALUX_CHECK(0 <= front && front < this->Scalars.GetSize());
  TETRALUX_CHECK(0 <= back && back < this->Scalars.GetSize());
  TETRALUX_CHECK(0 <= length && length < this->Lengths.Size);
  const std::size_t n = this->Scalars.GetSize();
  const std::size_t texel = (length * n + back) * n + front;
  const std::uint8_t* data = this->Texels.GetData() + texel * GetTexelSize(this->Settings.Format);
  switch (this->Settings.Format)
  {
    case TexelFormat::UNorm8:
      return Decode<UNorm8Channel>(data, rgba);
    case TexelFormat::UNorm16:
      return Decode<UNorm16Channel>(data, rgba);
    case TexelFormat::Half:
      return Decode<HalfChannel>(data, rgba);
    case TexelFormat::Float:
      return Decode<FloatChannel>(data, rgba);
  }
}

void PreIntegrationTable::FindPlaces(
  double frontScalar, double backScalar, double length, Place places[3]) const
{
  const auto find = [](float coordinate, int size)
  {
    const int index = std::min(static_cast<int>(coordinate), size - 2);
    TETRALUX_CHECK(index >= 0);
    return Place{ index, coordinate - static_cast<float>(index) };
  };
  const auto map = [this](double scalar)
  {
    const double x = (scalar - this->Scalars.Offset) / this->Scalars.Scale;
    return this->Scalars.GetCoordinate(static_cast<float>(x));
  };
  places[0] = find(map(frontScalar), this->Scalars.GetSize());
  places[1] = find(map(backScalar), this->Scalars.GetSize());
  places[2] = find(this->Lengths.GetCoordinate(static_cast<float>(length)), this->Lengths.Size);
}

void PreIntegrationTable::Lookup(
  double frontScalar, double backScalar, double length, float rgba[4]) const
{
  this->Interpolate(frontScalar, backScalar, length, rgba,
    [this](int f, int b, int r, float texel[4]) { this->GetTexel(f, b, r, texel); });
}

} // namespace tetralux
