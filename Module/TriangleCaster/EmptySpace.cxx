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
void FindRanges(const ImageVolume& volume, const std::int32_t (&size)[3], int threads,
  std::vector<BlockRanges::Range>& ranges)
{
  const auto* values = static_cast<const Value*>(volume.Values);
  const std::int64_t row = volume.Dimensions[0];
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
              const auto value = static_cast<float>(at[x]);
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

} // namespace

void BlockRanges::Build(const ImageVolume& volume, int threads)
{
  for (int a = 0; a < 3; ++a)
  {
    this->Size[a] = (volume.Dimensions[a] - 1 + BlockSize - 1) / BlockSize;
  }
  this->Ranges.resize(static_cast<std::size_t>(this->Size[0]) * this->Size[1] * this->Size[2]);
  switch (volume.Type)
  {
    case ImageScalar::Int8:
      FindRanges<std::int8_t>(volume, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::UInt8:
      FindRanges<std::uint8_t>(volume, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::Int16:
      FindRanges<std::int16_t>(volume, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::UInt16:
      FindRanges<std::uint16_t>(volume, this->Size, threads, this->Ranges);
      break;
    case ImageScalar::Float:
      FindRanges<float>(volume, this->Size, threads, this->Ranges);
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

void EmptySpace::Build(
  const BlockRanges& blocks, const std::function<bool(const BlockRanges::Range&)>& contributes)
{
  std::copy(blocks.GetSize(), blocks.GetSize() + 3, this->Size);
  const std::int64_t nx = this->Size[0] + 1, ny = this->Size[1] + 1, nz = this->Size[2] + 1;
  this->Sums.assign(static_cast<std::size_t>(nx * ny * nz), 0);
  const std::vector<BlockRanges::Range>& ranges = blocks.GetRanges();
  for (std::int64_t z = 1; z < nz; ++z)
  {
    for (std::int64_t y = 1; y < ny; ++y)
    {
      std::int32_t row = 0;
      for (std::int64_t x = 1; x < nx; ++x)
      {
        row += contributes(ranges[((z - 1) * (ny - 1) + y - 1) * (nx - 1) + x - 1]) ? 1 : 0;
        const auto at = [&](std::int64_t j, std::int64_t k)
        { return this->Sums[(k * ny + j) * nx + x]; };
        this->Sums[(z * ny + y) * nx + x] = row + at(y - 1, z) + at(y, z - 1) - at(y - 1, z - 1);
      }
    }
  }
}

} // namespace tetralux
