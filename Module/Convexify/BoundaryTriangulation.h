// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoundaryTriangulation_h
#define tetralux_BoundaryTriangulation_h

#include "Convexify/BoundarySurface.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A Delaunay triangulation as flat arrays. Beside its tetrahedra, of positive volume, it has an
/// infinite cell behind each triangle of the hull.
struct BoundaryTriangulation
{
  static constexpr std::int32_t Infinite = -1; ///< the point that infinite cells have

  std::vector<std::int32_t> Cells;      ///< four point ids for each cell
  std::vector<std::int32_t> Neighbors;  ///< the cells opposite to those points
  std::vector<std::int32_t> PointCells; ///< for each point a finite cell that has it

  std::int64_t GetNumberOfCells() const
  {
    return static_cast<std::int64_t>(this->Cells.size() / 4);
  }

  bool IsInfinite(std::int32_t cell) const
  {
    const std::int32_t* points = &this->Cells[4 * static_cast<std::size_t>(cell)];
    return points[0] < 0 || points[1] < 0 || points[2] < 0 || points[3] < 0;
  }

  /// Which of a cell's points is opposite to another cell.
  int FindFace(std::int32_t cell, std::int32_t neighbor) const
  {
    const std::int32_t* neighbors = &this->Neighbors[4 * static_cast<std::size_t>(cell)];
    return neighbors[0] == neighbor ? 0
      : neighbors[1] == neighbor    ? 1
      : neighbors[2] == neighbor    ? 2
                                    : 3;
  }
};

/// Delaunay triangulation of points, three coordinates each, no two at the same place. Has no cells
/// where all points are in one plane.
BoundaryTriangulation TriangulateDelaunay(const std::vector<double>& coordinates);

/// Triangulates the convex hull of points of one plane such that the edges, pairs of point ids, are
/// edges of it. ids: of the points; axis: a projection of the plane. Counterclockwise as seen by
/// ExactPoints::OrientProjected. Returns false where edges cross.
bool TriangulatePlane(const ExactPoints& points, const std::vector<std::int32_t>& ids,
  const std::vector<std::array<std::int32_t, 2>>& edges, int axis,
  std::vector<Triangle>& triangles);

} // namespace tetralux

#endif
