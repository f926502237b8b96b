// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/StructuredLayout.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace tetralux
{

bool StructuredLayout::IsThreeDimensional() const
{
  return *std::min_element(this->Dimensions, this->Dimensions + 3) > 1;
}

int StructuredLayout::GetParity(int i, int j, int k) const
{
  return (i + this->Extent[0] + j + this->Extent[2] + k + this->Extent[4]) & 1;
}

int StructuredLayout::GetParityOfPoint(std::int64_t point) const
{
  const std::int64_t row = point / this->Dimensions[0];
  return this->GetParity(static_cast<int>(point % this->Dimensions[0]),
    static_cast<int>(row % this->Dimensions[1]), static_cast<int>(row / this->Dimensions[1]));
}

bool GetStructuredLayout(vtkDataSet* dataSet, StructuredLayout& layout)
{
  if (auto image = vtkImageData::SafeDownCast(dataSet))
  {
    image->GetDimensions(layout.Dimensions);
    image->GetExtent(layout.Extent);
    layout.CellType = VTK_VOXEL;
    return true;
  }
  if (auto rectilinear = vtkRectilinearGrid::SafeDownCast(dataSet))
  {
    rectilinear->GetDimensions(layout.Dimensions);
    rectilinear->GetExtent(layout.Extent);
    layout.CellType = VTK_VOXEL;
    return true;
  }
  if (auto structured = vtkStructuredGrid::SafeDownCast(dataSet))
  {
    structured->GetDimensions(layout.Dimensions);
    structured->GetExtent(layout.Extent);
    layout.CellType = VTK_HEXAHEDRON;
    return true;
  }
  return false;
}

std::int64_t CountStructuredTetrahedra(vtkDataSet* dataSet)
{
  StructuredLayout layout;
  if (!GetStructuredLayout(dataSet, layout) || dataSet->GetCellGhostArray() ||
    dataSet->GetPointGhostArray() || !layout.IsThreeDimensional())
  {
    return 0;
  }
  return 5 * dataSet->GetNumberOfCells();
}

} // namespace tetralux
