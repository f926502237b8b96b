// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedralizeCells.h"

#include "Intake/DataSetBlocks.h"
#include "Intake/LeftOutCells.h"
#include "Intake/TetrahedraIntake.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributesFieldList.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <numeric>

vtkStandardNewMacro(vtkTetrahedralizeCells);

namespace
{

using Blocks = std::vector<tetralux::DataSetBlock>;

/// The blocks that have points; an empty block has no arrays, which says nothing about the others.
Blocks CollectFilledBlocks(vtkDataObject* input)
{
  Blocks blocks = tetralux::CollectDataSets(input);
  blocks.erase(
    std::remove_if(blocks.begin(), blocks.end(),
      [](const tetralux::DataSetBlock& block) { return block.DataSet->GetNumberOfPoints() == 0; }),
    blocks.end());
  return blocks;
}

/// Single precision only where every block has it: image data computes its points in double.
int GetPointPrecision(const Blocks& blocks)
{
  const bool allSingle = !blocks.empty() &&
    std::all_of(blocks.begin(), blocks.end(),
      [](const tetralux::DataSetBlock& block)
      {
        auto pointSet = vtkPointSet::SafeDownCast(block.DataSet);
        return pointSet && pointSet->GetPoints() &&
          pointSet->GetPoints()->GetDataType() == VTK_FLOAT;
      });
  return allSingle ? VTK_FLOAT : VTK_DOUBLE;
}

/// Which fields of a data set are wanted; ghost marks are not, since no ghost is in the output.
template <class AttributesT>
struct Fields
{
  Fields(const Blocks& blocks, AttributesT* (vtkDataSet::*get)())
  {
    for (const tetralux::DataSetBlock& block : blocks)
    {
      vtkNew<AttributesT> wanted;
      wanted->ShallowCopy((block.DataSet->*get)());
      wanted->RemoveArray(vtkDataSetAttributes::GhostArrayName());
      this->List.IntersectFieldList(wanted);
      this->Inputs.emplace_back(wanted);
    }
  }

  vtkDataSetAttributes::FieldList List;
  std::vector<vtkSmartPointer<AttributesT>> Inputs;
};

/// The index of the block that a concatenated id belongs to.
std::size_t FindBlock(
  const Blocks& blocks, std::int64_t id, std::int64_t tetralux::DataSetBlock::*first)
{
  const auto after = std::upper_bound(blocks.begin(), blocks.end(), id,
    [first](std::int64_t value, const tetralux::DataSetBlock& block)
    { return value < block.*first; });
  return static_cast<std::size_t>(after - blocks.begin()) - 1;
}

void CarryPointData(
  const Blocks& blocks, const tetralux::TetrahedralMesh& mesh, vtkPointData* output)
{
  const auto numberOfPoints = static_cast<vtkIdType>(mesh.GetNumberOfPoints());
  Fields<vtkPointData> fields(blocks, &vtkDataSet::GetPointData);
  if (blocks.size() == 1 && mesh.OriginalPoints.empty())
  {
    output->PassData(fields.Inputs[0]);
    return;
  }
  fields.List.CopyAllocate(output, vtkDataSetAttributes::INTERPOLATE, numberOfPoints, 0);
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const vtkIdType count = blocks[b].DataSet->GetNumberOfPoints();
    fields.List.CopyData(
      static_cast<int>(b), fields.Inputs[b], 0, count, output, blocks[b].FirstPoint);
  }

  const auto& added = mesh.AddedPoints;
  const auto numberOfAdded =
    added.Offsets.empty() ? 0 : static_cast<std::int64_t>(added.Offsets.size()) - 1;
  vtkNew<vtkIdList> sources;
  for (std::int64_t k = 0; k < numberOfAdded; ++k)
  {
    const std::int64_t begin = added.Offsets[k];
    const std::int64_t end = added.Offsets[k + 1];
    const std::size_t b =
      FindBlock(blocks, added.Sources[begin], &tetralux::DataSetBlock::FirstPoint);
    sources->Reset();
    for (std::int64_t j = begin; j < end; ++j)
    {
      sources->InsertNextId(added.Sources[j] - blocks[b].FirstPoint);
    }
    std::vector<double> weights(added.Weights.begin() + begin, added.Weights.begin() + end);
    fields.List.InterpolatePoint(static_cast<int>(b), fields.Inputs[b], sources, weights.data(),
      output, numberOfPoints - numberOfAdded + k);
  }
}

void CarryCellData(const Blocks& blocks, const tetralux::TetrahedralMesh& mesh, vtkCellData* output)
{
  Fields<vtkCellData> fields(blocks, &vtkDataSet::GetCellData);
  if (blocks.size() == 1 && mesh.OriginalCells.empty())
  {
    output->PassData(fields.Inputs[0]);
    return;
  }
  const auto numberOfCells = static_cast<vtkIdType>(mesh.GetNumberOfCells());
  fields.List.CopyAllocate(output, vtkDataSetAttributes::COPYTUPLE, numberOfCells, 0);
  std::size_t b = 0;
  for (vtkIdType i = 0; i < numberOfCells; ++i)
  {
    const std::int64_t original = mesh.OriginalCells[i]; // ascending
    while (b + 1 < blocks.size() && blocks[b + 1].FirstCell <= original)
    {
      ++b;
    }
    fields.List.CopyData(
      static_cast<int>(b), fields.Inputs[b], original - blocks[b].FirstCell, output, i);
  }
}

void AddIds(vtkDataSetAttributes* output, const char* name, const std::vector<std::int32_t>& ids,
  std::size_t count)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(count));
  vtkIdType* values = array->GetPointer(0);
  if (ids.empty())
  {
    std::iota(values, values + count, 0);
  }
  else
  {
    std::transform(ids.begin(), ids.end(), values,
      [](std::int32_t id) { return static_cast<vtkIdType>(std::max(id, -1)); });
  }
  output->AddArray(array);
}

} // namespace

//----------------------------------------------------------------------------
int vtkTetrahedralizeCells::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//----------------------------------------------------------------------------
int vtkTetrahedralizeCells::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  this->SetReport({});
  this->NumberOfAddedPoints = 0;

  // Splitting is about half of the work, copying the arrays the other half.
  const double splitShare = 0.5;
  tetralux::TetrahedraIntake intake = tetralux::TakeInTetrahedra(input,
    [&](double fraction)
    {
      this->UpdateProgress(splitShare * fraction);
      return !this->GetAbortExecute();
    });
  this->SetReport(intake.Report);
  if (!intake.Error.empty())
  {
    vtkErrorMacro(<< intake.Error);
    return 0;
  }
  if (intake.Aborted)
  {
    return 1;
  }
  for (const std::string& warning : { tetralux::DescribeLeftOutCells(intake.Report, {}),
         tetralux::DescribeFoldedCells(intake.Report) })
  {
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
  }

  const tetralux::TetrahedralMesh& mesh = intake.Mesh;
  const auto numberOfPoints = static_cast<vtkIdType>(mesh.GetNumberOfPoints());
  const auto numberOfCells = static_cast<vtkIdType>(mesh.GetNumberOfCells());
  this->NumberOfAddedPoints = numberOfPoints - intake.Report.NumberOfPoints;

  const Blocks blocks = CollectFilledBlocks(input);
  vtkNew<vtkPoints> points;
  points->SetDataType(GetPointPrecision(blocks));
  points->SetNumberOfPoints(numberOfPoints);
  for (vtkIdType i = 0; i < numberOfPoints; ++i)
  {
    points->SetPoint(i, &mesh.Points[3 * i]);
  }
  output->SetPoints(points);

  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(4 * numberOfCells);
  std::copy(mesh.Cells.begin(), mesh.Cells.end(), connectivity->GetPointer(0));
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(numberOfCells + 1);
  for (vtkIdType i = 0; i <= numberOfCells; ++i)
  {
    offsets->SetValue(i, static_cast<vtkTypeInt32>(4 * i)); // fits: see TetrahedralMesh
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(numberOfCells);
  types->FillValue(VTK_TETRA);
  output->SetCells(types, cells);

  this->UpdateProgress(splitShare);
  if (!blocks.empty())
  {
    CarryPointData(blocks, mesh, output->GetPointData());
    CarryCellData(blocks, mesh, output->GetCellData());
  }
  if (blocks.size() == 1)
  {
    output->GetFieldData()->ShallowCopy(blocks[0].DataSet->GetFieldData());
  }
  if (this->PassOriginalIds)
  {
    AddIds(output->GetPointData(), "OriginalPointIds", mesh.OriginalPoints, numberOfPoints);
    AddIds(output->GetCellData(), "OriginalCellIds", mesh.OriginalCells, numberOfCells);
  }
  this->UpdateProgress(1);
  return 1;
}

//----------------------------------------------------------------------------
void vtkTetrahedralizeCells::SetReport(const tetralux::TetrahedraIntakeReport& report)
{
  this->NumberOfSkippedCells = report.GetNumberOfSkippedCells();
  this->NumberOfGhostCells = report.GhostCells;
  this->NumberOfBlankedCells = report.BlankedCells;
  this->NumberOfLowerDimensionalCells = report.LowerDimensionalCells;
  this->NumberOfInvalidCells = report.InvalidCells;
  this->SkippedCellTypes = report.DescribeSkippedCells();
}

//----------------------------------------------------------------------------
void vtkTetrahedralizeCells::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PassOriginalIds: " << (this->PassOriginalIds ? "On" : "Off") << "\n";
  os << indent << "NumberOfSkippedCells: " << this->NumberOfSkippedCells << "\n";
  os << indent
     << "SkippedCellTypes: " << (this->SkippedCellTypes.empty() ? "(none)" : this->SkippedCellTypes)
     << "\n";
  os << indent << "NumberOfGhostCells: " << this->NumberOfGhostCells << "\n";
  os << indent << "NumberOfBlankedCells: " << this->NumberOfBlankedCells << "\n";
  os << indent << "NumberOfLowerDimensionalCells: " << this->NumberOfLowerDimensionalCells << "\n";
  os << indent << "NumberOfInvalidCells: " << this->NumberOfInvalidCells << "\n";
  os << indent << "NumberOfAddedPoints: " << this->NumberOfAddedPoints << "\n";
}
