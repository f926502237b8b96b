// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/GradientVoxels.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace tetralux
{
namespace
{

constexpr float LargestFloat = std::numeric_limits<float>::max();

/// What a difference along one axis is made of, at one place of that axis.
struct Difference
{
  std::int64_t Before, Behind; ///< offsets of its two values
  float Share;                 ///< 1 over the points between them

  Difference(int place, int dimension, std::int64_t stride)
    : Before(place > 0 ? -stride : 0)
    , Behind(place + 1 < dimension ? stride : 0)
    , Share(place > 0 && place + 1 < dimension ? 0.5f : 1.f)
  {
  }

  template <class Value>
  float Of(const Value* at) const
  {
    const float difference =
      (static_cast<float>(at[this->Behind]) - static_cast<float>(at[this->Before])) * this->Share;
    return difference >= -LargestFloat && difference <= LargestFloat ? difference : 0.f;
  }
};

/// The gradients of one row of points: dimension x of each component, one after the other.
template <class Value>
void FindRow(const ImageVolume& volume, const Value* row, int y, int z, float* gradients)
{
  const int* size = volume.Dimensions;
  const std::int64_t stride = size[0];
  const Difference inside(1, 3, 1);
  const Difference alongY(y, size[1], stride);
  const Difference alongZ(z, size[2], stride * size[1]);
  for (int x = 1; x + 1 < size[0]; ++x)
  {
    gradients[x] = inside.Of(row + x);
  }
  for (const int x : { 0, size[0] - 1 })
  {
    gradients[x] = Difference(x, size[0], 1).Of(row + x);
  }
  for (int x = 0; x < size[0]; ++x)
  {
    gradients[size[0] + x] = alongY.Of(row + x);
  }
  for (int x = 0; x < size[0]; ++x)
  {
    gradients[2 * size[0] + x] = alongZ.Of(row + x);
  }
}

/// Calls use(first point, first value, gradients) for each row of points.
template <class Value, class Use>
void ForEachRow(const ImageVolume& volume, int threads, const Use& use)
{
  const auto* values = static_cast<const Value*>(volume.Values);
  const int* size = volume.Dimensions;
#pragma omp parallel num_threads(threads)
  {
    std::vector<float> gradients(3 * static_cast<std::size_t>(size[0]));
#pragma omp for schedule(static)
    for (int z = 0; z < size[2]; ++z)
    {
      for (int y = 0; y < size[1]; ++y)
      {
        const std::size_t first = (static_cast<std::size_t>(z) * size[1] + y) * size[0];
        FindRow(volume, values + first, y, z, gradients.data());
        use(first, values + first, gradients);
      }
    }
  }
}

template <class Value>
float FindLargest(const ImageVolume& volume, int threads)
{
  std::vector<float> ofSlice(volume.Dimensions[2], 0.f);
  const std::size_t slice = static_cast<std::size_t>(volume.Dimensions[0]) * volume.Dimensions[1];
  ForEachRow<Value>(volume, threads,
    [&](std::size_t first, const Value*, const std::vector<float>& gradients)
    {
      float& largest = ofSlice[first / slice];
      for (const float g : gradients)
      {
        const float size = g < 0 ? -g : g;
        largest = size > largest ? size : largest;
      }
    });
  return *std::max_element(ofSlice.begin(), ofSlice.end());
}

template <class Value>
void FillWords(const ImageVolume& volume, float largest, int threads, RawVector<float>& words)
{
  const float factor = largest > 0 ? GradientVoxels::Largest / largest : 0.f;
  // A largest component below the normal numbers has no reciprocal.
  const float scale = factor <= LargestFloat ? factor : 0.f;
  const int count = volume.Dimensions[0];
  ForEachRow<Value>(volume, threads,
    [&](std::size_t first, const Value* values, const std::vector<float>& gradients)
    {
      for (int x = 0; x < count; ++x)
      {
        std::uint32_t word = 0;
        for (int a = 0; a < 3; ++a)
        {
          const float component = gradients[a * count + x] * scale;
          const int rounded = static_cast<int>(component + (component < 0 ? -0.5f : 0.5f));
          word |= (static_cast<std::uint32_t>(rounded) & 255u) << 8 * a;
        }
        if constexpr (std::is_same_v<Value, std::uint8_t>)
        {
          word |= static_cast<std::uint32_t>(values[x]) << 24;
        }
        std::memcpy(&words[first + x], &word, sizeof(word));
      }
    });
}

template <class Value>
float BuildWords(const ImageVolume& volume, int threads, RawVector<float>& words)
{
  const float largest = FindLargest<Value>(volume, threads);
  words.resize(GetNumberOfValues(volume));
  FillWords<Value>(volume, largest, threads, words);
  return largest / GradientVoxels::Largest;
}

} // namespace

void GradientVoxels::Build(const ImageVolume& volume, int threads)
{
  switch (volume.Type)
  {
    case ImageScalar::Int8:
      this->Scale = BuildWords<std::int8_t>(volume, threads, this->Words);
      break;
    case ImageScalar::UInt8:
      this->Scale = BuildWords<std::uint8_t>(volume, threads, this->Words);
      break;
    case ImageScalar::Int16:
      this->Scale = BuildWords<std::int16_t>(volume, threads, this->Words);
      break;
    case ImageScalar::UInt16:
      this->Scale = BuildWords<std::uint16_t>(volume, threads, this->Words);
      break;
    case ImageScalar::Float:
      this->Scale = BuildWords<float>(volume, threads, this->Words);
      break;
  }
}

} // namespace tetralux
