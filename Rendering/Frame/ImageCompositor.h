// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageCompositor_h
#define tetralux_ImageCompositor_h

#include "Frame/CameraRays.h"
#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <cstdint>
#include <memory>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// Blends a float picture over what the frame buffer shows that is bound for drawing, the first
/// one of its pictures. Holds graphics resources of one
/// window at a time, the last one.
class TETRALUXRENDERING_EXPORT ImageCompositor
{
public:
  ImageCompositor();
  ~ImageCompositor();
  ImageCompositor(const ImageCompositor&) = delete;
  ImageCompositor& operator=(const ImageCompositor&) = delete;

  /// A premultiplied picture, stretched over the rectangle with linear interpolation where the
  /// sizes differ, into the frame buffer that is bound for drawing. Leaves OpenGL's state as it
  /// was. Throws std::runtime_error, with one line, where there is no shader program or no texture.
  ///@{
  /// colors: width x height x 4 floats, lower row first. covered: pixels of the picture beyond
  /// which there is nothing in it; not empty.
  void Composite(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
    const float* colors, int width, int height, const PixelRectangle& covered);
  /// picture: of that window; its filters are set.
  void Composite(
    vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, vtkTextureObject* picture);
  ///@}

  /// Writes depths of a picture into the depth buffer, width x height of them, lower row first;
  /// what is 1 or more is left out, as is what the buffer has something in front of. The nearest
  /// one where the sizes differ. Throws as Composite.
  void WriteDepth(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
    const float* depths, int width, int height, const PixelRectangle& covered);

  /// Both at once, of a picture that is opaque wherever its depth is below 1, and empty elsewhere;
  /// of the size of the rectangle. colors: 0..255.
  void CompositeOpaque(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
    const std::uint8_t* colors, const float* depths, int width, int height,
    const PixelRectangle& covered);

  /// window: the one that goes away.
  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  /// A picture, lower row first.
  struct Memory
  {
    const void* Values;
    int Type; ///< VTK_FLOAT or VTK_UNSIGNED_CHAR
    int Components;
    int Width;
    int Height;
  };

  PixelRectangle Upload(const PixelRectangle& rectangle, const Memory& memory,
    const PixelRectangle& covered, vtkTextureObject* texture);
  void DrawDepth(const PixelRectangle& target, std::unique_ptr<vtkOpenGLQuadHelper>& quad,
    const char* shader, vtkTextureObject* colors);
  void Draw(std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* shader,
    vtkTextureObject* picture, vtkTextureObject* depths);

  // One for each type: a texture object keeps the first one that it is made of.
  vtkNew<vtkTextureObject> Texture;
  vtkNew<vtkTextureObject> ByteTexture;
  vtkNew<vtkTextureObject> DepthTexture;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  std::unique_ptr<vtkOpenGLQuadHelper> DepthQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> OpaqueQuad;
  ContextResources Context;
};

} // namespace tetralux

#endif
