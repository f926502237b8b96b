// SPDX-License-Identifier: BSD-3-Clause
#include "RayCast/RayCaster.h"

#include "Integral/SegmentIntegral.h"
#include "RayCast/RayCastKernel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <thread>

#include <omp.h>

namespace tetralux
{
namespace
{

/// Pixels along a tile's edge: rays of a tile share cells in the first-level cache, and there are
/// enough tiles to balance threads.
constexpr int TileSize = 16;

constexpr int InitialCrossings = 32;

/// Between two reports of progress: short for a user who wants to abort, long for the work.
constexpr std::chrono::milliseconds ReportInterval(5);

/// Rounding of distances along rays, in radii of the mesh: sixteen times that of a coordinate.
constexpr double SingleDistanceRounding = 1. / (1 << 20);
constexpr double DoubleDistanceRounding = SingleDistanceRounding / (1 << 29);

struct InstructionSet
{
  const char* Name;
  RayCastKernels Kernels;
};

/// The best instruction set of this processor.
InstructionSet GetInstructionSet(bool portable)
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  static const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2 && !portable)
  {
    return { "AVX2", GetRayCastKernelsAvx2() };
  }
#endif
  static_cast<void>(portable);
  return { "generic", GetRayCastKernelsGeneric() };
}

/// The cheapest way of integrating that is exact for the scene, or by table, and its name in
/// statistics. lit: emission and absorption, by lights.
Integrator ChooseIntegrator(VolumeScene& scene, bool lit, std::string& name)
{
  switch (scene.GetOpticalModel())
  {
    case OpticalModel::EmissionOnly:
      name = "emission";
      return Integrator::Emission;
    case OpticalModel::AbsorptionOnly:
      name = "optical depth";
      return Integrator::OpticalDepth;
    case OpticalModel::MaximumIntensity:
      name = "largest scalar";
      return Integrator::Maximum;
    case OpticalModel::Isosurfaces:
      name = "isosurfaces";
      return Integrator::Isosurfaces;
    case OpticalModel::EmissionAbsorption:
      break;
  }
  if (scene.GetPlan().ConstantColor && !lit)
  {
    name = "optical depth";
    return Integrator::OpticalDepth;
  }
  if (scene.GetTable() && !scene.HasCellScalars())
  {
    name = "table";
    return lit ? Integrator::LitTable : Integrator::Table;
  }
  name = "closed form";
  return lit ? Integrator::LitClosedForm : Integrator::ClosedForm;
}

/// Isosurfaces as the kernels read them.
struct SurfaceTables
{
  std::vector<std::array<float, 2>> Neighbors;
  std::vector<float> Colors;

  SurfaceTables(const std::vector<Isosurface>& surfaces, const VolumeScene::ScalarMap& map)
  {
    // Beyond all scalars of the tables, which are bounded.
    float below = -std::numeric_limits<float>::infinity();
    for (const Isosurface& surface : surfaces)
    {
      const float value = static_cast<float>(map.Map(surface.Value));
      this->Neighbors.push_back({ below, value });
      below = value;
      this->Colors.insert(this->Colors.end(),
        { surface.Color[0], surface.Color[1], surface.Color[2],
          std::clamp(surface.Opacity, 0.f, 1.f) });
    }
    this->Neighbors.push_back({ below, std::numeric_limits<float>::infinity() });
  }
};

/// A CrossingBuffer that owns its memory.
struct OwningCrossingBuffer : CrossingBuffer
{
  std::vector<Crossing> Storage;

  OwningCrossingBuffer()
  {
    this->Grow = &OwningCrossingBuffer::Double;
    this->Capacity = InitialCrossings / 2;
    Double(*this);
  }

  static void Double(CrossingBuffer& buffer)
  {
    auto& self = static_cast<OwningCrossingBuffer&>(buffer);
    self.Capacity *= 2;
    constexpr std::size_t Lanes = 8;
    self.Storage.resize(Lanes * static_cast<std::size_t>(self.Capacity));
    self.Crossings = self.Storage.data();
  }
};

/// The tables that rays are walked through; nullptr after an abort.
const WalkTables* ChooseTables(
  VolumeScene& scene, const RayCastOptions& options, RayCastStatistics& statistics)
{
  WalkMesh& mesh = *scene.GetMesh();
  if (options.ReentryBy == Reentry::Imaginary)
  {
    mesh.MakeConvex(options.Progress);
    if (!mesh.GetConvexification())
    {
      return nullptr;
    }
    if (!mesh.GetConvexTables().Faces.empty())
    {
      statistics.ImaginaryCells = true;
      return &mesh.GetConvexTables();
    }
  }
  if (const WalkTables* visible = scene.GetVisibleTables())
  {
    statistics.TransparentCells = scene.GetNumberOfTransparentCells();
    return visible;
  }
  return &mesh.GetTables();
}

} // namespace

RayCastStatistics CastRays(VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const RayCastOptions& options, Span<float> colors, Span<float> depths)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  if (colors.size() != 4 * pixels || depths.size() != pixels)
  {
    throw std::invalid_argument("the image arrays do not have the size of the ray grid");
  }
  scene.CheckComplete();

  RayCastStatistics statistics;
  const WalkMesh& mesh = *scene.GetMesh();
  const OpticalModel model = scene.GetOpticalModel();
  const bool cellData = scene.HasCellScalars();
  const bool lit = options.Shaded && model == OpticalModel::EmissionAbsorption && !cellData;
  const Integrator integrator = ChooseIntegrator(scene, lit, statistics.Integration);
  const double worldRadius = scene.GetWorldRadius(grid);
  const double geometryError = options.Arithmetic == Precision::Double
    ? 0
    : scene.EstimateGeometryError(worldRadius, SingleRounding);
  // Half of the error may come from ending rays early, a quarter from rounding.
  statistics.DoublePrecision = options.Arithmetic == Precision::Double ||
    !std::isfinite(geometryError) ||
    (options.Arithmetic == Precision::Automatic && geometryError > 0.25 * options.MaximumError);
  const bool endsEarly =
    model != OpticalModel::EmissionOnly && model != OpticalModel::MaximumIntensity;
  statistics.TerminationError = endsEarly ? 0.5 * options.MaximumError : 0;
  const bool hasWeights =
    model != OpticalModel::MaximumIntensity && model != OpticalModel::Isosurfaces;
  statistics.IntegralError = hasWeights ? SegmentWeightError : 0;
  statistics.GeometryError = statistics.DoublePrecision ? 0 : geometryError;
  const bool tabulated = integrator == Integrator::Table || integrator == Integrator::LitTable;
  statistics.TableError = tabulated ? scene.GetTableError() : 0;
  statistics.ErrorEstimate = statistics.TerminationError + statistics.IntegralError +
    statistics.TableError + statistics.GeometryError;

  const WalkTables* chosen = ChooseTables(scene, options, statistics);
  if (!chosen)
  {
    statistics.Aborted = true;
    return statistics;
  }
  const WalkTables& tables = *chosen;

  KernelInput in{};
  in.Points = statistics.DoublePrecision ? static_cast<const void*>(scene.GetPoints<double>())
                                         : static_cast<const void*>(scene.GetPoints<float>());
  if (cellData)
  {
    in.CellValues = scene.GetCellValues().data();
  }
  in.Faces = tables.Faces.data();
  in.Entries = tables.Entries.data();
  in.Nodes = tables.Bvh.Nodes.empty() ? nullptr : tables.Bvh.Nodes.data();
  in.Triangles = tables.Bvh.Triangles.data();
  in.NumberOfCells = mesh.GetNumberOfCells();
  std::copy_n(mesh.GetCenter(), 3, in.Center);
  in.Radius = mesh.GetRadius();
  in.Intervals = scene.GetIntervalTable().Intervals.data();
  in.NumberOfIntervals = static_cast<int>(scene.GetIntervalTable().Intervals.size());
  const VolumeScene::ScalarMap map = scene.GetScalarMap();
  const SurfaceTables surfaces(
    model == OpticalModel::Isosurfaces ? scene.GetIsosurfaces() : std::vector<Isosurface>(), map);
  in.SurfaceNeighbors = surfaces.Neighbors.data();
  in.SurfaceColors = surfaces.Colors.data();
  const SurfaceShading shading{ &mesh.GetMesh(), scene.GetScalars().data(),
    options.Shaded && options.SmoothShading && !cellData ? scene.GetPointGradients().data()
                                                         : nullptr,
    grid.MeshFromWorld, options.Lights, options.Surface };
  in.Shading = options.Shaded ? &shading : nullptr;
  in.DistanceRounding =
    worldRadius * (statistics.DoublePrecision ? DoubleDistanceRounding : SingleDistanceRounding);
  KernelTable table{};
  if (tabulated)
  {
    const PreIntegrationTable& t = *scene.GetTable();
    table.Texels = scene.GetFloatTexels();
    table.Axis = t.Scalars.Intervals.data();
    table.AxisSize = static_cast<int>(t.Scalars.Intervals.size());
    table.ScalarSize = t.Scalars.GetSize();
    table.LengthSize = t.Lengths.Size;
    table.Logarithmic = t.Lengths.Scale == LengthScale::Logarithmic;
    table.StepsPerDoubling = t.Lengths.StepsPerDoubling;
    table.InverseDelta = t.Lengths.InverseDelta;
  }
  in.Table = &table;
  in.Grid = &grid;
  in.Planes = limits.Planes.empty() ? nullptr : &limits.Planes.front();
  in.NumberOfPlanes = static_cast<int>(limits.Planes.size());
  in.CroppingPlanes = limits.Cropping ? limits.CroppingPlanes : nullptr;
  in.CroppingFlags = limits.CroppingFlags;
  in.MaximumDistances = limits.MaximumDistances;
  const double behind = statistics.TerminationError /
    (lit ? FindLargestBrightness(options.Lights, options.Surface) : 1);
  in.MaximumOpacity = static_cast<float>(1 - behind);
  in.MaximumDepth = static_cast<float>(-std::log(statistics.TerminationError));
  if (model == OpticalModel::EmissionAbsorption && scene.GetPlan().ConstantColor)
  {
    std::copy_n(scene.GetPlan().Color, 3, in.Color);
  }
  in.Colors = colors.data();
  in.Depths = depths.data();

  const InstructionSet set = GetInstructionSet(options.PortableKernels);
  const RayCastKernels::Pair& kernels = cellData ? set.Kernels.Cells[static_cast<int>(integrator)]
                                                 : set.Kernels.Points[static_cast<int>(integrator)];
  const RayCastKernel kernel = statistics.DoublePrecision ? kernels.Double : kernels.Single;

  const int tilesX = (grid.Width + TileSize - 1) / TileSize;
  const int tilesY = (grid.Height + TileSize - 1) / TileSize;
  const int tiles = tilesX * tilesY;
  const int threads = options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads();
  std::atomic<bool> stop{ false };
  std::atomic<int> tilesDone{ 0 };
  std::exception_ptr failure;
  KernelCounts counts;

  // By the calling thread only, and not for every tile: who is asked may look at a window's events.
  using Clock = std::chrono::steady_clock;
  Clock::time_point nextReport = Clock::now();
  const auto report = [&]()
  {
    if (omp_get_thread_num() != 0 || !options.Progress || Clock::now() < nextReport)
    {
      return;
    }
    nextReport = Clock::now() + ReportInterval;
    if (!options.Progress(static_cast<double>(tilesDone) / tiles))
    {
      statistics.Aborted = true;
      stop = true;
    }
  };

#pragma omp parallel num_threads(threads)
  {
    KernelCounts own;
    try
    {
      OwningCrossingBuffer buffer;
#pragma omp for schedule(dynamic) nowait
      for (int tile = 0; tile < tiles; ++tile)
      {
        if (stop)
        {
          continue;
        }
        try
        {
          const int x = tile % tilesX * TileSize;
          const int y = tile / tilesX * TileSize;
          kernel(in, x, y, std::min(x + TileSize, grid.Width), std::min(y + TileSize, grid.Height),
            buffer, own);
          ++tilesDone;
          report();
        }
        catch (...)
        {
#pragma omp critical(tetralux_cast_failure)
          failure = std::current_exception();
          stop = true;
        }
      }
      // Tiles go to whoever is free; the calling thread stays to be asked while others finish.
      while (omp_get_thread_num() == 0 && options.Progress && !stop && tilesDone < tiles)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        report();
      }
    }
    catch (...)
    {
#pragma omp critical(tetralux_cast_failure)
      failure = std::current_exception();
      stop = true;
    }
#pragma omp critical(tetralux_cast_counts)
    {
      counts.Segments += own.Segments;
      counts.Steps += own.Steps;
      counts.Paths += own.Paths;
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  if (options.Progress && !statistics.Aborted)
  {
    options.Progress(1); // too late to abort
  }
  statistics.InstructionSet = set.Name;
  statistics.NumberOfThreads = threads;
  statistics.Rays = static_cast<std::int64_t>(pixels);
  statistics.Segments = counts.Segments;
  statistics.Paths = counts.Paths;
  if (counts.Paths > 0)
  {
    // A sum is rounded once for each segment.
    const double segments = static_cast<double>(counts.Segments) / counts.Paths;
    statistics.SummationError = segments * std::numeric_limits<float>::epsilon() / 2;
    statistics.ErrorEstimate += statistics.SummationError;
  }
  statistics.LaneUse = counts.Steps
    ? static_cast<double>(counts.Segments) / (8. * static_cast<double>(counts.Steps))
    : 0;
  return statistics;
}

} // namespace tetralux
