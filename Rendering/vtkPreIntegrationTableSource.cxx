// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPreIntegrationTableSource.h"

#include "Integral/IntegrationPlan.h"
#include "Optics/IntervalTable.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationError.h"
#include "Preparation/TransferFunctionFromProperty.h"
#include "Properties/PropertySetters.h"

#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

using Mapper = vtkTetrahedraVolumeMapper;

namespace
{

/// Functions that are not piecewise linear are subdivided up to this error of a colour channel, on
/// paths of a hundred of the longest segments: that of a table with some hundred texels.
constexpr double FunctionError = 1e-5;
constexpr double SegmentsOfAPath = 100;

template <class Array, class T>
void AddField(
  vtkImageData* image, const char* name, const T* values, vtkIdType count, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count / components);
  std::copy_n(values, count, array->GetPointer(0));
  image->GetFieldData()->AddArray(array);
}

void AddNumbers(vtkImageData* image, const char* name, const std::vector<double>& values)
{
  AddField<vtkDoubleArray>(image, name, values.data(), static_cast<vtkIdType>(values.size()));
}

void AddError(vtkImageData* image, const char* name, const tetralux::PreIntegrationError& error)
{
  AddNumbers(image, name, { error.Segment, error.PerLength, error.Rounding });
}

/// Four components for each texel.
template <class Array, class T>
void SetTexels(vtkImageData* image, const T* texels, std::size_t count)
{
  vtkNew<Array> array;
  array->SetName("RGBA");
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  std::memcpy(array->GetPointer(0), texels, 4 * count * sizeof(T));
  image->GetPointData()->SetScalars(array);
}

void SetTexels(vtkImageData* image, const tetralux::PreIntegrationTable& table)
{
  const std::uint8_t* data = table.Texels.GetData();
  const std::size_t n = table.Scalars.GetSize();
  const std::size_t count = n * n * table.Lengths.Size;
  switch (table.Settings.Format)
  {
    case tetralux::TexelFormat::UNorm8:
      return SetTexels<vtkUnsignedCharArray>(image, data, count);
    case tetralux::TexelFormat::UNorm16:
      return SetTexels<vtkUnsignedShortArray>(
        image, reinterpret_cast<const unsigned short*>(data), count);
    case tetralux::TexelFormat::Float:
      return SetTexels<vtkFloatArray>(image, reinterpret_cast<const float*>(data), count);
    case tetralux::TexelFormat::Half:
      break;
  }
  std::vector<float> values(4 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    table.GetTexel(static_cast<int>(i % n), static_cast<int>(i / n % n),
      static_cast<int>(i / (n * n)), &values[4 * i]);
  }
  SetTexels<vtkFloatArray>(image, values.data(), count);
}

/// The values of a property of the mappers, without the one that leaves the choice to them.
std::vector<tetralux::NamedValue> GetDefiniteValues(const char* property)
{
  std::vector<tetralux::NamedValue> values =
    GetNamedValues(tetralux::GetMapperProperty(property), tetralux::VolumeKinds);
  values.erase(
    std::remove_if(values.begin(), values.end(),
      [](const tetralux::NamedValue& value) { return std::string(value.Name) == "automatic"; }),
    values.end());
  return values;
}

} // namespace

/// What is to be built, as far as it needs no texels.
struct vtkPreIntegrationTableSource::Plan
{
  tetralux::PropertyTransferFunction Property;
  tetralux::PreIntegrationSettings Settings;
  tetralux::ScalarAxisMap Scalars; ///< 3-D only
  int Dimensions[3] = { 1, 1, 1 };
  double Origin[3] = { 0, 0, 0 };
  double Spacing[3] = { 1, 1, 1 };
};

vtkStandardNewMacro(vtkPreIntegrationTableSource);

vtkPreIntegrationTableSource::vtkPreIntegrationTableSource() { this->SetNumberOfInputPorts(0); }

vtkPreIntegrationTableSource::~vtkPreIntegrationTableSource() = default;

void vtkPreIntegrationTableSource::SetVolumeProperty(vtkVolumeProperty* property)
{
  if (this->VolumeProperty != property)
  {
    this->VolumeProperty = property;
    this->Modified();
  }
}

vtkVolumeProperty* vtkPreIntegrationTableSource::GetVolumeProperty()
{
  return this->VolumeProperty;
}

vtkMTimeType vtkPreIntegrationTableSource::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->VolumeProperty ? std::max(own, this->VolumeProperty->GetMTime()) : own;
}

vtkPreIntegrationTableSource::Plan vtkPreIntegrationTableSource::MakePlan()
{
  if (!this->VolumeProperty)
  {
    throw std::invalid_argument("no VolumeProperty is set");
  }
  Plan plan;
  plan.Property = tetralux::TransferFunctionFromProperty(
    this->VolumeProperty, FunctionError, SegmentsOfAPath * this->LongestSegment);
  const auto& nodes = plan.Property.Function.Nodes;

  tetralux::PreIntegrationSettings& settings = plan.Settings;
  settings.ScalarSize = this->ScalarSize;
  settings.LengthSize = this->LengthSize;
  settings.Scale = this->LengthScale == Mapper::LOGARITHMIC_SCALE
    ? tetralux::LengthScale::Logarithmic
    : tetralux::LengthScale::Linear;
  settings.StepsPerDoubling = this->StepsPerDoubling;
  settings.Axis = this->ScalarAxis == Mapper::NODES_AXIS ? tetralux::ScalarAxis::Nodes
                                                         : tetralux::ScalarAxis::Uniform;
  settings.Format = static_cast<tetralux::TexelFormat>(this->Format - Mapper::UNORM8_FORMAT);
  std::copy_n(this->ScalarRange, 2, settings.ScalarRange);
  if (this->ScalarRange[0] > this->ScalarRange[1])
  {
    settings.ScalarRange[0] = nodes.front().Scalar;
    settings.ScalarRange[1] = nodes.back().Scalar;
  }
  settings.LongestSegment = this->LongestSegment;

  const double lo = settings.ScalarRange[0];
  const double step = (settings.ScalarRange[1] - lo) / (settings.ScalarSize - 1);
  const auto setScalarAxis = [&](int axis, int size, bool equalSteps)
  {
    plan.Dimensions[axis] = size;
    if (equalSteps)
    {
      plan.Origin[axis] = lo;
      plan.Spacing[axis] = step;
    }
  };
  if (this->BlendMode != Mapper::COMPOSITE_BLEND)
  {
    setScalarAxis(0, settings.ScalarSize, true);
    if (this->BlendMode != Mapper::MAXIMUM_INTENSITY_BLEND)
    {
      setScalarAxis(1, settings.ScalarSize, true);
    }
    return plan;
  }
  plan.Scalars = tetralux::MakeScalarAxis(plan.Property.Function, settings);
  const tetralux::LengthAxisMap lengths = tetralux::MakeLengthAxis(settings);
  // A single scalar got a range of its own.
  const bool equalSteps = settings.Axis == tetralux::ScalarAxis::Uniform && step > 0;
  setScalarAxis(0, plan.Scalars.GetSize(), equalSteps);
  setScalarAxis(1, plan.Scalars.GetSize(), equalSteps);
  plan.Dimensions[2] = lengths.Size;
  if (settings.Scale == tetralux::LengthScale::Linear)
  {
    plan.Spacing[2] = lengths.Delta;
  }
  return plan;
}

int vtkPreIntegrationTableSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  try
  {
    const Plan plan = this->MakePlan();
    vtkInformation* info = outputVector->GetInformationObject(0);
    const int extent[6] = { 0, plan.Dimensions[0] - 1, 0, plan.Dimensions[1] - 1, 0,
      plan.Dimensions[2] - 1 };
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::ORIGIN(), plan.Origin, 3);
    info->Set(vtkDataObject::SPACING(), plan.Spacing, 3);
    vtkDataObject::SetPointDataActiveScalarInfo(info,
      this->Format == Mapper::UNORM8_FORMAT      ? VTK_UNSIGNED_CHAR
        : this->Format == Mapper::UNORM16_FORMAT ? VTK_UNSIGNED_SHORT
                                                 : VTK_FLOAT,
      4);
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

int vtkPreIntegrationTableSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkImageData* image = vtkImageData::GetData(outputVector);
  try
  {
    const Plan plan = this->MakePlan();
    const tetralux::TransferFunction& function = plan.Property.Function;
    image->SetDimensions(plan.Dimensions);
    image->SetOrigin(plan.Origin);
    image->SetSpacing(plan.Spacing);
    AddNumbers(image, "FunctionError", { plan.Property.Error });

    const double* range = plan.Settings.ScalarRange;
    if (this->BlendMode != Mapper::COMPOSITE_BLEND)
    {
      // Opacity is not per length where there is no length.
      tetralux::TransferFunction opacities = function;
      for (tetralux::TransferFunction::Node& node : opacities.Nodes)
      {
        node.Left.Attenuation *= this->VolumeProperty->GetScalarOpacityUnitDistance();
        node.Right.Attenuation *= this->VolumeProperty->GetScalarOpacityUnitDistance();
      }
      tetralux::ScalarTable table;
      if (this->BlendMode == Mapper::MAXIMUM_INTENSITY_BLEND)
      {
        table = tetralux::MakeTransferTable(opacities, range, this->ScalarSize);
      }
      else if (this->BlendMode == Mapper::ISOSURFACE_BLEND)
      {
        std::vector<tetralux::Isosurface> surfaces;
        vtkContourValues* values = this->VolumeProperty->GetIsoSurfaceValues();
        for (int i = 0; i < values->GetNumberOfContours(); ++i)
        {
          const double scalar = values->GetValue(i);
          const auto value = tetralux::Evaluate(opacities, scalar);
          tetralux::Isosurface surface{ scalar, {}, 0 };
          std::copy_n(value.Color, 3, surface.Color);
          surface.Opacity = static_cast<float>(std::min(value.Attenuation, 1.));
          surfaces.push_back(surface);
        }
        std::sort(surfaces.begin(), surfaces.end(),
          [](const tetralux::Isosurface& a, const tetralux::Isosurface& b)
          { return a.Value < b.Value; });
        const auto same = [](const tetralux::Isosurface& a, const tetralux::Isosurface& b)
        { return a.Value == b.Value; };
        surfaces.erase(std::unique(surfaces.begin(), surfaces.end(), same), surfaces.end());
        table = tetralux::MakeIsosurfaceTable(surfaces, range, this->ScalarSize);
      }
      else
      {
        table = tetralux::MakeMeanTable(function, range, this->ScalarSize);
      }
      std::vector<double> texels(table.Size);
      for (int i = 0; i < table.Size; ++i)
      {
        texels[i] = table.GetScalar(i);
      }
      AddNumbers(image, "ScalarTexels", texels);
      SetTexels<vtkFloatArray>(image, table.Texels.data(), table.Texels.size() / 4);
      return 1;
    }

    tetralux::PreIntegrationTable table;
    tetralux::BuildPreIntegrationTable(function, plan.Settings, table);
    const tetralux::LengthAxisMap& lengths = table.Lengths;
    std::vector<double> lengthTexels(lengths.Size);
    for (int r = 0; r < lengths.Size; ++r)
    {
      lengthTexels[r] = lengths.GetLength(r);
    }
    AddNumbers(image, "ScalarTexels", table.Scalars.Texels);
    AddNumbers(image, "LengthTexels", lengthTexels);
    AddNumbers(image, "DeltaLength", { lengths.Delta });
    const int steps = lengths.Scale == tetralux::LengthScale::Linear ? 0 : lengths.StepsPerDoubling;
    AddField<vtkIntArray>(image, "StepsPerDoubling", &steps, 1);
    AddField<vtkFloatArray>(image, "ScalarAxisIntervals", &table.Scalars.Intervals.front().Lo,
      4 * static_cast<vtkIdType>(table.Scalars.Intervals.size()), 4);
    AddNumbers(image, "ScalarOffsetAndScale", { table.Scalars.Offset, table.Scalars.Scale });
    AddError(image, "ErrorBound", table.Bound);
    AddError(image, "ErrorEstimate", tetralux::EstimatePreIntegrationError(function, table));
    SetTexels(image, table);
    return 1;
  }
  catch (const std::exception& error)
  {
    image->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkPreIntegrationTableSource::SetBlendMode(int value)
{
  tetralux::SetEnumeration(
    this, "BlendMode", GetDefiniteValues("BlendMode"), this->BlendMode, value);
}

const char* vtkPreIntegrationTableSource::GetBlendModeAsString()
{
  return tetralux::GetValueName("BlendMode", this->BlendMode);
}

void vtkPreIntegrationTableSource::SetLengthScale(int value)
{
  tetralux::SetEnumeration(
    this, "LengthScale", GetDefiniteValues("TableLengthScale"), this->LengthScale, value);
}

const char* vtkPreIntegrationTableSource::GetLengthScaleAsString()
{
  return tetralux::GetValueName("TableLengthScale", this->LengthScale);
}

void vtkPreIntegrationTableSource::SetScalarAxis(int value)
{
  tetralux::SetEnumeration(
    this, "ScalarAxis", GetDefiniteValues("TableScalarAxis"), this->ScalarAxis, value);
}

const char* vtkPreIntegrationTableSource::GetScalarAxisAsString()
{
  return tetralux::GetValueName("TableScalarAxis", this->ScalarAxis);
}

void vtkPreIntegrationTableSource::SetFormat(int value)
{
  tetralux::SetEnumeration(this, "Format", GetDefiniteValues("TableFormat"), this->Format, value);
}

const char* vtkPreIntegrationTableSource::GetFormatAsString()
{
  return tetralux::GetValueName("TableFormat", this->Format);
}

void vtkPreIntegrationTableSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "VolumeProperty: " << this->VolumeProperty << '\n';
  os << indent << "ScalarRange: " << this->ScalarRange[0] << ", " << this->ScalarRange[1] << '\n';
  os << indent << "LongestSegment: " << this->LongestSegment << '\n';
  os << indent << "BlendMode: " << this->GetBlendModeAsString() << '\n';
  os << indent << "ScalarSize: " << this->ScalarSize << '\n';
  os << indent << "LengthSize: " << this->LengthSize << '\n';
  os << indent << "LengthScale: " << this->GetLengthScaleAsString() << '\n';
  os << indent << "StepsPerDoubling: " << this->StepsPerDoubling << '\n';
  os << indent << "ScalarAxis: " << this->GetScalarAxisAsString() << '\n';
  os << indent << "Format: " << this->GetFormatAsString() << '\n';
}
