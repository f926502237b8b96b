// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/PictureTask.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetralux
{
namespace
{

/// The smallest rectangle of rays with all that show something, by ray.
template <class IsShownT>
PixelRectangle FindRectangle(const PictureTask& picture, const IsShownT& isShown)
{
  const int width = picture.Grid.Width;
  int left = width;
  int right = -1;
  int lower = -1;
  int upper = -1;
  for (int j = 0; j < picture.Grid.Height; ++j)
  {
    const std::size_t row = static_cast<std::size_t>(j) * width;
    int first = 0;
    while (first < width && !isShown(row + first))
    {
      ++first;
    }
    if (first == width)
    {
      continue;
    }
    int last = width - 1;
    while (!isShown(row + last))
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

} // namespace

PixelRectangle FindCovered(const PictureTask& picture)
{
  constexpr float NoDistance = -1;
  return FindRectangle(
    picture, [&picture](std::size_t ray) { return picture.Depths[ray] != NoDistance; });
}

PixelRectangle FindColored(const PictureTask& picture)
{
  return FindRectangle(picture,
    [&picture](std::size_t ray)
    {
      const float* color = picture.Colors.data() + 4 * ray;
      return std::any_of(color, color + 4, [](float channel) { return channel != 0; });
    });
}

double FindLargestStep(const PictureTask& picture)
{
  const int width = picture.Grid.Width;
  const int height = picture.Grid.Height;
  float largest = 0;
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      const float* here = picture.Colors.data() + 4 * (static_cast<std::size_t>(j) * width + i);
      const auto compare = [here, &largest](const float* other)
      {
        for (int c = 0; c < 4; ++c)
        {
          largest = std::max(largest, std::abs(other[c] - here[c]));
        }
      };
      const std::size_t row = 4 * static_cast<std::size_t>(width);
      const bool right = i + 1 < width;
      if (right)
      {
        compare(here + 4);
      }
      if (j + 1 < height)
      {
        compare(here + row);
        if (right)
        {
          compare(here + row + 4);
        }
        if (i > 0)
        {
          compare(here + row - 4);
        }
      }
    }
  }
  return largest;
}

} // namespace tetralux
