// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/OpaqueDepth.h"
#include "OpenGL/LoadedFunctions.h"

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

/// A texture's format, and how its values are handed over.
struct DepthFormat
{
  GLenum Internal;
  GLenum Format;
  GLenum Type;
  std::size_t Bytes;
};

/// That of the depth buffer bound for reading: depths are copied only between equal ones.
DepthFormat FindDepthFormat(bool windowsOwn)
{
  const auto get = [windowsOwn](bool stencil, GLenum parameter)
  {
    GLint value = 0;
    GLint type = GL_NONE;
    const GLenum attachment = stencil ? (windowsOwn ? GL_STENCIL : GL_STENCIL_ATTACHMENT)
                                      : (windowsOwn ? GL_DEPTH : GL_DEPTH_ATTACHMENT);
    glGetFramebufferAttachmentParameteriv(
      GL_READ_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type != GL_NONE)
    {
      glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment, parameter, &value);
    }
    return value;
  };
  const GLint bits = get(false, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  if (bits == 0)
  {
    throw std::runtime_error("there is no depth buffer to take opaque geometry from");
  }
  const bool isFloat = get(false, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
  const bool stencil = get(true, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
  if (isFloat)
  {
    return stencil
      ? DepthFormat{ GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 8 }
      : DepthFormat{ GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4 };
  }
  if (stencil)
  {
    return { GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 4 };
  }
  const GLenum internal = bits == 16 ? GL_DEPTH_COMPONENT16
    : bits == 24                     ? GL_DEPTH_COMPONENT24
                                     : GL_DEPTH_COMPONENT32;
  return { internal, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, static_cast<std::size_t>(4) };
}

/// While one lives, reading comes from a frame buffer; then both that were bound are bound again.
class ReadingFrom
{
public:
  ReadingFrom(vtkOpenGLState* state, unsigned int framebuffer)
    : State(state)
  {
    state->PushFramebufferBindings();
    state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  }
  ~ReadingFrom() { this->State->PopFramebufferBindings(); }
  ReadingFrom(const ReadingFrom&) = delete;
  ReadingFrom& operator=(const ReadingFrom&) = delete;

private:
  vtkOpenGLState* State;
};

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
  const ReadingFrom reading(state, source);
  const DepthFormat format = FindDepthFormat(source == 0);

  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  const int width = rectangle.Width;
  const int height = rectangle.Height;
  const bool changed = this->Bytes == 0 || format.Internal != this->Format ||
    static_cast<int>(this->Texture->GetWidth()) != width ||
    static_cast<int>(this->Texture->GetHeight()) != height;
  if (changed)
  {
    this->Bytes = 0;
    this->Texture->ReleaseGraphicsResources(window);
    this->Texture->SetContext(window);
    this->Texture->SetInternalFormat(format.Internal);
    this->Texture->SetFormat(format.Format);
    this->Texture->SetDataType(format.Type);
    this->Texture->SetMinificationFilter(vtkTextureObject::Nearest);
    this->Texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
    this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
    if (!this->Texture->Allocate2D(width, height, 1, VTK_FLOAT))
    {
      throw std::runtime_error("no depth texture could be made");
    }
    this->Texture->Deactivate();
    this->Format = format.Internal;
  }
  this->Framebuffer->SetContext(window);
  this->Framebuffer->Bind(GL_DRAW_FRAMEBUFFER);
  if (changed)
  {
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER,
      format.Format == GL_DEPTH_STENCIL ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
      GL_TEXTURE_2D, this->Texture->GetHandle(), 0);
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

void OpaqueDepth::Read(Span<float> depths)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const ReadingFrom reading(state, this->Framebuffer->GetFBOIndex());
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
  if (this->Context.Get() != window || this->Bytes == 0)
  {
    return false;
  }
  OpaqueDepth now;
  now.Copy(window, rectangle);
  if (now.Format != this->Format || now.Bytes != this->Bytes)
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
