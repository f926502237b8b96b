// SPDX-License-Identifier: BSD-3-Clause
#ifndef GeneratedGrid_h
#define GeneratedGrid_h

#include "vtkSmartPointer.h"

class vtkUnstructuredGrid;
namespace tetralux
{
struct GeneratedMesh;
}

/// A generated mesh as a grid, with its scalars as the active point array "Field".
vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(const tetralux::GeneratedMesh& generated);

#endif
