// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PictureCapture_h
#define tetralux_PictureCapture_h

#include "Compositing/PartialPicture.h"
#include "OpenGL/FloatTarget.h"

#include <functional>

class vtkRenderer;
class vtkWindow;

namespace tetralux
{

/// Catches what is drawn in a picture of floats, before it is rounded to the bits of the window.
/// Belongs to one window's context, the last one.
class PictureCapture
{
public:
  /// Returns what draw adds to the viewport that the renderer draws now. The depth buffer is that
  /// of the frame buffer that is bound, for reading and for writing. Throws std::runtime_error,
  /// with one line, where there is no such picture.
  PartialPicture Draw(vtkRenderer* renderer, const std::function<void()>& draw);

  void ReleaseGraphicsResources(vtkWindow* window)
  {
    this->Target.ReleaseGraphicsResources(window);
  }

private:
  FloatTarget Target;
};

} // namespace tetralux

#endif
