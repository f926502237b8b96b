// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SimplexIntersection_h
#define tetralux_SimplexIntersection_h

#include "Geometry/ExactOrientation.h"

#include <cstdint>

namespace tetralux
{

/// Whether two triangles have nothing in common but the corners and the edge that they share by
/// their ids. They must have an area and must not be the same three points.
bool TrianglesMeetProperly(
  const ExactPoints& points, const std::int32_t* triangle0, const std::int32_t* triangle1);

/// The same for a tetrahedron of positive volume and a triangle that is not one of its faces.
bool CellMeetsTriangleProperly(
  const ExactPoints& points, const std::int32_t* cell, const std::int32_t* triangle);

/// Whether the inside of a tetrahedron of positive volume meets a triangle.
bool TrianglePiercesCell(
  const ExactPoints& points, const std::int32_t* cell, const std::int32_t* triangle);

/// False only where a tetrahedron and a triangle have no point in common. planeSigns: for each of
/// the tetrahedron's points the side of the triangle's plane.
bool CellCanMeetTriangle(const ExactPoints& points, const std::int32_t* cell,
  const std::int32_t* triangle, const int* planeSigns);

/// Whether two coplanar triangles have a part of their area in common. axis: a projection of their
/// plane, see ExactPoints::FindProjection.
bool CoplanarTrianglesOverlap(const ExactPoints& points, const std::int32_t* triangle0,
  const std::int32_t* triangle1, int axis);

} // namespace tetralux

#endif
