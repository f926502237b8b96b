// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/OpaqueDepth.h"
#include "OpenGL/LoadedFunctions.h"

#include "Frame/BoundForReading.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

/// The frame buffer that is bound for drawing; between frames, the one that frames are drawn into.
unsigned int FindSource(vtkOpenGLRenderWindow* window)
{
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  vtkOpenGLFramebufferObject* own = window->GetRenderFramebuffer();
  return bound == 0 && own->GetContext() ? own->GetFBOIndex() : static_cast<unsigned int>(bound);
}

} // namespace

OpaqueDepth::OpaqueDepth()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Framebuffer->ReleaseGraphicsResources(window);
        this->Texture->ReleaseGraphicsResources(window);
        this->Bytes = 0;
      })
{
}

OpaqueDepth::~OpaqueDepth() = default;

void OpaqueDepth::Copy(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle)
{
  this->Context.Set(window);
  while (glGetError() != GL_NO_ERROR) // of others
  {
  }
  vtkOpenGLState* state = window->GetState();
  const unsigned int source = FindSource(window);
  const BoundForReading reading(state, source);
  const DepthFormat format = FindDepthFormat(source == 0);

  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  const int width = rectangle.Width;
  const int height = rectangle.Height;
  const bool changed = this->Bytes == 0 || !(format == this->Format) ||
    static_cast<int>(this->Texture->GetWidth()) != width ||
    static_cast<int>(this->Texture->GetHeight()) != height;
  if (changed)
  {
    this->Bytes = 0;
    AllocateDepths(this->Texture, window, format, width, height, 0);
    this->Format = format;
  }
  this->Framebuffer->SetContext(window);
  this->Framebuffer->Bind(GL_DRAW_FRAMEBUFFER);
  if (changed)
  {
    AttachDepths(this->Texture, format);
    unsigned int none = GL_NONE;
    state->vtkglDrawBuffers(1, &none);
  }
  glBlitFramebuffer(rectangle.X, rectangle.Y, rectangle.X + width, rectangle.Y + height, 0, 0,
    width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  if (glGetError() != GL_NO_ERROR)
  {
    throw std::runtime_error("the depth buffer could not be copied");
  }
  this->Bytes = format.Bytes * width * height;
}

void OpaqueDepth::Upload(
  vtkOpenGLRenderWindow* window, int width, int height, Span<const float> depths)
{
  this->Context.Set(window);
  const vtkOpenGLState::ScopedglActiveTexture unit(window->GetState());
  const DepthFormat format = { GL_R32F, GL_RED, GL_FLOAT, sizeof(float) };
  if (this->Bytes == 0 || !(format == this->Format) ||
    static_cast<int>(this->Texture->GetWidth()) != width ||
    static_cast<int>(this->Texture->GetHeight()) != height)
  {
    this->Bytes = 0;
    AllocateDepths(this->Texture, window, format, width, height, 0);
    this->Format = format;
    this->Bytes = format.Bytes * width * height;
  }
  this->Texture->Activate();
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format.Format, format.Type, depths.data());
  this->Texture->Deactivate();
}

void OpaqueDepth::Read(Span<float> depths)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const BoundForReading reading(state, this->Framebuffer->GetFBOIndex());
  state->vtkglReadBuffer(GL_NONE);
  GLint alignment = 0;
  glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, sizeof(float));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glReadPixels(0, 0, static_cast<GLsizei>(this->Texture->GetWidth()),
    static_cast<GLsizei>(this->Texture->GetHeight()), GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, alignment);
}

bool OpaqueDepth::IsSame(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle)
{
  if (this->Context.Get() != window || this->Bytes == 0 || this->Format.Internal == GL_R32F)
  {
    return false;
  }
  OpaqueDepth now;
  now.Copy(window, rectangle);
  if (!(now.Format == this->Format) || now.Bytes != this->Bytes)
  {
    return false;
  }
  std::vector<float> depths[2];
  for (std::vector<float>& values : depths)
  {
    values.resize(static_cast<std::size_t>(rectangle.Width) * rectangle.Height);
  }
  now.Read(depths[0]);
  this->Read(depths[1]);
  return depths[0] == depths[1];
}

} // namespace tetralux
