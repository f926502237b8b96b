// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/OpaqueDistances.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtk_glew.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// What vtkRenderer clears the depth buffer to.
constexpr float EmptyDepth = 1;

/// Depths of the visible pixels, lower row first; of a multisampled buffer resolved.
std::vector<float> ReadDepths(vtkRenderer* renderer, const PixelRectangle& visible)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  std::vector<float> depths(static_cast<std::size_t>(visible.Width) * visible.Height);
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  GLint alignment = 0; // which reading changes
  glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  const int status = window->GetZbufferData(visible.X, visible.Y, visible.X + visible.Width - 1,
    visible.Y + visible.Height - 1, depths.data());
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, alignment);
  if (status != VTK_OK)
  {
    throw std::runtime_error("the depth buffer could not be read");
  }
  return depths;
}

} // namespace

std::vector<float> ReadOpaqueDistances(vtkRenderer* renderer, const CameraRays& rays)
{
  const PixelRectangle& visible = rays.GetVisible();
  const std::vector<float> depths = ReadDepths(renderer, visible);
  if (std::none_of(depths.begin(), depths.end(), [](float depth) { return depth < EmptyDepth; }))
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
          const float depth = depths[y * visible.Width + x];
          distances[static_cast<std::size_t>(j) * width + i] = depth < EmptyDepth
            ? static_cast<float>(rays.GetDistance(i, j, depth))
            : std::numeric_limits<float>::infinity();
        }
      }
    });
  return distances;
}

} // namespace tetralux
