// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/GraphicsMemory.h"
#include "OpenGL/LoadedFunctions.h"

namespace tetralux
{

GraphicsMemoryCheck::GraphicsMemoryCheck()
{
  while (glGetError() != GL_NO_ERROR)
  {
  }
}

void GraphicsMemoryCheck::Finish(const std::string& content) const
{
  bool full = false;
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
  {
    full = full || error == GL_OUT_OF_MEMORY;
  }
  if (full)
  {
    throw OutOfGraphicsMemory("the graphics card has no memory for " + content);
  }
}

} // namespace tetralux
