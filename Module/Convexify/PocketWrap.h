// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PocketWrap_h
#define tetralux_PocketWrap_h

#include "Convexify/BoundaryTriangulation.h"
#include "Convexify/PocketSearch.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// The neighbours of each point along edges of the Delaunay triangulation: the apex of a new cell
/// is looked for among them.
class PointNeighbors
{
public:
  explicit PointNeighbors(const BoundaryTriangulation& triangulation);

  /// Calls visit(point) for each neighbour; points that came later have none.
  template <class Visit>
  void ForEach(std::int32_t point, const Visit& visit) const
  {
    if (point + 1 < static_cast<std::int32_t>(this->Begin.size()))
    {
      for (std::int64_t i = this->Begin[point]; i < this->Begin[point + 1]; ++i)
      {
        visit(this->Points[i]);
      }
    }
  }

private:
  std::vector<std::int64_t> Begin;
  std::vector<std::int32_t> Points;
};

/// Which of the cells that fit in front of a triangle is taken.
enum class WrapOrder
{
  Delaunay, ///< the most Delaunay-like one
  Closing   ///< one with most of its faces in the front, of these the most Delaunay-like one
};

/// Fills a pocket from its front inwards by constrained gift wrapping. Returns the triangles around
/// what could not be filled.
Front WrapFront(const ExactPoints& points, const PointNeighbors& neighbors, const Front& front,
  WrapOrder order, std::vector<Cell>& cells);

} // namespace tetralux

#endif
