// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/InputSignature.h"

#include "Intake/TetrahedraIntake.h"
#include "vtkContourValues.h"

#include "vtkAbstractArray.h"
#include "vtkAbstractMapper.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeProperty.h"

#include <cstring>

namespace tetralux
{
namespace
{

void Add(Signature& signature, vtkObject* object)
{
  signature.push_back(reinterpret_cast<std::uintptr_t>(object));
  signature.push_back(object ? object->GetMTime() : 0);
}

void Add(Signature& signature, std::int64_t number)
{
  signature.push_back(static_cast<std::uint64_t>(number));
}

void Add(Signature& signature, const double* numbers, int count)
{
  for (int i = 0; i < count; ++i)
  {
    std::uint64_t bits;
    std::memcpy(&bits, numbers + i, sizeof(bits));
    signature.push_back(bits);
  }
}

void AddPoints(Signature& signature, vtkPoints* points)
{
  Add(signature, points ? points->GetData() : nullptr);
  Add(signature, points ? points->GetMTime() : 0);
}

void AddCells(Signature& signature, vtkUnstructuredGrid* grid)
{
  vtkCellArray* cells = grid->GetCells();
  Add(signature, cells ? cells->GetConnectivityArray() : nullptr);
  Add(signature, cells ? cells->GetOffsetsArray() : nullptr);
  Add(signature, cells ? cells->GetMTime() : 0);
  Add(signature, grid->GetCellTypesArray());
  Add(signature, grid->GetFaces());
  Add(signature, grid->GetFaceLocations());
}

void AddGeometry(Signature& signature, vtkDataSet* dataSet)
{
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(dataSet))
  {
    AddPoints(signature, grid->GetPoints());
    AddCells(signature, grid);
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(dataSet))
  {
    AddPoints(signature, structured->GetPoints());
    for (int c = 0; c < 6; ++c)
    {
      Add(signature, structured->GetExtent()[c]);
    }
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(dataSet))
  {
    Add(signature, rectilinear->GetXCoordinates());
    Add(signature, rectilinear->GetYCoordinates());
    Add(signature, rectilinear->GetZCoordinates());
    for (int c = 0; c < 6; ++c)
    {
      Add(signature, rectilinear->GetExtent()[c]);
    }
  }
  else if (auto* image = vtkImageData::SafeDownCast(dataSet))
  {
    Add(signature, image->GetOrigin(), 3);
    Add(signature, image->GetSpacing(), 3);
    Add(signature, image->GetDirectionMatrix()->GetData(), 9);
    for (int c = 0; c < 6; ++c)
    {
      Add(signature, image->GetExtent()[c]);
    }
  }
  else
  {
    Add(signature, dataSet);
  }
}

} // namespace

Signature GetMeshSignature(vtkDataObject* input)
{
  Signature signature;
  for (const DataSetBlock& block : CollectDataSets(input))
  {
    Add(signature, block.DataSet->GetDataObjectType());
    AddGeometry(signature, block.DataSet);
    const char* ghosts = vtkDataSetAttributes::GhostArrayName();
    Add(signature, block.DataSet->GetPointData()->GetArray(ghosts));
    Add(signature, block.DataSet->GetCellData()->GetArray(ghosts));
  }
  return signature;
}

Signature GetScalarsSignature(vtkDataObject* input, const ScalarSelection& selection)
{
  Signature signature;
  Add(signature, selection.ScalarMode);
  Add(signature, selection.VectorMode);
  Add(signature, selection.VectorComponent);
  for (const DataSetBlock& block : CollectDataSets(input))
  {
    int ofCells = 0;
    Add(signature,
      vtkAbstractMapper::GetAbstractScalars(block.DataSet, selection.ScalarMode,
        selection.ArrayAccessMode, selection.ArrayId, selection.ArrayName.c_str(), ofCells));
    Add(signature, ofCells);
  }
  return signature;
}

Signature GetPropertySignature(vtkVolumeProperty* property)
{
  Signature signature;
  const double unitDistance = property->GetScalarOpacityUnitDistance(0);
  Add(signature, &unitDistance, 1);
  Add(signature, property->GetScalarOpacity(0));
  if (property->GetColorChannels(0) == 3)
  {
    Add(signature, property->GetRGBTransferFunction(0));
  }
  else
  {
    Add(signature, property->GetGrayTransferFunction(0));
  }
  // Values count, not the time: a property makes its list of them when it is first asked.
  vtkContourValues* surfaces = property->GetIsoSurfaceValues();
  const int count = surfaces->GetNumberOfContours();
  Add(signature, surfaces->GetValues(), count);
  return signature;
}

} // namespace tetralux
