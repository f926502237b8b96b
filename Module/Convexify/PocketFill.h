// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PocketFill_h
#define tetralux_PocketFill_h

#include "Convexify/PocketFinder.h"
#include "Convexify/PocketWrap.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tetralux
{

/// Fills all pockets of an empty space with cells.
/// coordinates: of the points; Steiner points are added at the end.
/// flat: receives the triangles around pockets that are left empty, since there is no room for a
/// point in them, and no need: they are between the mesh and its hull, which is flat to rounding.
/// Returns the cells of the space and of its pockets; where a pocket can't be filled, the obstacle
/// says which. progress: as of Convexify.
std::vector<Cell> FillPockets(EmptySpace space, const PointNeighbors& neighbors,
  std::vector<double>& coordinates, Front& flat, Obstacle& obstacle,
  const std::function<bool(double)>& progress);

} // namespace tetralux

#endif
