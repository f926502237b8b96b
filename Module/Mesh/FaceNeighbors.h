// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FaceNeighbors_h
#define tetralux_FaceNeighbors_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Which cell lies behind each face (Weiler et al. 2003, section 3.2: a_{t,i} and f_{t,i}).
/// Face i of a tetrahedron is the one opposite to its point i.
struct FaceNeighbors
{
  /// Four for each cell: the cell behind face i, or ~b (that is -1 - b) where face i is boundary
  /// face b.
  std::vector<std::int32_t> Neighbors;

  /// Four for each cell: the face of that neighbour which is this face; 0 on the boundary.
  std::vector<std::uint8_t> NeighborFaces;

  /// 4 * cell + face for each boundary face, ascending.
  std::vector<std::int32_t> BoundaryFaces;

  /// Faces that three or more cells share; each of those cells sees the face as a boundary face,
  /// so that a walk is always a path from one boundary face to another.
  std::int64_t NumberOfNonManifoldFaces = 0;

  /// Parts connected through faces.
  std::int64_t NumberOfComponents = 0;
};

/// Matches faces by their three point ids. cells: four point ids for each tetrahedron, all
/// different, each below numberOfPoints. Linear time, parallel, the same result for any number of
/// threads.
TETRALUXCORE_EXPORT FaceNeighbors FindFaceNeighbors(
  Span<const std::int32_t> cells, std::size_t numberOfPoints);

} // namespace tetralux

#endif
