// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/RayTargets.h"

#include "GpuRayCast/RayPicture.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/GraphicsMemory.h"
#include "OpenGL/LoadedFunctions.h"

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

/// As in RayStatesDec.glsl.
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
  { GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, VTK_UNSIGNED_INT, 2 },
  { GL_RG32F, GL_RG, GL_FLOAT, VTK_FLOAT, 2 },
};
constexpr Format FormatOfNextEntries = { GL_R32I, GL_RED_INTEGER, GL_INT, VTK_INT, 1 };

/// Bytes of a pixel: both sets, next entries, and 16 bits of depth, which is 0 or 1.
constexpr std::size_t PixelSize = 2 * (8 + 8) + 4 + 2;
constexpr std::size_t LayerPixelSize = 4;

/// What a pass draws into.
constexpr GLenum Attachments[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
  GL_COLOR_ATTACHMENT3, GL_COLOR_ATTACHMENT4 };

void Attach(GLenum attachment, vtkTextureObject* texture)
{
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture->GetHandle(), 0);
}

/// Of the frame buffer that is bound: the first so many attachments.
void SelectAttachments(int number)
{
  glDrawBuffers(number, Attachments);
  glReadBuffer(Attachments[0]);
}

void CheckFramebuffer()
{
  if (glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
  {
    throw std::runtime_error("this OpenGL cannot draw into integer and floating point textures");
  }
}

/// Sets the frame buffers back that were bound before.
class FramebufferKeeper
{
public:
  explicit FramebufferKeeper(vtkOpenGLState* state)
    : State(state)
  {
    state->PushFramebufferBindings();
  }
  ~FramebufferKeeper() { this->State->PopFramebufferBindings(); }
  FramebufferKeeper(const FramebufferKeeper&) = delete;
  FramebufferKeeper& operator=(const FramebufferKeeper&) = delete;

private:
  vtkOpenGLState* State;
};

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

RayTargets::RayTargets()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        glDeleteFramebuffers(NumberOfFramebuffers, this->Framebuffers);
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
      })
{
}

RayTargets::~RayTargets() = default;

std::string RayTargets::FindObstacle(std::int64_t tetrahedra)
{
  constexpr std::int64_t Most = MostFaces / 4;
  return tetrahedra <= Most ? std::string()
                            : "the mesh has " + std::to_string(tetrahedra) +
      " tetrahedra, and rays on the graphics card tell apart at most " + std::to_string(Most);
}

std::size_t RayTargets::GetPixelSize(bool layers)
{
  return PixelSize + (layers ? LayerPixelSize : 0);
}

void RayTargets::Prepare(vtkOpenGLRenderWindow* window, int width, int rows, bool layers)
{
  if (this->Context.Get() == window && this->Size[0] == width && this->Size[1] == rows &&
    this->Layers == layers)
  {
    return;
  }
  this->Context.Release(this->Context.Get());
  this->Context.Set(window);
  try
  {
    this->Allocate(window, width, rows, layers);
  }
  catch (...)
  {
    this->Context.Release(window);
    throw;
  }
  this->Size[0] = width;
  this->Size[1] = rows;
  this->Layers = layers;
}

void RayTargets::Allocate(vtkOpenGLRenderWindow* window, int width, int rows, bool layers)
{
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const GraphicsMemoryCheck memory;
  for (auto& set : this->Textures)
  {
    for (int k = 0; k < NumberOfTextures; ++k)
    {
      AllocateTexture(window, set[k], FormatOf[k], width, rows);
    }
  }
  AllocateTexture(window, this->NextEntries, FormatOfNextEntries, width, rows);
  AllocateDepth(window, this->Depth, width, rows, vtkTextureObject::Fixed16);
  if (layers)
  {
    // Distances in it are compared with each other in single precision.
    AllocateDepth(window, this->LayerDepth, width, rows, vtkTextureObject::Float32);
  }
  memory.Finish("the states of " + std::to_string(width) + " x " + std::to_string(rows) + " rays");

  const FramebufferKeeper keeper(state);
  glGenFramebuffers(NumberOfFramebuffers, this->Framebuffers);
  for (int k = 0; k < NumberOfFramebuffers; ++k)
  {
    if (k == OfLayer && !layers)
    {
      continue;
    }
    state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffers[k]);
    Attach(GL_DEPTH_ATTACHMENT, k == OfLayer ? this->LayerDepth : this->Depth);
    if (k == OfNextEntries || k == OfLayer)
    {
      Attach(Attachments[0], this->NextEntries);
      SelectAttachments(1);
      CheckFramebuffer();
    }
    else if (k != OfColors)
    {
      for (int texture = 0; texture < NumberOfTextures; ++texture)
      {
        Attach(Attachments[texture], this->Textures[k][texture]);
      }
    }
  }
}

void RayTargets::SetBand(const FloatTarget& band)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  this->NumberOfPictures = static_cast<int>(band.GetSettings().Pictures.size());
  for (const int k : { OfSet0, OfSet1, OfColors })
  {
    state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffers[k]);
    int colors = k == OfColors ? 0 : NumberOfTextures;
    const int pictures = k == OfColors ? 1 : this->NumberOfPictures;
    for (int picture = 0; picture < pictures; ++picture)
    {
      Attach(Attachments[colors++], band.GetTexture(RayPicture::Colors + picture));
    }
    SelectAttachments(colors);
    CheckFramebuffer();
  }
  state->vtkglViewport(0, 0, band.GetSettings().Width, band.GetSettings().Height);
}

void RayTargets::BeginDrawing()
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  state->PushFramebufferBindings();
  state->vtkglGetIntegerv(GL_VIEWPORT, this->Viewport);
}

void RayTargets::EndDrawing()
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  state->vtkglViewport(this->Viewport[0], this->Viewport[1], this->Viewport[2], this->Viewport[3]);
  state->PopFramebufferBindings();
}

void RayTargets::DrawInto(int framebuffer)
{
  this->Context.Get()->GetState()->vtkglBindFramebuffer(
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

void RayTargets::Clear(bool largest)
{
  // The face is RayNeedsEntry, the entry NoEntry, the part the first one.
  const GLuint states[4] = { 0, 0, 0, 0 };
  const GLfloat sums[4] = { largest ? -LargestFloat : 0.f, LargestFloat, 0, 0 };
  const GLfloat farthest = 1;
  this->DrawInto(OfSet0);
  glClearBufferuiv(GL_COLOR, States, states);
  glClearBufferfv(GL_COLOR, Sums, sums);
  for (int picture = 0; picture < this->NumberOfPictures; ++picture)
  {
    const GLfloat value = picture == RayPicture::Distances ? -1.f : 0.f;
    const GLfloat values[4] = { value, value, value, value };
    glClearBufferfv(GL_COLOR, NumberOfTextures + picture, values);
  }
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void RayTargets::BeginAdding()
{
  // The opacity of colours is written where a ray is done.
  this->Context.Get()->GetState()->vtkglBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);
  for (int picture = 0; picture < this->NumberOfPictures; ++picture)
  {
    glEnablei(GL_BLEND, static_cast<GLuint>(NumberOfTextures + picture));
  }
}

void RayTargets::EndAdding()
{
  for (int picture = 0; picture < this->NumberOfPictures; ++picture)
  {
    glDisablei(GL_BLEND, static_cast<GLuint>(NumberOfTextures + picture));
  }
}

std::size_t RayTargets::GetNumberOfBytes() const
{
  return GetPixelSize(this->Layers) * static_cast<std::size_t>(this->Size[0]) *
    static_cast<std::size_t>(this->Size[1]);
}

} // namespace tetralux
