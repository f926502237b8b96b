// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/PixelSamples.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetralux
{
namespace
{

/// Distances in a pixel that differ by more than this many widths of it are those of two surfaces,
/// or of one that is seen under less than 15 degrees.
constexpr double LargestStep = 4;

/// How much the change of a channel, 0..1, may change from a pixel to the next one: an edge that is
/// weaker is at most four steps of 8 bits off.
constexpr float LargestBend = 1.f / 64;

/// What vtkRenderer clears the depth buffer to.
constexpr float EmptyDepth = 1;

bool IsStep(const OpaqueSamples& opaque, double nearest, double farthest)
{
  return farthest - nearest > LargestStep * (opaque.PixelWidth[0] * nearest + opaque.PixelWidth[1]);
}

bool IsShown(const float* color)
{
  return std::any_of(color, color + 4, [](float channel) { return channel != 0; });
}

/// Whether colours do not change evenly from a pixel to the next ones.
bool IsAtEnd(const float* colors, int width, int height, int x, int y)
{
  const float* here = colors + 4 * (static_cast<std::size_t>(y) * width + x);
  const auto bends = [here](std::ptrdiff_t step)
  {
    for (int c = 0; c < 4; ++c)
    {
      const float middle = here[c];
      if (std::abs(here[c - 4 * step] - 2 * middle + here[c + 4 * step]) > LargestBend)
      {
        return true;
      }
    }
    return false;
  };
  const bool across = x > 0 && x + 1 < width;
  const bool along = y > 0 && y + 1 < height;
  return (across && bends(1)) || (along && bends(width)) ||
    (across && along && (bends(width + 1) || bends(width - 1)));
}

/// What the samples of a pixel have.
struct PixelDepths
{
  float Nearest;
  float Farthest;
  float Mean;
};

PixelDepths FindDepths(const OpaqueSamples& opaque, std::size_t pixel)
{
  const std::size_t size = static_cast<std::size_t>(opaque.Width) * opaque.Height;
  const float* depth = opaque.Depths.data() + pixel;
  PixelDepths result = { *depth, *depth, *depth };
  double sum = *depth;
  for (int s = 1; s < opaque.Samples; ++s)
  {
    const float other = depth[s * size];
    result.Nearest = std::min(result.Nearest, other);
    result.Farthest = std::max(result.Farthest, other);
    sum += other;
  }
  result.Mean = static_cast<float>(sum / opaque.Samples);
  return result;
}

bool HasEdge(const OpaqueSamples& opaque, int x, int y, const PixelDepths& depths)
{
  return depths.Nearest < depths.Farthest &&
    (depths.Farthest >= EmptyDepth ||
      IsStep(opaque, opaque.GetDistance(x, y, depths.Nearest),
        opaque.GetDistance(x, y, depths.Farthest)));
}

} // namespace

std::vector<float> FindOpaqueDepths(const OpaqueSamples& opaque)
{
  if (std::none_of(
        opaque.Depths.begin(), opaque.Depths.end(), [](float depth) { return depth < EmptyDepth; }))
  {
    return {};
  }
  std::vector<float> middle(static_cast<std::size_t>(opaque.Width) * opaque.Height);
  vtkSMPTools::For(0, opaque.Height,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (auto y = static_cast<int>(firstRow); y < lastRow; ++y)
      {
        for (int x = 0; x < opaque.Width; ++x)
        {
          const std::size_t pixel = static_cast<std::size_t>(y) * opaque.Width + x;
          const PixelDepths depths = FindDepths(opaque, pixel);
          middle[pixel] = depths.Nearest < EmptyDepth && HasEdge(opaque, x, y, depths)
            ? opaque.Depths[pixel]
            : depths.Mean;
        }
      }
    });
  return middle;
}

std::vector<std::int32_t> FindEdges(const OpaqueSamples& opaque, const float* colors)
{
  std::vector<std::uint8_t> edges(static_cast<std::size_t>(opaque.Width) * opaque.Height, 0);
  vtkSMPTools::For(0, opaque.Height,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (auto y = static_cast<int>(firstRow); y < lastRow; ++y)
      {
        for (int x = 0; x < opaque.Width; ++x)
        {
          const std::size_t pixel = static_cast<std::size_t>(y) * opaque.Width + x;
          const bool edge = IsAtEnd(colors, opaque.Width, opaque.Height, x, y) ||
            (!opaque.Depths.empty() && IsShown(colors + 4 * pixel) &&
              HasEdge(opaque, x, y, FindDepths(opaque, pixel)));
          edges[pixel] = edge ? 1 : 0;
        }
      }
    });
  std::vector<std::int32_t> pixels;
  for (std::size_t pixel = 0; pixel < edges.size(); ++pixel)
  {
    if (edges[pixel] != 0)
    {
      pixels.push_back(static_cast<std::int32_t>(pixel));
    }
  }
  return pixels;
}

} // namespace tetralux
