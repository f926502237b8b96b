// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TextureFilterError_h
#define tetralux_TextureFilterError_h

#include "PreIntegration/PreIntegrationTable.h"
#include "TetraluxRenderingModule.h"

class vtkOpenGLRenderWindow;

namespace tetralux
{

/// Largest error of the graphics card's own interpolation along an axis of a 3-D texture, in units
/// of the change from a texel to the next: measured by drawing. Most cards have weights of eight
/// bits, off by 1 / 512, whatever the format; software may have others. Leaves OpenGL's state as it
/// was. Throws std::runtime_error, with one line, where nothing can be drawn.
TETRALUXRENDERING_EXPORT double MeasureTextureFilterError(
  vtkOpenGLRenderWindow* window, TexelFormat format);

} // namespace tetralux

#endif
