// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/HullTriangles.h"

#include "Base/DisjointSets.h"
#include "Geometry/TetrahedronFaces.h"

#include <algorithm>

namespace tetralux
{
namespace
{

using Edge = std::array<std::int32_t, 2>;

Edge MakeEdge(std::int32_t from, std::int32_t to)
{
  return { std::min(from, to), std::max(from, to) };
}

template <class T>
void SortUnique(std::vector<T>& items)
{
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

void AddEdges(const Triangle& triangle, std::vector<Edge>& edges)
{
  for (int i = 0; i < 3; ++i)
  {
    edges.push_back(MakeEdge(triangle[i], triangle[(i + 1) % 3]));
  }
}

/// Triangles of the hull that lie in one plane.
struct Plane
{
  std::vector<std::int32_t> Triangles;
  std::vector<Edge> BoundaryEdges; ///< those of the boundary that lie in it
};

/// All finite cells that have both ends of an edge.
void FindCellsAround(const BoundaryTriangulation& triangulation, std::int32_t firstCell,
  const Edge& edge, std::vector<std::int32_t>& cells)
{
  std::vector<std::int32_t> around = { firstCell };
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    const std::size_t cell = around[i];
    for (int j = 0; j < 4; ++j)
    {
      const std::int32_t point = triangulation.Cells[4 * cell + j];
      const std::int32_t neighbor = triangulation.Neighbors[4 * cell + j];
      if (point != edge[0] && point != edge[1] &&
        std::find(around.begin(), around.end(), neighbor) == around.end())
      {
        around.push_back(neighbor);
      }
    }
  }
  std::copy_if(around.begin(), around.end(), std::back_inserter(cells),
    [&](std::int32_t cell) { return !triangulation.IsInfinite(cell); });
}

} // namespace

//----------------------------------------------------------------------------
HullTriangles TriangulateHull(
  const BoundarySurface& surface, const BoundaryTriangulation& triangulation)
{
  const ExactPoints points(surface.Coordinates.data());
  const auto numberOfCells = static_cast<std::int32_t>(triangulation.GetNumberOfCells());

  // The triangulation's own hull.
  HullTriangles hull;
  std::vector<std::int32_t> infiniteCells;
  std::vector<std::int32_t> numbers(numberOfCells, -1);
  for (std::int32_t cell = 0; cell < numberOfCells; ++cell)
  {
    if (!triangulation.IsInfinite(cell))
    {
      continue;
    }
    const std::int32_t* corners = &triangulation.Cells[4 * static_cast<std::size_t>(cell)];
    const auto infinite =
      std::find(corners, corners + 4, BoundaryTriangulation::Infinite) - corners;
    const std::int32_t finiteCell =
      triangulation.Neighbors[4 * static_cast<std::size_t>(cell) + infinite];
    const std::int32_t* finite = &triangulation.Cells[4 * static_cast<std::size_t>(finiteCell)];
    const int* face = OutwardFaces[triangulation.FindFace(finiteCell, cell)];
    numbers[cell] = static_cast<std::int32_t>(hull.Triangles.size());
    hull.Triangles.push_back({ finite[face[0]], finite[face[2]], finite[face[1]] });
    hull.Cells.push_back(finiteCell);
    infiniteCells.push_back(cell);
  }
  hull.IsDelaunay.assign(hull.Triangles.size(), 1);

  // Planes of more than one triangle.
  DisjointSets sets(hull.Triangles.size());
  for (std::size_t h = 0; h < hull.Triangles.size(); ++h)
  {
    const std::size_t cell = infiniteCells[h];
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t neighbor = triangulation.Neighbors[4 * cell + i];
      if (triangulation.Cells[4 * cell + i] == BoundaryTriangulation::Infinite ||
        numbers[neighbor] < static_cast<std::int32_t>(h))
      {
        continue;
      }
      const std::int32_t apex = triangulation.Cells[4 * static_cast<std::size_t>(neighbor) +
        triangulation.FindFace(neighbor, static_cast<std::int32_t>(cell))];
      const auto [a, b, c] = hull.Triangles[h];
      if (points.Orient(a, b, c, apex) == 0)
      {
        sets.Unite(static_cast<std::int32_t>(h), numbers[neighbor]);
      }
    }
  }
  std::vector<Plane> planes(hull.Triangles.size()); // by the first triangle's number
  std::vector<Edge> planesOfPoints;                 // a point, and a plane that it is in
  for (std::size_t h = 0; h < hull.Triangles.size(); ++h)
  {
    planes[sets.Find(static_cast<std::int32_t>(h))].Triangles.push_back(
      static_cast<std::int32_t>(h));
  }
  for (std::size_t h = 0; h < hull.Triangles.size(); ++h)
  {
    const std::int32_t plane = sets.Find(static_cast<std::int32_t>(h));
    if (planes[plane].Triangles.size() > 1)
    {
      for (const std::int32_t point : hull.Triangles[h])
      {
        planesOfPoints.push_back({ point, plane });
      }
    }
  }
  if (planesOfPoints.empty())
  {
    return hull;
  }
  SortUnique(planesOfPoints);

  // The boundary's edges in them.
  std::vector<Edge> boundaryEdges;
  for (const Triangle& triangle : surface.Triangles)
  {
    AddEdges(triangle, boundaryEdges);
  }
  SortUnique(boundaryEdges);
  for (const Edge& edge : boundaryEdges)
  {
    auto at = std::lower_bound(planesOfPoints.begin(), planesOfPoints.end(), Edge{ edge[0], -1 });
    for (; at != planesOfPoints.end() && (*at)[0] == edge[0]; ++at)
    {
      const std::int32_t plane = (*at)[1];
      if (std::binary_search(planesOfPoints.begin(), planesOfPoints.end(), Edge{ edge[1], plane }))
      {
        planes[plane].BoundaryEdges.push_back(edge);
      }
    }
  }

  std::vector<std::uint8_t> isReplaced(hull.Triangles.size(), 0);
  std::vector<Triangle> replacements;
  std::vector<std::int32_t> replacementCells;
  for (const Plane& plane : planes)
  {
    if (plane.Triangles.size() < 2)
    {
      continue;
    }
    std::vector<Edge> delaunayEdges;
    std::vector<std::int32_t> ids;
    for (const std::int32_t h : plane.Triangles)
    {
      AddEdges(hull.Triangles[h], delaunayEdges);
      ids.insert(ids.end(), hull.Triangles[h].begin(), hull.Triangles[h].end());
    }
    SortUnique(delaunayEdges);
    if (std::includes(delaunayEdges.begin(), delaunayEdges.end(), plane.BoundaryEdges.begin(),
          plane.BoundaryEdges.end()))
    {
      continue;
    }

    SortUnique(ids);
    const auto [a, b, c] = hull.Triangles[plane.Triangles[0]];
    const int axis = points.FindProjection(a, b, c);
    std::vector<Triangle> triangles;
    if (!TriangulatePlane(points, ids, plane.BoundaryEdges, axis, triangles))
    {
      return {};
    }
    std::vector<Edge> edges;
    for (Triangle& triangle : triangles)
    {
      if (points.OrientProjected(a, b, c, axis) < 0)
      {
        std::swap(triangle[1], triangle[2]);
      }
      AddEdges(triangle, edges);
      replacements.push_back(triangle);
      replacementCells.push_back(hull.Cells[plane.Triangles[0]]);
    }
    SortUnique(edges);
    for (const std::int32_t h : plane.Triangles)
    {
      isReplaced[h] = 1;
      hull.JoinedCells.push_back({ hull.Cells[plane.Triangles[0]], hull.Cells[h] });
      std::vector<Edge> triangleEdges;
      AddEdges(hull.Triangles[h], triangleEdges);
      for (const Edge& edge : triangleEdges)
      {
        if (!std::binary_search(edges.begin(), edges.end(), edge))
        {
          FindCellsAround(triangulation, hull.Cells[h], edge, hull.LostCells);
        }
      }
    }
  }

  // A triangle may have come back as it was; its cell is then still behind it.
  HullTriangles result;
  result.LostCells = std::move(hull.LostCells);
  result.JoinedCells = std::move(hull.JoinedCells);
  std::vector<std::pair<Triangle, std::int32_t>> old;
  for (std::size_t h = 0; h < hull.Triangles.size(); ++h)
  {
    if (!isReplaced[h])
    {
      result.Triangles.push_back(hull.Triangles[h]);
      result.Cells.push_back(hull.Cells[h]);
      result.IsDelaunay.push_back(1);
      continue;
    }
    Triangle key = hull.Triangles[h];
    std::sort(key.begin(), key.end());
    old.emplace_back(key, hull.Cells[h]);
  }
  std::sort(old.begin(), old.end());
  for (std::size_t r = 0; r < replacements.size(); ++r)
  {
    Triangle key = replacements[r];
    std::sort(key.begin(), key.end());
    const auto at = std::lower_bound(old.begin(), old.end(), std::pair(key, -1));
    const bool isOld = at != old.end() && at->first == key;
    result.Triangles.push_back(replacements[r]);
    result.Cells.push_back(isOld ? at->second : replacementCells[r]);
    result.IsDelaunay.push_back(isOld);
  }
  return result;
}

} // namespace tetralux
