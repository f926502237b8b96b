// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/HiddenCells.h"

#include <cstdint>

namespace tetralux
{
namespace
{

/// Whether a point of a cell hides it. point: index of its first one.
bool IsHiddenByPoint(const ImageVolume& volume, std::int64_t point)
{
  const std::int64_t row = volume.Dimensions[0];
  const std::int64_t slice = row * volume.Dimensions[1];
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::int64_t at = point + ((corner & 1) != 0 ? 1 : 0) + ((corner & 2) != 0 ? row : 0) +
      ((corner & 4) != 0 ? slice : 0);
    if ((volume.PointFlags[at] & volume.HidingPointFlags) != 0)
    {
      return true;
    }
  }
  return false;
}

} // namespace

std::vector<unsigned char> FindHiddenCells(const ImageVolume& volume, int threads)
{
  if (!volume.PointFlags && !volume.CellFlags)
  {
    return {};
  }
  std::vector<unsigned char> hidden(GetNumberOfPoints(volume), 0);
  const std::int64_t nx = volume.Dimensions[0], ny = volume.Dimensions[1];
  bool any = false;
#pragma omp parallel for num_threads(threads) reduction(|| : any)
  for (int z = 0; z < volume.Dimensions[2] - 1; ++z)
  {
    for (std::int64_t y = 0; y < ny - 1; ++y)
    {
      for (std::int64_t x = 0; x < nx - 1; ++x)
      {
        const std::int64_t point = (z * ny + y) * nx + x;
        const std::int64_t cell = (z * (ny - 1) + y) * (nx - 1) + x;
        const bool isHidden =
          (volume.CellFlags && (volume.CellFlags[cell] & volume.HidingCellFlags) != 0) ||
          (volume.PointFlags && IsHiddenByPoint(volume, point));
        hidden[point] = isHidden ? 1 : 0;
        any = any || isHidden;
      }
    }
  }
  return any ? hidden : std::vector<unsigned char>();
}

} // namespace tetralux
