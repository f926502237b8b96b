// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/GridTetrahedra.h"

#include "Intake/DataSetCheck.h"
#include "Intake/IntakeReport.h"
#include "Mesh/MeshLimits.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace tetralux
{
namespace
{

/// Three for a type that VTK does not know, too: who knows what it fills.
int GetCellDimension(int cellType)
{
  auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(cellType));
  return cell ? cell->GetCellDimension() : 3;
}

bool HasMark(vtkUnsignedCharArray* marks, vtkIdType id, int bits)
{
  return marks && id < marks->GetNumberOfValues() && (marks->GetValue(id) & bits) != 0;
}

} // namespace

//----------------------------------------------------------------------------
std::string ReadTetrahedra(vtkUnstructuredGrid* grid, TetrahedralMesh& mesh)
{
  const vtkIdType numberOfPoints = grid->GetNumberOfPoints();
  const vtkIdType numberOfCells = grid->GetNumberOfCells();
  if (numberOfPoints > MaximumPoints || numberOfCells > MaximumCells)
  {
    return "the input has " + std::to_string(numberOfPoints) + " points and " +
      std::to_string(numberOfCells) + " cells; at most " + std::to_string(MaximumPoints) + " and " +
      std::to_string(MaximumCells) + " are possible";
  }
  const std::string damage = FindDamageOfCells(grid);
  if (!damage.empty())
  {
    return "the input is damaged: " + damage;
  }
  mesh.Points.resize(3 * static_cast<std::size_t>(numberOfPoints));
  for (vtkIdType i = 0; i < numberOfPoints; ++i)
  {
    grid->GetPoints()->GetPoint(i, &mesh.Points[3 * static_cast<std::size_t>(i)]);
  }

  vtkUnsignedCharArray* cellMarks = grid->GetCellGhostArray();
  vtkUnsignedCharArray* pointMarks = grid->GetPointGhostArray();
  int lowerDimensionalType = VTK_EMPTY_CELL; // the last one seen: they mostly come in a row
  for (vtkIdType cell = 0; cell < numberOfCells; ++cell)
  {
    const int type = grid->GetCellType(cell);
    if (type != VTK_TETRA)
    {
      if (type != lowerDimensionalType && GetCellDimension(type) == 3)
      {
        return "cell " + std::to_string(cell) + " is a " + GetCellTypeName(type) +
          ", not a vtkTetra; vtkTetrahedralizeCells makes tetrahedra of it";
      }
      lowerDimensionalType = type;
      continue;
    }
    vtkIdType size;
    const vtkIdType* ids;
    grid->GetCells()->GetCellAtId(cell, size, ids);
    std::array<std::int32_t, 4> points = { -1, -1, -1, -1 };
    bool isBlanked = HasMark(
      cellMarks, cell, vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL);
    for (vtkIdType i = 0; i < std::min<vtkIdType>(size, 4); ++i)
    {
      if (ids[i] >= 0 && ids[i] < numberOfPoints)
      {
        points[i] = static_cast<std::int32_t>(ids[i]);
        isBlanked = isBlanked || HasMark(pointMarks, ids[i], vtkDataSetAttributes::HIDDENPOINT);
      }
    }
    if (!isBlanked)
    {
      mesh.Cells.insert(mesh.Cells.end(), points.begin(), points.end());
      mesh.OriginalCells.push_back(static_cast<std::int32_t>(cell));
    }
  }
  return {};
}

} // namespace tetralux
