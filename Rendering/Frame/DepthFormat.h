// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DepthFormat_h
#define tetralux_DepthFormat_h

#include "TetraluxRenderingModule.h"

#include <cstddef>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace tetralux
{

/// A depth texture's format, and how its values are handed over, in the terms of OpenGL.
struct DepthFormat
{
  unsigned int Internal = 0;
  unsigned int Format = 0;
  unsigned int Type = 0;
  std::size_t Bytes = 0; ///< a pixel

  bool operator==(const DepthFormat& other) const { return this->Internal == other.Internal; }
};

/// That of the depth buffer that is bound for reading: depths are copied only between equal ones.
/// windowsOwn: it is not in a frame buffer object. Throws std::runtime_error, with one line, where
/// there is none.
DepthFormat FindDepthFormat(bool windowsOwn);

/// Makes a depth texture of the format, where no texture is or another one was. samples: of each
/// pixel; 0: the texture is not multisampled. Throws std::runtime_error, with one line, where it
/// can't be made.
void AllocateDepths(vtkTextureObject* texture, vtkOpenGLRenderWindow* window,
  const DepthFormat& format, int width, int height, int samples);

/// Attaches a depth texture of the format to the frame buffer that is bound for drawing.
void AttachDepths(vtkTextureObject* texture, const DepthFormat& format);

} // namespace tetralux

#endif
