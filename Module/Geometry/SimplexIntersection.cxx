// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SimplexIntersection.h"

#include "Geometry/TetrahedronFaces.h"

#include <algorithm>
#include <tuple>

namespace tetralux
{
namespace
{

bool Contains(const std::int32_t* ids, int count, std::int32_t id)
{
  return std::find(ids, ids + count, id) != ids + count;
}

/// Whether an edge and a triangle have more in common than the points that they share by their ids.
/// sign0, sign1: sides of the triangle's plane on which the ends lie.
bool EdgeMeetsImproperly(const ExactPoints& points, std::int32_t end0, std::int32_t end1, int sign0,
  int sign1, const std::int32_t* triangle)
{
  const bool shares0 = Contains(triangle, 3, end0);
  const bool shares1 = Contains(triangle, 3, end1);
  if ((shares0 && shares1) || sign0 * sign1 > 0)
  {
    return false;
  }
  const auto [a, b, c] = std::tuple(triangle[0], triangle[1], triangle[2]);
  if (shares0 || shares1)
  {
    const std::int32_t shared = shares0 ? end0 : end1;
    const std::int32_t other = shares0 ? end1 : end0;
    if ((shares0 ? sign1 : sign0) != 0)
    {
      return false;
    }
    // In the plane, from a corner on: into the corner's angle or along one of its legs.
    const int axis = points.FindProjection(a, b, c);
    const int corner = static_cast<int>(std::find(triangle, triangle + 3, shared) - triangle);
    const std::int32_t next = triangle[(corner + 1) % 3];
    const std::int32_t previous = triangle[(corner + 2) % 3];
    const int turn = points.OrientProjected(a, b, c, axis);
    return turn * points.OrientProjected(shared, next, other, axis) >= 0 &&
      turn * points.OrientProjected(shared, previous, other, axis) <= 0;
  }
  if (sign0 != 0 || sign1 != 0)
  {
    const int side0 = points.Orient(end0, end1, a, b);
    const int side1 = points.Orient(end0, end1, b, c);
    if (side0 * side1 < 0)
    {
      return false;
    }
    const int side2 = points.Orient(end0, end1, c, a);
    return side0 * side2 >= 0 && side1 * side2 >= 0;
  }

  // In the plane: apart where a line along an edge of the triangle or along the edge itself has the
  // two strictly on its two sides.
  const int axis = points.FindProjection(a, b, c);
  const int turn = points.OrientProjected(a, b, c, axis);
  for (int i = 0; i < 3; ++i)
  {
    const std::int32_t from = triangle[i];
    const std::int32_t to = triangle[(i + 1) % 3];
    if (turn * points.OrientProjected(from, to, end0, axis) < 0 &&
      turn * points.OrientProjected(from, to, end1, axis) < 0)
    {
      return false;
    }
  }
  const int side0 = points.OrientProjected(end0, end1, a, axis);
  const int side1 = points.OrientProjected(end0, end1, b, axis);
  const int side2 = points.OrientProjected(end0, end1, c, axis);
  return !(side0 == side1 && side1 == side2 && side0 != 0);
}

/// The sides of a triangle's plane on which the points lie.
template <int Count>
void GetPlaneSigns(const ExactPoints& points, const std::int32_t* triangle, const std::int32_t* ids,
  int (&signs)[Count])
{
  for (int i = 0; i < Count; ++i)
  {
    signs[i] = points.Orient(triangle[0], triangle[1], triangle[2], ids[i]);
  }
}

/// Whether the points that are not shared are all strictly on one side of a plane.
template <int Count>
bool IsApart(const std::int32_t* ids, const int (&signs)[Count], const std::int32_t* triangle)
{
  bool hasPositive = false;
  bool hasNegative = false;
  for (int i = 0; i < Count; ++i)
  {
    if (signs[i] == 0 && !Contains(triangle, 3, ids[i]))
    {
      return false;
    }
    hasPositive = hasPositive || signs[i] > 0;
    hasNegative = hasNegative || signs[i] < 0;
  }
  return !(hasPositive && hasNegative);
}

} // namespace

//----------------------------------------------------------------------------
bool TrianglesMeetProperly(
  const ExactPoints& points, const std::int32_t* triangle0, const std::int32_t* triangle1)
{
  int signs1[3];
  GetPlaneSigns(points, triangle0, triangle1, signs1);
  if (IsApart(triangle1, signs1, triangle0))
  {
    return true;
  }
  int signs0[3];
  GetPlaneSigns(points, triangle1, triangle0, signs0);
  if (IsApart(triangle0, signs0, triangle1))
  {
    return true;
  }
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    if (EdgeMeetsImproperly(points, triangle1[i], triangle1[j], signs1[i], signs1[j], triangle0) ||
      EdgeMeetsImproperly(points, triangle0[i], triangle0[j], signs0[i], signs0[j], triangle1))
    {
      return false;
    }
  }
  return true;
}

//----------------------------------------------------------------------------
bool CellMeetsTriangleProperly(
  const ExactPoints& points, const std::int32_t* cell, const std::int32_t* triangle)
{
  bool isInside[3] = { true, true, true };
  for (int face = 0; face < 4; ++face)
  {
    const std::int32_t corners[3] = { cell[OutwardFaces[face][0]], cell[OutwardFaces[face][1]],
      cell[OutwardFaces[face][2]] };
    bool separates = true;
    bool touches = false;
    for (int i = 0; i < 3; ++i)
    {
      if (Contains(corners, 3, triangle[i]))
      {
        isInside[i] = false;
        continue;
      }
      const int side = triangle[i] == cell[face]
        ? -1
        : points.Orient(corners[0], corners[1], corners[2], triangle[i]);
      isInside[i] = isInside[i] && side < 0;
      separates = separates && side >= 0;
      touches = touches || side == 0;
    }
    if (separates)
    {
      return !touches || TrianglesMeetProperly(points, corners, triangle);
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    if (isInside[i] && !Contains(cell, 4, triangle[i]))
    {
      return false;
    }
  }

  int signs[4];
  GetPlaneSigns(points, triangle, cell, signs);
  if (IsApart(cell, signs, triangle))
  {
    return true;
  }
  for (const auto& face : OutwardFaces)
  {
    const std::int32_t corners[3] = { cell[face[0]], cell[face[1]], cell[face[2]] };
    if (!TrianglesMeetProperly(points, corners, triangle))
    {
      return false;
    }
  }
  return true;
}

//----------------------------------------------------------------------------
bool TrianglePiercesCell(
  const ExactPoints& points, const std::int32_t* cell, const std::int32_t* triangle)
{
  int signs[4];
  GetPlaneSigns(points, triangle, cell, signs);
  const auto [lowest, highest] = std::minmax_element(signs, signs + 4);
  if (*lowest >= 0 || *highest <= 0)
  {
    return false;
  }
  // The plane cuts a convex polygon out of the cell. Apart in the plane: by a line along a side of
  // that polygon, which is in a face of the cell, ...
  for (int face = 0; face < 4; ++face)
  {
    const int* corners = OutwardFaces[face];
    bool separates = true;
    for (int i = 0; i < 3 && separates; ++i)
    {
      separates = triangle[i] == cell[face]
        ? false
        : points.Orient(cell[corners[0]], cell[corners[1]], cell[corners[2]], triangle[i]) >= 0;
    }
    if (separates)
    {
      return false;
    }
  }
  // ... or by an edge of the triangle: each corner of the polygon is on an edge of the cell, seen
  // from below the plane to above.
  for (int i = 0; i < 3; ++i)
  {
    const std::int32_t from = triangle[i];
    const std::int32_t to = triangle[(i + 1) % 3];
    bool separates = true;
    for (int low = 0; low < 4 && separates; ++low)
    {
      for (int high = 0; high < 4 && separates; ++high)
      {
        if (signs[low] <= 0 && signs[high] >= 0 && low != high &&
          (signs[low] < 0 || signs[high] > 0))
        {
          separates = points.Orient(from, to, cell[low], cell[high]) <= 0;
        }
      }
    }
    if (separates)
    {
      return false;
    }
  }
  return true;
}

//----------------------------------------------------------------------------
bool CellCanMeetTriangle(const ExactPoints& points, const std::int32_t* cell,
  const std::int32_t* triangle, const int* planeSigns)
{
  const auto [lowest, highest] = std::minmax_element(planeSigns, planeSigns + 4);
  if (*lowest > 0 || *highest < 0)
  {
    return false;
  }
  for (int face = 0; face < 4; ++face)
  {
    const int* corners = OutwardFaces[face];
    bool isApart = true;
    for (int i = 0; i < 3 && isApart; ++i)
    {
      isApart = triangle[i] != cell[face] &&
        points.Orient(cell[corners[0]], cell[corners[1]], cell[corners[2]], triangle[i]) > 0;
    }
    if (isApart)
    {
      return false;
    }
  }
  return true;
}

//----------------------------------------------------------------------------
bool CoplanarTrianglesOverlap(
  const ExactPoints& points, const std::int32_t* triangle0, const std::int32_t* triangle1, int axis)
{
  const std::int32_t* triangles[2] = { triangle0, triangle1 };
  for (int t = 0; t < 2; ++t)
  {
    const std::int32_t* triangle = triangles[t];
    const std::int32_t* other = triangles[1 - t];
    const int turn = points.OrientProjected(triangle[0], triangle[1], triangle[2], axis);
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = triangle[i];
      const std::int32_t to = triangle[(i + 1) % 3];
      if (std::all_of(other, other + 3,
            [&](std::int32_t id)
            { return turn * points.OrientProjected(from, to, id, axis) <= 0; }))
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace tetralux
