// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellSplit_h
#define tetralux_CellSplit_h

#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

/// Splits of the linear cells of VTK into tetrahedra, without new points, so that two cells which
/// share a quadrilateral split it along the same diagonal: the one that starts at the face's
/// smallest point id (Dompierre et al., How to Subdivide Pyramids, Prisms and Hexahedra into
/// Tetrahedra, 1999). Points in VTK's order of the cell type. A split of a positively oriented
/// convex cell has positively oriented tetrahedra; a wedge is positively oriented when the normal
/// of its first three points points away from the others, as vtkWedge documents it.
///
/// tets receives four ids for each tetrahedron; returns how many tetrahedra there are.
///@{
TETRALUXCORE_EXPORT int SplitPyramid(const std::int64_t ids[5], std::int64_t tets[2 * 4]);
TETRALUXCORE_EXPORT int SplitWedge(const std::int64_t ids[6], std::int64_t tets[3 * 4]);
TETRALUXCORE_EXPORT int SplitHexahedron(const std::int64_t ids[8], std::int64_t tets[6 * 4]);
///@}

/// The split of a hexahedron of a structured grid into five tetrahedra; neighbours along any axis
/// have the other parity (odd: i + j + k is odd) and so the same diagonals on the shared face.
TETRALUXCORE_EXPORT int SplitStructuredHexahedron(
  const std::int64_t ids[8], bool odd, std::int64_t tets[5 * 4]);

} // namespace tetralux

#endif
