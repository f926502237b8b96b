// SPDX-License-Identifier: BSD-3-Clause
#include "RayCast/RayCaster.h"

#include "Base/ParallelTiles.h"
#include "Integral/SegmentIntegral.h"
#include "RayCast/KernelInput.h"
#include "RayCast/RayCastKernel.h"
#include "Simd/InstructionSet.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <omp.h>

namespace tetralux
{
namespace
{

/// Pixels along a tile's edge: rays of a tile share cells in the first-level cache, and there are
/// enough tiles to balance threads.
constexpr int TileSize = 16;

constexpr int InitialCrossings = 32;

RayCastKernels GetKernels(InstructionSet set)
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  if (set == InstructionSet::Avx2)
  {
    return GetRayCastKernelsAvx2();
  }
#endif
  static_cast<void>(set);
  return GetRayCastKernelsGeneric();
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
  // Crossings points into Storage.
  OwningCrossingBuffer(const OwningCrossingBuffer&) = delete;
  OwningCrossingBuffer& operator=(const OwningCrossingBuffer&) = delete;

  static void Double(CrossingBuffer& buffer)
  {
    auto& self = static_cast<OwningCrossingBuffer&>(buffer);
    self.Capacity *= 2;
    self.Storage.resize(LaneCount * static_cast<std::size_t>(self.Capacity));
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

/// Chooses the integrator, precision and walk of a picture; no Tables after an abort. Tells
/// statistics what was chosen, and the errors that follow from it.
CastChoices ChooseCast(VolumeScene& scene, const RayGrid& grid, const RayCastOptions& options,
  RayCastStatistics& statistics)
{
  CastChoices choices;
  const OpticalModel model = scene.GetOpticalModel();
  choices.CellData = scene.HasCellScalars();
  choices.Lit = options.Shaded && model == OpticalModel::EmissionAbsorption && !choices.CellData;
  choices.Method = ChooseIntegrator(scene, choices.Lit, statistics.Integration);
  choices.WorldRadius = scene.GetWorldRadius(grid);
  const double geometryError = scene.EstimateGeometryError(choices.WorldRadius);
  // Half of the error may come from ending rays early, a quarter from rounding.
  choices.DoublePrecision = options.Arithmetic == Precision::Double ||
    !std::isfinite(geometryError) ||
    (options.Arithmetic == Precision::Automatic && geometryError > 0.25 * options.MaximumError);
  const bool endsEarly =
    model != OpticalModel::EmissionOnly && model != OpticalModel::MaximumIntensity;
  choices.TerminationError = endsEarly ? 0.5 * options.MaximumError : 0;
  const bool hasWeights =
    model != OpticalModel::MaximumIntensity && model != OpticalModel::Isosurfaces;
  statistics.DoublePrecision = choices.DoublePrecision;
  statistics.TerminationError = choices.TerminationError;
  statistics.IntegralError = hasWeights ? SegmentWeightError : 0;
  statistics.GeometryError = choices.DoublePrecision ? 0 : geometryError;
  statistics.TableError = choices.UsesTable() ? scene.GetTableError() : 0;
  choices.Tables = ChooseTables(scene, options, statistics);
  return choices;
}

RayCastKernel ChooseKernel(InstructionSet set, const CastChoices& choices)
{
  const RayCastKernels all = GetKernels(set);
  const RayCastKernels::Pair& pair = choices.CellData
    ? all.Cells[static_cast<int>(choices.Method)]
    : all.Points[static_cast<int>(choices.Method)];
  return choices.DoublePrecision ? pair.Double : pair.Single;
}

/// What a thread writes while it casts; on cache lines of its own.
struct alignas(64) ThreadMemory
{
  OwningCrossingBuffer Crossings;
  KernelCounts Counts;
};

/// Adds to statistics what the rays met, and the error that follows from it.
void Summarize(const std::vector<ThreadMemory>& threads, RayCastStatistics& statistics)
{
  KernelCounts counts;
  for (const ThreadMemory& thread : threads)
  {
    counts.Segments += thread.Counts.Segments;
    counts.Steps += thread.Counts.Steps;
    counts.Paths += thread.Counts.Paths;
  }
  statistics.NumberOfThreads = static_cast<int>(threads.size());
  statistics.Segments = counts.Segments;
  statistics.Paths = counts.Paths;
  if (counts.Paths > 0)
  {
    // A sum is rounded once for each segment.
    const double segments = static_cast<double>(counts.Segments) / counts.Paths;
    statistics.SummationError = segments * std::numeric_limits<float>::epsilon() / 2;
  }
  if (counts.Steps > 0)
  {
    statistics.LaneUse =
      static_cast<double>(counts.Segments) / (LaneCount * static_cast<double>(counts.Steps));
  }
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
  const CastChoices choices = ChooseCast(scene, grid, options, statistics);
  if (choices.Tables)
  {
    OwningKernelInput in;
    FillKernelInput(scene, grid, limits, options, choices, in);
    in.Colors = colors.data();
    in.Depths = depths.data();

    const InstructionSet set =
      options.PortableKernels ? InstructionSet::Generic : GetInstructionSet();
    const RayCastKernel kernel = ChooseKernel(set, choices);
    std::vector<ThreadMemory> threads(
      options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads());
    const TileGrid tiles{ grid.Width, grid.Height, TileSize };
    statistics.Aborted = !ForEachTile(tiles, static_cast<int>(threads.size()), options.Progress,
      [&](const Tile& tile, int thread)
      {
        ThreadMemory& memory = threads[thread];
        kernel(in, tile.X0, tile.Y0, tile.X1, tile.Y1, memory.Crossings, memory.Counts);
      });

    statistics.InstructionSet = GetName(set);
    statistics.Rays = static_cast<std::int64_t>(pixels);
    Summarize(threads, statistics);
  }
  else
  {
    statistics.Aborted = true;
  }
  statistics.ErrorEstimate = statistics.TerminationError + statistics.IntegralError +
    statistics.TableError + statistics.GeometryError + statistics.SummationError;
  return statistics;
}

} // namespace tetralux
