// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SteinerPoint_h
#define tetralux_SteinerPoint_h

#include "Convexify/PocketSearch.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// A point inside a pocket and the triangles of the front that it sees completely: cells from them
/// to the point fit into the pocket together.
struct SteinerPoint
{
  std::array<double, 3> Position;
  std::vector<std::int32_t> VisibleTriangles;
};

/// Finds a point that sees the whole front where there is one, else one that sees many of its
/// triangles. Returns false where none was found that sees any.
bool FindSteinerPoint(const ExactPoints& points, const Front& front, SteinerPoint& steiner);

} // namespace tetralux

#endif
