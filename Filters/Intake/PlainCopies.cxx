// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/PlainCopies.h"

#include "Intake/IntakeChunk.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArrayRange.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <atomic>

namespace tetralux
{

namespace
{

/// Copies the coordinates of a point array of any type.
struct CopyCoordinates
{
  template <class ArrayT>
  void operator()(ArrayT* array, double* out) const
  {
    const auto values = vtk::DataArrayValueRange<3>(array);
    vtkSMPTools::For(0, values.size(), 3 * ChunkSize,
      [&](vtkIdType begin, vtkIdType end)
      { std::copy(values.begin() + begin, values.begin() + end, out + begin); });
  }
};

struct CopyTetrahedronIds
{
  template <class CellStateT>
  bool operator()(CellStateT& state, vtkUnstructuredGrid* grid, std::int32_t* out) const
  {
    using ValueType = typename CellStateT::ValueType;
    const vtkIdType numberOfCells = state.GetNumberOfCells();
    const auto numberOfPoints = static_cast<ValueType>(grid->GetNumberOfPoints());
    const auto types = vtk::DataArrayValueRange<1>(grid->GetCellTypesArray());
    const auto offsets = vtk::DataArrayValueRange<1>(state.GetOffsets());
    const auto ids = vtk::DataArrayValueRange<1>(state.GetConnectivity());
    std::atomic<bool> regular{ ids.size() == 4 * numberOfCells };
    vtkSMPTools::For(0, numberOfCells, ChunkSize,
      [&](vtkIdType begin, vtkIdType end)
      {
        if (!regular)
        {
          return;
        }
        bool good = true;
        for (vtkIdType cellId = begin; cellId < end; ++cellId)
        {
          good &=
            types[cellId] == VTK_TETRA && offsets[cellId] == static_cast<ValueType>(4 * cellId);
        }
        for (vtkIdType i = 4 * begin; i < 4 * end; ++i)
        {
          const ValueType id = ids[i];
          good &= 0 <= id && id < numberOfPoints;
          out[i] = static_cast<std::int32_t>(id);
        }
        if (!good)
        {
          regular = false;
        }
      });
    return regular;
  }
};

} // namespace

void CopyPoints(vtkDataSet* dataSet, double* out)
{
  const vtkIdType numberOfPoints = dataSet->GetNumberOfPoints();
  if (numberOfPoints == 0)
  {
    return;
  }
  if (auto pointSet = vtkPointSet::SafeDownCast(dataSet))
  {
    vtkDataArray* array = pointSet->GetPoints()->GetData();
    CopyCoordinates worker;
    if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>::Execute(
          array, worker, out))
    {
      worker(array, out);
    }
    return;
  }
  double x[3];
  dataSet->GetPoint(0, x); // lets image data prepare its transform before threads ask
  vtkSMPTools::For(0, numberOfPoints, ChunkSize,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        dataSet->GetPoint(point, out + 3 * point);
      }
    });
}

bool CopyTetrahedra(vtkUnstructuredGrid* grid, std::int32_t* out)
{
  return grid->GetCells()->Visit(CopyTetrahedronIds{}, grid, out);
}

} // namespace tetralux
