// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/CPUPicture.h"

#include <algorithm>

namespace tetralux
{
namespace
{

constexpr float NoDistance = -1;

} // namespace

PixelRectangle FindCovered(const CPUPicture& picture)
{
  const int width = picture.Grid.Width;
  int left = width;
  int right = -1;
  int lower = -1;
  int upper = -1;
  for (int j = 0; j < picture.Grid.Height; ++j)
  {
    const float* row = picture.Depths.data() + static_cast<std::size_t>(j) * width;
    int first = 0;
    while (first < width && row[first] == NoDistance)
    {
      ++first;
    }
    if (first == width)
    {
      continue;
    }
    int last = width - 1;
    while (row[last] == NoDistance)
    {
      --last;
    }
    left = std::min(left, first);
    right = std::max(right, last);
    lower = lower < 0 ? j : lower;
    upper = j;
  }
  return right < 0 ? PixelRectangle()
                   : PixelRectangle{ left, lower, right + 1 - left, upper + 1 - lower };
}

} // namespace tetralux
