// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshParts_h
#define tetralux_MeshParts_h

#include "Mesh/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Appends the points and the cells of another mesh. Points at the same place stay apart. All are
/// those of an input of its own: there are no OriginalPoints and OriginalCells.
void AddMesh(TetrahedralMesh& mesh, const TetrahedralMesh& other);

/// The same cells, but the cells of each part have points of their own, as the pieces of a file
/// do. partOfCell: a number for each cell; cells of one number are a part. OriginalPoints has the
/// points of the given mesh.
TetrahedralMesh SeparateParts(
  const TetrahedralMesh& mesh, const std::vector<std::int64_t>& partOfCell);

/// The same with each cell as a part.
TetrahedralMesh SeparateCells(const TetrahedralMesh& mesh);

/// A unit cube of cubes, each split into six tetrahedra around its diagonal, that share the points
/// at their corners. Cubes down to an edge of 2^-depth are split into eight at random, half of
/// them, next to what is not: larger ones meet any number of smaller ones at a face.
TetrahedralMesh MakeOctree(int depth, std::uint64_t seed);

/// A cube of edge 0.5 beside eight of half its edge, from the origin to (1, 0.5, 0.5): the smallest
/// mesh with hanging nodes. Points and tetrahedra as in MakeOctree.
TetrahedralMesh MakeNineCubes();

} // namespace tetralux

#endif
