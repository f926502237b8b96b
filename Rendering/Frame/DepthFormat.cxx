// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/DepthFormat.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <stdexcept>

namespace tetralux
{

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

void AllocateDepths(vtkTextureObject* texture, vtkOpenGLRenderWindow* window,
  const DepthFormat& format, int width, int height, int samples)
{
  texture->ReleaseGraphicsResources(window);
  texture->SetContext(window);
  texture->SetSamples(samples);
  texture->SetInternalFormat(format.Internal);
  texture->SetFormat(format.Format);
  texture->SetDataType(format.Type);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  if (!texture->Allocate2D(width, height, 1, VTK_FLOAT))
  {
    throw std::runtime_error("no depth texture could be made");
  }
  texture->Deactivate();
}

void AttachDepths(vtkTextureObject* texture, const DepthFormat& format)
{
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER,
    format.Format == GL_DEPTH_STENCIL ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
    texture->GetTarget(), texture->GetHandle(), 0);
}

} // namespace tetralux
