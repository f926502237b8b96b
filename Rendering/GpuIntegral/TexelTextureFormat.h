// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TexelTextureFormat_h
#define tetralux_TexelTextureFormat_h

#include "OpenGL/LoadedFunctions.h"

#include "PreIntegration/PreIntegrationTable.h"

namespace tetralux
{

/// OpenGL's internal format of a texture with such texels.
inline GLenum GetInternalFormat(TexelFormat format)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return GL_RGBA8;
    case TexelFormat::UNorm16:
      return GL_RGBA16;
    case TexelFormat::Half:
      return GL_RGBA16F;
    case TexelFormat::Float:
      break;
  }
  return GL_RGBA32F;
}

} // namespace tetralux

#endif
