// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraNeighbors.h"

#include "Geometry/TetrahedronFaces.h"
#include "Intake/DataSetCheck.h"
#include "Intake/IntakeReport.h"
#include "Mesh/CellVolumes.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"
#include "Mesh/MeshLimits.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTypes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSignedCharArray.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <numeric>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkTetrahedraNeighbors);

namespace
{

struct MeshCounts
{
  vtkIdType BoundaryFaces = 0;
  vtkIdType Components = 0;
  vtkIdType NonManifoldFaces = 0;
  vtkIdType ZeroVolumeCells = 0;
  vtkIdType InvertedCells = 0;
  vtkIdType GhostCells = 0;
  vtkIdType BlankedCells = 0;
  vtkIdType LowerDimensionalCells = 0;
  vtkIdType InvalidCells = 0;
  vtkIdType NonFiniteCells = 0;
  vtkIdType CollapsedCells = 0;
  vtkIdType DuplicateCells = 0;
};

} // namespace

struct vtkTetrahedraNeighbors::Counts : MeshCounts
{
};

namespace
{

/// Points or cells that a task handles at least.
constexpr vtkIdType Grain = 16384;

/// What vtkGhostType says of points or cells.
class GhostMarks
{
public:
  GhostMarks(vtkUnsignedCharArray* array, vtkIdType count)
    : Values(array && array->GetNumberOfValues() >= count ? array->GetPointer(0) : nullptr)
  {
  }
  bool Has(vtkIdType id, int bits) const { return this->Values && (this->Values[id] & bits) != 0; }

private:
  const unsigned char* Values;
};

/// Three for a type that VTK does not know, too: who knows what it fills.
int GetCellDimension(int cellType)
{
  auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(cellType));
  return cell ? cell->GetCellDimension() : 3;
}

/// Finds the neighbours in one grid.
class GridNeighbors
{
public:
  explicit GridNeighbors(vtkUnstructuredGrid* grid)
    : Grid(grid)
    , NumberOfPoints(grid->GetNumberOfPoints())
    , NumberOfCells(grid->GetNumberOfCells())
    , CellMarks(grid->GetCellGhostArray(), this->NumberOfCells)
  {
  }

  /// Calls progress(fraction) before each part of the work; returns false where that does.
  /// error: one line where the grid is refused, with true returned.
  template <class Progress>
  bool Find(MeshCounts& counts, std::string& error, const Progress& progress)
  {
    if (!progress(0))
    {
      return false;
    }
    error = this->Read(counts);
    if (!error.empty())
    {
      return true;
    }
    if (!progress(0.2))
    {
      return false;
    }
    const tetralux::RemovedCells removed = tetralux::RemoveUnusableCells(this->Mesh);
    counts.InvalidCells += removed.InvalidPointIds;
    counts.NonFiniteCells += removed.NonFiniteCoordinates;
    counts.CollapsedCells += removed.RepeatedPoints;
    counts.DuplicateCells += removed.Duplicates;
    if (!progress(0.4))
    {
      return false;
    }
    const tetralux::CellVolumes volumes = tetralux::MeasureCells(this->Mesh);
    counts.ZeroVolumeCells += volumes.NumberOfZero;
    counts.InvertedCells += volumes.NumberOfInverted;
    this->Neighbors = tetralux::FindFaceNeighbors(this->Mesh.Cells, this->Mesh.GetNumberOfPoints());
    counts.NonManifoldFaces += this->Neighbors.NumberOfNonManifoldFaces;
    counts.Components += this->Neighbors.NumberOfComponents;
    return progress(0.7);
  }

  void FillGrid(vtkUnstructuredGrid* output) const
  {
    vtkNew<vtkIdTypeArray> neighbors;
    neighbors->SetName("Neighbors");
    neighbors->SetNumberOfComponents(4);
    neighbors->SetNumberOfTuples(this->NumberOfCells);
    neighbors->FillValue(vtkTetrahedraNeighbors::LEFT_OUT);
    vtkNew<vtkSignedCharArray> faces;
    faces->SetName("NeighborFaces");
    faces->SetNumberOfComponents(4);
    faces->SetNumberOfTuples(this->NumberOfCells);
    faces->FillValue(-1);
    vtkIdType* neighborValues = neighbors->GetPointer(0);
    signed char* faceValues = faces->GetPointer(0);
    vtkSMPTools::For(0, static_cast<vtkIdType>(this->Mesh.GetNumberOfCells()), Grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = 4 * begin; i < 4 * end; ++i)
        {
          const std::int32_t neighbor = this->Neighbors.Neighbors[i];
          const vtkIdType value = vtkIdType{ 4 } * this->Mesh.OriginalCells[i / 4] + i % 4;
          neighborValues[value] = neighbor < 0
            ? static_cast<vtkIdType>(vtkTetrahedraNeighbors::OUTSIDE)
            : this->Mesh.OriginalCells[neighbor];
          faceValues[value] =
            neighbor < 0 ? -1 : static_cast<signed char>(this->Neighbors.NeighborFaces[i]);
        }
      });
    output->ShallowCopy(this->Grid);
    output->GetCellData()->AddArray(neighbors);
    output->GetCellData()->AddArray(faces);
  }

  void FillBoundary(vtkPolyData* output, MeshCounts& counts) const
  {
    vtkNew<vtkCellArray> triangles;
    vtkNew<vtkIdList> cells;
    vtkNew<vtkSignedCharArray> faces;
    faces->SetName("FaceIds");
    for (const std::int32_t boundaryFace : this->Neighbors.BoundaryFaces)
    {
      const vtkIdType cell = this->Mesh.OriginalCells[boundaryFace / 4];
      if (!this->CellMarks.Has(cell, vtkDataSetAttributes::DUPLICATECELL))
      {
        const auto triangle = this->GetTriangle(boundaryFace / 4, boundaryFace % 4);
        triangles->InsertNextCell(3, triangle.data());
        cells->InsertNextId(cell);
        faces->InsertNextValue(static_cast<signed char>(boundaryFace % 4));
      }
    }
    const vtkIdType count = cells->GetNumberOfIds();
    counts.BoundaryFaces += count;

    output->SetPoints(this->Grid->GetPoints());
    output->SetPolys(triangles);
    output->GetPointData()->PassData(this->Grid->GetPointData());
    vtkNew<vtkIdList> all;
    all->SetNumberOfIds(count);
    std::iota(all->begin(), all->end(), 0);
    output->GetCellData()->CopyAllOn();
    output->GetCellData()->CopyAllocate(this->Grid->GetCellData(), count);
    output->GetCellData()->CopyData(this->Grid->GetCellData(), cells, all);
    vtkNew<vtkIdTypeArray> cellIds;
    cellIds->SetName("CellIds");
    cellIds->SetNumberOfValues(count);
    std::copy(cells->begin(), cells->end(), cellIds->GetPointer(0));
    output->GetCellData()->AddArray(cellIds);
    output->GetCellData()->AddArray(faces);
    output->GetFieldData()->ShallowCopy(this->Grid->GetFieldData());
  }

private:
  /// Takes the tetrahedra; returns why the grid is refused, or nothing.
  std::string Read(MeshCounts& counts)
  {
    if (this->NumberOfPoints > tetralux::MaximumPoints ||
      this->NumberOfCells > tetralux::MaximumCells)
    {
      return "the input has " + std::to_string(this->NumberOfPoints) + " points and " +
        std::to_string(this->NumberOfCells) + " cells; at most " +
        std::to_string(tetralux::MaximumPoints) + " and " + std::to_string(tetralux::MaximumCells) +
        " are possible";
    }
    const std::string damage = tetralux::FindDamageOfCells(this->Grid);
    if (!damage.empty())
    {
      return "the input is damaged: " + damage;
    }
    this->Mesh.Points.resize(3 * this->NumberOfPoints);
    vtkSMPTools::For(0, this->NumberOfPoints, Grain,
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          this->Grid->GetPoints()->GetPoint(i, &this->Mesh.Points[3 * i]);
        }
      });

    const GhostMarks pointMarks(this->Grid->GetPointGhostArray(), this->NumberOfPoints);
    const auto isHidden = [&](std::int32_t point)
    { return point >= 0 && pointMarks.Has(point, vtkDataSetAttributes::HIDDENPOINT); };
    this->Mesh.Cells.reserve(4 * this->NumberOfCells);
    this->Mesh.OriginalCells.reserve(this->NumberOfCells);
    int lowerDimensionalType = VTK_EMPTY_CELL; // the last one seen: they mostly come in a row
    for (vtkIdType cell = 0; cell < this->NumberOfCells; ++cell)
    {
      const int type = this->Grid->GetCellType(cell);
      if (type != VTK_TETRA)
      {
        if (type != lowerDimensionalType && GetCellDimension(type) == 3)
        {
          return "cell " + std::to_string(cell) + " is a " + tetralux::GetCellTypeName(type) +
            ", not a vtkTetra; vtkTetrahedralizeCells makes tetrahedra of it";
        }
        lowerDimensionalType = type;
        ++counts.LowerDimensionalCells;
        continue;
      }
      const std::array<std::int32_t, 4> points = this->GetPoints(cell);
      if (this->CellMarks.Has(
            cell, vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL) ||
        std::any_of(points.begin(), points.end(), isHidden))
      {
        ++counts.BlankedCells;
        continue;
      }
      counts.GhostCells += this->CellMarks.Has(cell, vtkDataSetAttributes::DUPLICATECELL);
      this->Mesh.Cells.insert(this->Mesh.Cells.end(), points.begin(), points.end());
      this->Mesh.OriginalCells.push_back(static_cast<std::int32_t>(cell));
    }
    return {};
  }

  /// -1 in place of what is no id of a point.
  std::array<std::int32_t, 4> GetPoints(vtkIdType cell) const
  {
    vtkIdType size;
    const vtkIdType* ids;
    this->Grid->GetCells()->GetCellAtId(cell, size, ids);
    std::array<std::int32_t, 4> points{ -1, -1, -1, -1 };
    for (vtkIdType i = 0; i < std::min<vtkIdType>(size, 4); ++i)
    {
      if (ids[i] >= 0 && ids[i] < this->NumberOfPoints)
      {
        points[i] = static_cast<std::int32_t>(ids[i]);
      }
    }
    return points;
  }

  /// A face of a cell of the mesh, seen counter-clockwise from outside.
  std::array<vtkIdType, 3> GetTriangle(std::int32_t cell, int face) const
  {
    const std::int32_t* points = &this->Mesh.Cells[4 * static_cast<std::size_t>(cell)];
    std::array<vtkIdType, 3> triangle;
    const int* corners = tetralux::OutwardFaces[face];
    std::transform(
      corners, corners + 3, triangle.begin(), [points](int corner) { return points[corner]; });

    double edges[3][3];
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edges[i][axis] = this->Mesh.Points[3 * static_cast<std::size_t>(points[i + 1]) + axis] -
          this->Mesh.Points[3 * static_cast<std::size_t>(points[0]) + axis];
      }
    }
    if (vtkMath::Determinant3x3(edges) < 0)
    {
      std::swap(triangle[1], triangle[2]);
    }
    return triangle;
  }

  vtkUnstructuredGrid* Grid;
  vtkIdType NumberOfPoints;
  vtkIdType NumberOfCells;
  GhostMarks CellMarks;
  tetralux::TetrahedralMesh Mesh;
  tetralux::FaceNeighbors Neighbors;
};

/// A block of the input and where its results go.
struct Block
{
  vtkDataSet* Input;
  vtkUnstructuredGrid* Grid;
  vtkPolyData* Boundary;
};

/// The blocks of a composite, with empty results in its place in both outputs; else the input
/// itself.
std::vector<Block> MakeBlocks(vtkDataObject* input, vtkDataObject* grids, vtkDataObject* boundaries)
{
  auto composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    return { { vtkDataSet::SafeDownCast(input), vtkUnstructuredGrid::SafeDownCast(grids),
      vtkPolyData::SafeDownCast(boundaries) } };
  }
  auto compositeGrids = vtkCompositeDataSet::SafeDownCast(grids);
  auto compositeBoundaries = vtkCompositeDataSet::SafeDownCast(boundaries);
  compositeGrids->CopyStructure(composite);
  compositeBoundaries->CopyStructure(composite);
  std::vector<Block> blocks;
  auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (auto dataSet = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()))
    {
      vtkNew<vtkUnstructuredGrid> grid;
      vtkNew<vtkPolyData> boundary;
      compositeGrids->SetDataSet(iterator, grid);
      compositeBoundaries->SetDataSet(iterator, boundary);
      blocks.push_back({ dataSet, grid, boundary });
    }
  }
  return blocks;
}

} // namespace

//----------------------------------------------------------------------------
vtkTetrahedraNeighbors::vtkTetrahedraNeighbors() { this->SetNumberOfOutputPorts(2); }

//----------------------------------------------------------------------------
vtkPolyData* vtkTetrahedraNeighbors::GetBoundary()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//----------------------------------------------------------------------------
int vtkTetrahedraNeighbors::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//----------------------------------------------------------------------------
int vtkTetrahedraNeighbors::FillOutputPortInformation(int, vtkInformation* info)
{
  // A composite for a composite: known when there is an input.
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

//----------------------------------------------------------------------------
vtkTypeBool vtkTetrahedraNeighbors::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  const bool composite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
  const char* const types[] = { "vtkUnstructuredGrid", "vtkPolyData" };
  for (int port = 0; port < 2; ++port)
  {
    const char* type = composite ? input->GetClassName() : types[port];
    vtkDataObject* output = vtkDataObject::GetData(outputVector, port);
    if (!output || std::strcmp(output->GetClassName(), type) != 0)
    {
      auto created = vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type));
      outputVector->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), created);
    }
  }
  return 1;
}

//----------------------------------------------------------------------------
int vtkTetrahedraNeighbors::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetCounts({});
  vtkDataObject* grids = vtkDataObject::GetData(outputVector, 0);
  vtkDataObject* boundaries = vtkDataObject::GetData(outputVector, 1);
  Counts counts;
  std::string error;
  bool finished = true;
  try
  {
    const std::vector<Block> blocks =
      MakeBlocks(vtkDataObject::GetData(inputVector[0]), grids, boundaries);
    for (std::size_t i = 0; i < blocks.size() && finished && error.empty(); ++i)
    {
      const Block& block = blocks[i];
      auto grid = vtkUnstructuredGrid::SafeDownCast(block.Input);
      if (!grid)
      {
        error = "a block of the input is a " + std::string(block.Input->GetClassName()) +
          ", not a vtkUnstructuredGrid; vtkTetrahedralizeCells makes tetrahedra of it";
        break;
      }
      const auto progress = [&](double fraction)
      {
        this->UpdateProgress((static_cast<double>(i) + fraction) / blocks.size());
        return !this->GetAbortExecute();
      };
      GridNeighbors neighbors(grid);
      finished = neighbors.Find(counts, error, progress);
      if (finished && error.empty())
      {
        neighbors.FillGrid(block.Grid);
        neighbors.FillBoundary(block.Boundary, counts);
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    error = "there is not enough memory to find the neighbours of the cells";
  }
  if (!finished || !error.empty())
  {
    grids->Initialize();
    boundaries->Initialize();
    if (!error.empty())
    {
      vtkErrorMacro(<< error);
      return 0;
    }
    return 1;
  }
  this->SetCounts(counts);
  this->UpdateProgress(1);
  return 1;
}

//----------------------------------------------------------------------------
void vtkTetrahedraNeighbors::SetCounts(const Counts& counts)
{
  this->NumberOfBoundaryFaces = counts.BoundaryFaces;
  this->NumberOfComponents = counts.Components;
  this->NumberOfNonManifoldFaces = counts.NonManifoldFaces;
  this->NumberOfZeroVolumeCells = counts.ZeroVolumeCells;
  this->NumberOfInvertedCells = counts.InvertedCells;
  this->NumberOfGhostCells = counts.GhostCells;
  this->NumberOfBlankedCells = counts.BlankedCells;
  this->NumberOfLowerDimensionalCells = counts.LowerDimensionalCells;
  this->NumberOfInvalidCells = counts.InvalidCells;
  this->NumberOfNonFiniteCells = counts.NonFiniteCells;
  this->NumberOfCollapsedCells = counts.CollapsedCells;
  this->NumberOfDuplicateCells = counts.DuplicateCells;
}

//----------------------------------------------------------------------------
void vtkTetrahedraNeighbors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfBoundaryFaces: " << this->NumberOfBoundaryFaces << "\n";
  os << indent << "NumberOfComponents: " << this->NumberOfComponents << "\n";
  os << indent << "NumberOfNonManifoldFaces: " << this->NumberOfNonManifoldFaces << "\n";
  os << indent << "NumberOfZeroVolumeCells: " << this->NumberOfZeroVolumeCells << "\n";
  os << indent << "NumberOfInvertedCells: " << this->NumberOfInvertedCells << "\n";
  os << indent << "NumberOfGhostCells: " << this->NumberOfGhostCells << "\n";
  os << indent << "NumberOfBlankedCells: " << this->NumberOfBlankedCells << "\n";
  os << indent << "NumberOfLowerDimensionalCells: " << this->NumberOfLowerDimensionalCells << "\n";
  os << indent << "NumberOfInvalidCells: " << this->NumberOfInvalidCells << "\n";
  os << indent << "NumberOfNonFiniteCells: " << this->NumberOfNonFiniteCells << "\n";
  os << indent << "NumberOfCollapsedCells: " << this->NumberOfCollapsedCells << "\n";
  os << indent << "NumberOfDuplicateCells: " << this->NumberOfDuplicateCells << "\n";
}
