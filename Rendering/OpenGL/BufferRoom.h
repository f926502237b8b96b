// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BufferRoom_h
#define tetralux_BufferRoom_h

#include "TetraluxRenderingModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tetralux
{

/// A buffer on a graphics card.
struct BufferSize
{
  const char* Content; ///< what a message calls it
  std::int64_t Texels;
  std::int64_t BytesPerTexel;
};

/// What a graphics card offers.
struct TexelLimits
{
  std::int64_t MaximumTexels = 0; ///< of a texture buffer
  std::int64_t FreeBytes = -1;    ///< -1: not known
};

/// Why buffers do not fit: one line with the numbers; empty where they fit.
TETRALUXRENDERING_EXPORT std::string FindObstacle(
  const std::vector<BufferSize>& buffers, const TexelLimits& limits);

} // namespace tetralux

#endif
