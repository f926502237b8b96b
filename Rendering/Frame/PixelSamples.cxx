// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/PixelSamples.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace tetralux
{
namespace
{

/// Depths that differ by more than this many widths of a pixel are those of two surfaces, or of one
/// that is seen under less than 15 degrees.
constexpr double LargestStep = 4;

/// What vtkRenderer clears the depth buffer to.
constexpr float EmptyDepth = 1;

/// What pixels around one show, the nearest and the farthest.
struct Neighborhood
{
  float Nearest = std::numeric_limits<float>::infinity();
  float Farthest = -1;
  bool Empty = false; ///< one of them shows nothing
};

Neighborhood LookAround(const OpaqueSamples& opaque, const float* distances, int x, int y)
{
  Neighborhood around;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, opaque.Height - 1); ++j)
  {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, opaque.Width - 1); ++i)
    {
      const float distance = distances[static_cast<std::size_t>(j) * opaque.Width + i];
      around.Empty = around.Empty || distance < 0;
      around.Nearest = distance < 0 ? around.Nearest : std::min(around.Nearest, distance);
      around.Farthest = std::max(around.Farthest, distance);
    }
  }
  return around;
}

bool IsStep(const OpaqueSamples& opaque, double nearest, double farthest)
{
  return farthest - nearest > LargestStep * (opaque.PixelWidth[0] * nearest + opaque.PixelWidth[1]);
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

std::vector<float> FindOpaqueDistances(const OpaqueSamples& opaque)
{
  if (std::none_of(
        opaque.Depths.begin(), opaque.Depths.end(), [](float depth) { return depth < EmptyDepth; }))
  {
    return {};
  }
  std::vector<float> distances(static_cast<std::size_t>(opaque.Width) * opaque.Height);
  vtkSMPTools::For(0, opaque.Height,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (auto y = static_cast<int>(firstRow); y < lastRow; ++y)
      {
        for (int x = 0; x < opaque.Width; ++x)
        {
          const std::size_t pixel = static_cast<std::size_t>(y) * opaque.Width + x;
          const PixelDepths depths = FindDepths(opaque, pixel);
          const float depth = depths.Nearest < EmptyDepth && HasEdge(opaque, x, y, depths)
            ? opaque.Depths[pixel]
            : depths.Mean;
          distances[pixel] = depth < EmptyDepth
            ? static_cast<float>(opaque.GetDistance(x, y, depth))
            : std::numeric_limits<float>::infinity();
        }
      }
    });
  return distances;
}

std::vector<std::int32_t> FindEdges(const OpaqueSamples& opaque, const float* distances)
{
  std::vector<std::uint8_t> edges(static_cast<std::size_t>(opaque.Width) * opaque.Height, 0);
  vtkSMPTools::For(0, opaque.Height,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (auto y = static_cast<int>(firstRow); y < lastRow; ++y)
      {
        for (int x = 0; x < opaque.Width; ++x)
        {
          const Neighborhood around = LookAround(opaque, distances, x, y);
          const std::size_t pixel = static_cast<std::size_t>(y) * opaque.Width + x;
          const bool edge = around.Farthest >= 0 &&
            (around.Empty || IsStep(opaque, around.Nearest, around.Farthest) ||
              (!opaque.Depths.empty() && HasEdge(opaque, x, y, FindDepths(opaque, pixel))));
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
