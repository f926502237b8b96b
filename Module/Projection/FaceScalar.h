// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FaceScalar_h
#define tetralux_FaceScalar_h

#include "Projection/ProjectionSettings.h"
#include "Projection/ScreenFrame.h"
#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

/// The scalar where rays go through a face of a projected mesh, as a function of the face alone.
/// The cells on both sides of it thus find the same scalar, to the last bit, and with that the same
/// side of a surface of constant scalar: along a ray such a surface is met as often as the ends of
/// the ray tell, never missed or met twice by rounding at a face.
///
/// With dx, dy the pixel's distance from Reference, and f(dx, dy) = f[0] + f[1] dx + f[2] dy:
///
///   share    Share(dx, dy) / Inverse(dx, dy), bound to 0..1; without perspective not divided
///   scalar   Lowest + share (Highest - Lowest), Highest at most
///
/// Relative to the least scalar of the face, so that rounding is relative to what the
/// scalar changes over the face; where it does not, it comes out as it is. Numbers are
/// finite for all faces; those of a face that is seen exactly from the side mean nothing,
/// but no ray goes through it.
///
/// As a graphics card reads it: three texels, of which the last one is of use in a
/// perspective only.
struct FaceScalar
{
  float Share[3]; ///< of the way from the lowest to the highest scalar, over the depth
  float Lowest;
  float Reference[2]; ///< centre of a pixel, in the coordinates of gl_FragCoord
  float Highest;
  float Padding0;
  float Inverse[3]; ///< 1 / depth
  float Padding1;
};
static_assert(sizeof(FaceScalar) == 3 * 16, "three texels of four numbers");

/// Of a face with points a, b and c. Another order of them gives other roundings: whoever asks for
/// a face twice does so with the same order.
TETRALUXCORE_EXPORT FaceScalar FindFaceScalar(const ScreenFrame& frame,
  const ProjectionSettings& settings, const ScreenPoint& a, const ScreenPoint& b,
  const ScreenPoint& c);

} // namespace tetralux

#endif
