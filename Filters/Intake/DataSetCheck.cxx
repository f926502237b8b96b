// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/DataSetCheck.h"

#include "Intake/StructuredLayout.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>

namespace tetralux
{

namespace
{

std::string FindDamage(vtkDataSet* dataSet, const StructuredLayout& layout)
{
  if (*std::min_element(layout.Dimensions, layout.Dimensions + 3) < 0)
  {
    return "an extent of its grid is no extent";
  }
  if (auto rectilinear = vtkRectilinearGrid::SafeDownCast(dataSet))
  {
    vtkDataArray* const coordinates[3] = { rectilinear->GetXCoordinates(),
      rectilinear->GetYCoordinates(), rectilinear->GetZCoordinates() };
    for (int axis = 0; axis < 3; ++axis)
    {
      const vtkIdType count = coordinates[axis] ? coordinates[axis]->GetNumberOfTuples() : 0;
      if (count < layout.Dimensions[axis])
      {
        return "its grid has " + std::to_string(layout.Dimensions[axis]) + " planes along " +
          std::string(1, "xyz"[axis]) + ", but " + std::to_string(count) + " coordinates there";
      }
    }
  }
  if (auto structured = vtkStructuredGrid::SafeDownCast(dataSet))
  {
    // Three extents of a damaged file may have a product beyond 64 bits.
    const double count = static_cast<double>(layout.Dimensions[0]) *
      static_cast<double>(layout.Dimensions[1]) * static_cast<double>(layout.Dimensions[2]);
    const vtkIdType points = structured->GetPoints() ? structured->GetNumberOfPoints() : 0;
    if (static_cast<double>(points) < count)
    {
      return "its grid of " + std::to_string(layout.Dimensions[0]) + " x " +
        std::to_string(layout.Dimensions[1]) + " x " + std::to_string(layout.Dimensions[2]) +
        " points has " + std::to_string(points) + " of them";
    }
  }
  return {};
}

/// Returns the first cell whose list of points is not within the array of them, or -1.
struct FindBadList
{
  template <class CellStateT>
  vtkIdType operator()(CellStateT& state) const
  {
    const vtkIdType end = state.GetConnectivity()->GetNumberOfValues();
    for (vtkIdType cell = 0; cell < state.GetNumberOfCells(); ++cell)
    {
      const vtkIdType first = state.GetBeginOffset(cell);
      const vtkIdType last = state.GetEndOffset(cell);
      if (first < 0 || last < first || end < last)
      {
        return cell;
      }
    }
    return -1;
  }
};

} // namespace

std::string FindDamage(vtkDataSet* dataSet)
{
  StructuredLayout layout;
  if (GetStructuredLayout(dataSet, layout))
  {
    return FindDamage(dataSet, layout);
  }
  if (auto grid = vtkUnstructuredGrid::SafeDownCast(dataSet))
  {
    const vtkIdType cells = grid->GetNumberOfCells();
    vtkUnsignedCharArray* types = grid->GetCellTypesArray();
    if (cells > 0 && (!types || types->GetNumberOfValues() < cells))
    {
      return "it has " + std::to_string(cells) + " cells, but types for " +
        std::to_string(types ? types->GetNumberOfValues() : 0) + " of them";
    }
  }
  return {};
}

std::string FindDamageOfCells(vtkUnstructuredGrid* grid)
{
  std::string damage = FindDamage(grid);
  if (damage.empty() && grid->GetNumberOfCells() > 0)
  {
    const vtkIdType cell = grid->GetCells()->Visit(FindBadList());
    if (cell >= 0)
    {
      damage = "the points of its cell " + std::to_string(cell) + " are not in its array of them";
    }
  }
  return damage;
}

} // namespace tetralux
