// SPDX-License-Identifier: BSD-3-Clause
#include "TestGrid.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  const tetralux::TetrahedralMesh& mesh, const std::vector<double>& scalars)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> array;
  array->SetName("Field");
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    points->InsertNextPoint(&mesh.Points[3 * p]);
    array->InsertNextValue(scalars[p]);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(array);
  grid->AllocateExact(mesh.GetNumberOfCells(), mesh.Cells.size());
  for (std::size_t cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    vtkIdType ids[4];
    std::copy_n(&mesh.Cells[4 * cell], 4, ids);
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  return grid;
}

std::vector<double> MakeField(
  const tetralux::TetrahedralMesh& mesh, const std::array<double, 3>& lower, double size)
{
  std::vector<double> field;
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    const double x = (mesh.Points[3 * p] - lower[0]) / size;
    const double y = (mesh.Points[3 * p + 1] - lower[1]) / size;
    const double z = (mesh.Points[3 * p + 2] - lower[2]) / size;
    field.push_back(std::sin(5 * x + 2 * y) * std::cos(4 * y - 3 * z));
  }
  return field;
}
