// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/InputSignature.h"

#include "vtkContourValues.h"

#include "vtkAbstractArray.h"
#include "vtkAbstractMapper.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <vector>

namespace tetralux
{
namespace
{

void Add(CacheKey& key, vtkObject* object)
{
  key.Add(object);
  key.Add(object ? object->GetMTime() : 0);
}

template <class Number>
void Add(CacheKey& key, const Number* numbers, int count)
{
  std::for_each(numbers, numbers + count, [&key](Number number) { key.Add(number); });
}

void AddPoints(CacheKey& key, vtkPoints* points)
{
  Add(key, points ? points->GetData() : nullptr);
  key.Add(points ? points->GetMTime() : 0);
}

/// What says which faces polyhedra have; some or all may be nullptr.
std::vector<vtkDataArray*> GetFaceArrays(vtkUnstructuredGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  std::vector<vtkDataArray*> arrays;
  for (vtkCellArray* cells : { grid->GetPolyhedronFaces(), grid->GetPolyhedronFaceLocations() })
  {
    arrays.push_back(cells ? cells->GetConnectivityArray() : nullptr);
    arrays.push_back(cells ? cells->GetOffsetsArray() : nullptr);
  }
  return arrays;
#else
  return { grid->GetFaces(), grid->GetFaceLocations() };
#endif
}

void AddCells(CacheKey& key, vtkDataSet* dataSet)
{
  key.Add(dataSet->GetDataObjectType());
  key.Add(dataSet->GetNumberOfPoints());
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(dataSet))
  {
    vtkCellArray* cells = grid->GetCells();
    Add(key, cells ? cells->GetConnectivityArray() : nullptr);
    Add(key, cells ? cells->GetOffsetsArray() : nullptr);
    key.Add(cells ? cells->GetMTime() : 0);
    Add(key, grid->GetCellTypesArray());
    for (vtkDataArray* array : GetFaceArrays(grid))
    {
      Add(key, array);
    }
    // Without them, Bezier cells of order 1 are linear.
    key.Add(grid->GetPointData()->GetRationalWeights() != nullptr);
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(dataSet))
  {
    Add(key, structured->GetExtent(), 6);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(dataSet))
  {
    Add(key, rectilinear->GetExtent(), 6);
  }
  else if (auto* image = vtkImageData::SafeDownCast(dataSet))
  {
    Add(key, image->GetExtent(), 6);
  }
  else
  {
    Add(key, dataSet);
  }
  const char* ghosts = vtkDataSetAttributes::GhostArrayName();
  Add(key, dataSet->GetPointData()->GetArray(ghosts));
  Add(key, dataSet->GetCellData()->GetArray(ghosts));
}

void Add(Digester& digester, vtkDataArray* array)
{
  digester.Add(static_cast<std::uint64_t>(array ? array->GetDataType() : 0));
  if (!array)
  {
    return;
  }
  const auto values = static_cast<std::size_t>(array->GetNumberOfValues());
  if (array->HasStandardMemoryLayout())
  {
    digester.Add(array->GetVoidPointer(0), values * array->GetDataTypeSize());
    return;
  }
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      const double value = array->GetComponent(i, c);
      digester.Add(&value, sizeof(value));
    }
  }
}

void AddGhosts(Digester& digester, vtkDataSet* dataSet)
{
  const char* ghosts = vtkDataSetAttributes::GhostArrayName();
  Add(digester, dataSet->GetPointData()->GetArray(ghosts));
  Add(digester, dataSet->GetCellData()->GetArray(ghosts));
}

/// When an object was modified, whatever it holds.
vtkMTimeType GetOwnTime(vtkObject* object)
{
  return object->vtkObject::GetMTime(); // NOLINT(bugprone-parent-virtual-call)
}

} // namespace

vtkMTimeType GetInputTime(vtkDataObject* input, const std::vector<DataSetBlock>& blocks)
{
  vtkMTimeType time = GetOwnTime(input);
  if (auto* tree = vtkDataObjectTree::SafeDownCast(input))
  {
    auto iterator = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
    iterator->VisitOnlyLeavesOff();
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      time = std::max(time, GetOwnTime(iterator->GetCurrentDataObject()));
    }
  }
  for (const DataSetBlock& block : blocks)
  {
    time = std::max(time, GetOwnTime(block.DataSet));
  }
  return time;
}

vtkMTimeType GetAttributesTime(const std::vector<DataSetBlock>& blocks)
{
  vtkMTimeType time = 0;
  for (const DataSetBlock& block : blocks)
  {
    time = std::max({ time, GetOwnTime(block.DataSet->GetPointData()),
      GetOwnTime(block.DataSet->GetCellData()) });
  }
  return time;
}

CacheKey GetCellsKey(const std::vector<DataSetBlock>& blocks)
{
  CacheKey key;
  for (const DataSetBlock& block : blocks)
  {
    AddCells(key, block.DataSet);
  }
  return key;
}

CacheKey GetPointsKey(const std::vector<DataSetBlock>& blocks)
{
  CacheKey key;
  for (const DataSetBlock& block : blocks)
  {
    if (auto* grid = vtkPointSet::SafeDownCast(block.DataSet))
    {
      AddPoints(key, grid->GetPoints());
    }
    else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(block.DataSet))
    {
      Add(key, rectilinear->GetXCoordinates());
      Add(key, rectilinear->GetYCoordinates());
      Add(key, rectilinear->GetZCoordinates());
    }
    else if (auto* image = vtkImageData::SafeDownCast(block.DataSet))
    {
      Add(key, image->GetOrigin(), 3);
      Add(key, image->GetSpacing(), 3);
      Add(key, image->GetDirectionMatrix()->GetData(), 9);
    }
  }
  return key;
}

Digest DigestCells(const std::vector<DataSetBlock>& blocks)
{
  Digester digester;
  for (const DataSetBlock& block : blocks)
  {
    vtkDataSet* dataSet = block.DataSet;
    digester.Add(static_cast<std::uint64_t>(dataSet->GetDataObjectType()));
    digester.Add(static_cast<std::uint64_t>(dataSet->GetNumberOfPoints()));
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(dataSet))
    {
      vtkCellArray* cells = grid->GetCells();
      Add(digester, cells ? cells->GetConnectivityArray() : nullptr);
      Add(digester, cells ? cells->GetOffsetsArray() : nullptr);
      Add(digester, grid->GetCellTypesArray());
      for (vtkDataArray* array : GetFaceArrays(grid))
      {
        Add(digester, array);
      }
      const bool hasWeights = grid->GetPointData()->GetRationalWeights() != nullptr;
      digester.Add(static_cast<std::uint64_t>(hasWeights));
    }
    else if (auto* structured = vtkStructuredGrid::SafeDownCast(dataSet))
    {
      digester.Add(structured->GetExtent(), 6 * sizeof(int));
    }
    else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(dataSet))
    {
      digester.Add(rectilinear->GetExtent(), 6 * sizeof(int));
    }
    else if (auto* image = vtkImageData::SafeDownCast(dataSet))
    {
      digester.Add(image->GetExtent(), 6 * sizeof(int));
    }
    else
    {
      digester.Add(MakeVersion()); // never the same
    }
    AddGhosts(digester, dataSet);
  }
  return digester.Get();
}

Digest DigestPoints(const std::vector<DataSetBlock>& blocks)
{
  Digester digester;
  for (const DataSetBlock& block : blocks)
  {
    if (auto* grid = vtkPointSet::SafeDownCast(block.DataSet))
    {
      Add(digester, grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr);
    }
    else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(block.DataSet))
    {
      Add(digester, rectilinear->GetXCoordinates());
      Add(digester, rectilinear->GetYCoordinates());
      Add(digester, rectilinear->GetZCoordinates());
    }
    else if (auto* image = vtkImageData::SafeDownCast(block.DataSet))
    {
      digester.Add(image->GetOrigin(), 3 * sizeof(double));
      digester.Add(image->GetSpacing(), 3 * sizeof(double));
      digester.Add(image->GetDirectionMatrix()->GetData(), 9 * sizeof(double));
    }
    else
    {
      digester.Add(MakeVersion()); // never the same
    }
  }
  return digester.Get();
}

Digest DigestScalars(const std::vector<DataSetBlock>& blocks, const ScalarSelection& selection)
{
  Digester digester;
  for (const DataSetBlock& block : blocks)
  {
    Add(digester, FindSelectedArray(block.DataSet, selection).Array);
    AddGhosts(digester, block.DataSet);
  }
  return digester.Get();
}

CacheKey GetScalarsKey(const std::vector<DataSetBlock>& blocks, const ScalarSelection& selection)
{
  CacheKey key;
  key.Add(selection.ScalarMode);
  key.Add(selection.VectorMode);
  key.Add(selection.VectorComponent);
  key.Add(selection.VectorSize);
  for (const DataSetBlock& block : blocks)
  {
    int ofCells = 0;
    Add(key,
      vtkAbstractMapper::GetAbstractScalars(block.DataSet, selection.ScalarMode,
        selection.ArrayAccessMode, selection.ArrayId, selection.ArrayName.c_str(), ofCells));
    key.Add(ofCells);
  }
  return key;
}

CacheKey GetPropertyKey(vtkVolumeProperty* property)
{
  CacheKey key;
  key.Add(property->GetScalarOpacityUnitDistance(0));
  Add(key, property->GetScalarOpacity(0));
  if (property->GetColorChannels(0) == 3)
  {
    Add(key, property->GetRGBTransferFunction(0));
  }
  else
  {
    Add(key, property->GetGrayTransferFunction(0));
  }
  // Values count, not the time: a property makes its list of them when it is first asked.
  vtkContourValues* surfaces = property->GetIsoSurfaceValues();
  Add(key, surfaces->GetValues(), surfaces->GetNumberOfContours());
  return key;
}

} // namespace tetralux
