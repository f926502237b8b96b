// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PocketFinder_h
#define tetralux_PocketFinder_h

#include "Convexify/BoundaryTriangulation.h"
#include "Convexify/PocketFront.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

using Cell = std::array<std::int32_t, 4>;

/// The empty space between a boundary and its hull: the cells of the Delaunay triangulation that
/// lie in it and conform with the boundary, and the pockets that they leave.
struct EmptySpace
{
  std::vector<Cell> Cells;
  std::vector<Front> Pockets;
  std::int64_t MissingFaces = 0; ///< boundary triangles that the triangulation does not have
};

EmptySpace FindPockets(
  const BoundarySurface& surface, const BoundaryTriangulation& triangulation, Obstacle& obstacle);

} // namespace tetralux

#endif
