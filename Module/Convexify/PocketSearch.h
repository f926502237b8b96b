// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PocketSearch_h
#define tetralux_PocketSearch_h

#include "Convexify/PocketFront.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

using Cell = std::array<std::int32_t, 4>;

/// Cells of positive volume whose faces cancel but for the front fill the pocket, each point of it
/// once: what they cover has the front as its boundary.
///
/// Joins a point of the front to all triangles that don't have it. Returns false where none sees
/// them all.
bool FillFromPoint(const ExactPoints& points, const Front& front, std::vector<Cell>& cells);

/// Searches, depth first, for cells over the front's own points. Returns false where there are none
/// or more than maximumSteps cells were tried.
bool SearchCells(
  const ExactPoints& points, const Front& front, int maximumSteps, std::vector<Cell>& cells);

/// The points of a front, ascending.
std::vector<std::int32_t> GetFrontPoints(const Front& front);

/// Orders apexes for cells over a triangle: the offset of the circumscribed sphere's centre along
/// the triangle's normal, which is the smallest for Delaunay's choice. Rounded.
class DelaunayOrder
{
public:
  DelaunayOrder(const ExactPoints& points, const Triangle& triangle);
  double operator()(std::int32_t apex) const;

private:
  const ExactPoints& Points;
  double Origin[3];
  double Normal[3];
  double Center[3]; ///< from Origin
  double SquaredRadius;
};

/// Whether a new cell of positive volume fits in front of a triangle: they meet properly, or the
/// triangle is a face of the cell and faces it.
bool CellFitsTriangle(const ExactPoints& points, const Cell& cell, const Triangle& triangle);

} // namespace tetralux

#endif
