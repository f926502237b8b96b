// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/ImageCompositor.h"
#include "OpenGL/LoadedFunctions.h"

#include "CompositeDepthFS.h"
#include "CompositeImageFS.h"
#include "CompositeOpaqueFS.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

/// While one lives, only the first picture of the frame buffer is drawn into: render passes bind
/// others beside it, such as positions and normals of opaque geometry.
class FirstPictureOnly
{
public:
  FirstPictureOnly()
  {
    GLint most = 0;
    glGetIntegerv(GL_MAX_DRAW_BUFFERS, &most);
    for (GLuint k = 1; k < static_cast<GLuint>(most); ++k)
    {
      GLint buffer = GL_NONE;
      glGetIntegerv(GL_DRAW_BUFFER0 + k, &buffer);
      if (buffer != GL_NONE)
      {
        Mask mask = { k, {} };
        glGetBooleani_v(GL_COLOR_WRITEMASK, k, mask.Channels);
        glColorMaski(k, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        this->Masks.push_back(mask);
      }
    }
  }
  ~FirstPictureOnly()
  {
    for (const Mask& mask : this->Masks)
    {
      const GLboolean* channels = mask.Channels;
      glColorMaski(mask.Buffer, channels[0], channels[1], channels[2], channels[3]);
    }
  }
  FirstPictureOnly(const FirstPictureOnly&) = delete;
  FirstPictureOnly& operator=(const FirstPictureOnly&) = delete;

private:
  struct Mask
  {
    GLuint Buffer;
    GLboolean Channels[4];
  };
  std::vector<Mask> Masks;
};

} // namespace

ImageCompositor::ImageCompositor()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Texture->ReleaseGraphicsResources(window);
        this->ByteTexture->ReleaseGraphicsResources(window);
        this->DepthTexture->ReleaseGraphicsResources(window);
        this->Quad.reset();
        this->DepthQuad.reset();
        this->OpaqueQuad.reset();
      })
{
}

ImageCompositor::~ImageCompositor() = default;

void ImageCompositor::Composite(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
  const float* colors, int width, int height, const PixelRectangle& covered)
{
  this->Context.Set(window);
  const PixelRectangle target =
    this->Upload(rectangle, { colors, VTK_FLOAT, 4, width, height }, covered, this->Texture);
  this->Composite(window, target, this->Texture);
}

void ImageCompositor::WriteDepth(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
  const float* depths, int width, int height, const PixelRectangle& covered)
{
  this->Context.Set(window);
  const PixelRectangle target =
    this->Upload(rectangle, { depths, VTK_FLOAT, 1, width, height }, covered, this->DepthTexture);
  this->DrawDepth(target, this->DepthQuad, CompositeDepthFS, nullptr);
}

void ImageCompositor::CompositeOpaque(vtkOpenGLRenderWindow* window,
  const PixelRectangle& rectangle, const std::uint8_t* colors, const float* depths, int width,
  int height, const PixelRectangle& covered)
{
  this->Context.Set(window);
  this->Upload(rectangle, { depths, VTK_FLOAT, 1, width, height }, covered, this->DepthTexture);
  const PixelRectangle target = this->Upload(
    rectangle, { colors, VTK_UNSIGNED_CHAR, 4, width, height }, covered, this->ByteTexture);
  this->ByteTexture->SetMinificationFilter(vtkTextureObject::Nearest);
  this->ByteTexture->SetMagnificationFilter(vtkTextureObject::Nearest);
  this->DrawDepth(target, this->OpaqueQuad, CompositeOpaqueFS, this->ByteTexture);
}

/// Draws the depth texture over what the buffers hold, with colours if there are any.
void ImageCompositor::DrawDepth(const PixelRectangle& target,
  std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* shader, vtkTextureObject* colors)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  state->vtkglDisable(GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_TRUE);
  // Rays end at what the buffer holds, but where a ray covers several pixels, one may be nearer.
  state->vtkglDepthFunc(GL_LEQUAL);
  const GLboolean mask = colors ? GL_TRUE : GL_FALSE;
  state->vtkglColorMask(mask, mask, mask, mask);
  state->vtkglViewport(target.X, target.Y, target.Width, target.Height);
  this->DepthTexture->SetMinificationFilter(vtkTextureObject::Nearest);
  this->DepthTexture->SetMagnificationFilter(vtkTextureObject::Nearest);
  this->Draw(quad, shader, colors, this->DepthTexture);
}

/// Makes the texture of what is covered of a picture. Returns where it belongs in the window.
PixelRectangle ImageCompositor::Upload(const PixelRectangle& rectangle, const Memory& memory,
  const PixelRectangle& covered, vtkTextureObject* texture)
{
  // Where a ray is a pixel, what is empty needs neither upload nor drawing.
  const bool sameSize = memory.Width == rectangle.Width && memory.Height == rectangle.Height;
  const PixelRectangle part =
    sameSize ? covered : PixelRectangle{ 0, 0, memory.Width, memory.Height };
  const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
  texture->SetContext(this->Context.Get());
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  const std::size_t bytes = memory.Components * (memory.Type == VTK_FLOAT ? sizeof(float) : 1);
  const auto* first = static_cast<const char*>(memory.Values) +
    bytes * (static_cast<std::size_t>(part.Y) * memory.Width + part.X);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, memory.Width);
  const bool made = texture->Create2DFromRaw(
    part.Width, part.Height, memory.Components, memory.Type, const_cast<char*>(first)); // only read
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (!made)
  {
    throw std::runtime_error("no texture of " + std::to_string(part.Width) + " x " +
      std::to_string(part.Height) + " pixels could be made");
  }
  texture->Deactivate();
  return sameSize
    ? PixelRectangle{ rectangle.X + part.X, rectangle.Y + part.Y, part.Width, part.Height }
    : rectangle;
}

void ImageCompositor::Composite(
  vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, vtkTextureObject* picture)
{
  this->Context.Set(window);
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state->vtkglViewport(rectangle.X, rectangle.Y, rectangle.Width, rectangle.Height);

  const bool sameSize = static_cast<int>(picture->GetWidth()) == rectangle.Width &&
    static_cast<int>(picture->GetHeight()) == rectangle.Height;
  const int filter = sameSize ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  picture->SetMinificationFilter(filter);
  picture->SetMagnificationFilter(filter);

  this->Draw(this->Quad, CompositeImageFS, picture, nullptr);
}

/// Draws a picture, depths or both by a shader, whose program quad keeps.
void ImageCompositor::Draw(std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* shader,
  vtkTextureObject* picture, vtkTextureObject* depths)
{
  vtkOpenGLRenderWindow* window = this->Context.Get();
  if (!quad)
  {
    quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, shader, "");
  }
  if (!quad->Program || !window->GetShaderCache()->ReadyShaderProgram(quad->Program))
  {
    quad.reset();
    throw std::runtime_error("the shader program that composites the picture did not compile");
  }
  const std::pair<const char*, vtkTextureObject*> textures[] = { { "image", picture },
    { "depths", depths } };
  for (const auto& [name, texture] : textures)
  {
    if (texture)
    {
      texture->Activate();
      quad->Program->SetUniformi(name, texture->GetTextureUnit());
    }
  }
  const FirstPictureOnly firstOnly;
  quad->Render();
  for (const auto& [name, texture] : textures)
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
}

} // namespace tetralux
