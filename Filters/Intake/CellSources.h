// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellSources_h
#define tetralux_CellSources_h

#include "Intake/StructuredLayout.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Where the intake has cells from. All sources have the same functions; those with IsParallel may
/// be asked by several threads at once.

/// A cell as a source hands it out.
struct SourceCell
{
  int Type = VTK_EMPTY_CELL;

  /// Ids within the block.
  std::vector<std::int64_t> Points;

  /// 0 or 1 in a cell of a structured grid with its points in the order of a hexahedron: whether
  /// i + j + k is odd; else -1.
  int Parity = -1;
};

/// Cells of a vtkUnstructuredGrid, read straight from its arrays.
template <class CellStateT>
class UnstructuredSource
{
public:
  static constexpr bool IsParallel = true;

  UnstructuredSource(vtkUnstructuredGrid* grid, CellStateT& state)
    : Grid(grid)
    , State(state)
    , Types(grid->GetCellTypesArray())
  {
  }

  void GetCell(vtkIdType cellId, SourceCell& cell) const
  {
    cell.Type = this->Types->GetValue(cellId);
    cell.Points.clear();
    const vtkIdType begin = this->State.GetBeginOffset(cellId);
    const vtkIdType end = this->State.GetEndOffset(cellId);
    auto* connectivity = this->State.GetConnectivity();
    if (0 <= begin && begin <= end && end <= connectivity->GetNumberOfValues())
    {
      const auto ids = vtk::DataArrayValueRange<1>(connectivity, begin, end);
      cell.Points.assign(ids.begin(), ids.end());
    }
  }

  /// Hands the faces of a polyhedron to addFace(ids, size).
  template <class AddFaceT>
  void GetFaces(vtkIdType cellId, AddFaceT&& addFace) const
  {
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
    vtkCellArray* faces = this->Grid->GetPolyhedronFaces();
    vtkCellArray* locations = this->Grid->GetPolyhedronFaceLocations();
    if (!faces || !locations || cellId >= locations->GetNumberOfCells())
    {
      return;
    }
    vtkNew<vtkIdList> ofCell, points;
    locations->GetCellAtId(cellId, ofCell);
    for (vtkIdType i = 0; i < ofCell->GetNumberOfIds(); ++i)
    {
      const vtkIdType face = ofCell->GetId(i);
      if (face < 0 || face >= faces->GetNumberOfCells())
      {
        return;
      }
      faces->GetCellAtId(face, points);
      addFace(points->GetPointer(0), points->GetNumberOfIds());
    }
#else
    // VTK's own functions take for granted that these arrays are whole.
    vtkIdTypeArray* locations = this->Grid->GetFaceLocations();
    vtkIdTypeArray* stream = this->Grid->GetFaces(); // number of faces, then size and ids of each
    const vtkIdType end = stream ? stream->GetNumberOfValues() : 0;
    vtkIdType next =
      locations && cellId < locations->GetNumberOfValues() ? locations->GetValue(cellId) : -1;
    vtkIdType faces = 0 <= next && next < end ? stream->GetValue(next++) : 0;
    for (; faces > 0 && next < end; --faces)
    {
      const vtkIdType size = stream->GetValue(next++);
      if (size < 0 || size > end - next)
      {
        return;
      }
      addFace(stream->GetPointer(next), size);
      next += size;
    }
#endif
  }

private:
  vtkUnstructuredGrid* Grid;
  CellStateT& State;
  vtkUnsignedCharArray* Types;
};

/// Cells of any data set through its virtual functions, which need not be thread-safe.
class DataSetSource
{
public:
  static constexpr bool IsParallel = false;

  explicit DataSetSource(vtkDataSet* dataSet)
    : DataSet(dataSet)
  {
  }

  void GetCell(vtkIdType cellId, SourceCell& cell) const
  {
    cell.Type = this->DataSet->GetCellType(cellId);
    this->DataSet->GetCellPoints(cellId, this->Ids);
    cell.Points.assign(this->Ids->begin(), this->Ids->end());
  }

  template <class AddFaceT>
  void GetFaces(vtkIdType cellId, AddFaceT&& addFace) const
  {
    vtkCell* cell = this->DataSet->GetCell(cellId);
    for (int i = 0; i < cell->GetNumberOfFaces(); ++i)
    {
      vtkIdList* ids = cell->GetFace(i)->GetPointIds();
      addFace(ids->GetPointer(0), ids->GetNumberOfIds());
    }
  }

private:
  vtkDataSet* DataSet;
  vtkNew<vtkIdList> Ids;
};

/// Cells of a three-dimensional structured grid.
class StructuredSource
{
public:
  static constexpr bool IsParallel = true;

  explicit StructuredSource(const StructuredLayout& layout)
    : Layout(layout)
  {
  }

  void GetCell(vtkIdType cellId, SourceCell& cell) const
  {
    const std::int64_t pointsX = this->Layout.Dimensions[0];
    const std::int64_t pointsXY = pointsX * this->Layout.Dimensions[1];
    const std::int64_t cellsX = pointsX - 1;
    const std::int64_t cellsY = this->Layout.Dimensions[1] - 1;
    const std::int64_t i = cellId % cellsX;
    const std::int64_t j = cellId / cellsX % cellsY;
    const std::int64_t k = cellId / (cellsX * cellsY);
    const std::int64_t p = i + pointsX * j + pointsXY * k;
    const std::int64_t q = p + pointsXY;
    cell.Type = this->Layout.CellType;
    cell.Points = { p, p + 1, p + 1 + pointsX, p + pointsX, q, q + 1, q + 1 + pointsX,
      q + pointsX };
    cell.Parity =
      this->Layout.GetParity(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
  }

  template <class AddFaceT>
  void GetFaces(vtkIdType, AddFaceT&&) const
  {
  }

private:
  StructuredLayout Layout;
};

} // namespace tetralux

#endif
