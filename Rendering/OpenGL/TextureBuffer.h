// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TextureBuffer_h
#define tetralux_TextureBuffer_h

#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <cstddef>
#include <cstdint>
#include <string>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// An array that shaders read by texelFetch of a samplerBuffer (floats) or an isamplerBuffer
/// (integers). Belongs to one window's context, the last one that it was uploaded to.
class TETRALUXRENDERING_EXPORT TextureBuffer
{
public:
  TextureBuffer();
  ~TextureBuffer();
  TextureBuffer(const TextureBuffer&) = delete;
  TextureBuffer& operator=(const TextureBuffer&) = delete;

  /// numberOfTexels of 1, 2 or 4 components each; at least one texel is made. what: the name of the
  /// array in errors. Throws std::runtime_error, with one line, where the graphics card has no
  /// texture that large or no memory for it. Needs the window's context to be current.
  ///@{
  void Upload(vtkOpenGLRenderWindow* window, const float* texels, std::size_t numberOfTexels,
    int components, const std::string& what);
  void Upload(vtkOpenGLRenderWindow* window, const std::int32_t* texels, std::size_t numberOfTexels,
    int components, const std::string& what);
  ///@}

  /// Also once its context has ended.
  bool IsEmpty() const { return this->Bytes == 0; }
  std::size_t GetNumberOfBytes() const { return this->Bytes; }

  /// Binds the array to a texture unit and the program's sampler to that; Deactivate gives the unit
  /// back.
  ///@{
  void Activate(vtkShaderProgram* program, const char* sampler);
  void Deactivate();
  ///@}

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  void UploadBytes(vtkOpenGLRenderWindow* window, const void* texels, std::size_t numberOfTexels,
    int components, int type, const std::string& what);

  vtkNew<vtkTextureObject> Texture;
  vtkNew<vtkOpenGLBufferObject> Buffer; ///< of the texture
  std::size_t Bytes = 0;
  ContextResources Context;
};

} // namespace tetralux

#endif
