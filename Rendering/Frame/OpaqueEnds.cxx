// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/OpaqueEnds.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <limits>

namespace tetralux
{
namespace
{

/// What vtkRenderer clears the depth buffer to.
constexpr float EmptyDepth = 1;

} // namespace

std::vector<float> ReadOpaqueDepths(
  OpaqueDepth& depth, vtkOpenGLRenderWindow* window, const CameraRays& rays)
{
  const PixelRectangle& visible = rays.GetVisible();
  std::vector<float> depths(static_cast<std::size_t>(visible.Width) * visible.Height);
  depth.Copy(window, visible);
  depth.Read(depths);
  if (std::none_of(depths.begin(), depths.end(), [](float value) { return value < EmptyDepth; }))
  {
    return {};
  }
  const int width = rays.GetGrid().Width;
  const int height = rays.GetGrid().Height;
  if (width == visible.Width && height == visible.Height)
  {
    return depths;
  }
  std::vector<float> ofRays;
  ofRays.reserve(static_cast<std::size_t>(width) * height);
  for (int j = 0; j < height; ++j)
  {
    const auto y = static_cast<std::size_t>((j + 0.5) * visible.Height / height);
    for (int i = 0; i < width; ++i)
    {
      const auto x = static_cast<std::size_t>((i + 0.5) * visible.Width / width);
      ofRays.push_back(depths[y * visible.Width + x]);
    }
  }
  return ofRays;
}

std::vector<float> FindOpaqueDistances(const CameraRays& rays, const std::vector<float>& depths)
{
  std::vector<float> distances(depths.size());
  const int width = rays.GetGrid().Width;
  vtkSMPTools::For(0, rays.GetGrid().Height,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (auto j = static_cast<int>(firstRow); j < lastRow; ++j)
      {
        for (int i = 0; i < width; ++i)
        {
          const std::size_t ray = static_cast<std::size_t>(j) * width + i;
          distances[ray] = depths[ray] < EmptyDepth
            ? static_cast<float>(rays.GetDistance(i, j, depths[ray]))
            : std::numeric_limits<float>::infinity();
        }
      }
    });
  return distances;
}

} // namespace tetralux
