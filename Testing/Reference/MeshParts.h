// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshParts_h
#define tetralux_MeshParts_h

#include "Mesh/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Appends the points and the cells of another mesh. Points at the same place stay apart.
void AddMesh(TetrahedralMesh& mesh, const TetrahedralMesh& other);

/// The same cells, but the cells of each part have points of their own, as the pieces of a file
/// do. partOfCell: a number for each cell; cells of one number are a part. OriginalPoints has the
/// points of the given mesh.
TetrahedralMesh SeparateParts(
  const TetrahedralMesh& mesh, const std::vector<std::int64_t>& partOfCell);

/// The same with each cell as a part.
TetrahedralMesh SeparateCells(const TetrahedralMesh& mesh);

} // namespace tetralux

#endif
