// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImagePreparation.h"

#include "Base/Stopwatch.h"
#include "ImagePreparation/ImageBlends.h"
#include "ImagePreparation/ImageFunctions.h"
#include "ImagePreparation/ImageObstacles.h"
#include "ImagePreparation/ScalarRange.h"
#include "ImagePreparation/TransferTableFromProperty.h"
#include "Integral/ErrorBudget.h"
#include "Preparation/InputSignature.h"
#include "Preparation/IsosurfacesFromProperty.h"
#include "Preparation/TransferFunctionFromProperty.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

void Check(const std::string& obstacle)
{
  if (!obstacle.empty())
  {
    throw std::invalid_argument(obstacle);
  }
}

/// The longest way through a volume, world units: a power of two that is above it, so that a
/// volume which grows a little changes nothing.
double FindLongestPath(const ImageVolume& volume, const double steps[3])
{
  double squares = 0;
  for (int a = 0; a < 3; ++a)
  {
    const double edge = (volume.Dimensions[a] - 1) * steps[a];
    squares += edge * edge;
  }
  return std::exp2(std::ceil(std::log2(std::sqrt(squares))));
}

/// The largest absolute value of red, green and blue that are components.
double FindLargestChannel(vtkDataArray* array, const double scale[3])
{
  double largest = 0;
  for (int c = 0; c < 3; ++c)
  {
    double range[2];
    array->GetFiniteRange(range, c);
    if (range[0] <= range[1])
    {
      largest = std::max({ largest, scale[c] * std::abs(range[0]), scale[c] * std::abs(range[1]) });
    }
  }
  return largest;
}

/// Whether opacities are those of points, not of lengths.
bool IsOpacityOfPoints(ImageBlend blend)
{
  return blend != ImageBlend::Composite && blend != ImageBlend::Additive;
}

/// What blend modes take from elsewhere than functions.
void AddBlend(const ImageOptics& optics, CacheKey& key)
{
  key.Add(optics.Blend);
  for (int side = 0; side < 2; ++side)
  {
    key.Add(optics.AverageRange[side]);
    key.Add(optics.GreyRange[side]);
  }
  for (const double coefficient : optics.SlicePlane)
  {
    key.Add(coefficient);
  }
}

} // namespace

ImagePreparation::ImagePreparation(vtkObject* source)
  : Source(source)
{
}

void ImagePreparation::Update(const ImageInput& input)
{
  this->Rebuilt.clear();
  this->ScalarsSeconds = this->FunctionSeconds = 0;
  auto* image = vtkImageData::SafeDownCast(input.Data);
  if (!image)
  {
    throw std::invalid_argument(FindObstacle(input.Data, input.Scalars));
  }
  Check(FindObstacle(input.Property, input.Blend));
  const Stopwatch stopwatch;
  const bool hasNewScalars = this->Scalars.Update(image, input.Scalars);
  const ImageVolume& scalars = this->Scalars.GetVolume();
  if (this->Mask.Update(input.Mask, input.Type, scalars.Dimensions) || hasNewScalars)
  {
    ImageVolume volume = scalars;
    this->Mask.AddTo(volume);
    this->Caster.SetVolume(volume);
    this->ScalarsSeconds = stopwatch.GetSeconds();
    this->Rebuilt.emplace_back("scalars");
  }
  this->Placement = PlaceImage(image);
  this->PrepareFunction(input, FindSelectedArray(image, input.Scalars));
  if (!this->Rebuilt.empty())
  {
    this->Version = MakeVersion();
  }
  this->UnusedWarning.Update(this->Source,
    DescribeUnused(input.Property, input.Blend, this->Scalars.GetNumberOfComponents(),
      input.Scalars.VectorMode, this->Mask.HasLabels()));
}

void ImagePreparation::PrepareFunction(const ImageInput& input, const SelectedArray& selected)
{
  ImageOptics optics;
  optics.Blend = input.Blend;
  std::copy_n(input.AverageRange, 2, optics.AverageRange);
  if (input.Blend == ImageBlend::Slice)
  {
    optics.SlicePlane = GetSlicePlane(input.Property);
  }
  const bool hasTable = input.Property->GetTransferFunctionMode() == vtkVolumeProperty::TF_2D;
  if (hasTable || input.Blend == ImageBlend::AverageIntensity ||
    input.Blend == ImageBlend::Additive)
  {
    const std::array<double, 2> range = FindScalarRange(selected);
    std::copy_n(range.begin(), 2, optics.GreyRange);
  }
  double steps[3];
  MeasureSteps(this->Placement, input.Matrix, steps);
  const double longestPath = FindLongestPath(this->Scalars.GetVolume(), steps);
  const double gradientLength = (steps[0] + steps[1] + steps[2]) / 3; // as VTK has it
  ErrorSpending spending;
  spending.Approximated = true;
  spending.Sliced = true; // the least that functions have
  const double maximumError =
    std::max(MakeErrorBudget(input.MaximumError, spending).Functions, SmallestFunctionError);
  CacheKey exactKey = GetPropertyKey(input.Property);
  exactKey.Add(input.Opacity);
  AddBlend(optics, exactKey);
  const bool hasGradients = input.Blend == ImageBlend::Composite && !hasTable &&
    tetralux::HasGradientOpacity(input.Property, 0);
  exactKey.Add(hasGradients);
  exactKey.Add(hasTable);
  const int components = this->Scalars.GetVolume().Components;
  const bool independent = components > 1 && input.Property->GetIndependentComponents() != 0;
  const bool hasLabels = this->Mask.HasLabels();
  exactKey.Add(components);
  exactKey.Add(independent);
  exactKey.Add(hasLabels);
  if (independent || hasLabels)
  {
    AddComponentsAndLabels(input.Property, components, exactKey);
  }
  if (hasLabels)
  {
    exactKey.Add(input.LabelShare);
  }
  double largestChannel = 0;
  if (components > 1 && !independent)
  {
    SetDependentComponents(this->Scalars.GetValueType(), optics);
    largestChannel = components == 4 ? FindLargestChannel(selected.Array, optics.ColorScale) : 0;
    exactKey.Add(this->Scalars.GetValueType());
    exactKey.Add(largestChannel);
  }
  if (hasGradients || hasTable || independent || hasLabels)
  {
    exactKey.Add(input.Norm);
    exactKey.Add(gradientLength);
    optics.GradientLength = gradientLength;
    optics.Norm = input.Norm;
  }
  if (hasTable)
  {
    vtkImageData* table = input.Property->GetTransferFunction2D();
    exactKey.Add(table);
    exactKey.Add(table ? table->GetMTime() : 0);
  }
  if (hasGradients)
  {
    exactKey.Add(input.Property->GetGradientOpacity(0));
    exactKey.Add(input.Property->GetGradientOpacity(0)->GetMTime());
  }
  CacheKey key = exactKey;
  key.Add(maximumError);
  key.Add(longestPath);
  // Error and path matter only to a property that had to be approximated.
  if (this->Function.Has(this->FunctionError == 0 ? exactKey : key))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->Function.Reset();
  FunctionRules rules;
  rules.OpacitiesAreShares = input.Opacity == StepOpacity::Power || IsOpacityOfPoints(input.Blend);
  rules.MaximumError = maximumError;
  rules.LongestPath = longestPath;
  optics.Opacity = input.Opacity;
  optics.UnitDistance = input.Property->GetScalarOpacityUnitDistance(0);
  optics.Function = MakeFunction(input.Property, 0, rules);
  if (input.Blend == ImageBlend::Isosurfaces)
  {
    optics.Surfaces = IsosurfacesFromProperty(input.Property, optics.Function);
  }
  if (hasGradients)
  {
    optics.GradientOpacity = MakeGradientOpacity(input.Property, 0, rules);
  }
  if (independent)
  {
    SetIndependentComponents(input.Property, components, rules, optics);
  }
  if (hasLabels)
  {
    SetLabels(input.Property, rules, optics);
    optics.LabelShare = input.LabelShare;
  }
  this->FunctionError = rules.Error;
  this->LargestChannel = largestChannel;
  optics.Table =
    TransferTableFromProperty(input.Property, { optics.GreyRange[0], optics.GreyRange[1] });
  this->Caster.SetOptics(optics);
  this->Optics = std::move(optics);
  this->Function.Set(this->FunctionError == 0 ? exactKey : key);
  this->FunctionSeconds = stopwatch.GetSeconds();
  this->Rebuilt.emplace_back("transfer function");
}

double ImagePreparation::GetLargestColor() const
{
  double largest = std::max(this->LargestChannel, tetralux::GetLargestColor(this->Optics.Function));
  for (const ComponentOptics& other : this->Optics.OtherComponents)
  {
    largest = std::max(largest, tetralux::GetLargestColor(other.Function));
  }
  for (const LabelOptics& label : this->Optics.Labels)
  {
    largest = std::max(largest, tetralux::GetLargestColor(label.Function));
  }
  for (const TransferTable::Entry& entry : this->Optics.Table.Entries)
  {
    for (const float channel : entry.Color)
    {
      largest = std::max(largest, std::abs(static_cast<double>(channel)));
    }
  }
  return largest;
}

Json ImagePreparation::DescribeSeconds() const
{
  Json seconds;
  seconds["scalars"] = this->ScalarsSeconds;
  seconds["transfer_function"] = this->FunctionSeconds;
  return seconds;
}

Json ImagePreparation::DescribeInput() const
{
  const ImageVolume& volume = this->Scalars.GetVolume();
  Json input;
  input["points"] = GetNumberOfPoints(volume);
  input["components"] = volume.Components;
  input["dimensions"] = { volume.Dimensions[0], volume.Dimensions[1], volume.Dimensions[2] };
  input["array"] = this->Scalars.GetArrayName();
  input["array_type"] = this->Scalars.GetTypeName();
  input["array_of"] = "points";
  input["copied_bytes"] = this->Scalars.GetNumberOfCopiedBytes();
  input["transfer_function_nodes"] = this->Optics.Function.Nodes.size();
  return input;
}

} // namespace tetralux
