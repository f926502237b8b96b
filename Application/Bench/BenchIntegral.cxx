// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchIntegral.h"

#include "Bench/BenchMappers.h"
#include "Bench/BenchMeasure.h"
#include "Bench/BenchScene.h"
#include "Bench/BenchSettings.h"
#include "Bench/BenchView.h"
#include "Frame/CameraRays.h"
#include "ImageIntegral/ImageIntegral.h"
#include "ImagePreparation/ImagePreparation.h"
#include "Setup/SceneOptions.h"

#include "vtkImageData.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <chrono>
#include <vector>

BenchMeasurement MeasureIntegral(const BenchRun& run)
{
  BenchMeasurement measurement;
  BenchRow& row = measurement.Row;
  row.Setting = GetReferenceSetting(run.Scene);

  // What the triangle caster makes of the scene, and the rays that it casts.
  BenchSetting caster;
  caster.Method = "triangle-caster";
  const BenchView view(
    run.Window, run.Scene, MakeBenchMapper(caster, run.View.NumberOfThreads), run.View);
  tetralux::ImagePreparation preparation(view.GetMapper());
  tetralux::ImageInput input;
  input.Data = run.Scene.Image;
  input.Property = run.Scene.Property;
  input.Matrix = view.GetVolume()->GetMatrix();
  input.MaximumError = tetralux::ImageIntegralError;
  preparation.Update(input);
  const tetralux::CameraRays rays(view.GetRenderer(), 1);
  const tetralux::RayGrid grid = ToIndices(preparation.GetPlacement(), rays.GetGrid());

  const auto start = std::chrono::steady_clock::now();
  const std::vector<double> pixels = tetralux::IntegrateImage(
    preparation.GetScalars().GetVolume(), preparation.GetOptics(), grid, run.View.NumberOfThreads);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  measurement.Picture = { grid.Width, grid.Height, { pixels.begin(), pixels.end() } };
  row.Frames = 1;
  row.BestSeconds = row.MedianSeconds = seconds.count();
  row.ErrorEstimate = tetralux::ImageIntegralError + preparation.GetFunctionError();
  return measurement;
}
