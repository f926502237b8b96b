// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/ImageCompositor.h"

#include "CompositeImageFS.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtk_glew.h"

#include <stdexcept>
#include <string>

namespace tetralux
{

ImageCompositor::ImageCompositor() = default;

ImageCompositor::~ImageCompositor() { this->ReleaseGraphicsResources(this->Window); }

void ImageCompositor::Composite(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
  const float* colors, int width, int height, const PixelRectangle& covered)
{
  this->SetWindow(window);
  // Where a ray is a pixel, what is empty needs neither upload nor drawing.
  const bool sameSize = width == rectangle.Width && height == rectangle.Height;
  const PixelRectangle part = sameSize ? covered : PixelRectangle{ 0, 0, width, height };
  {
    const vtkOpenGLState::ScopedglActiveTexture unit(window->GetState());
    this->Texture->SetContext(window);
    this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
    this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
    const float* first = colors + 4 * (static_cast<std::size_t>(part.Y) * width + part.X);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, width);
    const bool made = this->Texture->Create2DFromRaw(
      part.Width, part.Height, 4, VTK_FLOAT, const_cast<float*>(first)); // only read
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    if (!made)
    {
      throw std::runtime_error("no texture of " + std::to_string(part.Width) + " x " +
        std::to_string(part.Height) + " floating point pixels could be made");
    }
    this->Texture->Deactivate();
  }
  const PixelRectangle target = sameSize
    ? PixelRectangle{ rectangle.X + part.X, rectangle.Y + part.Y, part.Width, part.Height }
    : rectangle;
  this->Composite(window, target, this->Texture);
}

void ImageCompositor::SetWindow(vtkOpenGLRenderWindow* window)
{
  if (this->Window != window)
  {
    this->ReleaseGraphicsResources(this->Window);
    this->Quad.reset(); // also where the last window is no more
    this->Window = window;
  }
}

void ImageCompositor::Composite(
  vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, vtkTextureObject* picture)
{
  this->SetWindow(window);
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

  if (!this->Quad)
  {
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, CompositeImageFS, "");
  }
  if (!this->Quad->Program || !window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program))
  {
    this->Quad.reset();
    throw std::runtime_error("the shader program that composites the picture did not compile");
  }
  picture->Activate();
  this->Quad->Program->SetUniformi("image", picture->GetTextureUnit());
  this->Quad->Render();
  picture->Deactivate();
}

void ImageCompositor::ReleaseGraphicsResources(vtkWindow* window)
{
  if (!this->Window || window != this->Window)
  {
    return;
  }
  this->Texture->ReleaseGraphicsResources(window);
  this->Quad.reset();
  this->Window = nullptr;
}

} // namespace tetralux
