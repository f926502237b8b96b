// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchMappers.h"

#include "Bench/BenchSetting.h"
#include "CommandLine/CommandErrors.h"
#include "Setup/Methods.h"
#include "vtkTetrahedraRayIntegrator.h"
#include "vtkTetrahedraVolumeMapper.h"

#include "vtkNew.h"
#include "vtkProjectedTetrahedraMapper.h"
#include "vtkUnstructuredGridPreIntegration.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"

namespace
{

vtkSmartPointer<vtkTetrahedraVolumeMapper> MakeOurMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  // Only processors have threads to set.
  const bool onProcessor = setting.Method == "ray-cast" || setting.Method == "isosurface";
  const int threads = onProcessor ? numberOfThreads : 0;
  vtkSmartPointer<vtkTetrahedraVolumeMapper> mapper = vtkTetrahedraVolumeMapper::SafeDownCast(
    MakeMapper(setting.Method, threads, setting.Assignments));
  if (!mapper)
  {
    throw UsageError("--setting: the benchmark renders cells, '" + setting.Method + "' image data");
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

vtkSmartPointer<vtkUnstructuredGridVolumeMapper> MakeBenchMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  if (!IsPeer(setting))
  {
    return MakeOurMapper(setting, numberOfThreads);
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
