// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestGrid_h
#define TestGrid_h

#include "Mesh/TetrahedralMesh.h"

#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <vector>

/// A mesh as VTK's grid, with a point array, its active scalars.
vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  const tetralux::TetrahedralMesh& mesh, const std::vector<double>& scalars);

/// A field on a mesh's points, between -1 and 1, that bends everywhere. Its period grows with size,
/// in units of the mesh.
std::vector<double> MakeField(
  const tetralux::TetrahedralMesh& mesh, const std::array<double, 3>& lower, double size);

#endif
