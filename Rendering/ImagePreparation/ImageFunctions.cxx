// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageFunctions.h"

#include "Frame/RendererLights.h"
#include "Preparation/ComponentsFromProperty.h"
#include "Preparation/TransferFunctionFromProperty.h"

#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace tetralux
{
namespace
{

constexpr int LargestLabel = 255;

void ClampOpacities(TransferFunction& function)
{
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Left.Attenuation = std::min(node.Left.Attenuation, 1.);
    node.Right.Attenuation = std::min(node.Right.Attenuation, 1.);
  }
}

TransferFunction MakeOpacity(vtkPiecewiseFunction* function, FunctionRules& rules)
{
  vtkNew<vtkVolumeProperty> property;
  property->SetScalarOpacity(function);
  PropertyTransferFunction made =
    TransferFunctionFromProperty(property, rules.MaximumError, rules.LongestPath);
  rules.Error += made.Error;
  ClampOpacities(made.Function);
  return std::move(made.Function);
}

} // namespace

bool HasGradientOpacity(vtkVolumeProperty* property, int component)
{
  if (property->GetDisableGradientOpacity(component) != 0 ||
    !property->HasGradientOpacity(component))
  {
    return false;
  }
  vtkPiecewiseFunction* function = property->GetGradientOpacity(component);
  double node[4];
  for (int i = 0; i < function->GetSize(); ++i)
  {
    function->GetNodeValue(i, node);
    if (node[1] != 1)
    {
      return true;
    }
  }
  return false;
}

TransferFunction MakeFunction(vtkVolumeProperty* property, int component, FunctionRules& rules)
{
  PropertyTransferFunction made =
    TransferFunctionFromProperty(property, rules.MaximumError, rules.LongestPath, component);
  rules.Error += made.Error;
  RemoveUnitDistance(made.Function, property->GetScalarOpacityUnitDistance(component));
  if (rules.OpacitiesAreShares)
  {
    ClampOpacities(made.Function);
  }
  return std::move(made.Function);
}

TransferFunction MakeGradientOpacity(
  vtkVolumeProperty* property, int component, FunctionRules& rules)
{
  return HasGradientOpacity(property, component)
    ? MakeOpacity(property->GetGradientOpacity(component), rules)
    : TransferFunction();
}

void SetIndependentComponents(
  vtkVolumeProperty* property, int components, FunctionRules& rules, ImageOptics& optics)
{
  optics.Components = ImageComponents::Independent;
  optics.Weight = property->GetComponentWeight(0);
  for (int component = 1; component < components; ++component)
  {
    ComponentOptics other;
    other.Function = MakeFunction(property, component, rules);
    other.UnitDistance = property->GetScalarOpacityUnitDistance(component);
    other.GradientOpacity = MakeGradientOpacity(property, component, rules);
    other.Weight = property->GetComponentWeight(component);
    other.Shaded = property->GetShade(component) != 0;
    other.Surface = GetMaterial(property, component);
    optics.OtherComponents.push_back(std::move(other));
  }
}

void SetDependentComponents(int valueType, ImageOptics& optics)
{
  optics.Components = ImageComponents::Dependent;
  std::fill_n(optics.ColorScale, 3, 1 / GetLargestChannel(valueType));
}

void SetLabels(vtkVolumeProperty* property, FunctionRules& rules, ImageOptics& optics)
{
  const std::set<int> labels = property->GetLabelMapLabels();
  if (labels.empty())
  {
    return;
  }
  if (*labels.begin() < 0 || *labels.rbegin() > LargestLabel)
  {
    throw std::invalid_argument("the property has functions of label " +
      std::to_string(*labels.begin() < 0 ? *labels.begin() : *labels.rbegin()) +
      "; labels of image data are from 0 to " + std::to_string(LargestLabel));
  }
  const LabelOptics plain = { optics.Function, optics.GradientOpacity };
  optics.Labels.assign(*labels.rbegin(), plain);
  for (const int label : labels)
  {
    if (label == 0)
    {
      continue; // VTK shows it as what has no label
    }
    vtkNew<vtkVolumeProperty> own;
    vtkColorTransferFunction* color = property->GetLabelColor(label);
    vtkPiecewiseFunction* opacity = property->GetLabelScalarOpacity(label);
    vtkPiecewiseFunction* gradientOpacity = property->GetLabelGradientOpacity(label);
    if (color || property->GetColorChannels() == 3)
    {
      own->SetColor(color ? color : property->GetRGBTransferFunction());
    }
    else
    {
      own->SetColor(property->GetGrayTransferFunction());
    }
    own->SetScalarOpacity(opacity ? opacity : property->GetScalarOpacity());
    LabelOptics& optic = optics.Labels[label - 1];
    optic.Function = MakeFunction(own, 0, rules);
    if (gradientOpacity)
    {
      optic.GradientOpacity = MakeOpacity(gradientOpacity, rules);
    }
  }
}

void AddComponentsAndLabels(vtkVolumeProperty* property, int components, CacheKey& key)
{
  key.Add(property->GetMTime()); // weights, shading, which functions there are
  const auto add = [&key](vtkObject* function)
  {
    key.Add(function);
    key.Add(function ? function->GetMTime() : 0);
  };
  for (int component = 0; component < components; ++component)
  {
    property->GetColorChannels(component) == 3 ? add(property->GetRGBTransferFunction(component))
                                               : add(property->GetGrayTransferFunction(component));
    add(property->GetScalarOpacity(component));
    // Where there is none, the getter would make one, which VTK's mappers take for one of the user.
    add(
      property->HasGradientOpacity(component) ? property->GetGradientOpacity(component) : nullptr);
  }
  for (const int label : property->GetLabelMapLabels())
  {
    key.Add(label);
    add(property->GetLabelColor(label));
    add(property->GetLabelScalarOpacity(label));
    add(property->GetLabelGradientOpacity(label));
  }
}

} // namespace tetralux
