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
};

/// Rays by which to measure what approximate integrals do to pictures: what each goes through,
/// front to back.
struct RaySample
{
  std::vector<std::vector<RaySegment>> Rays;
};

} // namespace tetralux

#endif
