// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/ScalarExtraction.h"

#include "Intake/DataSetBlocks.h"
#include "Intake/TetrahedraIntake.h"

#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tetralux
{

namespace
{

// Values of vtkMapper's VTK_SCALAR_MODE_... and vtkAbstractMapper's VTK_GET_ARRAY_BY_...; this
// module does not depend on rendering.
enum ScalarModes
{
  Default = 0,
  UsePointData = 1,
  UseCellData = 2,
  UsePointFieldData = 3,
  UseCellFieldData = 4,
  UseFieldData = 5
};
enum ArrayAccessModes
{
  ById = 0,
  ByName = 1
};
enum VectorModes
{
  Disabled = -1,
  Magnitude = 0,
  Component = 1
};

constexpr const char* FieldDataError =
  "scalars of the field data belong to no point or cell; choose point or cell data";

/// Values that one task converts.
constexpr vtkIdType Grain = 65536;

/// One number for each tuple of an array.
struct ReduceTuples
{
  template <class ArrayT>
  void operator()(ArrayT* array, vtkIdType count, const ScalarSelection& selection, int component,
    double* out) const
  {
    const auto tuples = vtk::DataArrayTupleRange(array);
    const int size =
      selection.VectorSize > 0 ? selection.VectorSize : array->GetNumberOfComponents();
    const bool magnitude = selection.VectorMode == Magnitude && size > 1;
    vtkSMPTools::For(0, count, Grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const auto tuple = tuples[i];
          if (magnitude)
          {
            double sum = 0;
            for (int c = 0; c < size; ++c)
            {
              const auto value = static_cast<double>(tuple[component + c]);
              sum += value * value;
            }
            out[i] = std::sqrt(sum);
          }
          else
          {
            out[i] = static_cast<double>(tuple[component]);
          }
        }
      });
  }
};

vtkDataArray* SelectArray(vtkDataSetAttributes* attributes, const ScalarSelection& selection)
{
  switch (selection.ScalarMode)
  {
    case UsePointFieldData:
    case UseCellFieldData:
      return selection.ArrayAccessMode == ByName ? attributes->GetArray(selection.ArrayName.c_str())
                                                 : attributes->GetArray(selection.ArrayId);
    default:
      return attributes->GetScalars();
  }
}

/// The selected array of one block. cellData: -1 where either will do, else 0 or 1; set to what was
/// found.
vtkDataArray* FindArray(vtkDataSet* dataSet, const ScalarSelection& selection, int& cellData)
{
  if (cellData != 1)
  {
    if (vtkDataArray* array = SelectArray(dataSet->GetPointData(), selection))
    {
      cellData = 0;
      return array;
    }
  }
  if (cellData != 0)
  {
    if (vtkDataArray* array = SelectArray(dataSet->GetCellData(), selection))
    {
      cellData = 1;
      return array;
    }
  }
  return nullptr;
}

std::string DescribeSelection(const ScalarSelection& selection)
{
  switch (selection.ScalarMode)
  {
    case UsePointData:
      return "the input has no active point scalars";
    case UseCellData:
      return "the input has no active cell scalars";
    case UsePointFieldData:
    case UseCellFieldData:
    {
      const std::string kind = selection.ScalarMode == UsePointFieldData ? "point" : "cell";
      return selection.ArrayAccessMode == ByName
        ? "the input has no " + kind + " array named '" + selection.ArrayName + "'"
        : "the input has no " + kind + " array number " + std::to_string(selection.ArrayId);
    }
    default:
      return "the input has no active point or cell scalars";
  }
}

void AppendNames(vtkDataSetAttributes* attributes, std::vector<std::string>& names)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    if (!array ||
      (array->GetName() && !std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName())))
    {
      continue;
    }
    std::string name = array->GetName() ? array->GetName() : "(no name)";
    if (array->GetNumberOfComponents() != 1)
    {
      name += " (" + std::to_string(array->GetNumberOfComponents()) + " components)";
    }
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  }
}

std::string Join(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

/// -1 where points or cells will do, else whether it is cells.
int GetWantedKind(const ScalarSelection& selection)
{
  switch (selection.ScalarMode)
  {
    case UsePointData:
    case UsePointFieldData:
      return 0;
    case UseCellData:
    case UseCellFieldData:
      return 1;
    default:
      return -1;
  }
}

/// What is wrong with an array for count points or cells, or an empty text. component: receives
/// the one that is selected.
std::string CheckArray(vtkDataArray* array, vtkIdType count, bool cellData,
  const ScalarSelection& selection, int& component)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  if (array->GetNumberOfTuples() < count)
  {
    return "array '" + name + "' has " + std::to_string(array->GetNumberOfTuples()) +
      " values for " + std::to_string(count) + (cellData ? " cells" : " points");
  }
  const int components = array->GetNumberOfComponents();
  const bool chosen = selection.VectorMode == Component || selection.VectorSize > 0;
  component = chosen ? selection.VectorComponent : 0;
  if (component < 0 || component >= components)
  {
    return "array '" + name + "' has no component " + std::to_string(component) + "; it has " +
      std::to_string(components) + ", counted from 0";
  }
  return "";
}

/// Values of the input's points or cells, all blocks one after the other; empty on error.
std::vector<double> ReadInput(
  vtkDataObject* input, const ScalarSelection& selection, ExtractedScalars& result)
{
  int cellData = GetWantedKind(selection);

  // The first block that has the array decides what kind it is, so ask before converting.
  const std::vector<DataSetBlock> blocks = CollectDataSets(input);
  std::int64_t points = 0;
  std::int64_t cells = 0;
  bool found = false;
  for (const DataSetBlock& block : blocks)
  {
    found = FindArray(block.DataSet, selection, cellData) != nullptr || found;
    points += block.DataSet->GetNumberOfPoints();
    cells += block.DataSet->GetNumberOfCells();
  }
  if (!found)
  {
    result.Error = DescribeSelection(selection) + "; there are " + DescribeArrays(input);
    return {};
  }
  result.CellData = cellData == 1;

  std::vector<double> values(
    result.CellData ? cells : points, std::numeric_limits<double>::quiet_NaN());
  for (const DataSetBlock& block : blocks)
  {
    vtkDataArray* array = FindArray(block.DataSet, selection, cellData);
    const vtkIdType count =
      result.CellData ? block.DataSet->GetNumberOfCells() : block.DataSet->GetNumberOfPoints();
    if (!array || count == 0)
    {
      continue;
    }
    if (result.ArrayName.empty() && array->GetName())
    {
      result.ArrayName = array->GetName();
    }
    int component = 0;
    result.Error = CheckArray(array, count, result.CellData, selection, component);
    if (!result.Error.empty())
    {
      return {};
    }
    if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE)
    {
      const double rounding = array->GetDataType() == VTK_FLOAT
        ? static_cast<double>(std::numeric_limits<float>::epsilon()) / 2
        : std::numeric_limits<double>::epsilon() / 2;
      result.Rounding = std::max(result.Rounding, rounding);
    }
    double* out = values.data() + (result.CellData ? block.FirstCell : block.FirstPoint);
    ReduceTuples worker;
    if (!vtkArrayDispatch::Dispatch::Execute(array, worker, count, selection, component, out))
    {
      worker(array, count, selection, component, out);
    }
  }
  return values;
}

/// Input values carried over to the mesh's points.
std::vector<double> ToPoints(std::vector<double>&& input, const TetrahedralMesh& mesh)
{
  if (mesh.OriginalPoints.empty())
  {
    return std::move(input);
  }
  std::vector<double> values(mesh.GetNumberOfPoints());
  vtkSMPTools::For(0, static_cast<vtkIdType>(values.size()), Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const std::int64_t original = mesh.OriginalPoints[i];
        if (original >= 0)
        {
          values[i] = input[original];
          continue;
        }
        const auto& added = mesh.AddedPoints;
        double sum = 0;
        for (std::int64_t j = added.Offsets[-1 - original]; j < added.Offsets[-original]; ++j)
        {
          sum += added.Weights[j] * input[added.Sources[j]];
        }
        values[i] = sum;
      }
    });
  return values;
}

/// Input values carried over to the mesh's tetrahedra.
std::vector<double> ToCells(std::vector<double>&& input, const TetrahedralMesh& mesh)
{
  if (mesh.OriginalCells.empty())
  {
    return std::move(input);
  }
  std::vector<double> values(mesh.GetNumberOfCells());
  vtkSMPTools::For(0, static_cast<vtkIdType>(values.size()), Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        values[i] = input[mesh.OriginalCells[i]];
      }
    });
  return values;
}

} // namespace

ExtractedScalars ExtractScalars(
  vtkDataObject* input, const TetrahedralMesh& mesh, const ScalarSelection& selection)
{
  ExtractedScalars result;
  if (selection.ScalarMode == UseFieldData)
  {
    result.Error = FieldDataError;
    return result;
  }
  std::vector<double> values = ReadInput(input, selection, result);
  if (result.Error.empty())
  {
    result.Values =
      result.CellData ? ToCells(std::move(values), mesh) : ToPoints(std::move(values), mesh);
  }
  return result;
}

SelectedArray FindSelectedArray(vtkDataSet* dataSet, const ScalarSelection& selection)
{
  SelectedArray selected;
  if (selection.ScalarMode == UseFieldData)
  {
    selected.Error = FieldDataError;
    return selected;
  }
  int cellData = GetWantedKind(selection);
  selected.Array = FindArray(dataSet, selection, cellData);
  if (!selected.Array)
  {
    selected.Error = DescribeSelection(selection) + "; there are " + DescribeArrays(dataSet);
    return selected;
  }
  selected.CellData = cellData == 1;
  selected.Magnitude =
    selection.VectorMode == Magnitude && selected.Array->GetNumberOfComponents() > 1;
  selected.Error = CheckArray(selected.Array,
    selected.CellData ? dataSet->GetNumberOfCells() : dataSet->GetNumberOfPoints(),
    selected.CellData, selection, selected.Component);
  return selected;
}

std::string DescribeArrays(vtkDataObject* input)
{
  std::vector<std::string> pointNames;
  std::vector<std::string> cellNames;
  for (const DataSetBlock& block : CollectDataSets(input))
  {
    AppendNames(block.DataSet->GetPointData(), pointNames);
    AppendNames(block.DataSet->GetCellData(), cellNames);
  }
  return "point arrays: " + Join(pointNames) + "; cell arrays: " + Join(cellNames);
}

} // namespace tetralux
