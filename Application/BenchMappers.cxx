// SPDX-License-Identifier: BSD-3-Clause
#include "BenchMappers.h"

#include "BenchSettings.h"
#include "Methods.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTetrahedraRayIntegrator.h"

#include "vtkNew.h"
#include "vtkProjectedTetrahedraMapper.h"
#include "vtkUnstructuredGridPreIntegration.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"

namespace
{

vtkSmartPointer<vtkTetrahedraRayCastMapper> MakeRayCastMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  auto mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->SetNumberOfThreads(numberOfThreads);
  for (const std::string& assignment : setting.Assignments)
  {
    SetProperty(mapper, assignment);
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

vtkSmartPointer<vtkUnstructuredGridVolumeMapper> MakeMapper(
  const BenchSetting& setting, int numberOfThreads)
{
  switch (setting.Method)
  {
    case BenchMethod::ProjectedTetrahedra:
      return vtkSmartPointer<vtkProjectedTetrahedraMapper>::New();
    case BenchMethod::Bunyk:
      return MakeBunykMapper();
    case BenchMethod::BunykPreIntegration:
    {
      auto mapper = MakeBunykMapper();
      vtkNew<vtkUnstructuredGridPreIntegration> integrator;
      mapper->SetRayIntegrator(integrator);
      return mapper;
    }
    case BenchMethod::BunykClosedForm:
    {
      auto mapper = MakeBunykMapper();
      vtkNew<vtkTetrahedraRayIntegrator> integrator;
      mapper->SetRayIntegrator(integrator);
      return mapper;
    }
    default:
      return MakeRayCastMapper(setting, numberOfThreads);
  }
}

void CheckSetting(const BenchSetting& setting) { MakeRayCastMapper(setting, 0); }
