// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchIntegral.h"

#include "Bench/BenchMappers.h"
#include "Bench/BenchMeasure.h"
#include "Bench/BenchScene.h"
#include "Bench/BenchSettings.h"
#include "Bench/BenchView.h"
#include "CellIntegral/CellIntegral.h"
#include "CommandLine/CommandErrors.h"
#include "Frame/CameraRays.h"
#include "ImageIntegral/ImageIntegral.h"
#include "ImagePreparation/ImagePreparation.h"
#include "Preparation/ScenePreparation.h"
#include "Setup/SceneOptions.h"

#include "vtkImageData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <chrono>
#include <stdexcept>
#include <vector>

namespace
{

/// An integral along rays, and what it may be off by.
struct Integral
{
  tetralux::RayGrid Grid;
  std::vector<double> Pixels;
  double Error = 0;
  double Seconds = 0; ///< without what it takes to prepare the scene
};

/// Calls integrate, which returns the pixels, and times it.
template <class Integrate>
void Run(const Integrate& integrate, Integral& result)
{
  const auto start = std::chrono::steady_clock::now();
  result.Pixels = integrate();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  result.Seconds = seconds.count();
}

/// Makes of a scene what a method's mapper makes of it, for the rays that it casts.
BenchView MakeView(const BenchRun& run, const char* method)
{
  BenchSetting setting;
  setting.Method = method;
  return { run.Window, run.Scene, MakeBenchMapper(setting, run.View.NumberOfThreads), run.View };
}

Integral IntegrateImage(const BenchRun& run)
{
  const BenchView view = MakeView(run, "triangle-caster");
  tetralux::ImagePreparation preparation(view.GetMapper());
  tetralux::ImageInput input;
  input.Data = run.Scene.Image;
  input.Property = run.Scene.Property;
  input.Matrix = view.GetVolume()->GetMatrix();
  input.MaximumError = tetralux::ImageIntegralError;
  preparation.Update(input);
  Integral result;
  result.Grid =
    ToIndices(preparation.GetPlacement(), tetralux::CameraRays(view.GetRenderer(), 1).GetGrid());
  result.Error = tetralux::ImageIntegralError + preparation.GetFunctionError();
  Run(
    [&]
    {
      return tetralux::IntegrateImage(preparation.GetScalars().GetVolume(), preparation.GetOptics(),
        result.Grid, run.View.NumberOfThreads);
    },
    result);
  return result;
}

Integral IntegrateCells(const BenchRun& run)
{
  const BenchView view = MakeView(run, "ray-cast");
  tetralux::ScenePreparation preparation(view.GetMapper());
  tetralux::MapperSettings settings;
  settings.MaximumError = tetralux::CellIntegralError;
  settings.Scalars.ScalarMode = view.GetMapper()->GetScalarMode();
  settings.Table.Use = tetralux::TableUse::Never;
  tetralux::SceneInput input;
  input.Data = run.Scene.Mesh;
  input.Property = run.Scene.Property;
  input.Matrix = view.GetVolume()->GetMatrix();
  preparation.Update(settings, input, {});
  const tetralux::CameraRays rays(view.GetRenderer(), 1);
  tetralux::RayLimits limits;
  rays.AddClippingRange(limits);
  Integral result;
  result.Grid = rays.GetGrid();
  result.Error = tetralux::CellIntegralError + preparation.Scene.Optics.GetFunctionError();
  Run(
    [&]
    {
      return tetralux::IntegrateCells(
        preparation.Scene, result.Grid, limits, run.View.NumberOfThreads);
    },
    result);
  return result;
}

} // namespace

BenchMeasurement MeasureIntegral(const BenchRun& run)
{
  Integral integral;
  try
  {
    integral = run.Scene.IsOfImages() ? IntegrateImage(run) : IntegrateCells(run);
  }
  catch (const std::invalid_argument& error)
  {
    throw WorkError("'" + run.Scene.Name + "': " + error.what());
  }
  BenchMeasurement measurement;
  measurement.Picture = { integral.Grid.Width, integral.Grid.Height,
    { integral.Pixels.begin(), integral.Pixels.end() } };
  BenchRow& row = measurement.Row;
  row.Setting = GetReferenceSetting(run.Scene);
  row.Frames = 1;
  row.BestSeconds = row.MedianSeconds = integral.Seconds;
  row.ErrorEstimate = integral.Error;
  return measurement;
}
