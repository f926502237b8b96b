// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ConvexFaces_h
#define tetralux_ConvexFaces_h

#include <cstdint>
#include <vector>

namespace tetralux
{

/// The surface of the convex hull of a cell's points.
struct ConvexFaces
{
  /// Convex polygons of point ids, seen counter-clockwise from outside. All points of a plane are
  /// in one polygon, so that the cell on the other side finds the same one.
  std::vector<std::vector<std::int64_t>> Polygons;

  /// The ids that are no corner of a polygon: inside of the cell, of a face or of an edge.
  std::vector<std::int64_t> Others;
};

/// Finds the faces of a few points, given by their ids. Ids and positions that are there twice
/// count once. points: coordinates by point id. Returns false where the points enclose no volume.
/// Time grows with the cube of the number of ids, and with its fourth power if most are in one
/// plane: meant for the tens of points that cells have.
bool FindConvexFaces(
  const std::vector<std::int64_t>& ids, const double* points, ConvexFaces& faces);

} // namespace tetralux

#endif
