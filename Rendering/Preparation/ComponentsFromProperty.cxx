// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/ComponentsFromProperty.h"

#include "Preparation/TransferFunctionFromProperty.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkType.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace tetralux
{
namespace
{

// Of ScalarSelection.
constexpr int DisabledVectorMode = -1;
constexpr int MagnitudeVectorMode = 0;
constexpr int ComponentVectorMode = 1;

/// The last node of functions that a property makes by itself; the first one is at 0.
constexpr double LastOfOwnNodes = 1024;

/// Whether a function is the one that a property makes where none is set: from value0 to 1.
bool IsOwnOfProperty(vtkPiecewiseFunction* function, double value0)
{
  double first[4], last[4];
  if (function->GetSize() != 2)
  {
    return false;
  }
  function->GetNodeValue(0, first);
  function->GetNodeValue(1, last);
  return first[0] == 0 && first[1] == value0 && last[0] == LastOfOwnNodes && last[1] == 1;
}

/// Whether somebody gave a component functions.
bool HasFunctions(vtkVolumeProperty* property, int component)
{
  return property->GetColorChannels(component) == 3 ||
    !IsOwnOfProperty(property->GetGrayTransferFunction(component), 0) ||
    !IsOwnOfProperty(property->GetScalarOpacity(component), 1);
}

bool HaveFunctions(vtkVolumeProperty* property, int components)
{
  for (int c = 1; c < std::min(components, MostComponents); ++c)
  {
    if (HasFunctions(property, c))
    {
      return true;
    }
  }
  return false;
}

/// Whether colours say which number of a tuple they are of: VTK's defaults say nothing.
bool ChooseVectors(vtkScalarsToColors* colors)
{
  return colors &&
    (colors->GetVectorMode() != vtkScalarsToColors::COMPONENT || colors->GetVectorComponent() > 0);
}

/// Components that are not there count as the last one, as VTK maps arrays to colours.
void UseVectors(vtkScalarsToColors* colors, int components, ScalarSelection& selection)
{
  const int first = std::clamp(colors->GetVectorComponent(), 0, components - 1);
  selection.VectorMode = ComponentVectorMode;
  selection.VectorComponent = first;
  if (colors->GetVectorMode() == vtkScalarsToColors::MAGNITUDE)
  {
    const int size = colors->GetVectorSize();
    selection.VectorMode = MagnitudeVectorMode;
    selection.VectorComponent = size > 0 ? first : 0;
    selection.VectorSize = size > 0 ? std::min(size, components - first) : components;
  }
}

/// The first block's that has it.
vtkDataArray* FindArray(const std::vector<DataSetBlock>& blocks, const ScalarSelection& selection)
{
  for (const DataSetBlock& block : blocks)
  {
    if (vtkDataArray* array = FindSelectedArray(block.DataSet, selection).Array)
    {
      return array;
    }
  }
  return nullptr;
}

std::string DescribeArray(vtkDataArray* array)
{
  return "array '" + std::string(array->GetName() ? array->GetName() : "") + "' has " +
    std::to_string(array->GetNumberOfComponents()) + " components";
}

/// A property of one component: nullptr stands for what is not seen.
TransferFunction MakeFunction(vtkColorTransferFunction* color, vtkPiecewiseFunction* grey,
  vtkPiecewiseFunction* opacity, double unitDistance, double maximumError, double longestPath,
  double& error)
{
  vtkNew<vtkVolumeProperty> property;
  if (color)
  {
    property->SetColor(color);
  }
  else
  {
    vtkNew<vtkPiecewiseFunction> black;
    black->AddPoint(0, 0);
    property->SetColor(grey ? grey : black);
  }
  // Colours are approximated where something attenuates.
  vtkNew<vtkPiecewiseFunction> full;
  full->AddPoint(0, 1);
  property->SetScalarOpacity(opacity ? opacity : full);
  property->SetScalarOpacityUnitDistance(unitDistance);
  PropertyTransferFunction made = TransferFunctionFromProperty(property, maximumError, longestPath);
  error += made.Error;
  if (!opacity)
  {
    for (TransferFunction::Node& node : made.Function.Nodes)
    {
      node.Left.Attenuation = node.Right.Attenuation = 0;
    }
  }
  return std::move(made.Function);
}

/// A colour channel that is the scalar itself, divided by largest.
TransferFunction MakeChannel(int channel, const std::vector<double>& values, double largest)
{
  double range[2] = { 0, 1 };
  bool any = false;
  for (const double value : values)
  {
    if (std::isfinite(value))
    {
      range[0] = any ? std::min(range[0], value) : value;
      range[1] = any ? std::max(range[1], value) : value;
      any = true;
    }
  }
  TransferFunction function;
  for (const double scalar : range)
  {
    if (std::abs(scalar / largest) > LargestColor)
    {
      std::ostringstream message;
      message << "a component that is a colour is " << scalar << ", and at most " << LargestColor
              << " can be drawn";
      throw std::invalid_argument(message.str());
    }
    TransferFunction::Value value{};
    value.Color[channel] = scalar / largest;
    if (function.Nodes.empty() || function.Nodes.back().Scalar < scalar)
    {
      function.Nodes.push_back({ scalar, value, value });
    }
  }
  return function;
}

ComponentFunctions MakeDependent(vtkVolumeProperty* property, const ComponentUse& use,
  const std::vector<const std::vector<double>*>& values, double maximumError, double longestPath,
  double& error)
{
  ComponentFunctions components;
  components.Dependent = true;
  const double unitDistance = property->GetScalarOpacityUnitDistance();
  if (use.Components == 2)
  {
    const bool colored = property->GetColorChannels() == 3;
    components.Functions.push_back(
      MakeFunction(colored ? property->GetRGBTransferFunction() : nullptr,
        colored ? nullptr : property->GetGrayTransferFunction(), nullptr, unitDistance,
        maximumError / 2, longestPath, error));
  }
  else
  {
    for (int c = 0; c < 3; ++c)
    {
      components.Functions.push_back(MakeChannel(c, *values[c], GetLargestChannel(use.ValueType)));
    }
  }
  components.Functions.push_back(MakeFunction(nullptr, nullptr, property->GetScalarOpacity(),
    unitDistance, maximumError / 2, longestPath, error));
  return components;
}

} // namespace

ScalarSelection ComponentUse::Select(int component) const
{
  ScalarSelection selection = this->Selection;
  if (this->Shown != Kind::One)
  {
    selection.VectorMode = ComponentVectorMode;
    selection.VectorComponent = component;
  }
  return selection;
}

ComponentUse FindComponentUse(const std::vector<DataSetBlock>& blocks,
  const ScalarSelection& selection, vtkVolumeProperty* property)
{
  ComponentUse use;
  use.Selection = selection;
  vtkDataArray* array = FindArray(blocks, selection);
  const int components = array ? array->GetNumberOfComponents() : 1;
  if (components == 1 || selection.VectorMode != DisabledVectorMode)
  {
    return use;
  }
  use.ValueType = array->GetDataType();
  if (!property->GetIndependentComponents())
  {
    if (components != 2 && components != 4)
    {
      throw std::invalid_argument("IndependentComponents is off, and " + DescribeArray(array) +
        "; dependent components are 2 or 4");
    }
    use.Shown = ComponentUse::Kind::Dependent;
    use.Components = components;
    return use;
  }
  vtkScalarsToColors* colors =
    property->GetColorChannels() == 3 ? property->GetRGBTransferFunction() : nullptr;
  if (!ChooseVectors(colors))
  {
    colors = array->GetLookupTable();
  }
  if (ChooseVectors(colors))
  {
    if (colors->GetVectorMode() == vtkScalarsToColors::RGBCOLORS)
    {
      use.Warning = "VectorMode RGBColors of the colour function is not used, and the first "
                    "component is shown: components are colours where IndependentComponents is off";
      return use;
    }
    UseVectors(colors, components, use.Selection);
    return use;
  }
  if (HaveFunctions(property, components))
  {
    if (components > MostComponents)
    {
      use.Warning = "functions of further components are not used, and the first component is "
                    "shown: " +
        DescribeArray(array) + ", and there are functions of " + std::to_string(MostComponents);
      return use;
    }
    use.Shown = ComponentUse::Kind::Independent;
    use.Components = components;
  }
  return use;
}

ComponentFunctions ComponentsFromProperty(vtkVolumeProperty* property, const ComponentUse& use,
  const std::vector<const std::vector<double>*>& values, double maximumError, double longestPath,
  double& error)
{
  error = 0;
  if (use.Shown == ComponentUse::Kind::Dependent)
  {
    return MakeDependent(property, use, values, maximumError, longestPath, error);
  }
  ComponentFunctions components;
  for (int c = 0; c < use.Components; ++c)
  {
    PropertyTransferFunction made =
      TransferFunctionFromProperty(property, maximumError / use.Components, longestPath, c);
    error += made.Error;
    components.Functions.push_back(std::move(made.Function));
  }
  return components;
}

void AddComponents(vtkVolumeProperty* property, const ComponentUse& use, CacheKey& key)
{
  key.Add(use.Shown);
  key.Add(use.Components);
  key.Add(use.ValueType);
  if (use.Shown != ComponentUse::Kind::Independent)
  {
    return;
  }
  const auto add = [&key](vtkObject* function)
  {
    key.Add(function);
    key.Add(function->GetMTime());
  };
  for (int c = 1; c < use.Components; ++c)
  {
    key.Add(property->GetScalarOpacityUnitDistance(c));
    add(property->GetScalarOpacity(c));
    property->GetColorChannels(c) == 3 ? add(property->GetRGBTransferFunction(c))
                                       : add(property->GetGrayTransferFunction(c));
  }
}

double GetLargestChannel(int valueType)
{
  switch (valueType)
  {
    case VTK_UNSIGNED_CHAR:
      return VTK_UNSIGNED_CHAR_MAX;
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return VTK_SIGNED_CHAR_MAX;
    case VTK_UNSIGNED_SHORT:
      return VTK_UNSIGNED_SHORT_MAX;
    case VTK_SHORT:
      return VTK_SHORT_MAX;
    default:
      return 1;
  }
}

} // namespace tetralux
