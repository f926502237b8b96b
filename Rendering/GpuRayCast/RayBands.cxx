// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/RayBands.h"

#include "OpenGL/GraphicsMemory.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tetralux
{

int FindRowsOfBand(const RayBandRequest& request)
{
  if (request.Width > request.LargestSize)
  {
    throw std::runtime_error("the picture is " + std::to_string(request.Width) +
      " pixels wide, and this OpenGL draws into at most " + std::to_string(request.LargestSize));
  }
  const std::int64_t affordable = request.MaximumBytes / (request.BytesPerPixel * request.Width);
  const std::int64_t most = std::min<std::int64_t>(affordable, request.LargestSize);
  const int rows = static_cast<int>(std::clamp<std::int64_t>(most, 1, request.Height));
  const int bands = (request.Height + rows - 1) / rows;
  return (request.Height + bands - 1) / bands;
}

int HalveRowsUntilMade(int rows, const std::function<void(int rows)>& make)
{
  for (;; rows = (rows + 1) / 2)
  {
    try
    {
      make(rows);
      return rows;
    }
    catch (const OutOfGraphicsMemory&)
    {
      if (rows == 1)
      {
        throw;
      }
    }
  }
}

} // namespace tetralux
