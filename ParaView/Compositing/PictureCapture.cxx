// SPDX-License-Identifier: BSD-3-Clause
#include "Compositing/PictureCapture.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace tetralux
{

namespace
{

/// What a frame buffer has as its depth buffer.
struct DepthAttachment
{
  GLint Type = GL_NONE; ///< GL_TEXTURE, GL_RENDERBUFFER or GL_NONE
  GLint Name = 0;
  GLenum Point = GL_DEPTH_ATTACHMENT; ///< or together with the stencil buffer
};

GLint GetAttachment(GLenum point, GLenum parameter)
{
  GLint value = 0;
  glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, point, parameter, &value);
  return value;
}

/// That of the frame buffer that is bound for drawing.
DepthAttachment FindDepthAttachment()
{
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  DepthAttachment result;
  if (bound == 0)
  {
    return result;
  }
  result.Type = GetAttachment(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
  if (result.Type != GL_NONE)
  {
    result.Name = GetAttachment(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME);
    const bool stencil =
      GetAttachment(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == result.Type &&
      GetAttachment(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME) == result.Name;
    result.Point = stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
  }
  return result;
}

/// While one lives, the frame buffer that is bound for drawing has this depth buffer, too.
class SharedDepth
{
public:
  explicit SharedDepth(const DepthAttachment& depth)
    : Depth(depth)
  {
    this->Attach(static_cast<GLuint>(depth.Name));
  }
  ~SharedDepth() { this->Attach(0); }
  SharedDepth(const SharedDepth&) = delete;
  SharedDepth& operator=(const SharedDepth&) = delete;

private:
  void Attach(GLuint name)
  {
    if (this->Depth.Type == GL_TEXTURE)
    {
      glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, this->Depth.Point, GL_TEXTURE_2D, name, 0);
    }
    else
    {
      glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, this->Depth.Point, GL_RENDERBUFFER, name);
    }
  }

  DepthAttachment Depth;
};

/// Reads from the frame buffer that is bound.
std::vector<float> ReadPixels(
  vtkOpenGLState* state, const PixelRectangle& rectangle, GLenum format, int components)
{
  std::vector<float> values(
    static_cast<std::size_t>(components) * rectangle.Width * rectangle.Height);
  GLint alignment = 0;
  glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, sizeof(float));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glReadPixels(
    rectangle.X, rectangle.Y, rectangle.Width, rectangle.Height, format, GL_FLOAT, values.data());
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, alignment);
  return values;
}

/// Leaves the empty border out. A pixel without colour counts if opaque geometry is in it.
PartialPicture Pack(
  const PixelRectangle& whole, const std::vector<float>& colors, const std::vector<float>& depths)
{
  constexpr float Farthest = 1; // of the depth buffer, where nothing was drawn
  int left = whole.Width, right = 0, low = whole.Height, high = 0;
  for (int y = 0; y < whole.Height; ++y)
  {
    for (int x = 0; x < whole.Width; ++x)
    {
      const std::size_t pixel = static_cast<std::size_t>(y) * whole.Width + x;
      const float* color = &colors[4 * pixel];
      if (depths[pixel] < Farthest || color[0] != 0 || color[1] != 0 || color[2] != 0 ||
        color[3] != 0)
      {
        left = std::min(left, x);
        right = std::max(right, x + 1);
        low = std::min(low, y);
        high = y + 1;
      }
    }
  }
  PartialPicture result;
  if (right == 0)
  {
    return result;
  }
  result.Rectangle = { whole.X + left, whole.Y + low, right - left, high - low };
  result.Colors.reserve(
    static_cast<std::size_t>(4) * result.Rectangle.Width * result.Rectangle.Height);
  for (int y = low; y < high; ++y)
  {
    for (int x = left; x < right; ++x)
    {
      const std::size_t pixel = static_cast<std::size_t>(y) * whole.Width + x;
      const float* color = &colors[4 * pixel];
      result.Colors.insert(result.Colors.end(), color, color + 3);
      result.Colors.push_back(std::copysign(color[3], depths[pixel] < Farthest ? -1.f : 1.f));
    }
  }
  return result;
}

} // namespace

PartialPicture PictureCapture::Draw(vtkRenderer* renderer, const std::function<void()>& draw)
{
  const DrawnViewport viewport = FindDrawnViewport(renderer);
  const PixelRectangle& visible = viewport.Visible;
  if (visible.Width == 0)
  {
    return PartialPicture();
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  const DepthAttachment depth = FindDepthAttachment();
  if (depth.Type == GL_NONE)
  {
    throw std::runtime_error("there is no frame buffer with a depth buffer to draw into");
  }
  FloatTarget::Settings settings;
  settings.Width = visible.X + visible.Width;
  settings.Height = visible.Y + visible.Height;
  this->Target.Prepare(window, settings);

  const FloatTarget::Use use(this->Target);
  const SharedDepth shared(depth);
  if (glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
  {
    throw std::runtime_error("the window's depth buffer serves no picture of floats");
  }
  const vtkOpenGLState::ScopedglViewport savedViewport(state);
  const vtkOpenGLState::ScopedglScissor savedScissor(state);
  const vtkOpenGLState::ScopedglClearColor savedColor(state);
  const PixelRectangle& whole = viewport.Whole;
  state->vtkglScissor(0, 0, settings.Width, settings.Height);
  state->vtkglClearColor(0, 0, 0, 0);
  state->vtkglClear(GL_COLOR_BUFFER_BIT);
  state->vtkglViewport(whole.X, whole.Y, whole.Width, whole.Height);
  draw();
  return Pack(visible, ReadPixels(state, visible, GL_RGBA, 4),
    ReadPixels(state, visible, GL_DEPTH_COMPONENT, 1));
}

} // namespace tetralux
