// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PixelBlending_h
#define tetralux_PixelBlending_h

#include "TetraluxRenderingModule.h"

#include <cstdint>

namespace tetralux
{

// Pixels of a frame buffer in the processor's memory: 8 bits a channel, red lowest, as
// GL_UNSIGNED_INT_8_8_8_8_REV has them. Depths count steps of 2^-32.

/// Blends premultiplied colours, four a pixel, over pixels. Rounds once, to the nearest. Colours
/// count as 0..1, as in a frame buffer of 8 bits; what is not a number counts as 0.
TETRALUXRENDERING_EXPORT void BlendColors(const float* colors, std::uint32_t* pixels, int count);

/// Puts what is opaque before the pixels, with its depth, unless they are nearer. depths: below 1
/// where there is something. bytes: four a pixel.
TETRALUXRENDERING_EXPORT void PutOpaque(const std::uint8_t* bytes, const float* depths,
  std::uint32_t* pixels, std::uint32_t* pixelDepths, int count);

/// Puts depths below 1 into the buffer, unless that has nearer ones.
TETRALUXRENDERING_EXPORT void PutDepths(const float* depths, std::uint32_t* pixelDepths, int count);

} // namespace tetralux

#endif
