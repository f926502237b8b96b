// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/RayTargets.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"
#include "vtk_glew.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

/// As in RayStatesDec.glsl.
constexpr GLint RayNeedsEntry = -2;
constexpr GLfloat LargestFloat = 3.402823e38f;

struct Format
{
  GLenum Internal;
  GLenum External;
  GLenum Type;
  int VtkType;
  int Components;
};

constexpr Format FormatOf[RayTargets::NumberOfTextures] = {
  { GL_RGBA32I, GL_RGBA_INTEGER, GL_INT, VTK_INT, 4 },
  { GL_RGBA32I, GL_RGBA_INTEGER, GL_INT, VTK_INT, 4 },
  { GL_RGBA32F, GL_RGBA, GL_FLOAT, VTK_FLOAT, 4 },
  { GL_RGBA32F, GL_RGBA, GL_FLOAT, VTK_FLOAT, 4 },
};
constexpr Format FormatOfNextEntries = { GL_R32I, GL_RED_INTEGER, GL_INT, VTK_INT, 1 };

/// Bytes of a pixel: both sets, next entries and two depths, four each.
constexpr std::size_t PixelSize = 4 * (2 * 16 + 1 + 2);

void AllocateTexture(vtkOpenGLRenderWindow* window, vtkTextureObject* texture, const Format& format,
  int width, int height)
{
  texture->SetContext(window);
  texture->SetInternalFormat(format.Internal);
  texture->SetFormat(format.External);
  texture->SetDataType(format.Type);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  if (!texture->Allocate2D(width, height, format.Components, format.VtkType))
  {
    throw std::runtime_error("no texture of " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels could be made for the states of rays");
  }
  texture->Deactivate();
}

void AllocateDepth(
  vtkOpenGLRenderWindow* window, vtkTextureObject* texture, int width, int height, int format)
{
  texture->SetContext(window);
  if (!texture->AllocateDepth(
        static_cast<unsigned int>(width), static_cast<unsigned int>(height), format))
  {
    throw std::runtime_error("no depth buffer could be made for the states of rays");
  }
  texture->Deactivate();
}

} // namespace

RayTargets::RayTargets() = default;

RayTargets::~RayTargets() { this->ReleaseGraphicsResources(this->Window); }

void RayTargets::Prepare(vtkOpenGLRenderWindow* window, int width, int height)
{
  if (this->Window == window && this->Size[0] == width && this->Size[1] == height)
  {
    return;
  }
  this->ReleaseGraphicsResources(this->Window);
  this->Window = window;
  try
  {
    this->Allocate(window, width, height);
  }
  catch (...)
  {
    this->ReleaseGraphicsResources(window);
    throw;
  }
  this->Size[0] = width;
  this->Size[1] = height;
}

void RayTargets::Allocate(vtkOpenGLRenderWindow* window, int width, int height)
{
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  for (auto& set : this->Textures)
  {
    for (int k = 0; k < NumberOfTextures; ++k)
    {
      AllocateTexture(window, set[k], FormatOf[k], width, height);
    }
  }
  AllocateTexture(window, this->NextEntries, FormatOfNextEntries, width, height);
  AllocateDepth(window, this->Depth, width, height, vtkTextureObject::Fixed24);
  // Distances in it are compared with each other in single precision.
  AllocateDepth(window, this->LayerDepth, width, height, vtkTextureObject::Float32);

  bool complete = true;
  constexpr GLenum Attachments[NumberOfTextures] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
    GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3 };
  const auto attach = [](GLenum attachment, vtkTextureObject* texture)
  {
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture->GetHandle(), 0);
  };
  state->PushFramebufferBindings();
  glGenFramebuffers(NumberOfFramebuffers, this->Framebuffers);
  for (int k = 0; k < NumberOfFramebuffers; ++k)
  {
    state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffers[k]);
    attach(GL_DEPTH_ATTACHMENT, k == OfLayer ? this->LayerDepth : this->Depth);
    int colors = 0;
    if (k == OfNextEntries || k == OfLayer)
    {
      attach(Attachments[colors++], this->NextEntries);
    }
    else if (k != OfDepth)
    {
      for (const auto& texture : this->Textures[k])
      {
        attach(Attachments[colors++], texture);
      }
    }
    glDrawBuffers(colors, Attachments);
    glReadBuffer(
      colors > 0 ? Attachments[0] : GL_NONE); // OpenGL before 4.1 wants that one to exist
    complete = complete && glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
  state->PopFramebufferBindings();
  if (!complete)
  {
    throw std::runtime_error("this OpenGL cannot draw into integer and floating point textures");
  }
}

void RayTargets::BeginDrawing()
{
  vtkOpenGLState* state = this->Window->GetState();
  state->PushFramebufferBindings();
  state->vtkglGetIntegerv(GL_VIEWPORT, this->Viewport);
  state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
}

void RayTargets::EndDrawing()
{
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglViewport(this->Viewport[0], this->Viewport[1], this->Viewport[2], this->Viewport[3]);
  state->PopFramebufferBindings();
}

void RayTargets::DrawInto(int framebuffer)
{
  this->Window->GetState()->vtkglBindFramebuffer(
    GL_DRAW_FRAMEBUFFER, this->Framebuffers[framebuffer]);
}

void RayTargets::ClearLayer()
{
  const GLint none[4] = { -1, 0, 0, 0 };
  const GLfloat farthest = 1;
  this->DrawInto(OfLayer);
  glClearBufferiv(GL_COLOR, 0, none);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void RayTargets::Clear(float firstColor)
{
  const GLint states[4] = { 0, 0, 0, RayNeedsEntry };
  const GLint entries[4] = { -1, 0, 0, 0 };
  const GLfloat colors[4] = { firstColor, 0, 0, 0 };
  const GLfloat firsts[4] = { LargestFloat, 0, 0, 0 };
  const GLfloat farthest = 1;
  for (int set = 0; set < 2; ++set)
  {
    this->DrawInto(set);
    glClearBufferiv(GL_COLOR, States, states);
    glClearBufferiv(GL_COLOR, Entries, entries);
    glClearBufferfv(GL_COLOR, Colors, colors);
    glClearBufferfv(GL_COLOR, Firsts, firsts);
  }
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

std::size_t RayTargets::GetNumberOfBytes() const
{
  return PixelSize * static_cast<std::size_t>(this->Size[0]) *
    static_cast<std::size_t>(this->Size[1]);
}

void RayTargets::ReleaseGraphicsResources(vtkWindow* window)
{
  if (!this->Window || window != this->Window)
  {
    return;
  }
  this->Window->PushContext();
  glDeleteFramebuffers(NumberOfFramebuffers, this->Framebuffers);
  this->Window->PopContext();
  std::fill_n(this->Framebuffers, static_cast<int>(NumberOfFramebuffers), 0u);
  for (auto& set : this->Textures)
  {
    for (auto& texture : set)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  this->NextEntries->ReleaseGraphicsResources(window);
  this->Depth->ReleaseGraphicsResources(window);
  this->LayerDepth->ReleaseGraphicsResources(window);
  this->Size[0] = this->Size[1] = 0;
  this->Window = nullptr;
}

} // namespace tetralux
