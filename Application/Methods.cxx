// SPDX-License-Identifier: BSD-3-Clause
#include "Methods.h"

#include "CommandErrors.h"
#include "MapperProperties.h"
#include "OptionValues.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <functional>

namespace
{

struct Method
{
  std::string Name;
  std::function<vtkSmartPointer<vtkTetrahedraVolumeMapper>()> Make;
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
  };
  return methods;
}

} // namespace

std::vector<std::string> GetMethodNames()
{
  std::vector<std::string> names = { "auto" };
  for (const Method& method : GetMethods())
  {
    names.push_back(method.Name);
  }
  return names;
}

vtkSmartPointer<vtkTetrahedraVolumeMapper> MakeMapper(
  const std::string& method, int numberOfThreads)
{
  const std::string chosen = method == "auto" ? "ray-cast" : method;
  for (const Method& candidate : GetMethods())
  {
    if (candidate.Name != chosen)
    {
      continue;
    }
    vtkSmartPointer<vtkTetrahedraVolumeMapper> mapper = candidate.Make();
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
      throw UsageError("--threads: the method '" + chosen + "' has none to set");
    }
    return mapper;
  }
  throw UsageError("--method: this version has no method '" + method + "'; there are " +
    JoinNames(GetMethodNames()));
}
