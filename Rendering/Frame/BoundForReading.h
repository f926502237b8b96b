// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoundForReading_h
#define tetralux_BoundForReading_h

#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLState.h"

namespace tetralux
{

/// While one lives, reading comes from a frame buffer. Then both that were bound are bound again.
class BoundForReading
{
public:
  BoundForReading(vtkOpenGLState* state, unsigned int framebuffer)
    : State(state)
  {
    state->PushFramebufferBindings();
    state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  }
  ~BoundForReading() { this->State->PopFramebufferBindings(); }
  BoundForReading(const BoundForReading&) = delete;
  BoundForReading& operator=(const BoundForReading&) = delete;

private:
  vtkOpenGLState* State;
};

} // namespace tetralux

#endif
