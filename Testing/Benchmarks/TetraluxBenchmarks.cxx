// SPDX-License-Identifier: BSD-3-Clause

// What the numerics cost, and how that grows with the mesh. Meshes are balls of about as many
// tetrahedra as a benchmark's name says; the largest takes part where --benchmark_filter names its
// number. Time is that of the wall, CPU that of all threads.
//
//   Cast/...         pictures of 512 x 512 pixels; Wall and Cpu: nanoseconds for each cell that a
//                    ray walks through. Entries: share of the picture's time that goes into finding
//                    where rays enter the mesh, measured by a picture that ends in front of it.
//   Prepare/...      what is done once for a mesh, by stage; Wall and Cpu: nanoseconds a
//                    tetrahedron.
//   Tree/...         the min/max tree over the tetrahedra, by how it is divided and the cells of a
//                    leaf at most: built anew, its boxes fitted to points that moved, and the
//                    ranges of a time step; Wall and Cpu: nanoseconds a tetrahedron. Bytes: of
//                    boxes, cell ids and ranges, a tetrahedron.
//   Integral/...     SegmentIntegralBenchmark.cxx.

#include "Base/Stopwatch.h"
#include "Generate/GeneratedMeshes.h"
#include "Hierarchy/MinMaxTree.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"
#include "Mesh/SpatialOrder.h"
#include "RayCast/RayCaster.h"
#include "Walk/WalkMesh.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tetralux;

constexpr int ImageSize = 512;
constexpr std::int64_t LargestSize = 10000000;

/// Adds up wall and processor time.
class TimeSum
{
public:
  void Start()
  {
    this->WallWatch = Stopwatch();
    this->CpuBegin = std::clock();
  }
  void Stop()
  {
    this->Wall += this->WallWatch.GetSeconds();
    this->Cpu += static_cast<double>(std::clock() - this->CpuBegin) / CLOCKS_PER_SEC;
  }
  /// Nanoseconds for each of a number of items, over all that was timed.
  void Report(benchmark::State& state, double items) const
  {
    state.counters["Wall"] = 1e9 * this->Wall / items;
    state.counters["Cpu"] = 1e9 * this->Cpu / items;
  }
  double GetWall() const { return this->Wall; }

private:
  Stopwatch WallWatch;
  std::clock_t CpuBegin = 0;
  double Wall = 0;
  double Cpu = 0;
};

/// A ball of about so many tetrahedra; the last one is kept.
const GeneratedMesh& GetBall(std::int64_t size)
{
  static std::int64_t lastSize = 0;
  static GeneratedMesh ball;
  if (size != lastSize)
  {
    ball = {};
    const double cells = std::round(std::cbrt(static_cast<double>(size) / 2.5));
    ball = GenerateMesh("ball", { { "cells", cells } });
    lastSize = size;
  }
  return ball;
}

/// The kinds of pictures.
struct CastKind
{
  const char* Name;
  bool CellScalars;
  Precision Arithmetic;
};

/// The ball's scalars lie around 0; something is to be seen everywhere, and seen through.
TransferFunction MakeFunction(const std::vector<double>& scalars)
{
  const auto [low, high] = std::minmax_element(scalars.begin(), scalars.end());
  TransferFunction function;
  constexpr int Nodes = 5;
  for (int k = 0; k < Nodes; ++k)
  {
    const double x = static_cast<double>(k) / (Nodes - 1);
    const TransferFunction::Value value = { { x, 1 - x, 0.5 }, 0.2 + 0.8 * (k % 2) };
    function.Nodes.push_back({ *low + x * (*high - *low), value, value });
  }
  return function;
}

/// A ball of radius 1 that fills most of the picture, in perspective.
RayGrid MakeGrid()
{
  constexpr double Eye = 4;
  constexpr double HalfHeight = 0.27; // tangent of half the view angle
  constexpr double Pixel = 2 * HalfHeight / ImageSize;
  RayGrid grid;
  grid.Width = grid.Height = ImageSize;
  grid.Origin[2] = Eye;
  grid.Direction[0] = grid.Direction[1] = (0.5 - 0.5 * ImageSize) * Pixel;
  grid.Direction[2] = -1;
  grid.DirectionStepX[0] = grid.DirectionStepY[1] = Pixel;
  return grid;
}

void CastBall(benchmark::State& state, std::int64_t size, const CastKind& kind)
{
  const GeneratedMesh& ball = GetBall(size);
  const auto mesh = std::make_shared<WalkMesh>(ball.Mesh);
  VolumeScene volume;
  volume.Mesh.SetMesh(mesh);
  volume.Optics.SetTransferFunction(MakeFunction(ball.Scalars));
  std::vector<double> scalars;
  if (kind.CellScalars)
  {
    for (const std::int64_t cell : mesh->GetMesh().OriginalCells)
    {
      scalars.push_back(ball.Scalars[ball.Mesh.Cells[4 * cell]]);
    }
    volume.Mesh.SetCellScalars(std::move(scalars));
  }
  else
  {
    for (const std::int64_t point : mesh->GetMesh().OriginalPoints)
    {
      scalars.push_back(ball.Scalars[point]);
    }
    volume.Mesh.SetPointScalars(std::move(scalars));
  }

  const RayGrid grid = MakeGrid();
  std::vector<float> colors(4 * ImageSize * ImageSize);
  std::vector<float> depths(ImageSize * ImageSize);
  RayCastOptions options;
  options.Arithmetic = kind.Arithmetic;
  options.MaximumError = 1e-9; // rays end where they leave
  RayLimits inFront;
  inFront.Planes = { { 0, 0, 1, -1.5 } }; // nearer to the eye than the ball
  const auto cast = [&](const RayLimits& limits)
  { return CastRays(volume, grid, limits, options, colors, depths); };
  RayCastStatistics statistics = cast({}); // fills the tables

  TimeSum all;
  TimeSum entries;
  for (auto _ : state)
  {
    all.Start();
    statistics = cast({});
    all.Stop();
    state.PauseTiming();
    entries.Start();
    benchmark::DoNotOptimize(cast(inFront));
    entries.Stop();
    state.ResumeTiming();
  }
  const double segments = static_cast<double>(statistics.Segments);
  all.Report(state, segments * static_cast<double>(state.iterations()));
  state.counters["Entries"] = entries.GetWall() / all.GetWall();
  state.counters["Segments"] = segments;
  state.counters["LaneUse"] = statistics.LaneUse;
  state.counters["Threads"] = statistics.NumberOfThreads;
  state.SetLabel(statistics.InstructionSet);
}

/// The stages of the preparation: each works on what the ones before it left.
enum class Stage
{
  Cleaning,
  Ordering,
  Neighbors,
  BoundaryTree,
  Everything,
  Scalars
};

void Prepare(benchmark::State& state, std::int64_t size, Stage stage)
{
  const GeneratedMesh& ball = GetBall(size);
  TetrahedralMesh start = ball.Mesh;
  if (stage != Stage::Cleaning && stage != Stage::Everything)
  {
    RemoveUnusableCells(start);
  }
  if (stage == Stage::Neighbors)
  {
    OrderSpatially(start);
  }
  std::unique_ptr<WalkMesh> mesh;
  std::vector<float> points;
  std::vector<std::int32_t> triangles;
  if (stage == Stage::BoundaryTree || stage == Stage::Scalars)
  {
    mesh = std::make_unique<WalkMesh>(start);
    const std::size_t numberOfPoints = mesh->GetMesh().GetNumberOfPoints();
    points.resize(4 * numberOfPoints);
    for (std::size_t p = 0; p < numberOfPoints; ++p)
    {
      const WalkPoint<float>& point = mesh->GetPoints<float>()[p];
      std::copy_n(&point.X, 1, &points[4 * p]);
      std::copy_n(&point.Y, 1, &points[4 * p + 1]);
      std::copy_n(&point.Z, 1, &points[4 * p + 2]);
    }
    for (std::int32_t b = 0; b < mesh->GetNumberOfBoundaryFaces(); ++b)
    {
      const WalkEntry& entry = mesh->GetEntries()[b];
      triangles.insert(triangles.end(), entry.Points, entry.Points + 3);
    }
  }

  TimeSum time;
  for (auto _ : state)
  {
    state.PauseTiming();
    TetrahedralMesh work = start;
    state.ResumeTiming();
    time.Start();
    switch (stage)
    {
      case Stage::Cleaning:
        benchmark::DoNotOptimize(RemoveUnusableCells(work));
        break;
      case Stage::Ordering:
        OrderSpatially(work);
        break;
      case Stage::Neighbors:
        benchmark::DoNotOptimize(
          FindFaceNeighbors(work.Cells, work.GetNumberOfPoints()).NumberOfComponents);
        break;
      case Stage::BoundaryTree:
        benchmark::DoNotOptimize(BuildBoundaryBvh(points, triangles, 1e-6f).Nodes.data());
        break;
      case Stage::Everything:
        benchmark::DoNotOptimize(WalkMesh(std::move(work)).GetTableSize());
        break;
      case Stage::Scalars:
        mesh->SetPointScalars<float>(ball.Scalars, 0, 1);
        break;
    }
    time.Stop();
  }
  time.Report(state,
    static_cast<double>(ball.Mesh.GetNumberOfCells()) * static_cast<double>(state.iterations()));
}

/// What is done with the min/max tree.
enum class TreeStage
{
  Build,
  Refit,
  Ranges
};

void MakeTree(
  benchmark::State& state, std::int64_t size, const MinMaxTreeOptions& options, TreeStage stage)
{
  const GeneratedMesh& ball = GetBall(size);
  TetrahedralMesh mesh = ball.Mesh;
  OrderSpatially(mesh);
  std::vector<double> scalars;
  for (const std::int64_t point : mesh.OriginalPoints)
  {
    scalars.push_back(ball.Scalars[point]);
  }
  const double center[3] = { 0, 0, 0 };
  MinMaxTree tree = BuildMinMaxTree(mesh, center, 1, options);
  MinMaxRanges ranges = MakeMinMaxRanges(tree, mesh, scalars, options.NumberOfThreads);

  TimeSum time;
  for (auto _ : state)
  {
    time.Start();
    switch (stage)
    {
      case TreeStage::Build:
        tree = BuildMinMaxTree(mesh, center, 1, options);
        break;
      case TreeStage::Refit:
        RefitMinMaxTree(tree, mesh, center, 1, options.NumberOfThreads);
        break;
      case TreeStage::Ranges:
        ranges = MakeMinMaxRanges(tree, mesh, scalars, options.NumberOfThreads);
        break;
    }
    time.Stop();
  }
  const auto numberOfCells = static_cast<double>(mesh.GetNumberOfCells());
  time.Report(state, numberOfCells * static_cast<double>(state.iterations()));
  const std::size_t bytes = tree.Nodes.size() * sizeof(MinMaxTree::Node) +
    tree.Cells.size() * sizeof(std::int32_t) + ranges.Nodes.size() * sizeof(MinMaxTree::Range);
  state.counters["Bytes"] = static_cast<double>(bytes) / numberOfCells;
}

void Register(std::int64_t size)
{
  const std::string number = std::to_string(size);
  const auto add = [](const std::string& name, auto function)
  {
    benchmark::RegisterBenchmark(name.c_str(), function)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
  };
  constexpr CastKind kinds[] = { { "points/single", false, Precision::Single },
    { "points/double", false, Precision::Double }, { "cells/single", true, Precision::Single },
    { "cells/double", true, Precision::Double } };
  for (const CastKind& kind : kinds)
  {
    add("Cast/" + number + "/" + kind.Name,
      [size, kind](benchmark::State& state) { CastBall(state, size, kind); });
  }
  const std::pair<const char*, Stage> stages[] = { { "cleaning", Stage::Cleaning },
    { "ordering", Stage::Ordering }, { "neighbors", Stage::Neighbors },
    { "boundary-tree", Stage::BoundaryTree }, { "everything", Stage::Everything },
    { "scalars", Stage::Scalars } };
  for (const auto& [name, stage] : stages)
  {
    add("Prepare/" + number + "/" + name,
      [size, stage = stage](benchmark::State& state) { Prepare(state, size, stage); });
  }
  const std::pair<const char*, TreeBuild> builds[] = {
    { "spatial-median", TreeBuild::SpatialMedian }, { "surface-area", TreeBuild::SurfaceArea }
  };
  const std::pair<const char*, TreeStage> treeStages[] = { { "build", TreeStage::Build },
    { "refit", TreeStage::Refit }, { "ranges", TreeStage::Ranges } };
  for (const auto& [build, kind] : builds)
  {
    for (const int leafSize : { 4, 8, 12, 16 })
    {
      for (const auto& [name, stage] : treeStages)
      {
        MinMaxTreeOptions options;
        options.Build = kind;
        options.LeafSize = leafSize;
        add("Tree/" + number + "/" + build + "/" + std::to_string(leafSize) + "/" + name,
          [size, options, stage = stage](benchmark::State& state)
          { MakeTree(state, size, options, stage); });
      }
    }
  }
}

} // namespace

int main(int argc, char** argv)
{
  const std::string largest = std::to_string(LargestSize);
  const bool withLargest = std::any_of(argv, argv + argc,
    [&](const char* argument) { return std::strstr(argument, largest.c_str()); });
  for (std::int64_t size = 10000; size < LargestSize; size *= 10)
  {
    Register(size);
  }
  if (withLargest)
  {
    Register(LargestSize);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
