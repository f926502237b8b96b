// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/DrawnViewport.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <limits>

namespace tetralux
{
namespace
{

/// Whether the frame buffer that is bound for drawing is that of a render pass.
bool DrawsIntoPass(vtkOpenGLRenderWindow* window)
{
  if (!window || !window->GetRenderFramebuffer()->GetContext())
  {
    return false; // nothing was drawn yet
  }
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  const auto index = static_cast<unsigned int>(bound);
  // Between frames it is the one that is shown.
  return index != 0 && index != window->GetRenderFramebuffer()->GetFBOIndex() &&
    index != window->GetDisplayFramebuffer()->GetFBOIndex();
}

/// What limits of a size leave of a rectangle.
PixelRectangle Cut(const PixelRectangle& whole, int width, int height)
{
  PixelRectangle part;
  part.X = std::max(whole.X, 0);
  part.Y = std::max(whole.Y, 0);
  part.Width = std::max(std::min(whole.X + whole.Width, width) - part.X, 0);
  part.Height = std::max(std::min(whole.Y + whole.Height, height) - part.Y, 0);
  if (part.Width == 0 || part.Height == 0)
  {
    part.Width = part.Height = 0;
  }
  return part;
}

} // namespace

DrawnViewport FindDrawnViewport(vtkRenderer* renderer)
{
  DrawnViewport result;
  PixelRectangle& whole = result.Whole;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (DrawsIntoPass(window))
  {
    GLint viewport[4] = { 0, 0, 0, 0 };
    glGetIntegerv(GL_VIEWPORT, viewport);
    whole = { viewport[0], viewport[1], viewport[2], viewport[3] };
    constexpr int Unlimited = std::numeric_limits<int>::max();
    result.Visible = Cut(whole, Unlimited, Unlimited);
    return result;
  }
  renderer->GetTiledSizeAndOrigin(&whole.Width, &whole.Height, &whole.X, &whole.Y);
  const int* size = renderer->GetRenderWindow()->GetActualSize();
  result.Visible = Cut(whole, size[0], size[1]);
  return result;
}

} // namespace tetralux
