// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/MapperProperties.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace
{

/// One property: how its value is read from text. option is what an error calls it.
struct Property
{
  std::string Name;
  std::function<void(
    vtkTetrahedraVolumeMapper*, const std::string& option, const std::string& text)>
    Set;
};

using Properties = std::vector<Property>;

template <class MapperT, class ValueT>
Property MakeReal(
  const std::string& name, void (MapperT::*set)(ValueT), double minimum, double maximum)
{
  return { name,
    [=](vtkTetrahedraVolumeMapper* mapper, const std::string& option, const std::string& text)
    {
      const double value = ParseNumber(option, text);
      if (value < minimum || value > maximum)
      {
        throw UsageError(option + ": '" + text + "' is not a number from " + FormatNumber(minimum) +
          " to " + FormatNumber(maximum));
      }
      (static_cast<MapperT*>(mapper)->*set)(static_cast<ValueT>(value));
    } };
}

template <class MapperT>
Property MakeInteger(const std::string& name, void (MapperT::*set)(int), int minimum, int maximum)
{
  return { name,
    [=](vtkTetrahedraVolumeMapper* mapper, const std::string& option, const std::string& text)
    { (static_cast<MapperT*>(mapper)->*set)(ParseInteger(option, text, minimum, maximum)); } };
}

template <class MapperT>
Property MakeSwitch(const std::string& name, void (MapperT::*set)(vtkTypeBool))
{
  return MakeInteger(name, set, 0, 1);
}

/// Those that all mappers have.
Properties MakeCommonProperties()
{
  using Mapper = vtkTetrahedraVolumeMapper;
  return {
    { "BlendMode",
      [](vtkTetrahedraVolumeMapper* mapper, const std::string& option, const std::string& text)
      {
        const std::map<std::string, int> modes = { { "composite", Mapper::COMPOSITE_BLEND },
          { "maximum-intensity", Mapper::MAXIMUM_INTENSITY_BLEND },
          { "additive", Mapper::ADDITIVE_BLEND }, { "isosurface", Mapper::ISOSURFACE_BLEND },
          { "absorption", Mapper::ABSORPTION_BLEND } };
        const auto mode = modes.find(text);
        if (mode == modes.end())
        {
          std::vector<std::string> names;
          for (const auto& [name, number] : modes)
          {
            names.push_back(name);
          }
          throw UsageError(option + ": '" + text + "' is none of " + JoinNames(names));
        }
        mapper->SetBlendMode(mode->second);
      } },
    MakeSwitch("Cropping", &Mapper::SetCropping),
    MakeInteger("CroppingRegionFlags", &Mapper::SetCroppingRegionFlags, 0, 0x7ffffff),
    { "CroppingRegionPlanes",
      [](vtkTetrahedraVolumeMapper* mapper, const std::string& option, const std::string& text)
      {
        const std::vector<double> planes =
          ParseNumbers(option, text, 6, "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX");
        mapper->SetCroppingRegionPlanes(planes.data());
      } },
    MakeInteger(
      "Integration", &Mapper::SetIntegration, Mapper::AUTOMATIC_INTEGRATION, Mapper::TABLE),
    MakeSwitch("IntermixIntersectingGeometry", &Mapper::SetIntermixIntersectingGeometry),
    MakeReal("MaximumError", &Mapper::SetMaximumError, 0, 1),
    MakeSwitch("SmoothShading", &Mapper::SetSmoothShading),
    MakeInteger(
      "TableFormat", &Mapper::SetTableFormat, Mapper::AUTOMATIC_FORMAT, Mapper::FLOAT_FORMAT),
    MakeInteger("TableLengthScale", &Mapper::SetTableLengthScale, Mapper::AUTOMATIC_SCALE,
      Mapper::LOGARITHMIC_SCALE),
    MakeInteger("TableLengthSize", &Mapper::SetTableLengthSize, 0, 4096),
    MakeReal("TableMaximumBytes", &Mapper::SetTableMaximumBytes, 65536, 1e12),
    MakeInteger(
      "TableScalarAxis", &Mapper::SetTableScalarAxis, Mapper::AUTOMATIC_AXIS, Mapper::NODES_AXIS),
    MakeInteger("TableScalarSize", &Mapper::SetTableScalarSize, 0, 4096),
  };
}

Properties MakeRayCastProperties()
{
  using Mapper = vtkTetrahedraRayCastMapper;
  return {
    MakeSwitch("AutoAdjustSampleDistances", &Mapper::SetAutoAdjustSampleDistances),
    MakeReal("ImageSampleDistance", &Mapper::SetImageSampleDistance, 0.1, 100),
    MakeReal("MaximumImageSampleDistance", &Mapper::SetMaximumImageSampleDistance, 0.1, 100),
    MakeReal("MinimumImageSampleDistance", &Mapper::SetMinimumImageSampleDistance, 0.1, 100),
    MakeInteger("NumberOfThreads", &Mapper::SetNumberOfThreads, 0, 1024),
    MakeInteger(
      "Precision", &Mapper::SetPrecision, Mapper::AUTOMATIC_PRECISION, Mapper::DOUBLE_PRECISION),
    MakeInteger("Reentry", &Mapper::SetReentry, Mapper::AUTOMATIC_REENTRY, Mapper::IMAGINARY_CELLS),
  };
}

Properties WithCommonProperties(Properties properties)
{
  Properties common = MakeCommonProperties();
  properties.insert(properties.end(), common.begin(), common.end());
  std::sort(properties.begin(), properties.end(),
    [](const Property& a, const Property& b) { return a.Name < b.Name; });
  return properties;
}

Properties MakeGpuRayCastProperties()
{
  using Mapper = vtkTetrahedraGPURayCastMapper;
  return {
    MakeSwitch("CountFragments", &Mapper::SetCountFragments),
    MakeInteger("Reentry", &Mapper::SetReentry, Mapper::AUTOMATIC_REENTRY, Mapper::NO_REENTRY),
    MakeInteger("StepsPerPass", &Mapper::SetStepsPerPass, 1, 65535),
  };
}

Properties MakeProjectionProperties()
{
  using Mapper = vtkTetrahedraProjectionMapper;
  return {
    MakeSwitch("AlphaDithering", &Mapper::SetAlphaDithering),
    MakeInteger(
      "ColorBuffer", &Mapper::SetColorBuffer, Mapper::AUTOMATIC_BUFFER, Mapper::UNORM8_BUFFER),
    MakeInteger("Order", &Mapper::SetOrder, Mapper::AUTOMATIC_ORDER, Mapper::CENTROID_ORDER),
    MakeSwitch("PerspectiveInterpolation", &Mapper::SetPerspectiveInterpolation),
  };
}

/// All properties of each mapper, by name.
const std::map<std::string, Properties>& GetPropertiesOfMappers()
{
  static const std::map<std::string, Properties> ofMappers = {
    { "vtkTetrahedraGPURayCastMapper", WithCommonProperties(MakeGpuRayCastProperties()) },
    { "vtkTetrahedraProjectionMapper", WithCommonProperties(MakeProjectionProperties()) },
    { "vtkTetrahedraRayCastMapper", WithCommonProperties(MakeRayCastProperties()) },
  };
  return ofMappers;
}

const Properties& GetProperties(vtkTetrahedraVolumeMapper* mapper)
{
  return GetPropertiesOfMappers().at(mapper->GetClassName());
}

} // namespace

std::vector<std::string> GetPropertyNames(vtkTetrahedraVolumeMapper* mapper)
{
  std::vector<std::string> names;
  for (const Property& property : GetProperties(mapper))
  {
    names.push_back(property.Name);
  }
  return names;
}

std::vector<std::string> GetPropertyNames()
{
  std::set<std::string> names;
  for (const auto& [mapper, properties] : GetPropertiesOfMappers())
  {
    for (const Property& property : properties)
    {
      names.insert(property.Name);
    }
  }
  return { names.begin(), names.end() };
}

bool HasProperty(vtkTetrahedraVolumeMapper* mapper, const std::string& name)
{
  const std::vector<std::string> names = GetPropertyNames(mapper);
  return std::find(names.begin(), names.end(), name) != names.end();
}

void SetProperty(vtkTetrahedraVolumeMapper* mapper, const std::string& assignment)
{
  const auto [name, value] = ParseAssignment("--set", assignment);
  for (const Property& property : GetProperties(mapper))
  {
    if (property.Name == name)
    {
      property.Set(mapper, "--set " + name, value);
      return;
    }
  }
  throw UsageError("--set: the mapper has no property '" + name + "'; there are " +
    JoinNames(GetPropertyNames(mapper)));
}
