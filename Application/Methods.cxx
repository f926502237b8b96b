// SPDX-License-Identifier: BSD-3-Clause
#include "Methods.h"

#include "CommandErrors.h"
#include "OptionValues.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <functional>
#include <map>

namespace
{

using Mapper = vtkTetrahedraRayCastMapper;

/// One property: how its value is read from text. option is what an error calls it.
struct Property
{
  std::string Name;
  std::function<void(Mapper*, const std::string& option, const std::string& text)> Set;
};

template <class ValueT>
Property MakeReal(
  const std::string& name, void (Mapper::*set)(ValueT), double minimum, double maximum)
{
  return { name,
    [=](Mapper* mapper, const std::string& option, const std::string& text)
    {
      const double value = ParseNumber(option, text);
      if (value < minimum || value > maximum)
      {
        throw UsageError(option + ": '" + text + "' is not a number from " + FormatNumber(minimum) +
          " to " + FormatNumber(maximum));
      }
      (mapper->*set)(static_cast<ValueT>(value));
    } };
}

Property MakeInteger(const std::string& name, void (Mapper::*set)(int), int minimum, int maximum)
{
  return { name, [=](Mapper* mapper, const std::string& option, const std::string& text) {
            (mapper->*set)(ParseInteger(option, text, minimum, maximum));
          } };
}

Property MakeSwitch(const std::string& name, void (Mapper::*set)(vtkTypeBool))
{
  return MakeInteger(name, set, 0, 1);
}

const std::vector<Property>& GetProperties()
{
  static const std::vector<Property> properties = {
    MakeSwitch("AutoAdjustSampleDistances", &Mapper::SetAutoAdjustSampleDistances),
    { "BlendMode",
      [](Mapper* mapper, const std::string& option, const std::string& text)
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
      [](Mapper* mapper, const std::string& option, const std::string& text)
      {
        const std::vector<double> planes =
          ParseNumbers(option, text, 6, "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX");
        mapper->SetCroppingRegionPlanes(planes.data());
      } },
    MakeReal("ImageSampleDistance", &Mapper::SetImageSampleDistance, 0.1, 100),
    MakeInteger(
      "Integration", &Mapper::SetIntegration, Mapper::AUTOMATIC_INTEGRATION, Mapper::TABLE),
    MakeSwitch("IntermixIntersectingGeometry", &Mapper::SetIntermixIntersectingGeometry),
    MakeReal("MaximumError", &Mapper::SetMaximumError, 0, 1),
    MakeReal("MaximumImageSampleDistance", &Mapper::SetMaximumImageSampleDistance, 0.1, 100),
    MakeReal("MinimumImageSampleDistance", &Mapper::SetMinimumImageSampleDistance, 0.1, 100),
    MakeInteger("NumberOfThreads", &Mapper::SetNumberOfThreads, 0, 1024),
    MakeInteger(
      "Precision", &Mapper::SetPrecision, Mapper::AUTOMATIC_PRECISION, Mapper::DOUBLE_PRECISION),
    MakeInteger("Reentry", &Mapper::SetReentry, Mapper::AUTOMATIC_REENTRY, Mapper::IMAGINARY_CELLS),
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
  return properties;
}

} // namespace

std::vector<std::string> GetMethodNames() { return { "auto", "ray-cast" }; }

std::string ResolveMethod(const std::string& name)
{
  const std::vector<std::string> names = GetMethodNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
  {
    throw UsageError(
      "--method: this version has no method '" + name + "'; there are " + JoinNames(names));
  }
  return name == "auto" ? "ray-cast" : name;
}

std::vector<std::string> GetPropertyNames()
{
  std::vector<std::string> names;
  for (const Property& property : GetProperties())
  {
    names.push_back(property.Name);
  }
  return names;
}

void SetProperty(vtkTetrahedraRayCastMapper* mapper, const std::string& assignment)
{
  const auto [name, value] = ParseAssignment("--set", assignment);
  for (const Property& property : GetProperties())
  {
    if (property.Name == name)
    {
      property.Set(mapper, "--set " + name, value);
      return;
    }
  }
  throw UsageError(
    "--set: the mapper has no property '" + name + "'; there are " + JoinNames(GetPropertyNames()));
}
