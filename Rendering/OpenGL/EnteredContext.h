// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EnteredContext_h
#define tetralux_EnteredContext_h

#include "vtkOpenGLRenderWindow.h"

namespace tetralux
{

/// While one lives, the context of a window is current; then, where the window has a way back, that
/// which was before.
class EnteredContext
{
public:
  explicit EnteredContext(vtkOpenGLRenderWindow* window)
    : Window(window)
  {
    window->PushContext();
  }
  ~EnteredContext() { this->Window->PopContext(); }
  EnteredContext(const EnteredContext&) = delete;
  EnteredContext& operator=(const EnteredContext&) = delete;

private:
  vtkOpenGLRenderWindow* Window;
};

} // namespace tetralux

#endif
