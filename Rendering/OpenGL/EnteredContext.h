// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EnteredContext_h
#define tetralux_EnteredContext_h

#include "OpenGL/CurrentContext.h"

#include "vtkOpenGLRenderWindow.h"

namespace tetralux
{

/// While one lives, the context of a window is current; then that which was before.
class EnteredContext
{
public:
  explicit EnteredContext(vtkOpenGLRenderWindow* window)
    : Window(window)
  {
    CurrentContext::LeaveHeadless(); // the window's may be one of GLX
    window->PushContext();
  }
  ~EnteredContext()
  {
    this->Window->PopContext();
    this->Before.Restore();
  }
  EnteredContext(const EnteredContext&) = delete;
  EnteredContext& operator=(const EnteredContext&) = delete;

private:
  CurrentContext Before;
  vtkOpenGLRenderWindow* Window;
};

} // namespace tetralux

#endif
