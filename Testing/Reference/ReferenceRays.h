// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceRays_h
#define tetralux_ReferenceRays_h

#include "ReferenceVector.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <array>
#include <cstddef>
#include <vector>

namespace tetralux
{

/// The ray of one pixel. A distance along it is in world units.
struct ReferenceRay
{
  reference::Vector WorldOrigin;
  reference::Vector WorldDirection; ///< of length 1
  reference::Vector Origin;         ///< in mesh coordinates
  reference::Vector Direction;      ///< in mesh coordinates, for one world unit
};

ReferenceRay MakeReferenceRay(const RayGrid& grid, int i, int j);

/// Parts of a ray, distances of their ends, ascending and apart from each other.
using ReferenceIntervals = std::vector<std::array<reference::Real, 2>>;

/// Which parts of begin..end the limits keep; each is as long as it can be. pixel: for
/// MaximumDistances.
ReferenceIntervals ApplyReferenceLimits(const RayLimits& limits, const ReferenceRay& ray,
  std::size_t pixel, reference::Real begin, reference::Real end);

} // namespace tetralux

#endif
