// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DrawnViewport_h
#define tetralux_DrawnViewport_h

#include "TetraluxRenderingModule.h"

class vtkRenderer;

namespace tetralux
{

/// A rectangle of pixels of what is drawn into, from its lower left.
struct PixelRectangle
{
  int X = 0;
  int Y = 0;
  int Width = 0;
  int Height = 0;
};

/// Where a renderer draws: into the window, or into a frame buffer that a render pass bound, which
/// may be of another size.
struct DrawnViewport
{
  PixelRectangle Whole;   ///< the viewport, parts of which may be outside of the window
  PixelRectangle Visible; ///< the part of it that is drawn; empty where Width or Height is 0
};

/// The viewport that a renderer draws into now. Where the frame buffer that is bound is not the
/// window's, it is OpenGL's viewport, which render passes set.
TETRALUXRENDERING_EXPORT DrawnViewport FindDrawnViewport(vtkRenderer* renderer);

} // namespace tetralux

#endif
