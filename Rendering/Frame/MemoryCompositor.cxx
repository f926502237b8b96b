// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/MemoryCompositor.h"

#include "Frame/BoundForReading.h"
#include "Frame/PixelBlending.h"
#include "OpenGL/GraphicsCard.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkSMPTools.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// Values of 32 bits are handed over and taken, in rows without gaps.
constexpr int ValueBytes = 4;

/// Rows that a thread takes at once: enough that starting it does not count.
constexpr vtkIdType RowsOfThread = 64;

GLint GetInteger(GLenum name)
{
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLint GetAttachment(GLenum attachment, GLenum name)
{
  GLint value = 0;
  glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, name, &value);
  return value;
}

bool IsAttached(GLenum attachment)
{
  return GetAttachment(attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE;
}

bool HasEightBits(GLenum attachment)
{
  for (const GLenum size :
    { GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE, GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE,
      GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE, GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE })
  {
    if (GetAttachment(attachment, size) != 8)
    {
      return false;
    }
  }
  return GetAttachment(attachment, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) ==
    GL_UNSIGNED_NORMALIZED &&
    GetAttachment(attachment, GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) == GL_LINEAR;
}

bool HasWideFixedDepth()
{
  return IsAttached(GL_DEPTH_ATTACHMENT) && !IsAttached(GL_STENCIL_ATTACHMENT) &&
    GetAttachment(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE) == 32 &&
    GetAttachment(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) ==
    GL_UNSIGNED_NORMALIZED;
}

/// Whether a copy would write what drawing would not.
bool IsMasked()
{
  GLboolean channels[4];
  glGetBooleanv(GL_COLOR_WRITEMASK, channels);
  return std::any_of(channels, channels + 4, [](GLboolean on) { return on == GL_FALSE; }) ||
    glIsEnabled(GL_STENCIL_TEST) == GL_TRUE;
}

bool DrawsIntoOnePicture()
{
  const GLint most = GetInteger(GL_MAX_DRAW_BUFFERS);
  for (GLint k = 1; k < most; ++k)
  {
    if (GetInteger(GL_DRAW_BUFFER0 + k) != GL_NONE)
    {
      return false;
    }
  }
  return true;
}

/// While one lives, rows of values of 32 bits are handed over and taken.
class ValueRows
{
public:
  explicit ValueRows(vtkOpenGLState* state)
    : State(state)
  {
    for (int k = 0; k < 2; ++k)
    {
      this->Before[k] = GetInteger(Names[k]);
      state->vtkglPixelStorei(Names[k], ValueBytes);
    }
  }
  ~ValueRows()
  {
    for (int k = 0; k < 2; ++k)
    {
      this->State->vtkglPixelStorei(Names[k], this->Before[k]);
    }
  }
  ValueRows(const ValueRows&) = delete;
  ValueRows& operator=(const ValueRows&) = delete;

private:
  static constexpr GLenum Names[2] = { GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT };
  vtkOpenGLState* State;
  GLint Before[2];
};

void Upload(vtkTextureObject* texture, int width, int height, GLenum format, GLenum type,
  const std::vector<std::uint32_t>& values)
{
  texture->Activate();
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format, type, values.data());
  texture->Deactivate();
}

} // namespace

MemoryCompositor::MemoryCompositor() = default;
MemoryCompositor::~MemoryCompositor() = default;

bool MemoryCompositor::CanComposite(const MemoryPicture& picture)
{
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (!renderer || !IsSoftwareRenderer(renderer) || GetInteger(GL_DRAW_FRAMEBUFFER_BINDING) == 0)
  {
    return false;
  }
  const auto drawn = static_cast<GLenum>(GetInteger(GL_DRAW_BUFFER0));
  return drawn != GL_NONE && IsAttached(drawn) && HasEightBits(drawn) && DrawsIntoOnePicture() &&
    GetInteger(GL_SAMPLE_BUFFERS) == 0 && !IsMasked() && (!picture.Depths || HasWideFixedDepth());
}

void MemoryCompositor::Composite(vtkOpenGLRenderWindow* window, int x, int y,
  const MemoryPicture& picture, const PixelRectangle& covered)
{
  while (glGetError() != GL_NO_ERROR) // of others
  {
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  const ValueRows rows(state);
  const int width = covered.Width;
  const int height = covered.Height;
  const auto size = static_cast<std::size_t>(width) * height;
  const bool depths = picture.Depths != nullptr;
  this->Prepare(window, width, height, depths);

  x += covered.X;
  y += covered.Y;
  this->Pixels.resize(size);
  this->PixelDepths.resize(depths ? size : 0);
  {
    const auto drawn = static_cast<unsigned int>(GetInteger(GL_DRAW_FRAMEBUFFER_BINDING));
    const auto buffer = static_cast<unsigned int>(GetInteger(GL_DRAW_BUFFER0));
    const BoundForReading reading(state, drawn);
    const auto before = static_cast<unsigned int>(GetInteger(GL_READ_BUFFER));
    state->vtkglReadBuffer(buffer);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glReadPixels(x, y, width, height, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, this->Pixels.data());
    if (depths)
    {
      glReadPixels(
        x, y, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, this->PixelDepths.data());
    }
    state->vtkglReadBuffer(before);
  }
  this->Blend(picture, covered);

  Upload(this->Colors, width, height, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, this->Pixels);
  if (depths)
  {
    Upload(this->Depths, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, this->PixelDepths);
  }
  const BoundForReading reading(state, this->Framebuffer->GetFBOIndex());
  glBlitFramebuffer(0, 0, width, height, x, y, x + width, y + height,
    depths ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT, GL_NEAREST);
  if (glGetError() != GL_NO_ERROR)
  {
    throw std::runtime_error("the picture could not be copied into the frame buffer");
  }
}

void MemoryCompositor::Composite(vtkOpenGLRenderWindow* window, int x, int y,
  vtkTextureObject* picture, const PixelRectangle& part)
{
  vtkOpenGLState* state = window->GetState();
  this->SourceColors.resize(4 * static_cast<std::size_t>(part.Width) * part.Height);
  {
    const ValueRows rows(state);
    this->Source->SetContext(window);
    state->PushFramebufferBindings();
    this->Source->Bind(GL_READ_FRAMEBUFFER);
    glFramebufferTexture2D(
      GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture->GetHandle(), 0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glReadPixels(
      part.X, part.Y, part.Width, part.Height, GL_RGBA, GL_FLOAT, this->SourceColors.data());
    // Else it would keep the texture's memory after its owner let that go.
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    state->PopFramebufferBindings();
  }
  MemoryPicture read;
  read.Width = part.Width;
  read.Height = part.Height;
  read.Colors = this->SourceColors.data();
  this->Composite(
    window, x + part.X, y + part.Y, read, PixelRectangle{ 0, 0, part.Width, part.Height });
}

/// Makes room for a rectangle in the textures.
void MemoryCompositor::Prepare(vtkOpenGLRenderWindow* window, int width, int height, bool depths)
{
  vtkOpenGLState* state = window->GetState();
  const auto hasRoom = [width, height](vtkTextureObject* texture)
  {
    return texture->GetHandle() != 0 && static_cast<int>(texture->GetWidth()) >= width &&
      static_cast<int>(texture->GetHeight()) >= height;
  };
  const bool colorsFit = hasRoom(this->Colors);
  const bool depthsFit = !depths || hasRoom(this->Depths);
  if (colorsFit && depthsFit)
  {
    return;
  }
  width = std::max(width, static_cast<int>(this->Colors->GetWidth()));
  height = std::max(height, static_cast<int>(this->Colors->GetHeight()));
  state->PushFramebufferBindings();
  this->Framebuffer->SetContext(window);
  this->Framebuffer->Bind(GL_DRAW_FRAMEBUFFER);
  if (!colorsFit)
  {
    this->Colors->SetContext(window);
    this->Colors->SetMinificationFilter(vtkTextureObject::Nearest);
    this->Colors->SetMagnificationFilter(vtkTextureObject::Nearest);
    this->Colors->Allocate2D(width, height, 4, VTK_UNSIGNED_CHAR);
    this->Colors->Deactivate();
    glFramebufferTexture2D(
      GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->Colors->GetHandle(), 0);
  }
  if (!depthsFit)
  {
    const DepthFormat format = { GL_DEPTH_COMPONENT32, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
      ValueBytes };
    AllocateDepths(this->Depths, window, format, width, height, 0);
    AttachDepths(this->Depths, format);
  }
  state->PopFramebufferBindings();
}

void MemoryCompositor::Blend(const MemoryPicture& picture, const PixelRectangle& covered)
{
  vtkSMPTools::For(0, covered.Height, RowsOfThread,
    [&](vtkIdType firstRow, vtkIdType lastRow)
    {
      for (vtkIdType row = firstRow; row < lastRow; ++row)
      {
        const std::int64_t first =
          static_cast<std::int64_t>(covered.Y + row) * picture.Width + covered.X;
        const std::int64_t place = static_cast<std::int64_t>(row) * covered.Width;
        std::uint32_t* pixels = this->Pixels.data() + place;
        const float* depths = picture.Depths ? picture.Depths + first : nullptr;
        if (picture.Bytes)
        {
          PutOpaque(picture.Bytes + 4 * first, depths, pixels, this->PixelDepths.data() + place,
            covered.Width);
          continue;
        }
        BlendColors(picture.Colors + 4 * first, pixels, covered.Width);
        if (depths)
        {
          PutDepths(depths, this->PixelDepths.data() + place, covered.Width);
        }
      }
    });
}

void MemoryCompositor::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Framebuffer->ReleaseGraphicsResources(window);
  this->Source->ReleaseGraphicsResources(window);
  this->Colors->ReleaseGraphicsResources(window);
  this->Depths->ReleaseGraphicsResources(window);
}

} // namespace tetralux
