// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PolyhedronFilling_h
#define tetralux_PolyhedronFilling_h

#include "TetraluxCoreModule.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tetralux
{

/// A polyhedron that need not be convex, divided by FillPolyhedron.
struct PolyhedronFilling
{
  /// Four places of corners for each tetrahedron, of positive volume in VTK's order.
  std::vector<std::int32_t> Cells;

  /// The surface of what is left, as the whole was given; empty if the tetrahedra fill it.
  std::vector<std::int32_t> Rest;
};

/// Cuts tetrahedra between corners off a polyhedron, which meet it and each other in whole faces,
/// until nothing is left, or until isDone, if there is one, says so of the rest. corners:
/// coordinates, three each. triangles: its surface, three places of corners each, seen
/// counter-clockwise from outside.
///
/// Returns whether it did. Some polyhedra can't be filled between their corners (Schoenhardt 1928),
/// and to find out is hard (Ruppert and Seidel 1992): it gives up after a bounded search.
TETRALUXCORE_EXPORT bool FillPolyhedron(const std::vector<double>& corners,
  const std::vector<std::int32_t>& triangles,
  const std::function<bool(const std::vector<std::int32_t>&)>& isDone, PolyhedronFilling& filling);

} // namespace tetralux

#endif
