// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GridTetrahedra_h
#define tetralux_GridTetrahedra_h

#include "Mesh/TetrahedralMesh.h"

#include <string>

class vtkUnstructuredGrid;

namespace tetralux
{

/// Takes the tetrahedra of a grid, all points and in OriginalCells the grid's ids. Cells of lower
/// dimension and blanked cells (vtkGhostType HIDDENCELL, REFINEDCELL or a HIDDENPOINT corner) are
/// left out; a tetrahedron with a point id that does not exist has -1 there.
/// Returns why the grid is refused, in one line, or nothing: other three-dimensional cells, more
/// than 2^31 - 1 points or 2^29 - 1 cells.
std::string ReadTetrahedra(vtkUnstructuredGrid* grid, TetrahedralMesh& mesh);

} // namespace tetralux

#endif
