// SPDX-License-Identifier: BSD-3-Clause
#ifndef GeneratedGrid_h
#define GeneratedGrid_h

#include "vtkSmartPointer.h"

class vtkUnstructuredGrid;
namespace tetralux
{
struct GeneratedMesh;
}

/// Makes a grid of a generated mesh. Its scalars are the active point array "Field".
vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(const tetralux::GeneratedMesh& generated);

#endif
