// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Bench.h"

#include "Bench/BenchCsv.h"
#include "Bench/BenchFeatures.h"
#include "Bench/BenchFront.h"
#include "Bench/BenchIntegral.h"
#include "Bench/BenchJson.h"
#include "Bench/BenchMachine.h"
#include "Bench/BenchMeasure.h"
#include "Bench/BenchOptions.h"
#include "Bench/BenchPage.h"
#include "Bench/BenchScenes.h"
#include "Bench/BenchSettings.h"
#include "Bench/BenchView.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/ProgressLine.h"
#include "Files/AtomicOutput.h"
#include "Files/WriteBytes.h"
#include "Setup/SceneCamera.h"
#include "vtkHeadlessRenderWindow.h"

#include <cstdio>
#include <iostream>

namespace
{

constexpr const char* CsvFile = "results.csv"; ///< marks a folder that may be replaced
constexpr const char* JsonFile = "results.json";
constexpr const char* PageFile = "index.html";

/// Pixels along an edge without --size.
constexpr int FullSize = 512;
constexpr int QuickSize = 64;

/// Frames of a quick run: too few to measure time.
constexpr int QuickFrames = 2;

void CheckOptions(const BenchOptions& options)
{
  const SceneOptions& scene = options.Scene;
  const bool ofFile = !scene.Input.Plot3dSolution.empty() || scene.Input.Time ||
    scene.Input.TimeStep || !scene.Array.empty() || !scene.Component.empty() ||
    !scene.TransferFile.empty() || scene.OpacityUnitDistance || scene.CameraPosition ||
    scene.CameraFocalPoint || scene.CameraViewUp || scene.CameraViewAngle ||
    scene.CameraParallelScale;
  if (scene.Input.Name.empty() && ofFile)
  {
    throw UsageError("bench: arrays, transfer functions and cameras are those of a FILE, and none "
                     "is given");
  }
  if (!scene.Input.Name.empty() && !options.DataFolder.empty())
  {
    throw UsageError("--data: with a FILE, only that is rendered");
  }
  CheckCamera(scene);
}

/// Fills in what the options leave open.
BenchOptions Complete(BenchOptions options)
{
  options.DataFolder = GetDataFolder(options);
  if (options.Scene.Width == 0)
  {
    options.Scene.Width = options.Scene.Height = options.Quick ? QuickSize : FullSize;
  }
  if (options.Quick)
  {
    options.Frames = std::min(options.Frames, QuickFrames);
  }
  return options;
}

/// Returns the command that repeats the run, without paths.
std::string DescribeCommand(const BenchOptions& options)
{
  std::string command = "tetralux bench";
  command += options.Scene.Input.Name.empty() ? "" : " FILE";
  command += options.DataFolder.empty() || options.Quick ? "" : " --data FOLDER";
  command += options.Quick ? " --quick" : "";
  command += options.Features ? " --features" : "";
  for (const std::string& name : options.Scenes)
  {
    command += " --scene " + name;
  }
  for (const std::string& setting : options.Settings)
  {
    command += " --setting '" + setting + "'";
  }
  return command + " --size " + std::to_string(options.Scene.Width) + "," +
    std::to_string(options.Scene.Height) + " --frames " + std::to_string(options.Frames) +
    " --output FOLDER";
}

void WriteText(AtomicOutput& folder, const std::string& file, const std::string& text)
{
  ::WriteText(text, folder.AddFile(file), folder.GetName() + "/" + file);
}

void PrintRow(const BenchRow& row)
{
  char text[160];
  std::snprintf(text, sizeof(text), "  %-26s", row.Setting.Name.c_str());
  std::cout << text;
  if (row.Failure.empty())
  {
    std::snprintf(text, sizeof(text), " %9.2f ms   largest error %.2e   RMS %.2e",
      1e3 * row.BestSeconds, row.Errors.Maximum, row.Errors.RootMeanSquare);
    std::cout << text;
  }
  else
  {
    std::cout << " failed: " << row.Failure;
  }
  std::cout << std::endl;
}

BenchSceneResult MeasureScene(const BenchScene& scene, const BenchOptions& options,
  AtomicOutput& folder, vtkHeadlessRenderWindow* window)
{
  const BenchRun run = { scene, options.Scene, options.Frames, folder, window };
  BenchSceneResult result;
  result.Name = scene.Name;
  result.Description = scene.Description;
  result.Width = options.Scene.Width;
  result.Height = options.Scene.Height;
  std::cout << scene.Name << ": " << scene.Description << std::endl;

  BenchMeasurement reference = MeasureIntegral(run);
  Compare(run, reference.Picture, reference);
  if (reference.Row.Errors.NumberOfPixels == 0)
  {
    throw WorkError("'" + scene.Name + "': the picture is empty");
  }
  result.Rows.push_back(reference.Row);
  PrintRow(result.Rows.back());

  const std::vector<BenchSetting> settings = ListSettings(options, scene);
  ProgressLine progress("measuring " + scene.Name);
  for (std::size_t i = 0; i < settings.size(); ++i)
  {
    progress.Show(static_cast<double>(i) / static_cast<double>(settings.size()));
    BenchMeasurement measurement = Measure(run, settings[i]);
    if (measurement.Row.Failure.empty())
    {
      Compare(run, reference.Picture, measurement);
    }
    result.Rows.push_back(measurement.Row);
    PrintRow(result.Rows.back());
  }
  MarkFront(result);
  return result;
}

} // namespace

void RunBench(const BenchOptions& given)
{
  CheckOptions(given);
  const BenchOptions options = Complete(given);
  const std::vector<BenchSceneMaker> makers = ListScenes(options); // throws if a setting is wrong

  AtomicOutput folder(options.Output, CsvFile);
  folder.AddFolder("pictures");
  std::vector<BenchSceneResult> results;
  results.reserve(makers.size());
  const vtkSmartPointer<vtkHeadlessRenderWindow> window = MakeBenchWindow(options.Scene);
  for (const BenchSceneMaker& maker : makers)
  {
    results.push_back(MeasureScene(maker.Make(), options, folder, window));
  }
  std::vector<BenchFeature> features;
  if (options.Features)
  {
    features = MeasureFeatures(options.Scene, options.Frames, options.Quick);
  }
  const nlohmann::ordered_json json = MakeResults(results, features,
    DescribeMachine(GetOpenGLRenderer(window), options.Scene.NumberOfThreads),
    DescribeCommand(options));
  WriteText(folder, JsonFile, json.dump(2) + "\n");
  WriteText(folder, CsvFile, MakeCsv(json));
  WriteText(folder, PageFile, MakePage(json, results));
  folder.Commit();
}
