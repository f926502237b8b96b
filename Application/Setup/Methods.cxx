// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/Methods.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "MapperPropertyAccess.h"
#include "Setup/MapperProperties.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTriangleCasterMapper.h"

#include "vtkNew.h"
#include "vtkRenderWindow.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace
{

struct Method
{
  std::string Name;
  std::function<vtkSmartPointer<vtkAbstractVolumeMapper>()> Make;
};

template <class MapperT>
Method MakeMethod(const std::string& name)
{
  return { name, [] { return vtkSmartPointer<MapperT>::New(); } };
}

const std::vector<Method>& GetMethods()
{
  static const std::vector<Method> methods = {
    MakeMethod<vtkTetrahedraRayCastMapper>("ray-cast"),
    MakeMethod<vtkTetrahedraGPURayCastMapper>("gpu-ray-cast"),
    MakeMethod<vtkTetrahedraProjectionMapper>("projection"),
    MakeMethod<vtkTetrahedraIsosurfaceMapper>("isosurface"),
    MakeMethod<vtkTriangleCasterMapper>("triangle-caster"),
  };
  return methods;
}

/// Names of the methods whose mappers are of these kinds.
std::string JoinMethods(unsigned kinds)
{
  std::vector<std::string> names;
  for (const Method& method : GetMethods())
  {
    if ((tetralux::GetKind(method.Make()) & kinds) != 0)
    {
      names.push_back(method.Name);
    }
  }
  return JoinNames(names);
}

/// The default as --set takes it.
std::string FormatDefault(const tetralux::MapperProperty& property)
{
  std::string text = FormatValues(property, property.Default);
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

void Describe(const tetralux::MapperProperty& property, std::ostream& text)
{
  const std::string unit = property.Unit;
  text << "  " << property.Name << "=" << FormatDefault(property) << "\n      " << property.Meaning
       << "\n";
  if (property.Type != tetralux::PropertyType::Enumeration)
  {
    constexpr unsigned WithoutNames = 0;
    text << "      " << DescribeValues(property, WithoutNames)
         << (unit.empty() ? "" : ", in " + unit) << "\n";
  }
  for (const tetralux::NamedValue& value : property.Values)
  {
    const bool ofAll = (value.Kinds & property.Kinds) == property.Kinds;
    text << "      " << value.Name << " (" << value.Number << "): " << value.Meaning
         << (ofAll ? "" : "; " + JoinMethods(value.Kinds) + " only") << "\n";
  }
}

vtkSmartPointer<vtkAbstractVolumeMapper> MakeDefaultMapper(const std::string& method)
{
  for (const Method& candidate : GetMethods())
  {
    if (candidate.Name == method)
    {
      return candidate.Make();
    }
  }
  throw UsageError("--method: this version has no method '" + method + "'; there are " +
    JoinNames(GetMethodNames()));
}

/// Returns the first property of settings that the mapper of a method has not, or an empty text.
std::string FindLackingProperty(const std::string& method, const std::vector<std::string>& settings)
{
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeDefaultMapper(method);
  for (const std::string& setting : settings)
  {
    std::string name = ParseAssignment("--set", setting).first;
    if (!HasProperty(mapper, name))
    {
      return name;
    }
  }
  return "";
}

} // namespace

std::string DescribeProperties()
{
  std::ostringstream text;
  text << "What --set takes, with defaults; AutoAdjustSampleDistances is turned off by the tool. "
          "Values are\nnames or numbers; case, '-' and '_' do not matter.\n";
  std::vector<unsigned> groups;
  for (const tetralux::MapperProperty& property : tetralux::GetMapperProperties())
  {
    if (std::find(groups.begin(), groups.end(), property.Kinds) == groups.end())
    {
      groups.push_back(property.Kinds);
    }
  }
  for (const unsigned kinds : groups)
  {
    text << "\n" << JoinMethods(kinds) << ":\n";
    for (const tetralux::MapperProperty* property : GetSettableProperties())
    {
      if (property->Kinds == kinds)
      {
        Describe(*property, text);
      }
    }
  }
  return text.str();
}

std::vector<std::string> GetMethodNames()
{
  std::vector<std::string> names = { "auto" };
  for (const Method& method : GetMethods())
  {
    names.push_back(method.Name);
  }
  return names;
}

vtkSmartPointer<vtkAbstractVolumeMapper> MakeMapper(
  const std::string& method, int numberOfThreads, const std::vector<std::string>& settings)
{
  vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeDefaultMapper(method);
  if (HasProperty(mapper, "AutoAdjustSampleDistances"))
  {
    SetProperty(mapper, "AutoAdjustSampleDistances=0");
  }
  if (HasProperty(mapper, "NumberOfThreads"))
  {
    SetProperty(mapper, "NumberOfThreads=" + std::to_string(numberOfThreads));
  }
  else if (numberOfThreads > 0)
  {
    throw UsageError("--threads: the method '" + method + "' has none to set");
  }
  for (const std::string& setting : settings)
  {
    SetProperty(mapper, setting);
  }
  return mapper;
}

bool TakesSettings(
  const std::string& method, int numberOfThreads, const std::vector<std::string>& settings)
{
  try
  {
    MakeMapper(method, numberOfThreads, settings);
    return true;
  }
  catch (const UsageError&)
  {
    return false;
  }
}

std::vector<MethodChoice> ListMethods(const std::string& method, vtkRenderWindow* window,
  int numberOfThreads, const std::vector<std::string>& settings, bool isosurfaces)
{
  if (method != "auto")
  {
    return { { method, "" } };
  }
  if (isosurfaces && FindLackingProperty("isosurface", settings).empty())
  {
    return { { "isosurface", "isosurfaces are traced" } };
  }
  if (numberOfThreads > 0)
  {
    return { { "ray-cast", "a number of threads is set" } };
  }
  std::vector<MethodChoice> methods;
  std::string reason;
  for (const char* name : { "gpu-ray-cast", "projection" })
  {
    const std::string lacking = FindLackingProperty(name, settings);
    if (lacking.empty())
    {
      methods.push_back({ name, "" });
    }
    else
    {
      reason += (reason.empty() ? "" : ", ") + std::string(name) + " has no property " + lacking;
    }
  }
  if (!methods.empty())
  {
    vtkNew<vtkTetrahedraGPURayCastMapper> rayCaster;
    if (!rayCaster->IsAccelerated(window))
    {
      methods.clear();
    }
    reason = rayCaster->GetSupportReason() + (reason.empty() ? "" : ", ") + reason;
    for (MethodChoice& choice : methods)
    {
      choice.Reason = reason;
    }
  }
  methods.push_back({ "ray-cast", reason });
  return methods;
}
