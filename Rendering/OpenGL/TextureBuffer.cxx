// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/TextureBuffer.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// One of nothing: a texture has to have something.
constexpr float EmptyTexel[4] = { 0, 0, 0, 0 };

// VTK knows no formats of integers by itself.

GLenum GetInternalFormat(int type, int components)
{
  if (type == VTK_INT)
  {
    return components == 1 ? GL_R32I : components == 2 ? GL_RG32I : GL_RGBA32I;
  }
  return components == 1 ? GL_R32F : components == 2 ? GL_RG32F : GL_RGBA32F;
}

GLenum GetFormat(int type, int components)
{
  if (type == VTK_INT)
  {
    return components == 1 ? GL_RED_INTEGER : components == 2 ? GL_RG_INTEGER : GL_RGBA_INTEGER;
  }
  return components == 1 ? GL_RED : components == 2 ? GL_RG : GL_RGBA;
}

} // namespace

TextureBuffer::TextureBuffer()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Buffer->ReleaseGraphicsResources();
        this->Texture->ReleaseGraphicsResources(window);
        this->Bytes = 0;
      })
{
}

TextureBuffer::~TextureBuffer() = default;

void TextureBuffer::Upload(vtkOpenGLRenderWindow* window, const float* texels,
  std::size_t numberOfTexels, int components, const std::string& what)
{
  this->UploadBytes(window, texels, numberOfTexels, components, VTK_FLOAT, what);
}

void TextureBuffer::Upload(vtkOpenGLRenderWindow* window, const std::int32_t* texels,
  std::size_t numberOfTexels, int components, const std::string& what)
{
  this->UploadBytes(window, texels, numberOfTexels, components, VTK_INT, what);
}

void TextureBuffer::UploadBytes(vtkOpenGLRenderWindow* window, const void* texels,
  std::size_t numberOfTexels, int components, int type, const std::string& what)
{
  this->Context.Set(window);
  if (numberOfTexels == 0)
  {
    texels = EmptyTexel;
    numberOfTexels = 1;
  }
  vtkOpenGLState* state = window->GetState();
  int largest = 0;
  state->vtkglGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  if (numberOfTexels > static_cast<std::size_t>(std::max(largest, 0)))
  {
    throw std::runtime_error(what + " takes " + std::to_string(numberOfTexels) +
      " texels, and buffer textures of this graphics card have " + std::to_string(largest) +
      " at most");
  }
  // Both types have four bytes.
  const std::size_t values = numberOfTexels * components;
  const std::size_t bytes = values * sizeof(float);
  this->Bytes = 0;
  while (glGetError() != GL_NO_ERROR) // of others
  {
  }
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const bool uploaded = this->Buffer->Upload(
    static_cast<const float*>(texels), values, vtkOpenGLBufferObject::TextureBuffer);
  const bool outOfMemory = glGetError() != GL_NO_ERROR;
  this->Buffer->Release();
  this->Texture->SetContext(window);
  this->Texture->SetInternalFormat(GetInternalFormat(type, components));
  this->Texture->SetFormat(GetFormat(type, components));
  this->Texture->SetDataType(type == VTK_INT ? GL_INT : GL_FLOAT);
  if (!uploaded || outOfMemory ||
    !this->Texture->CreateTextureBuffer(
      static_cast<unsigned int>(numberOfTexels), components, type, this->Buffer))
  {
    throw std::runtime_error(
      "the graphics card has no memory for the " + std::to_string(bytes) + " bytes of " + what);
  }
  this->Texture->Deactivate();
  this->Bytes = bytes;
}

void TextureBuffer::Activate(vtkShaderProgram* program, const char* sampler)
{
  const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
  this->Texture->Activate();
  program->SetUniformi(sampler, this->Texture->GetTextureUnit());
}

void TextureBuffer::Deactivate()
{
  if (this->Context.Get())
  {
    const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
    this->Texture->Deactivate();
  }
}

} // namespace tetralux
