// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoundarySurface_h
#define tetralux_BoundarySurface_h

#include "Geometry/ExactOrientation.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/TetrahedralMesh.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tetralux
{

using Triangle = std::array<std::int32_t, 3>;

/// Why and where something can't be convexified; nothing where Reason is empty.
struct Obstacle
{
  std::string Reason;
  std::array<double, 3> Point = { 0, 0, 0 };
  std::array<std::int32_t, 2> Cells = { -1, -1 }; ///< of the mesh, -1 for none
};

/// Of an obstacle where cells are at the same place and have other points there.
constexpr const char* TouchingCellsReason = "cells touch without sharing points";

/// The boundary of a mesh as one oriented surface over points of its own.
struct BoundarySurface
{
  /// Coordinates of the points that the boundary uses, no two at the same place.
  std::vector<double> Coordinates;

  /// For each of them its id in the mesh, the smallest of those at the same place.
  std::vector<std::int32_t> PointIds;

  /// The empty space is on the positive side of each, as GetOrientation(triangle, point) sees
  /// it. Two boundary faces at the same place are none; nor is a face that has two of its
  /// corners at the same place.
  std::vector<Triangle> Triangles;

  /// For each triangle 4 * cell + face of the mesh.
  std::vector<std::int32_t> Faces;

  /// For each point of the mesh the smallest id of the boundary's points at the same place; -1 for
  /// one that no boundary face has.
  std::vector<std::int32_t> MergedIds;

  /// Two boundary faces at the same place, of different cells: a walk does not go on from one to
  /// the other, though the triangles tell nothing of it.
  Obstacle Contact;

  /// The triangles that have other ids in the mesh: a cell that is put on one of them shares no
  /// face with the mesh.
  std::vector<std::int32_t> Seams;

  /// Whether a cell is turned against the others of its part, to rounding: it overlaps with them.
  bool HasInvertedCells = false;

  std::int32_t GetNumberOfPoints() const
  {
    return static_cast<std::int32_t>(this->PointIds.size());
  }
};

/// Takes the boundary out of a mesh. Its orientation is the one that neighbouring cells agree on,
/// such that each connected part has a positive volume.
BoundarySurface FindBoundarySurface(
  const TetrahedralMesh& mesh, const FaceNeighbors& neighbors, Obstacle& obstacle);

/// Whether two points of a cell are at the same place. mergedIds: as of a BoundarySurface.
bool IsCollapsed(
  const TetrahedralMesh& mesh, const std::vector<std::int32_t>& mergedIds, std::int64_t cell);

/// Whether triangles are the whole boundary of a convex body, each point of it once, seen from
/// outside as BoundarySurface::Triangles are. Exact; linear time.
bool IsConvexSurface(const ExactPoints& points, const std::vector<Triangle>& triangles);

/// Finds two triangles of a surface that have more in common than corners and edges.
Obstacle FindSelfIntersection(const BoundarySurface& surface);

/// The volume on the negative side of a closed surface.
double MeasureEnclosedVolume(
  const std::vector<double>& coordinates, const std::vector<Triangle>& triangles);

} // namespace tetralux

#endif
