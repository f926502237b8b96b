// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SampleCompositor_h
#define tetralux_SampleCompositor_h

#include "Frame/DrawnViewport.h"
#include "Frame/PixelSamples.h"
#include "OpenGL/ContextResources.h"
#include "OpenGL/ScreenProgram.h"
#include "OpenGL/TextureBuffer.h"
#include "TetraluxRenderingModule.h"

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace tetralux
{

/// Blends samples of some pixels over what a multisampled frame buffer shows, each into the sample
/// of its own. Belongs to one window's context, the last one.
class TETRALUXRENDERING_EXPORT SampleCompositor
{
public:
  SampleCompositor();
  ~SampleCompositor();
  SampleCompositor(const SampleCompositor&) = delete;
  SampleCompositor& operator=(const SampleCompositor&) = delete;

  /// Into the frame buffer that is bound for drawing. rectangle: that of the picture, a pixel of it
  /// each. Depths below 1 are written unless the sample has less. samples: of one pixel at least.
  /// Leaves OpenGL's state as it was. Throws std::runtime_error, with one line, where there is no
  /// shader program or no memory.
  void Composite(
    vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, const PixelSamples& samples);

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  void Draw(ScreenProgram& screen, bool depths, const PixelRectangle& rectangle,
    const PixelSamples& samples, TextureBuffer& values);

  ScreenProgram ColorProgram;
  ScreenProgram DepthProgram;
  TextureBuffer Pixels;
  TextureBuffer Colors;
  TextureBuffer Depths;
  ContextResources Context;
};

} // namespace tetralux

#endif
