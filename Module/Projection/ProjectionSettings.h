// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProjectionSettings_h
#define tetralux_ProjectionSettings_h

namespace tetralux
{

/// How cells are projected.
struct ProjectionSettings
{
  int Width = 0; ///< of the picture, pixels
  int Height = 0;

  /// How far silhouettes are widened, pixels: more than graphics cards may move their corners.
  double Margin = 1. / 256;

  /// By how much rays pass beside the centres of pixels, pixels, see FindShift.
  double Shift = 0;

  /// Perspective interpolation (Kraus et al. 2004, section 2.2). Off: depths and scalars are
  /// interpolated linearly on the screen, by the rasteriser, which is wrong in a perspective.
  bool Interpolate = true;
};

} // namespace tetralux

#endif
