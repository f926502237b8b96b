// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/OpaqueDistances.h"

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

std::vector<float> ReadOpaqueDistances(
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
  std::vector<float> distances(static_cast<std::size_t>(width) * height);
  vtkSMPTools::For(0, height,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (auto j = static_cast<int>(firstRow); j < lastRow; ++j)
      {
        const auto y = static_cast<std::size_t>((j + 0.5) * visible.Height / height);
        for (int i = 0; i < width; ++i)
        {
          const auto x = static_cast<std::size_t>((i + 0.5) * visible.Width / width);
          const float value = depths[y * visible.Width + x];
          distances[static_cast<std::size_t>(j) * width + i] = value < EmptyDepth
            ? static_cast<float>(rays.GetDistance(i, j, value))
            : std::numeric_limits<float>::infinity();
        }
      }
    });
  return distances;
}

} // namespace tetralux
