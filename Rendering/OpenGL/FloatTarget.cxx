// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/FloatTarget.h"

#include "OpenGL/GraphicsMemory.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

GLenum GetInternalFormat(const FloatTarget::Picture& picture)
{
  const bool one = picture.Components == 1;
  const bool two = picture.Components == 2;
  switch (picture.Format)
  {
    case ChannelFormat::UNorm8:
      return one ? GL_R8 : two ? GL_RG8 : GL_RGBA8;
    case ChannelFormat::Half:
      return one ? GL_R16F : two ? GL_RG16F : GL_RGBA16F;
    case ChannelFormat::Float:
      break;
  }
  return one ? GL_R32F : two ? GL_RG32F : GL_RGBA32F;
}

GLenum GetFormat(const FloatTarget::Picture& picture)
{
  return picture.Components == 1 ? GL_RED : picture.Components == 2 ? GL_RG : GL_RGBA;
}

std::size_t GetPixelSize(const FloatTarget::Picture& picture)
{
  const std::size_t channel = picture.Format == ChannelFormat::UNorm8 ? 1
    : picture.Format == ChannelFormat::Half                           ? 2
                                                                      : 4;
  return channel * picture.Components;
}

constexpr std::size_t DepthStencilSize = 4;

} // namespace

FloatTarget::FloatTarget()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Framebuffer->ReleaseGraphicsResources(window);
        for (const auto& texture : this->Textures)
        {
          texture->ReleaseGraphicsResources(window);
        }
        this->Textures.clear();
        if (this->DepthTexture)
        {
          this->DepthTexture->ReleaseGraphicsResources(window);
          this->DepthTexture = nullptr;
        }
        this->Made = Settings();
      })
{
}

FloatTarget::~FloatTarget() = default;

void FloatTarget::Prepare(vtkOpenGLRenderWindow* window, const Settings& settings)
{
  if (this->Context.Get() == window && settings == this->Made)
  {
    return;
  }
  this->Context.Release(this->Context.Get());
  this->Context.Set(window);
  try
  {
    this->Allocate(window, settings);
  }
  catch (...)
  {
    this->Context.Release(window);
    throw;
  }
  this->Made = settings;
}

void FloatTarget::Allocate(vtkOpenGLRenderWindow* window, const Settings& settings)
{
  const std::string size =
    std::to_string(settings.Width) + " x " + std::to_string(settings.Height) + " pixels";
  int largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(settings.Width, settings.Height) > largest)
  {
    throw std::runtime_error("the picture has " + size + ", and this OpenGL draws at most " +
      std::to_string(largest) + " x " + std::to_string(largest));
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const GraphicsMemoryCheck memory;
  for (const Picture& picture : settings.Pictures)
  {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(window);
    texture->SetInternalFormat(GetInternalFormat(picture));
    texture->SetFormat(GetFormat(picture));
    texture->SetDataType(picture.Format == ChannelFormat::UNorm8 ? GL_UNSIGNED_BYTE : GL_FLOAT);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    this->Textures.push_back(texture);
    if (!texture->Allocate2D(settings.Width, settings.Height, picture.Components,
          picture.Format == ChannelFormat::UNorm8 ? VTK_UNSIGNED_CHAR : VTK_FLOAT))
    {
      throw std::runtime_error("no texture of " + size + " could be made");
    }
    texture->Deactivate();
  }
  if (settings.DepthStencil)
  {
    this->DepthTexture = vtkSmartPointer<vtkTextureObject>::New();
    this->DepthTexture->SetContext(window);
    if (!this->DepthTexture->AllocateDepthStencil(settings.Width, settings.Height))
    {
      throw std::runtime_error("no depth and stencil buffer of " + size + " could be made");
    }
    this->DepthTexture->Deactivate();
  }
  memory.Finish("a picture of " + size);

  this->Framebuffer->SetContext(window);
  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  for (std::size_t k = 0; k < this->Textures.size(); ++k)
  {
    this->Framebuffer->AddColorAttachment(static_cast<unsigned int>(k), this->Textures[k]);
  }
  if (this->DepthTexture)
  {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D,
      this->DepthTexture->GetHandle(), 0);
  }
  this->Framebuffer->ActivateDrawBuffers(static_cast<unsigned int>(this->Textures.size()));
  this->Framebuffer->ActivateReadBuffer(0);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  state->PopFramebufferBindings();
  if (!complete)
  {
    throw std::runtime_error(
      "this graphics card cannot draw into pictures of " + size + " in the format that is needed");
  }
}

std::size_t FloatTarget::GetNumberOfBytes() const
{
  std::size_t pixelSize = this->DepthTexture ? DepthStencilSize : 0;
  for (std::size_t k = 0; k < this->Textures.size(); ++k)
  {
    pixelSize += GetPixelSize(this->Made.Pictures[k]);
  }
  return pixelSize * this->Made.Width * this->Made.Height;
}

vtkTextureObject* FloatTarget::GetTexture(int picture) const { return this->Textures[picture]; }

FloatTarget::Use::Use(FloatTarget& target)
  : Target(target)
{
  vtkOpenGLState* state = target.Context.Get()->GetState();
  state->PushFramebufferBindings();
  state->vtkglGetIntegerv(GL_VIEWPORT, this->Viewport);
  target.Framebuffer->Bind();
  this->DrawInto(static_cast<int>(target.Textures.size()));
  state->vtkglViewport(0, 0, target.Made.Width, target.Made.Height);
}

FloatTarget::Use::~Use()
{
  vtkOpenGLState* state = this->Target.Context.Get()->GetState();
  state->vtkglViewport(this->Viewport[0], this->Viewport[1], this->Viewport[2], this->Viewport[3]);
  state->PopFramebufferBindings();
}

void FloatTarget::Use::DrawInto(int numberOfPictures)
{
  // All are named: VTK's record of them takes no notice of a smaller number.
  std::vector<unsigned int> buffers(this->Target.Textures.size(), GL_NONE);
  for (int k = 0; k < numberOfPictures; ++k)
  {
    buffers[k] = GL_COLOR_ATTACHMENT0 + k;
  }
  this->Target.Context.Get()->GetState()->vtkglDrawBuffers(
    static_cast<unsigned int>(buffers.size()), buffers.data());
}

void FloatTarget::Read(int picture, Span<float> values)
{
  const Use use(*this);
  vtkOpenGLState* state = this->Context.Get()->GetState();
  int alignment = 0;
  glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, 4);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  this->Framebuffer->ActivateReadBuffer(static_cast<unsigned int>(picture));
  glReadPixels(0, 0, this->Made.Width, this->Made.Height, GetFormat(this->Made.Pictures[picture]),
    GL_FLOAT, values.data());
  state->vtkglPixelStorei(GL_PACK_ALIGNMENT, alignment);
}

} // namespace tetralux
