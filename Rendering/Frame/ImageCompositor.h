// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageCompositor_h
#define tetralux_ImageCompositor_h

#include "Frame/DrawnViewport.h"
#include "Frame/MemoryCompositor.h"
#include "Frame/MemoryPicture.h"
#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <memory>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// Blends a picture over what the frame buffer shows that is bound for drawing, the first one of
/// its pictures. Holds graphics resources of one window at a time, the last one.
class TETRALUXRENDERING_EXPORT ImageCompositor
{
public:
  ImageCompositor();
  ~ImageCompositor();
  ImageCompositor(const ImageCompositor&) = delete;
  ImageCompositor& operator=(const ImageCompositor&) = delete;

  /// A premultiplied picture, stretched over the rectangle with linear interpolation where the
  /// sizes differ, into the frame buffer that is bound for drawing. covered: pixels of the picture
  /// beyond which there is nothing in it; not empty. Nothing is done for what is not covered, if
  /// the sizes agree. Leaves OpenGL's state as it was. Throws std::runtime_error, with one line,
  /// where there is no shader program or no texture.
  ///@{
  /// Bytes have the size of the rectangle. Depths are the nearest ones where the sizes differ.
  void Composite(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
    const MemoryPicture& picture, const PixelRectangle& covered);
  /// picture: of that window; its filters are set.
  void Composite(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle,
    vtkTextureObject* picture, const PixelRectangle& covered);
  ///@}

  /// window: the one that goes away.
  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  void Upload(const void* values, int type, int components, const MemoryPicture& picture,
    const PixelRectangle& part, vtkTextureObject* texture);
  void Blend(const PixelRectangle& rectangle, const PixelRectangle& part, vtkTextureObject* colors);
  void DrawDepth(const PixelRectangle& rectangle, const PixelRectangle& part,
    std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* shader, vtkTextureObject* colors);
  void Draw(std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* shader,
    vtkTextureObject* picture, vtkTextureObject* depths);

  MemoryCompositor Memory; ///< where it can, else the rest draws

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
