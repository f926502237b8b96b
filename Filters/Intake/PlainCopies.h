// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PlainCopies_h
#define tetralux_PlainCopies_h

#include <cstdint>

class vtkDataSet;
class vtkUnstructuredGrid;

namespace tetralux
{

/// What the intake takes over as it is.

/// Copies the coordinates of all points, three each.
void CopyPoints(vtkDataSet* dataSet, double* out);

/// Copies the ids of a grid that has tetrahedra only, one after the other, four each; false where a
/// cell is anything else or names a point that does not exist.
bool CopyTetrahedra(vtkUnstructuredGrid* grid, std::int32_t* out);

} // namespace tetralux

#endif
