// SPDX-License-Identifier: BSD-3-Clause

// Isosurfaces of tetrahedra by several ways: extracted as triangles that Embree traces or OpenGL
// draws, and cast by rays through the cells. Prints a table as CSV, one row for each case and way,
// with the medians of a frame's seconds. The ways take turns, frame by frame.
// Testing/Benchmarks/isosurface_peers.py runs it for meshes of several sizes.

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "Frame/CameraRays.h"
#include "Isosurfaces/EmbreeWay.h"
#include "Isosurfaces/IsosurfaceScene.h"
#include "Isosurfaces/IsosurfaceWindow.h"
#include "Isosurfaces/WindowWays.h"
#include "Setup/SceneOptionGroups.h"
#include "Setup/SceneOptions.h"

#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <omp.h>

using namespace tetralux;

namespace
{

constexpr int LargestNumberOfFrames = 1000;

/// Before each frame, in which threads of the way before stop waiting for more work.
constexpr std::chrono::milliseconds PauseForThreads(10);

constexpr std::pair<IsosurfaceCase, const char*> Cases[] = {
  { IsosurfaceCase::SameView, "same view" },
  { IsosurfaceCase::NewIsovalue, "new isovalue" },
  { IsosurfaceCase::NewStep, "new step" },
  { IsosurfaceCase::Shadows, "shadows" },
  { IsosurfaceCase::TwoLayers, "two layers" },
};

struct PeerOptions
{
  std::string Mesh;
  std::string Isovalue;
  int Frames = 5;
  SceneOptions Scene;
};

using Ways = std::vector<std::unique_ptr<IsosurfaceWay>>;

Ways MakeWays(vtkUnstructuredGrid* grid, const SceneOptions& options)
{
  IsosurfaceWindow window(options, grid->GetBounds());
  std::cerr << "OpenGL: " << window.GetOpenGL() << "\n";
  EmbreeView view;
  view.Rays = CameraRays(window.GetRenderer(), 1).GetGrid();
  view.Light = window.GetLightPosition();
  const int threads = options.NumberOfThreads;

  Ways ways;
  ways.push_back(
    std::make_unique<EmbreeWay>(grid, view, RTC_BUILD_QUALITY_LOW, ScalarTree::Off, threads));
  ways.push_back(
    std::make_unique<EmbreeWay>(grid, view, RTC_BUILD_QUALITY_MEDIUM, ScalarTree::Off, threads));
  ways.push_back(
    std::make_unique<EmbreeWay>(grid, view, RTC_BUILD_QUALITY_LOW, ScalarTree::On, threads));
  ways.push_back(MakeTracerWay(grid, options));
  ways.push_back(MakeTracerAloneWay(grid, options));
  ways.push_back(MakeRasteriserWay(grid, options));
  ways.push_back(MakeRayCasterWay(grid, options));
  ways.push_back(MakeEmptyWay(grid, options));
  return ways;
}

double GetMedian(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

template <class Getter>
double GetMedian(const std::vector<IsosurfaceTimes>& times, Getter get)
{
  std::vector<double> values;
  std::transform(times.begin(), times.end(), std::back_inserter(values), get);
  return GetMedian(values);
}

/// A mesh's name in a field of the table.
std::string Quote(const std::string& text) { return "\"" + text + "\""; }

void PrintRow(const PeerOptions& options, const IsosurfaceScene& scene, const char* name,
  IsosurfaceWay& way, const std::vector<IsosurfaceTimes>& times)
{
  using Times = IsosurfaceTimes;
  std::printf("%s,%lld,%d,%d,%d,%.9g,%s,%s,%zu,%.6g,%.6g,%.6g,%.6g,%lld,%lld\n",
    Quote(options.Mesh).c_str(), static_cast<long long>(scene.Grid->GetNumberOfCells()),
    options.Scene.Width, options.Scene.Height, options.Scene.NumberOfThreads,
    scene.Isovalues.front(), name, Quote(way.GetName()).c_str(), times.size(),
    GetMedian(times, [](const Times& t) { return t.GetSum(); }),
    GetMedian(times, [](const Times& t) { return t.Extract; }),
    GetMedian(times, [](const Times& t) { return t.Build; }),
    GetMedian(times, [](const Times& t) { return t.Draw; }),
    static_cast<long long>(way.GetNumberOfTriangles()),
    static_cast<long long>(way.CountCoveredPixels()));
  std::fflush(stdout);
}

void MeasureCase(const PeerOptions& options, const IsosurfaceScene& scene, IsosurfaceCase which,
  const char* name, const Ways& all)
{
  std::vector<IsosurfaceWay*> ways;
  for (const auto& way : all)
  {
    if (way->Takes(which))
    {
      way->SetCase(which);
      ways.push_back(way.get());
    }
  }
  std::vector<std::vector<IsosurfaceTimes>> times(ways.size());
  for (int frame = 0; frame <= options.Frames; ++frame)
  {
    const bool newIsovalue = which == IsosurfaceCase::NewIsovalue;
    const bool newStep = which == IsosurfaceCase::NewStep;
    const double isovalue = scene.Isovalues[newIsovalue ? frame % scene.Isovalues.size() : 0];
    vtkDoubleArray* step = scene.Steps[newStep ? frame % scene.Steps.size() : 0];
    if (scene.Grid->GetPointData()->GetScalars() != step)
    {
      scene.Grid->GetPointData()->SetScalars(step);
    }
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
      ways[i]->SetIsovalue(isovalue);
      std::this_thread::sleep_for(PauseForThreads);
      const IsosurfaceTimes measured = ways[i]->DrawFrame();
      if (frame > 0) // the first frame makes what does not change
      {
        times[i].push_back(measured);
      }
    }
  }
  for (std::size_t i = 0; i < ways.size(); ++i)
  {
    PrintRow(options, scene, name, *ways[i], times[i]);
  }
}

void Measure(const PeerOptions& options)
{
  // Each library has its own threads. Mesa reads the variable when the first context is made.
  const int threads = options.Scene.NumberOfThreads;
  vtkSMPTools::Initialize(threads);
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);

  const IsosurfaceScene scene = MakeIsosurfaceScene(
    options.Mesh, options.Scene.Array, ParseNumber("--isovalue", options.Isovalue));
  std::cerr << "VTK's threads: " << vtkSMPTools::GetBackend() << ", "
            << vtkSMPTools::GetEstimatedNumberOfThreads() << "\n"
            << "Embree: " << RTC_VERSION_STRING << "\n";
  const Ways ways = MakeWays(scene.Grid, options.Scene);
  std::printf("mesh,tetrahedra,width,height,threads,isovalue,case,way,frames,seconds,"
              "extract_seconds,build_seconds,draw_seconds,triangles,covered_pixels\n");
  for (const auto& [which, name] : Cases)
  {
    MeasureCase(options, scene, which, name, ways);
  }
}

void AddOptions(CLI::App& app, PeerOptions& options)
{
  app
    .add_option("MESH", options.Mesh,
      "A generator with its parameters, as ring:around=600,across=32, or a file as tetralux render "
      "reads it")
    ->required()
    ->type_name("");
  app.add_option("--isovalue", options.Isovalue, "Scalar of the surface")
    ->required()
    ->type_name("V");
  app.add_option("--array", options.Scene.Array, "Array of a file's points")->type_name("NAME");
  AddOption(&app, "--frames", "Frames measured of each case and way; default: 5",
    [&options](const std::string& name, const std::string& text)
    { options.Frames = ParseInteger(name, text, 1, LargestNumberOfFrames); })
    ->type_name("N");
  AddCameraOptions(&app, options.Scene);
  AddSizeOptions(&app, options.Scene);
}

} // namespace

int main(int argc, char* argv[])
try
{
  CLI::App app("Isosurfaces of tetrahedra by several ways, timed", "IsosurfacePeers");
  PeerOptions options;
  AddOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  if (options.Scene.NumberOfThreads == 0)
  {
    options.Scene.NumberOfThreads = omp_get_num_procs();
  }
  Measure(options);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "IsosurfacePeers: " << error.what() << "\n";
  return 1;
}
