// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/BoundaryTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <unordered_map>

namespace tetralux
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

//----------------------------------------------------------------------------
BoundaryTriangulation TriangulateDelaunay(const std::vector<double>& coordinates)
{
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
  using Cell = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel,
    CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
  using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;

  std::vector<std::pair<Kernel::Point_3, std::int32_t>> points;
  points.reserve(coordinates.size() / 3);
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
  {
    points.emplace_back(Kernel::Point_3(coordinates[i], coordinates[i + 1], coordinates[i + 2]),
      static_cast<std::int32_t>(i / 3));
  }
  const Delaunay delaunay(points.begin(), points.end());
  BoundaryTriangulation result;
  if (delaunay.dimension() < 3)
  {
    return result;
  }

  delaunay.infinite_vertex()->info() = BoundaryTriangulation::Infinite;
  std::int32_t numberOfCells = 0;
  for (const auto cell : delaunay.all_cell_handles())
  {
    cell->info() = numberOfCells++;
  }
  result.Cells.resize(4 * static_cast<std::size_t>(numberOfCells));
  result.Neighbors.resize(4 * static_cast<std::size_t>(numberOfCells));
  result.PointCells.resize(coordinates.size() / 3);
  for (const auto cell : delaunay.all_cell_handles())
  {
    const bool isFinite = !delaunay.is_infinite(cell);
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t point = cell->vertex(i)->info();
      result.Cells[4 * static_cast<std::size_t>(cell->info()) + i] = point;
      result.Neighbors[4 * static_cast<std::size_t>(cell->info()) + i] = cell->neighbor(i)->info();
      if (isFinite)
      {
        result.PointCells[point] = cell->info();
      }
    }
  }
  return result;
}

//----------------------------------------------------------------------------
bool TriangulatePlane(const ExactPoints& points, const std::vector<std::int32_t>& ids,
  const std::vector<std::array<std::int32_t, 2>>& edges, int axis, std::vector<Triangle>& triangles)
{
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
  using Plane = CGAL::Constrained_Delaunay_triangulation_2<Kernel,
    CGAL::Triangulation_data_structure_2<Vertex, Face>, CGAL::No_constraint_intersection_tag>;

  const int x = axis == 0 ? 1 : 0;
  const int y = axis == 2 ? 1 : 2;
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> places;
  places.reserve(ids.size());
  for (const std::int32_t id : ids)
  {
    places.emplace_back(Kernel::Point_2(points[id][x], points[id][y]), id);
  }
  Plane plane;
  plane.insert(places.begin(), places.end());
  std::unordered_map<std::int32_t, Plane::Vertex_handle> vertices;
  for (const auto vertex : plane.finite_vertex_handles())
  {
    vertices[vertex->info()] = vertex;
  }
  try
  {
    for (const auto& edge : edges)
    {
      plane.insert_constraint(vertices.at(edge[0]), vertices.at(edge[1]));
    }
  }
  catch (const Plane::Intersection_of_constraints_exception&)
  {
    return false;
  }
  for (const auto face : plane.finite_face_handles())
  {
    triangles.push_back(
      { face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info() });
  }
  return true;
}

} // namespace tetralux
