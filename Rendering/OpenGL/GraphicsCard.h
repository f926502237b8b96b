// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GraphicsCard_h
#define tetralux_GraphicsCard_h

#include "OpenGL/BufferRoom.h"
#include "TetraluxRenderingModule.h"

#include <string>

class vtkOpenGLRenderWindow;

namespace tetralux
{

/// What draws in a window.
struct GraphicsCard
{
  std::string Renderer; ///< OpenGL's name for it
  bool Software = false;
  int Version[2] = { 0, 0 }; ///< of OpenGL
  TexelLimits Limits;        ///< now: free memory changes
};

/// Asks the window's context, which has to be current.
TETRALUXRENDERING_EXPORT GraphicsCard DescribeGraphicsCard(vtkOpenGLRenderWindow* window);

/// Whether the name of a renderer is that of one that runs on the processor.
TETRALUXRENDERING_EXPORT bool IsSoftwareRenderer(std::string renderer);

} // namespace tetralux

#endif
