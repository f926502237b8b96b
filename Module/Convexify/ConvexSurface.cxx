// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/BoundarySurface.h"

#include "Base/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

struct DirectedEdge
{
  std::int32_t From, To;
  std::int32_t Triangle;
  std::int32_t Apex;

  std::pair<std::int32_t, std::int32_t> Key() const { return std::minmax(this->From, this->To); }
};

/// Whether a surface, convex at all of its edges and connected, covers its shadow only once.
bool CoversOnce(const ExactPoints& points, const std::vector<Triangle>& triangles)
{
  // Takes a point of a triangle's shadow that is on no edge. Exactly one triangle that turns as
  // this one does must lie over it.
  constexpr std::size_t attempts = 64;
  for (std::size_t seed = 0; seed < std::min(attempts, triangles.size()); ++seed)
  {
    const auto [a, b, c] = triangles[seed];
    const int axis = points.FindProjection(a, b, c);
    const int turn = points.OrientProjected(a, b, c, axis);
    const int x = axis == 0 ? 1 : 0;
    const int y = axis == 2 ? 1 : 2;
    const auto getMiddle = [&, a = a, b = b, c = c](int i)
    { return 0.3 * points[a][i] + 0.31 * points[b][i] + 0.39 * points[c][i]; };
    const double middle[2] = { getMiddle(x), getMiddle(y) };
    const auto getSide = [&](std::int32_t from, std::int32_t to)
    {
      return turn *
        GetExactOrientation(
          points[from][x], points[from][y], points[to][x], points[to][y], middle[0], middle[1]);
    };

    std::int64_t covering = 0;
    bool isOnEdge = false;
    for (const Triangle& triangle : triangles)
    {
      const auto [low, high] =
        std::minmax({ points[triangle[0]][x], points[triangle[1]][x], points[triangle[2]][x] });
      if (middle[0] < low || middle[0] > high)
      {
        continue;
      }
      const int sides[3] = { getSide(triangle[0], triangle[1]), getSide(triangle[1], triangle[2]),
        getSide(triangle[2], triangle[0]) };
      const auto [least, most] = std::minmax({ sides[0], sides[1], sides[2] });
      isOnEdge = isOnEdge || (least == 0 && most >= 0);
      covering += least > 0;
    }
    if (!isOnEdge && covering > 0)
    {
      return covering == 1;
    }
  }
  return false;
}

} // namespace

//----------------------------------------------------------------------------
bool IsConvexSurface(const ExactPoints& points, const std::vector<Triangle>& triangles)
{
  if (triangles.empty() || triangles.size() % 2 != 0)
  {
    return triangles.empty();
  }
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * triangles.size());
  std::vector<std::int32_t> ids;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const Triangle& triangle = triangles[t];
    for (int i = 0; i < 3; ++i)
    {
      edges.push_back({ triangle[i], triangle[(i + 1) % 3], static_cast<std::int32_t>(t),
        triangle[(i + 2) % 3] });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const DirectedEdge& edge0, const DirectedEdge& edge1) { return edge0.Key() < edge1.Key(); });

  // Every edge once in each direction.
  for (std::size_t i = 0; i < edges.size(); i += 2)
  {
    if (edges[i + 1].From != edges[i].To || edges[i + 1].To != edges[i].From ||
      (i + 2 < edges.size() && edges[i + 2].Key() == edges[i].Key()))
    {
      return false;
    }
  }

  // One sphere: connected, and of Euler characteristic 2, which rules out points where two parts of
  // a surface meet.
  for (const Triangle& triangle : triangles)
  {
    ids.insert(ids.end(), triangle.begin(), triangle.end());
  }
  DisjointSets sets(triangles.size());
  std::size_t parts = triangles.size();
  for (std::size_t i = 0; i < edges.size(); i += 2)
  {
    parts -= sets.Unite(edges[i].Triangle, edges[i + 1].Triangle);
  }
  std::sort(ids.begin(), ids.end());
  const auto numberOfPoints =
    static_cast<std::size_t>(std::unique(ids.begin(), ids.end()) - ids.begin());
  if (parts > 1 || numberOfPoints + triangles.size() != edges.size() / 2 + 2)
  {
    return false;
  }

  bool isConvex = true;
  const auto numberOfEdges = static_cast<std::int64_t>(edges.size());
#pragma omp parallel for schedule(static) reduction(&& : isConvex)
  for (std::int64_t i = 0; i < numberOfEdges; i += 2)
  {
    if (!isConvex)
    {
      continue;
    }
    const auto [a, b, c] = triangles[edges[i].Triangle];
    const std::int32_t apex = edges[i + 1].Apex;
    const int side = points.Orient(a, b, c, apex);
    isConvex = side <= 0;
    if (side == 0)
    {
      // In one plane, but not folded back.
      const int axis = points.FindProjection(a, b, c);
      const int side0 = points.OrientProjected(edges[i].From, edges[i].To, edges[i].Apex, axis);
      const int side1 = points.OrientProjected(edges[i].From, edges[i].To, apex, axis);
      isConvex = side0 * side1 < 0;
    }
  }
  return isConvex && CoversOnce(points, triangles);
}

} // namespace tetralux
