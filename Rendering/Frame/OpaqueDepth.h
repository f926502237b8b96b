// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OpaqueDepth_h
#define tetralux_OpaqueDepth_h

#include "Base/Span.h"
#include "Frame/DepthFormat.h"
#include "Frame/DrawnViewport.h"
#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <cstddef>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// The depths of the opaque geometry that was drawn before, as a texture. Belongs to one
/// window's context, the last one.
class TETRALUXRENDERING_EXPORT OpaqueDepth
{
public:
  OpaqueDepth();
  ~OpaqueDepth();
  OpaqueDepth(const OpaqueDepth&) = delete;
  OpaqueDepth& operator=(const OpaqueDepth&) = delete;

  /// Copies a rectangle of the depth buffer that is bound for drawing; of a multisampled one, one
  /// of the samples of each pixel, as resolving it does. Leaves OpenGL's state as it was. Throws
  /// std::runtime_error, with one line, where there is none or it can't be copied.
  void Copy(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle);

  /// Takes depths from memory, 0..1, lower row first. Leaves OpenGL's state as it was. Throws
  /// std::runtime_error, with one line, where there is no texture for them.
  void Upload(vtkOpenGLRenderWindow* window, int width, int height, Span<const float> depths);

  /// Depths 0..1, lower row first, a texel for each pixel of the rectangle.
  vtkTextureObject* GetTexture() const { return this->Texture; }

  /// Reads the depths of the last copy into one number a pixel. The window's context has to be
  /// current. Leaves OpenGL's state as it was.
  void Read(Span<float> depths);

  /// Whether the depth buffer that is bound for drawing holds the depths of the last copy. Throws
  /// as Copy does.
  bool IsSame(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle);

  std::size_t GetNumberOfBytes() const { return this->Bytes; }

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkNew<vtkTextureObject> Texture;
  DepthFormat Format;
  std::size_t Bytes = 0;
  ContextResources Context;
};

} // namespace tetralux

#endif
