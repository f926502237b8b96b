// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImagePreparation.h"

#include "Base/Stopwatch.h"
#include "ImagePreparation/ImageBlends.h"
#include "ImagePreparation/ImageObstacles.h"
#include "ImagePreparation/ScalarRange.h"
#include "ImagePreparation/TransferTableFromProperty.h"
#include "Integral/ErrorBudget.h"
#include "Preparation/InputSignature.h"
#include "Preparation/IsosurfacesFromProperty.h"
#include "Preparation/TransferFunctionFromProperty.h"

#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
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

/// Opacities above 1 count as 1.
void ClampOpacities(TransferFunction& function)
{
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Left.Attenuation = std::min(node.Left.Attenuation, 1.);
    node.Right.Attenuation = std::min(node.Right.Attenuation, 1.);
  }
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

/// The gradient opacity of a property, in the place of attenuation; error: receives what
/// approximating it adds.
TransferFunction MakeGradientOpacity(
  vtkVolumeProperty* property, double maximumError, double longestPath, double& error)
{
  vtkNew<vtkVolumeProperty> gradients;
  gradients->SetScalarOpacity(property->GetGradientOpacity(0));
  PropertyTransferFunction function =
    TransferFunctionFromProperty(gradients, maximumError, longestPath);
  error = function.Error;
  ClampOpacities(function.Function);
  return std::move(function.Function);
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
  if (this->Scalars.Update(image, input.Scalars))
  {
    this->Caster.SetVolume(this->Scalars.GetVolume());
    this->ScalarsSeconds = stopwatch.GetSeconds();
    this->Rebuilt.emplace_back("scalars");
  }
  this->Placement = PlaceImage(image);
  this->PrepareFunction(input, FindSelectedArray(image, input.Scalars));
  this->UnusedWarning.Update(this->Source,
    DescribeUnused(input.Property, input.Blend, this->Scalars.GetNumberOfComponents(),
      input.Scalars.VectorMode));
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
  const double maximumError =
    std::max(MakeErrorBudget(input.MaximumError, spending).Functions, SmallestFunctionError);
  CacheKey exactKey = GetPropertyKey(input.Property);
  exactKey.Add(input.Opacity);
  AddBlend(optics, exactKey);
  const bool hasGradients = input.Blend == ImageBlend::Composite && !hasTable &&
    tetralux::HasGradientOpacity(input.Property);
  exactKey.Add(hasGradients);
  exactKey.Add(hasTable);
  if (hasGradients || hasTable)
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
  PropertyTransferFunction function =
    TransferFunctionFromProperty(input.Property, maximumError, longestPath);
  optics.UnitDistance = input.Property->GetScalarOpacityUnitDistance(0);
  RemoveUnitDistance(function.Function, optics.UnitDistance);
  if (input.Opacity == StepOpacity::Power || IsOpacityOfPoints(input.Blend))
  {
    ClampOpacities(function.Function);
  }
  if (input.Blend == ImageBlend::Isosurfaces)
  {
    optics.Surfaces = IsosurfacesFromProperty(input.Property, function.Function);
  }
  optics.Function = std::move(function.Function);
  optics.Opacity = input.Opacity;
  this->FunctionError = function.Error;
  if (hasGradients)
  {
    double error;
    optics.GradientOpacity = MakeGradientOpacity(input.Property, maximumError, longestPath, error);
    this->FunctionError += error;
  }
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
  double largest = tetralux::GetLargestColor(this->Optics.Function);
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
  input["points"] = GetNumberOfValues(volume);
  input["dimensions"] = { volume.Dimensions[0], volume.Dimensions[1], volume.Dimensions[2] };
  input["array"] = this->Scalars.GetArrayName();
  input["array_type"] = this->Scalars.GetTypeName();
  input["array_of"] = "points";
  input["copied_bytes"] = this->Scalars.GetNumberOfCopiedBytes();
  input["transfer_function_nodes"] = this->Optics.Function.Nodes.size();
  return input;
}

} // namespace tetralux
