// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConvexifyTetrahedra.h"

#include "Convexify/Convexification.h"
#include "Intake/GridTetrahedra.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <vector>

vtkStandardNewMacro(vtkConvexifyTetrahedra);

struct vtkConvexifyTetrahedra::Results : tetralux::Convexification
{
  vtkIdType NumberOfCells = 0;
  vtkIdType NumberOfSteinerPoints = 0;
};

namespace
{

/// Global ids go on after the largest one.
void ContinueGlobalIds(vtkDataSetAttributes* attributes, vtkIdType firstNew)
{
  vtkDataArray* ids = vtkArrayDownCast<vtkDataArray>(attributes->GetGlobalIds());
  if (!ids || ids->GetNumberOfComponents() != 1)
  {
    return;
  }
  double next = 0;
  for (vtkIdType i = 0; i < firstNew; ++i)
  {
    next = std::max(next, ids->GetTuple1(i) + 1);
  }
  for (vtkIdType i = firstNew; i < ids->GetNumberOfTuples(); ++i)
  {
    ids->SetTuple1(i, next++);
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
vtkConvexifyTetrahedra::vtkConvexifyTetrahedra()
  : LastResults(new Results)
{
}

//----------------------------------------------------------------------------
vtkConvexifyTetrahedra::~vtkConvexifyTetrahedra() = default;

//----------------------------------------------------------------------------
int vtkConvexifyTetrahedra::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  *this->LastResults = Results();
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
    tetralux::Convexification result =
      tetralux::Convexify(mesh, tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()),
        [this](double fraction)
        {
          this->UpdateProgress(fraction);
          return !this->GetAbortExecute();
        });
    if (!result.Refusal.empty())
    {
      static_cast<tetralux::Convexification&>(*this->LastResults).Refusal = result.Refusal;
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
    this->LastResults->NumberOfCells = result.GetNumberOfCells();
    this->LastResults->NumberOfSteinerPoints = result.GetNumberOfSteinerPoints();
    static_cast<tetralux::Convexification&>(*this->LastResults) = std::move(result);
    this->LastResults->Cells = {};
    this->LastResults->SteinerPoints = {};
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
vtkIdType vtkConvexifyTetrahedra::GetNumberOfBoundaryFaces()
{
  return this->LastResults->BoundaryFaces;
}

//----------------------------------------------------------------------------
vtkIdType vtkConvexifyTetrahedra::GetNumberOfMissingFaces()
{
  return this->LastResults->MissingFaces;
}

//----------------------------------------------------------------------------
vtkIdType vtkConvexifyTetrahedra::GetNumberOfFlatPocketFaces()
{
  return this->LastResults->FlatPocketFaces;
}

//----------------------------------------------------------------------------
vtkIdType vtkConvexifyTetrahedra::GetNumberOfImaginaryCells()
{
  return this->LastResults->NumberOfCells;
}

//----------------------------------------------------------------------------
vtkIdType vtkConvexifyTetrahedra::GetNumberOfSteinerPoints()
{
  return this->LastResults->NumberOfSteinerPoints;
}

//----------------------------------------------------------------------------
bool vtkConvexifyTetrahedra::GetInputIsConvex() { return this->LastResults->Convex; }

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetHullVolume() { return this->LastResults->HullVolume; }

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetMeshVolume() { return this->LastResults->MeshVolume; }

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetImaginaryVolume() { return this->LastResults->ImaginaryVolume; }

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetConvexTestSeconds()
{
  return this->LastResults->ConvexTestSeconds;
}

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetTriangulationSeconds()
{
  return this->LastResults->TriangulationSeconds;
}

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetPocketSeconds() { return this->LastResults->PocketSeconds; }

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetFillSeconds() { return this->LastResults->FillSeconds; }

//----------------------------------------------------------------------------
double vtkConvexifyTetrahedra::GetVerificationSeconds()
{
  return this->LastResults->VerificationSeconds;
}

//----------------------------------------------------------------------------
const char* vtkConvexifyTetrahedra::GetRefusal() { return this->LastResults->Refusal.c_str(); }

//----------------------------------------------------------------------------
void vtkConvexifyTetrahedra::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "InputIsConvex: " << (this->GetInputIsConvex() ? "Yes" : "No") << "\n";
  os << indent << "Refusal: " << (*this->GetRefusal() ? this->GetRefusal() : "(none)") << "\n";
  os << indent << "NumberOfBoundaryFaces: " << this->GetNumberOfBoundaryFaces() << "\n";
  os << indent << "NumberOfMissingFaces: " << this->GetNumberOfMissingFaces() << "\n";
  os << indent << "NumberOfFlatPocketFaces: " << this->GetNumberOfFlatPocketFaces() << "\n";
  os << indent << "NumberOfImaginaryCells: " << this->GetNumberOfImaginaryCells() << "\n";
  os << indent << "NumberOfSteinerPoints: " << this->GetNumberOfSteinerPoints() << "\n";
  os << indent << "HullVolume: " << this->GetHullVolume() << "\n";
  os << indent << "MeshVolume: " << this->GetMeshVolume() << "\n";
  os << indent << "ImaginaryVolume: " << this->GetImaginaryVolume() << "\n";
  os << indent << "ConvexTestSeconds: " << this->GetConvexTestSeconds() << "\n";
  os << indent << "TriangulationSeconds: " << this->GetTriangulationSeconds() << "\n";
  os << indent << "PocketSeconds: " << this->GetPocketSeconds() << "\n";
  os << indent << "FillSeconds: " << this->GetFillSeconds() << "\n";
  os << indent << "VerificationSeconds: " << this->GetVerificationSeconds() << "\n";
}
