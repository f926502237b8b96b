// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConvexifyTetrahedra.h"

#include "Convexify/Convexification.h"
#include "Intake/GridTetrahedra.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>
#include <new>
#include <vector>

vtkStandardNewMacro(vtkConvexifyTetrahedra);

namespace
{

/// Numbers the new ids of an array after the largest old one, in the integers of the array: ids
/// above 2^53 have no double of their own.
struct ContinueIds
{
  template <class ArrayT>
  void operator()(ArrayT* ids, vtkIdType firstNew, bool& fits) const
  {
    using Id = vtk::GetAPIType<ArrayT>;
    auto values = vtk::DataArrayValueRange<1>(ids);
    Id next = 0;
    bool isFull = false;
    for (vtkIdType i = 0; i < firstNew; ++i)
    {
      const Id id = values[i];
      if (id >= next)
      {
        isFull = id == std::numeric_limits<Id>::max();
        next = isFull ? id : static_cast<Id>(id + 1);
      }
    }
    for (vtkIdType i = firstNew; i < values.size() && !isFull; ++i)
    {
      values[i] = next;
      isFull = next == std::numeric_limits<Id>::max() && i + 1 < values.size();
      next = isFull ? next : static_cast<Id>(next + 1);
    }
    fits = !isFull;
  }
};

/// Continues the global ids, or removes them if their type has no room for the new ones.
void ContinueGlobalIds(vtkDataSetAttributes* attributes, vtkIdType firstNew)
{
  vtkDataArray* ids = vtkArrayDownCast<vtkDataArray>(attributes->GetGlobalIds());
  if (!ids || ids->GetNumberOfComponents() != 1)
  {
    return;
  }
  const ContinueIds worker;
  bool fits = true;
  if (!vtkArrayDispatch::Dispatch::Execute(ids, worker, firstNew, fits))
  {
    worker(ids, firstNew, fits);
  }
  if (!fits)
  {
    attributes->SetGlobalIds(nullptr);
  }
}

/// A copy of all arrays that has room for more tuples.
void CopyArrays(
  vtkDataSetAttributes* input, vtkIdType count, vtkIdType newCount, vtkDataSetAttributes* output)
{
  output->CopyAllOn();
  output->CopyAllocate(input, newCount);
  output->CopyData(input, 0, count, 0);
  output->SetNumberOfTuples(newCount);
}

/// For each Steiner point a point of the input that shares a cell with it, or with another one.
std::vector<vtkIdType> FindSources(const tetralux::Convexification& result, vtkIdType firstPoint)
{
  std::vector<vtkIdType> sources(result.GetNumberOfSteinerPoints(), -1);
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    for (std::size_t cell = 0; cell < result.Cells.size(); cell += 4)
    {
      vtkIdType source = -1;
      for (std::size_t i = cell; i < cell + 4; ++i)
      {
        const vtkIdType point = result.Cells[i];
        source = std::max(source, point < firstPoint ? point : sources[point - firstPoint]);
      }
      for (std::size_t i = cell; i < cell + 4 && source >= 0; ++i)
      {
        const vtkIdType point = result.Cells[i];
        if (point >= firstPoint && sources[point - firstPoint] < 0)
        {
          sources[point - firstPoint] = source;
          isChanged = true;
        }
      }
    }
  }
  return sources;
}

void AddPoints(
  vtkUnstructuredGrid* input, const tetralux::Convexification& result, vtkUnstructuredGrid* output)
{
  const vtkIdType count = input->GetNumberOfPoints();
  const vtkIdType added = result.GetNumberOfSteinerPoints();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count + added);
  double position[3];
  for (vtkIdType i = 0; i < count; ++i)
  {
    input->GetPoint(i, position);
    points->SetPoint(i, position);
  }
  for (vtkIdType i = 0; i < added; ++i)
  {
    points->SetPoint(count + i, &result.SteinerPoints[3 * static_cast<std::size_t>(i)]);
  }
  output->SetPoints(points);

  vtkPointData* data = output->GetPointData();
  CopyArrays(input->GetPointData(), count, count + added, data);
  const std::vector<vtkIdType> sources = FindSources(result, count);
  for (vtkIdType i = 0; i < added; ++i)
  {
    data->CopyData(input->GetPointData(), sources[i], count + i);
  }
  ContinueGlobalIds(data, count);
}

void AddCells(
  vtkUnstructuredGrid* input, const tetralux::Convexification& result, vtkUnstructuredGrid* output)
{
  const vtkIdType count = input->GetNumberOfCells();
  const vtkIdType added = result.GetNumberOfCells();
  vtkNew<vtkCellArray> cells;
  cells->DeepCopy(input->GetCells());
  vtkNew<vtkUnsignedCharArray> types;
  types->DeepCopy(input->GetCellTypesArray());
  for (std::size_t cell = 0; cell < result.Cells.size(); cell += 4)
  {
    const vtkIdType points[4] = { result.Cells[cell], result.Cells[cell + 1],
      result.Cells[cell + 2], result.Cells[cell + 3] };
    cells->InsertNextCell(4, points);
    types->InsertNextValue(VTK_TETRA);
  }
  output->SetCells(types, cells);

  vtkCellData* data = output->GetCellData();
  CopyArrays(input->GetCellData(), count, count + added, data);
  for (vtkIdType i = count; i < count + added; ++i)
  {
    data->NullData(i);
  }
  ContinueGlobalIds(data, count);
}

void MarkImaginary(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output)
{
  vtkNew<vtkUnsignedCharArray> marks;
  marks->SetName("Imaginary");
  marks->SetNumberOfValues(output->GetNumberOfCells());
  vtkDataArray* old = input->GetCellData()->GetArray("Imaginary");
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    marks->SetValue(
      i, i >= input->GetNumberOfCells() || (old && old->GetComponent(i, 0) != 0) ? 1 : 0);
  }
  output->GetCellData()->AddArray(marks);
}

} // namespace

//----------------------------------------------------------------------------
int vtkConvexifyTetrahedra::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  this->SetResults({});
  try
  {
    tetralux::TetrahedralMesh mesh;
    const std::string error = tetralux::ReadTetrahedra(input, mesh);
    if (!error.empty())
    {
      vtkErrorMacro(<< error);
      return 0;
    }
    tetralux::RemoveUnusableCells(mesh);
    const tetralux::Convexification result =
      tetralux::Convexify(mesh, tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()),
        tetralux::TouchingCells::Join,
        [this](double fraction)
        {
          this->UpdateProgress(fraction);
          return !this->GetAbortExecute();
        });
    if (!result.Refusal.empty())
    {
      this->Refusal = result.Refusal;
      vtkErrorMacro(<< "the mesh can't be made convex: " << result.Refusal);
      return 0;
    }
    if (result.Aborted)
    {
      return 1;
    }
    output->ShallowCopy(input);
    if (result.GetNumberOfSteinerPoints() > 0)
    {
      AddPoints(input, result, output);
    }
    if (result.GetNumberOfCells() > 0)
    {
      AddCells(input, result, output);
    }
    MarkImaginary(input, output);
    this->SetResults(result);
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    vtkErrorMacro(<< "there is not enough memory to make the mesh convex");
    return 0;
  }
  return 1;
}

//----------------------------------------------------------------------------
void vtkConvexifyTetrahedra::SetResults(const tetralux::Convexification& results)
{
  this->NumberOfBoundaryFaces = results.BoundaryFaces;
  this->NumberOfMissingFaces = results.MissingFaces;
  this->NumberOfFlatPocketFaces = results.FlatPocketFaces;
  this->NumberOfImaginaryCells = results.GetNumberOfCells();
  this->NumberOfSteinerPoints = results.GetNumberOfSteinerPoints();
  this->InputIsConvex = results.Convex;
  this->HullVolume = results.HullVolume;
  this->MeshVolume = results.MeshVolume;
  this->ImaginaryVolume = results.ImaginaryVolume;
  this->ConvexTestSeconds = results.ConvexTestSeconds;
  this->TriangulationSeconds = results.TriangulationSeconds;
  this->PocketSeconds = results.PocketSeconds;
  this->FillSeconds = results.FillSeconds;
  this->VerificationSeconds = results.VerificationSeconds;
  this->Refusal = results.Refusal;
}

//----------------------------------------------------------------------------
void vtkConvexifyTetrahedra::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "InputIsConvex: " << (this->InputIsConvex ? "Yes" : "No") << "\n";
  os << indent << "Refusal: " << (this->Refusal.empty() ? "(none)" : this->Refusal) << "\n";
  os << indent << "NumberOfBoundaryFaces: " << this->NumberOfBoundaryFaces << "\n";
  os << indent << "NumberOfMissingFaces: " << this->NumberOfMissingFaces << "\n";
  os << indent << "NumberOfFlatPocketFaces: " << this->NumberOfFlatPocketFaces << "\n";
  os << indent << "NumberOfImaginaryCells: " << this->NumberOfImaginaryCells << "\n";
  os << indent << "NumberOfSteinerPoints: " << this->NumberOfSteinerPoints << "\n";
  os << indent << "HullVolume: " << this->HullVolume << "\n";
  os << indent << "MeshVolume: " << this->MeshVolume << "\n";
  os << indent << "ImaginaryVolume: " << this->ImaginaryVolume << "\n";
  os << indent << "ConvexTestSeconds: " << this->ConvexTestSeconds << "\n";
  os << indent << "TriangulationSeconds: " << this->TriangulationSeconds << "\n";
  os << indent << "PocketSeconds: " << this->PocketSeconds << "\n";
  os << indent << "FillSeconds: " << this->FillSeconds << "\n";
  os << indent << "VerificationSeconds: " << this->VerificationSeconds << "\n";
}
