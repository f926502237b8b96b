// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MemoryCompositor_h
#define tetralux_MemoryCompositor_h

#include "Frame/DepthFormat.h"
#include "Frame/DrawnViewport.h"
#include "Frame/MemoryPicture.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <cstdint>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// Composites a picture in the processor's memory where OpenGL draws on the processor, too. There,
/// copying a rectangle of the frame buffer out and in again takes a tenth of drawing it, and the
/// processor's own code blends faster than shaders do. Blends by PixelBlending.h, so that a channel
/// is rounded once. Holds textures of one window's context.
class TETRALUXRENDERING_EXPORT MemoryCompositor
{
public:
  MemoryCompositor();
  ~MemoryCompositor();
  MemoryCompositor(const MemoryCompositor&) = delete;
  MemoryCompositor& operator=(const MemoryCompositor&) = delete;

  /// Whether it can composite into the frame buffer that is bound for drawing: OpenGL is software,
  /// and one picture is drawn into, of 8 bits a channel, without multisampling, masks or stencil.
  /// The depth buffer, if the picture has depths, has 32 bits of fixed point.
  static bool CanComposite(const MemoryPicture& picture);

  /// A pixel of the picture is one of the frame buffer; its lower left is at x, y there. covered:
  /// pixels of the picture beyond which there is nothing in it; not empty. Leaves OpenGL's state as
  /// it was. Throws std::runtime_error, with one line, where the frame buffer can't be copied.
  void Composite(vtkOpenGLRenderWindow* window, int x, int y, const MemoryPicture& picture,
    const PixelRectangle& covered);

  /// The same of a part of a texture of that window, which has premultiplied colours.
  void Composite(vtkOpenGLRenderWindow* window, int x, int y, vtkTextureObject* picture,
    const PixelRectangle& part);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Prepare(vtkOpenGLRenderWindow* window, int width, int height, bool depths);
  void Blend(const MemoryPicture& picture, const PixelRectangle& covered);

  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkNew<vtkTextureObject> Colors;
  vtkNew<vtkTextureObject> Depths;

  vtkNew<vtkOpenGLFramebufferObject> Source; ///< to read textures
  std::vector<float> SourceColors;

  // What was copied out of the frame buffer.
  std::vector<std::uint32_t> Pixels;
  std::vector<std::uint32_t> PixelDepths;
};

} // namespace tetralux

#endif
