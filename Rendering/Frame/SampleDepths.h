// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SampleDepths_h
#define tetralux_SampleDepths_h

#include "Frame/DepthFormat.h"
#include "Frame/DrawnViewport.h"
#include "OpenGL/ContextResources.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/ScreenProgram.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <array>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// Places of the samples of each pixel in the frame buffer that is bound for drawing, from the
/// pixel's lower left, 0..1. Empty where that is not multisampled.
TETRALUXRENDERING_EXPORT std::vector<std::array<double, 2>> FindSamplePlaces();

/// The depths of opaque geometry in each sample of a multisampled frame buffer. Belongs to one
/// window's context, the last one.
class TETRALUXRENDERING_EXPORT SampleDepths
{
public:
  SampleDepths();
  ~SampleDepths();
  SampleDepths(const SampleDepths&) = delete;
  SampleDepths& operator=(const SampleDepths&) = delete;

  /// Reads a rectangle of the depth buffer that is bound for drawing: for each sample, a picture of
  /// depths 0..1, lower row first. samples: of each pixel. Leaves OpenGL's state as it was. Throws
  /// std::runtime_error, with one line, where there is no depth buffer or it can't be read.
  std::vector<float> Read(
    vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, int samples);

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  void Copy(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, int samples);

  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkNew<vtkTextureObject> Texture; ///< multisampled
  DepthFormat Format;
  FloatTarget Target; ///< four samples to a picture
  ScreenProgram Program;
  ContextResources Context;
};

} // namespace tetralux

#endif
