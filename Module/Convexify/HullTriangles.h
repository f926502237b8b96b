// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HullTriangles_h
#define tetralux_HullTriangles_h

#include "Convexify/BoundaryTriangulation.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// The convex hull of a boundary, triangulated such that no edge of the boundary crosses a
/// triangle. The triangles are those of the Delaunay triangulation, except in planes of more than
/// three points where it lacks edges of the boundary.
struct HullTriangles
{
  /// Each seen from inside: the hull is on its positive side. None where edges cross.
  std::vector<Triangle> Triangles;
  std::vector<std::int32_t> Cells; ///< for each a finite cell of the triangulation behind its plane
  std::vector<std::uint8_t> IsDelaunay; ///< and whether it is a face of that cell

  /// Finite cells with an edge in the hull that is no edge of its triangles.
  std::vector<std::int32_t> LostCells;

  /// Pairs of cells that lie behind the same plane.
  std::vector<std::array<std::int32_t, 2>> JoinedCells;
};

HullTriangles TriangulateHull(
  const BoundarySurface& surface, const BoundaryTriangulation& triangulation);

} // namespace tetralux

#endif
