// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchMappers.h"

#include "Bench/BenchSetting.h"
#include "CommandLine/OptionValues.h"
#include "Setup/Methods.h"
#include "vtkTetrahedraRayIntegrator.h"

#include "vtkFixedPointVolumeRayCastMapper.h"
#include "vtkGPUVolumeRayCastMapper.h"
#include "vtkNew.h"
#include "vtkProjectedTetrahedraMapper.h"
#include "vtkUnstructuredGridPreIntegration.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"

namespace
{

vtkSmartPointer<vtkAbstractVolumeMapper> MakeOurMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  // Only processors have threads to set.
  const std::string& method = setting.Method;
  const bool onProcessor =
    method == "ray-cast" || method == "isosurface" || method == "triangle-caster";
  return MakeMapper(method, onProcessor ? numberOfThreads : 0, setting.Assignments);
}

/// Makes one of VTK's mappers of image data cast a ray a pixel, with slices as far apart as the
/// setting says.
template <class MapperT>
vtkSmartPointer<MapperT> MakeImageMapper(const BenchSetting& setting)
{
  auto mapper = vtkSmartPointer<MapperT>::New();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->SetImageSampleDistance(1);
  for (const std::string& assignment : setting.Assignments)
  {
    const auto [name, value] = ParseAssignment("SampleDistance", assignment);
    mapper->SetSampleDistance(static_cast<float>(ParsePositive(name, value)));
  }
  return mapper;
}

vtkSmartPointer<vtkAbstractVolumeMapper> MakeFixedPointMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  auto mapper = MakeImageMapper<vtkFixedPointVolumeRayCastMapper>(setting);
  mapper->SetInteractiveSampleDistance(mapper->GetSampleDistance());
  if (numberOfThreads > 0)
  {
    mapper->SetNumberOfThreads(numberOfThreads);
  }
  return mapper;
}

vtkSmartPointer<vtkUnstructuredGridVolumeRayCastMapper> MakeBunykMapper()
{
  auto mapper = vtkSmartPointer<vtkUnstructuredGridVolumeRayCastMapper>::New();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->SetImageSampleDistance(1);
  return mapper;
}

} // namespace

vtkSmartPointer<vtkAbstractVolumeMapper> MakeBenchMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  if (!IsPeer(setting))
  {
    return MakeOurMapper(setting, numberOfThreads);
  }
  if (setting.Method == "vtk-fixed-point")
  {
    return MakeFixedPointMapper(setting, numberOfThreads);
  }
  if (setting.Method == "vtk-gpu")
  {
    return MakeImageMapper<vtkGPUVolumeRayCastMapper>(setting);
  }
  if (setting.Method == "vtk-projected-tetrahedra")
  {
    return vtkSmartPointer<vtkProjectedTetrahedraMapper>::New();
  }
  auto mapper = MakeBunykMapper();
  if (setting.Method == "vtk-bunyk-preintegration")
  {
    vtkNew<vtkUnstructuredGridPreIntegration> integrator;
    mapper->SetRayIntegrator(integrator);
  }
  else if (setting.Method == "vtk-bunyk-closed-form")
  {
    vtkNew<vtkTetrahedraRayIntegrator> integrator;
    mapper->SetRayIntegrator(integrator);
  }
  return mapper;
}

void CheckSetting(const BenchSetting& setting) { MakeOurMapper(setting, 0); }
