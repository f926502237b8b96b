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

/// While one lives, a picture that is drawn over the whole viewport fills a rectangle, and only a
/// part of that is drawn.
class PartOfViewport
{
public:
  /// part: of the rectangle.
  PartOfViewport(vtkOpenGLState* state, const PixelRectangle& rectangle, const PixelRectangle& part)
    : CullFace(state, GL_CULL_FACE)
    , ScissorTest(state, GL_SCISSOR_TEST)
    , Scissor(state)
    , Viewport(state)
    , Unit(state)
  {
    state->vtkglDisable(GL_CULL_FACE);
    state->vtkglEnable(GL_SCISSOR_TEST);
    state->vtkglViewport(rectangle.X, rectangle.Y, rectangle.Width, rectangle.Height);
    state->vtkglScissor(rectangle.X + part.X, rectangle.Y + part.Y, part.Width, part.Height);
  }

private:
  vtkOpenGLState::ScopedglEnableDisable CullFace;
  vtkOpenGLState::ScopedglEnableDisable ScissorTest;
  vtkOpenGLState::ScopedglScissor Scissor;
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglActiveTexture Unit;
};

bool IsOfSize(vtkTextureObject* texture, int width, int height)
{
  return static_cast<int>(texture->GetWidth()) == width &&
    static_cast<int>(texture->GetHeight()) == height;
}

void SetFilter(vtkTextureObject* texture, int filter)
{
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
}

} // namespace

ImageCompositor::ImageCompositor()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Memory.ReleaseGraphicsResources(window);
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
  const MemoryPicture& picture, const PixelRectangle& covered)
{
  this->Context.Set(window);
  const bool sameSize = picture.Width == rectangle.Width && picture.Height == rectangle.Height;
  if (sameSize && MemoryCompositor::CanComposite(picture))
  {
    this->Memory.Composite(window, rectangle.X, rectangle.Y, picture, covered);
    return;
  }
  // Where a ray is a pixel, what is empty needs neither upload nor drawing.
  const PixelRectangle part =
    sameSize ? covered : PixelRectangle{ 0, 0, picture.Width, picture.Height };
  const PixelRectangle drawn =
    sameSize ? covered : PixelRectangle{ 0, 0, rectangle.Width, rectangle.Height };
  if (picture.Depths)
  {
    this->Upload(picture.Depths, VTK_FLOAT, 1, picture, part, this->DepthTexture);
  }
  if (picture.Bytes)
  {
    this->Upload(picture.Bytes, VTK_UNSIGNED_CHAR, 4, picture, part, this->ByteTexture);
    SetFilter(this->ByteTexture, vtkTextureObject::Nearest);
    this->DrawDepth(rectangle, drawn, this->OpaqueQuad, CompositeOpaqueFS, this->ByteTexture);
    return;
  }
  this->Upload(picture.Colors, VTK_FLOAT, 4, picture, part, this->Texture);
  if (picture.Depths)
  {
    this->DrawDepth(rectangle, drawn, this->DepthQuad, CompositeDepthFS, nullptr);
  }
  this->Blend(rectangle, drawn, this->Texture);
}

void ImageCompositor::Composite(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
  vtkTextureObject* picture, const PixelRectangle& covered)
{
  this->Context.Set(window);
  if (IsOfSize(picture, rectangle.Width, rectangle.Height) &&
    MemoryCompositor::CanComposite(MemoryPicture()))
  {
    this->Memory.Composite(window, rectangle.X, rectangle.Y, picture, covered);
    return;
  }
  this->Blend(rectangle, covered, picture);
}

/// Draws the depth texture over what the buffers hold, with colours if there are any. part: of the
/// rectangle.
void ImageCompositor::DrawDepth(const PixelRectangle& rectangle, const PixelRectangle& part,
  std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* shader, vtkTextureObject* colors)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const PartOfViewport drawn(state, rectangle, part);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  state->vtkglDisable(GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  // Rays end at what the buffer holds, but where a ray covers several pixels, one may be nearer.
  state->vtkglDepthFunc(GL_LEQUAL);
  const GLboolean mask = colors ? GL_TRUE : GL_FALSE;
  state->vtkglColorMask(mask, mask, mask, mask);
  SetFilter(this->DepthTexture, vtkTextureObject::Nearest);
  this->Draw(quad, shader, colors, this->DepthTexture);
}

/// Brings a part of a picture's values into a texture of all of them, which is made where there is
/// none of that size.
void ImageCompositor::Upload(const void* values, int type, int components,
  const MemoryPicture& picture, const PixelRectangle& part, vtkTextureObject* texture)
{
  const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
  const int width = picture.Width;
  const int height = picture.Height;
  if (texture->GetHandle() == 0 || !IsOfSize(texture, width, height))
  {
    texture->SetContext(this->Context.Get());
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    if (!texture->Create2DFromRaw(width, height, components, type, nullptr))
    {
      throw std::runtime_error("no texture of " + std::to_string(width) + " x " +
        std::to_string(height) + " pixels could be made");
    }
  }
  const std::size_t bytes = components * (type == VTK_FLOAT ? sizeof(float) : 1);
  const auto* first =
    static_cast<const char*>(values) + bytes * (static_cast<std::size_t>(part.Y) * width + part.X);
  texture->Activate();
  glPixelStorei(GL_UNPACK_ROW_LENGTH, width);
  glTexSubImage2D(GL_TEXTURE_2D, 0, part.X, part.Y, part.Width, part.Height,
    texture->GetFormat(type, components, false), texture->GetDataType(type), first);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  texture->Deactivate();
}

/// Blends the picture over a part of the rectangle that it belongs to.
void ImageCompositor::Blend(
  const PixelRectangle& rectangle, const PixelRectangle& part, vtkTextureObject* colors)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const PartOfViewport drawn(state, rectangle, part);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  SetFilter(colors,
    IsOfSize(colors, rectangle.Width, rectangle.Height) ? vtkTextureObject::Nearest
                                                        : vtkTextureObject::Linear);
  this->Draw(this->Quad, CompositeImageFS, colors, nullptr);
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
