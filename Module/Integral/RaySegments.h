// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RaySegments_h
#define tetralux_RaySegments_h

#include <vector>

namespace tetralux
{

/// A ray's way through a cell.
struct RaySegment
{
  double Front, Back; ///< scalars at its ends, finite
  double Length;      ///< world units, more than 0

  /// Change of the scalar across the ray for one radius of the mesh; 0 in a cell of constant
  /// scalar.
  double Gradient = 0;

  /// Tangents of the angles between the ray and the normals of the faces at its ends: how much
  /// farther along the ray it meets them where they move across it.
  double FrontSlope = 0, BackSlope = 0;

  bool First = false; ///< the ray enters the mesh here
  bool Last = false;  ///< and leaves it here
};

/// Rays by which to measure what approximate integrals do to pictures: what each goes through,
/// front to back.
struct RaySample
{
  std::vector<std::vector<RaySegment>> Rays;

  /// How often each ray would be one of a picture: where rays were drawn through places in cells,
  /// those through many and small cells were drawn too often. In any unit; empty: all the same.
  std::vector<double> Weights;
};

} // namespace tetralux

#endif
