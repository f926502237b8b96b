// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GeneratedGrid.h"

#include "Generate/GeneratedMeshes.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(const tetralux::GeneratedMesh& generated)
{
  const tetralux::TetrahedralMesh& mesh = generated.Mesh;
  const auto numberOfPoints = static_cast<vtkIdType>(mesh.GetNumberOfPoints());
  const auto numberOfCells = static_cast<vtkIdType>(mesh.GetNumberOfCells());

  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(numberOfPoints);
  std::copy(mesh.Points.begin(), mesh.Points.end(), coordinates->GetPointer(0));
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);

  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(4 * numberOfCells);
  std::copy(mesh.Cells.begin(), mesh.Cells.end(), connectivity->GetPointer(0));
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(numberOfCells + 1);
  for (vtkIdType i = 0; i <= numberOfCells; ++i)
  {
    offsets->SetValue(i, static_cast<vtkTypeInt32>(4 * i));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);

  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("Field");
  scalars->SetNumberOfValues(numberOfPoints);
  std::copy(generated.Scalars.begin(), generated.Scalars.end(), scalars->GetPointer(0));

  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, cells);
  grid->GetPointData()->SetScalars(scalars);
  return grid;
}
