// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/EmptySpace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace tetralux
{
namespace
{

template <class Value>
void FindRanges(const ImageVolume& volume, int component, const std::int32_t (&size)[3],
  int threads, std::vector<BlockRanges::Range>& ranges)
{
  const auto* values = static_cast<const Value*>(volume.Values) + component;
  const std::int64_t step = volume.Components;
  const std::int64_t row = step * volume.Dimensions[0];
  const std::int64_t slice = row * volume.Dimensions[1];
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (std::int32_t bz = 0; bz < size[2]; ++bz)
  {
    const int z1 = std::min((bz + 1) * BlockRanges::BlockSize, volume.Dimensions[2] - 1);
    for (std::int32_t by = 0; by < size[1]; ++by)
    {
      const int y1 = std::min((by + 1) * BlockRanges::BlockSize, volume.Dimensions[1] - 1);
      for (std::int32_t bx = 0; bx < size[0]; ++bx)
      {
        const int x1 = std::min((bx + 1) * BlockRanges::BlockSize, volume.Dimensions[0] - 1);
        float low = std::numeric_limits<float>::infinity();
        float high = -low;
        int finite = 0;
        int count = 0;
        for (int z = bz * BlockRanges::BlockSize; z <= z1; ++z)
        {
          for (int y = by * BlockRanges::BlockSize; y <= y1; ++y)
          {
            const Value* at = values + z * slice + y * row;
            for (int x = bx * BlockRanges::BlockSize; x <= x1; ++x)
            {
              const auto value = static_cast<float>(at[x * step]);
              low = value < low ? value : low;
              high = value > high ? value : high;
              if constexpr (std::is_same_v<Value, float>)
              {
                finite += std::isfinite(value) ? 1 : 0;
                ++count;
              }
            }
          }
        }
        ranges[(static_cast<std::int64_t>(bz) * size[1] + by) * size[0] + bx] = { low, high,
          finite > 0 && finite < count };
      }
    }
  }
}

std::int32_t CountBlocks(int points)
{
  return (points - 1 + BlockRanges::BlockSize - 1) / BlockRanges::BlockSize;
}

BlockLabels::Set FindLabels(const ImageVolume& volume, const std::vector<unsigned char>& hidden,
  const std::int64_t (&block)[3])
{
  std::int64_t begin[3], end[3];
  for (int a = 0; a < 3; ++a)
  {
    begin[a] = block[a] * BlockRanges::BlockSize;
    end[a] = std::min<std::int64_t>(begin[a] + BlockRanges::BlockSize, volume.Dimensions[a] - 1);
  }
  BlockLabels::Set labels = 0;
  bool shown = hidden.empty();
  for (std::int64_t z = begin[2]; z <= end[2]; ++z)
  {
    for (std::int64_t y = begin[1]; y <= end[1]; ++y)
    {
      for (std::int64_t x = begin[0]; x <= end[0]; ++x)
      {
        const std::int64_t point = (z * volume.Dimensions[1] + y) * volume.Dimensions[0] + x;
        const bool isCell = x < end[0] && y < end[1] && z < end[2];
        shown = shown || (isCell && hidden[point] == 0);
        if (!volume.Mask || volume.Mask[point] != 0)
        {
          labels |= BlockLabels::GetSet(volume.Labels ? volume.Labels[point] : 0);
        }
      }
    }
  }
  return shown ? labels : 0;
}

} // namespace

void BlockRanges::Build(const ImageVolume& volume, int component, int threads)
{
  for (int a = 0; a < 3; ++a)
  {
    this->Size[a] = CountBlocks(volume.Dimensions[a]);
  }
  this->Ranges.resize(static_cast<std::size_t>(this->Size[0]) * this->Size[1] * this->Size[2]);
  switch (volume.Type)
  {
    case ImageScalar::Int8:
      FindRanges<std::int8_t>(volume, component, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::UInt8:
      FindRanges<std::uint8_t>(volume, component, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::Int16:
      FindRanges<std::int16_t>(volume, component, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::UInt16:
      FindRanges<std::uint16_t>(volume, component, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::Float:
      FindRanges<float>(volume, component, this->Size, threads, this->Ranges);
      break;
  }
}

BlockRanges::Range BlockRanges::FindRange(const double low[3], const double high[3]) const
{
  const BlockBox box(this->Size, BlockSize, low, high);
  Range all{ std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() };
  for (std::int64_t z = box.From[2]; z < box.To[2]; ++z)
  {
    for (std::int64_t y = box.From[1]; y < box.To[1]; ++y)
    {
      const Range* row = this->Ranges.data() + (z * this->Size[1] + y) * this->Size[0];
      for (std::int64_t x = box.From[0]; x < box.To[0]; ++x)
      {
        all.Low = std::min(all.Low, row[x].Low);
        all.High = std::max(all.High, row[x].High);
        all.Mixed = all.Mixed || row[x].Mixed;
      }
    }
  }
  return all;
}

BlockRanges::Range BlockRanges::GetRange() const
{
  Range all{ std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() };
  for (const Range& range : this->Ranges)
  {
    all.Low = std::min(all.Low, range.Low);
    all.High = std::max(all.High, range.High);
  }
  return std::isfinite(all.Low) && std::isfinite(all.High) ? all : Range{ 0, 0 };
}

void BlockLabels::Build(
  const ImageVolume& volume, const std::vector<unsigned char>& hiddenCells, int threads)
{
  this->Sets.clear();
  if (!volume.Labels && !volume.Mask && hiddenCells.empty())
  {
    return;
  }
  std::int64_t size[3];
  for (int a = 0; a < 3; ++a)
  {
    size[a] = CountBlocks(volume.Dimensions[a]);
  }
  this->Sets.resize(size[0] * size[1] * size[2]);
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (std::int64_t bz = 0; bz < size[2]; ++bz)
  {
    for (std::int64_t by = 0; by < size[1]; ++by)
    {
      for (std::int64_t bx = 0; bx < size[0]; ++bx)
      {
        const std::int64_t block[3] = { bx, by, bz };
        this->Sets[(bz * size[1] + by) * size[0] + bx] = FindLabels(volume, hiddenCells, block);
      }
    }
  }
}

void EmptySpace::Build(
  const std::int32_t size[3], int threads, const std::function<bool(std::int64_t)>& contributes)
{
  std::copy(size, size + 3, this->Size);
  const std::int64_t nx = this->Size[0] + 1, ny = this->Size[1] + 1, nz = this->Size[2] + 1;
  this->Sums.assign(static_cast<std::size_t>(nx * ny * nz), 0);
  // Sums in each layer of blocks by itself, and then over the layers.
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (std::int64_t z = 1; z < nz; ++z)
  {
    for (std::int64_t y = 1; y < ny; ++y)
    {
      std::int32_t row = 0;
      std::int32_t* sums = &this->Sums[(z * ny + y) * nx];
      for (std::int64_t x = 1; x < nx; ++x)
      {
        row += contributes(((z - 1) * (ny - 1) + y - 1) * (nx - 1) + x - 1) ? 1 : 0;
        sums[x] = row + sums[x - nx];
      }
    }
  }
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::int64_t y = 1; y < ny; ++y)
  {
    for (std::int64_t z = 2; z < nz; ++z)
    {
      std::int32_t* sums = &this->Sums[(z * ny + y) * nx];
      for (std::int64_t x = 1; x < nx; ++x)
      {
        sums[x] += sums[x - ny * nx];
      }
    }
  }
}

} // namespace tetralux
