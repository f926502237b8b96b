// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/Arrays.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/ScalarExtraction.h"
#include "Intake/TetrahedraIntake.h"

#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace
{

void Extend(std::array<double, 2>& range, double value)
{
  range = range[0] > range[1]
    ? std::array<double, 2>{ value, value }
    : std::array<double, 2>{ std::min(range[0], value), std::max(range[1], value) };
}

struct Summarize
{
  template <class ArrayT>
  void operator()(ArrayT* array, ArraySummary& summary) const
  {
    for (const auto tuple : vtk::DataArrayTupleRange(array))
    {
      double squares = 0;
      for (int component = 0; component < summary.Components; ++component)
      {
        const auto value = static_cast<double>(tuple[component]);
        squares += value * value;
        if (std::isfinite(value))
        {
          Extend(summary.Ranges[component], value);
        }
        else
        {
          ++summary.NonFiniteValues;
        }
      }
      if (std::isfinite(squares))
      {
        Extend(summary.MagnitudeRange, std::sqrt(squares));
      }
    }
    summary.Values += array->GetNumberOfValues();
  }
};

void AddArrays(
  vtkDataSetAttributes* attributes, bool cellData, std::vector<ArraySummary>& summaries)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    if (!array || !array->GetName() ||
      !std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()))
    {
      continue;
    }
    auto found = std::find_if(summaries.begin(), summaries.end(),
      [&](const ArraySummary& summary)
      {
        return summary.CellData == cellData && summary.Name == array->GetName() &&
          summary.Components == array->GetNumberOfComponents();
      });
    if (found == summaries.end())
    {
      ArraySummary summary;
      summary.Name = array->GetName();
      summary.CellData = cellData;
      summary.DataType = array->GetDataType();
      summary.Components = array->GetNumberOfComponents();
      summary.Ranges.resize(summary.Components, { 1, -1 });
      found = summaries.insert(summaries.end(), summary);
    }
    found->Active = found->Active || array == attributes->GetScalars();
    Summarize worker;
    if (!vtkArrayDispatch::Dispatch::Execute(array, worker, *found))
    {
      worker(array, *found);
    }
  }
}

const ArraySummary* FindDefault(const std::vector<ArraySummary>& arrays)
{
  const auto find = [&arrays](auto&& predicate) -> const ArraySummary*
  {
    const auto found = std::find_if(arrays.begin(), arrays.end(), predicate);
    return found == arrays.end() ? nullptr : &*found;
  };
  if (const ArraySummary* active = find([](const ArraySummary& array) { return array.Active; }))
  {
    return active;
  }
  if (const ArraySummary* real = find([](const ArraySummary& array)
        { return array.DataType == VTK_FLOAT || array.DataType == VTK_DOUBLE; }))
  {
    return real;
  }
  return find([](const ArraySummary&) { return true; });
}

} // namespace

std::vector<ArraySummary> ListArrays(vtkDataObject* data)
{
  std::vector<ArraySummary> summaries;
  const std::vector<tetralux::DataSetBlock> blocks = tetralux::CollectDataSets(data);
  for (const tetralux::DataSetBlock& block : blocks)
  {
    AddArrays(block.DataSet->GetPointData(), false, summaries);
  }
  for (const tetralux::DataSetBlock& block : blocks)
  {
    AddArrays(block.DataSet->GetCellData(), true, summaries);
  }
  return summaries;
}

ArrayChoice ChooseArray(vtkDataObject* data, const std::string& name, const std::string& component,
  const std::string& option)
{
  const std::vector<ArraySummary> arrays = ListArrays(data);
  const ArraySummary* array = nullptr;
  if (name.empty())
  {
    array = FindDefault(arrays);
    if (!array)
    {
      throw WorkError("the input has no arrays to colour by");
    }
  }
  else
  {
    const auto found = std::find_if(arrays.begin(), arrays.end(),
      [&name](const ArraySummary& summary) { return summary.Name == name; });
    if (found == arrays.end())
    {
      throw WorkError(option + ": the input has no array named '" + name + "'; there are " +
        tetralux::DescribeArrays(data));
    }
    array = &*found;
  }

  ArrayChoice choice;
  choice.Array = *array;
  choice.Magnitude =
    component == "magnitude" ? array->Components > 1 : component.empty() && array->Components > 1;
  if (!component.empty() && component != "magnitude")
  {
    choice.Component = ParseInteger("--component", component, 0, VTK_INT_MAX);
    if (choice.Component >= array->Components)
    {
      throw WorkError("--component: array '" + array->Name + "' has no component " + component +
        "; it has " + std::to_string(array->Components) + ", counted from 0");
    }
  }
  choice.Range = choice.Magnitude ? array->MagnitudeRange : array->Ranges[choice.Component];
  if (choice.Range[0] > choice.Range[1])
  {
    throw WorkError("array '" + array->Name + "' has no finite values");
  }
  return choice;
}
