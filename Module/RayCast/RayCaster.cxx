// SPDX-License-Identifier: BSD-3-Clause
#include "RayCast/RayCaster.h"

#include "Base/ParallelTiles.h"
#include "Integral/SegmentWeightError.h"
#include "RayCast/BoundaryTiles.h"
#include "RayCast/KernelInput.h"
#include "RayCast/RayCastKernel.h"
#include "Scene/IntegratorChoice.h"
#include "Simd/InstructionSet.h"
#include "View/MeshToWorld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <omp.h>

namespace tetralux
{
namespace
{

/// Sorting a face of the boundary into tiles costs as much as this share of finding the boundary by
/// the hierarchy for a ray.
constexpr double RaysPerFace = 0.5;

constexpr int InitialCrossings = 32;

/// wide: of AVX-512, those of 16 lanes.
RayCastKernels GetKernels(InstructionSet set, bool wide)
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  switch (set)
  {
    case InstructionSet::Avx512:
      return wide ? GetRayCastKernelsAvx512Wide() : GetRayCastKernelsAvx512();
    case InstructionSet::Avx2:
      return GetRayCastKernelsAvx2();
    default:
      break;
  }
#else
  static_cast<void>(set);
  static_cast<void>(wide);
#endif
  return GetRayCastKernelsGeneric();
}

/// A CrossingBuffer that owns its memory.
struct OwningCrossingBuffer : CrossingBuffer
{
  std::vector<FaceCrossing> Storage;

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
    self.Storage.resize(static_cast<std::size_t>(self.Capacity));
    self.Crossings = self.Storage.data();
  }
};

/// The tables that rays are walked through; nullptr after an abort.
const WalkTables* ChooseTables(
  VolumeScene& scene, const RayCastOptions& options, RayCastStatistics& statistics)
{
  WalkMesh& mesh = *scene.Mesh.GetMesh();
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
  SceneNeeds needs;
  needs.VisibleTables = true;
  scene.Prepare(needs);
  if (const WalkTables* visible = scene.GetVisibleTables())
  {
    statistics.TransparentCells = scene.GetNumberOfTransparentCells();
    return visible;
  }
  return &mesh.GetTables();
}

/// Chooses the integrator, precision and walk of a picture, and prepares what they need of the
/// scene; no Tables after an abort. Tells statistics what was chosen, and the errors that follow
/// from it.
CastChoices ChooseCast(VolumeScene& scene, const RayGrid& grid, const RayCastOptions& options,
  RayCastStatistics& statistics)
{
  scene.Prepare({});
  CastChoices choices;
  choices.CellData = scene.Mesh.HasCellScalars();
  choices.Method =
    ChooseIntegrator(scene, FindLighting(options.Shaded, options.SmoothShading, options.Lights));
  const bool tabulated = IsTabulated(choices.Method);
  const ErrorBudget budget = MakeErrorBudget(options.MaximumError,
    { EndsEarly(choices.Method), tabulated, false, scene.Optics.GetFunctionError() > 0,
      choices.Method == Integrator::VaryingLight });
  choices.WorldRadius =
    scene.Mesh.GetMesh()->GetRadius() * MeasureMeshToWorld(grid.MeshFromWorld).Largest;
  const double geometryError = options.Arithmetic == Precision::Double
    ? 0
    : scene.EstimateGeometryError(choices.WorldRadius, SingleRounding);
  choices.DoublePrecision = options.Arithmetic == Precision::Double ||
    choices.Method == Integrator::Components || !std::isfinite(geometryError) ||
    (options.Arithmetic == Precision::Automatic && geometryError > budget.Geometry);
  choices.GeometryError = budget.Geometry;
  choices.TerminationError = budget.Termination;
  choices.Lit = options.Shaded && !choices.CellData &&
    (IsLit(choices.Method) || choices.Method == Integrator::Isosurfaces);
  choices.SmoothShading = options.SmoothShading;
  statistics.Integration = choices.Method;
  statistics.Budget = budget;
  statistics.DoublePrecision = choices.DoublePrecision;
  statistics.TerminationError = choices.TerminationError;
  statistics.IntegralError = HasWeights(choices.Method) ? SegmentWeightError : 0;
  statistics.GeometryError = choices.DoublePrecision ? 0 : geometryError;
  choices.LightError = budget.Light;
  if (IsLit(choices.Method))
  {
    const WalkMesh& mesh = *scene.Mesh.GetMesh();
    choices.Brightness = FindLargestBrightness(options.Lights, options.Surface, grid.MeshFromWorld,
      mesh.GetCenter(), mesh.GetRadius(), MeasureMeshToWorld(grid.MeshFromWorld).Smallest);
    statistics.Brightness = choices.Brightness;
  }
  statistics.TableError = tabulated ? scene.Optics.GetTableError() : 0;
  choices.Tables = ChooseTables(scene, options, statistics);
  if (choices.Tables)
  {
    SceneNeeds needs;
    needs.SinglePoints = !choices.DoublePrecision;
    needs.DoublePoints = choices.DoublePrecision;
    needs.PointGradients = choices.Lit && choices.SmoothShading;
    needs.CellGradients = choices.Lit && !choices.SmoothShading;
    needs.FloatTexels = tabulated;
    needs.ComponentRows = choices.Method == Integrator::Components;
    scene.Prepare(needs);
  }
  return choices;
}

/// Whether rays are cast in packets of 16.
bool IsWide(const RayCastOptions& options, const CastChoices& choices)
{
  return !options.Kernels && options.WideKernels && !choices.DoublePrecision && HasFastWideLanes();
}

RayCastKernel ChooseKernel(InstructionSet set, bool wide, const CastChoices& choices)
{
  const RayCastKernels all = GetKernels(set, wide);
  const RayCastKernels::Pair& pair = choices.CellData
    ? all.Cells[static_cast<int>(choices.Method)]
    : all.Points[static_cast<int>(choices.Method)];
  return choices.DoublePrecision ? pair.Double : pair.Single;
}

/// The rays of a picture that do not end before they begin.
std::int64_t CountRays(const RayGrid& grid, const RayLimits& limits)
{
  const std::int64_t pixels = static_cast<std::int64_t>(grid.Width) * grid.Height;
  return limits.MaximumDistances ? pixels -
      std::count(limits.MaximumDistances, limits.MaximumDistances + pixels,
        -std::numeric_limits<float>::infinity())
                                 : pixels;
}

/// Sorts the boundary into tiles, if that is asked for or pays, and possible.
bool FillTiles(const WalkMesh& mesh, const WalkTables& tables, const RayGrid& grid,
  const RayLimits& limits, const RayCastOptions& options, int threads, BoundaryTiles& tiles,
  KernelInput& in)
{
  const bool pays = options.Boundary == BoundarySearch::Automatic
    ? RaysPerFace * static_cast<double>(tables.Entries.size()) <
      static_cast<double>(CountRays(grid, limits))
    : options.Boundary == BoundarySearch::Tiles;
  if (!pays || !MakeBoundaryTiles(mesh, tables, grid, threads, tiles))
  {
    return false;
  }
  in.TileFaces = tiles.Faces.data();
  in.TileBegins = tiles.Begins.data();
  in.TileColumns = tiles.Grid.GetColumns();
  return !tiles.Faces.empty();
}

/// What a thread writes while it casts; on cache lines of its own.
struct alignas(64) ThreadMemory
{
  OwningCrossingBuffer Crossings[PacketsInFlight];
  KernelCounts Counts;
};

/// Whether a segment adds each piece on which the function is linear.
bool AddsPieces(Integrator integrator)
{
  return HasWeights(integrator) && !IsTabulated(integrator);
}

/// Adds to statistics what the rays met, and the errors that follow from it. pieces: that a segment
/// adds. largest: what a channel comes to.
void Summarize(const std::vector<ThreadMemory>& threads, double pieces, double largest,
  RayCastStatistics& statistics)
{
  KernelCounts counts;
  for (const ThreadMemory& thread : threads)
  {
    counts.Segments += thread.Counts.Segments;
    counts.Lanes += thread.Counts.Lanes;
    counts.Paths += thread.Counts.Paths;
    counts.ShiftError = std::max(counts.ShiftError, thread.Counts.ShiftError);
  }
  statistics.NumberOfThreads = static_cast<int>(threads.size());
  statistics.Segments = counts.Segments;
  statistics.Paths = counts.Paths;
  statistics.GeometryError = std::max(statistics.GeometryError, std::min(1., counts.ShiftError));
  if (counts.Paths > 0)
  {
    // A sum is rounded once for each piece.
    const double segments = static_cast<double>(counts.Segments) / counts.Paths;
    statistics.SummationError =
      largest * std::min(1., segments * pieces * std::numeric_limits<float>::epsilon() / 2);
  }
  if (counts.Lanes > 0)
  {
    statistics.LaneUse = static_cast<double>(counts.Segments) / static_cast<double>(counts.Lanes);
  }
}

/// A picture on its way through the kernels.
class Casting
{
public:
  Casting(VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
    const RayCastOptions& options, const CastChoices& choices, Span<float> colors,
    Span<float> depths)
    : Scene(scene)
    , Grid(grid)
    , Limits(limits)
    , Options(options)
    , Choices(choices)
    , Colors(colors)
    , Depths(depths)
    , Set(options.Kernels.value_or(GetWidestInstructionSet()))
    , Threads(options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads())
  {
  }

  void Cast(RayCastStatistics& statistics)
  {
    OwningKernelInput in;
    this->Fill(this->Choices, in);
    statistics.BoundaryTiles = FillTiles(*this->Scene.Mesh.GetMesh(), *this->Choices.Tables,
      this->Grid, this->Limits, this->Options, this->GetNumberOfThreads(), this->Boundary, in);
    // Where double precision takes over, it is a part of the work that is not known yet.
    const bool mixed = in.ShiftFactor > 0 && this->Options.Arithmetic == Precision::Automatic;
    RawVector<std::uint8_t> marks;
    if (mixed)
    {
      marks.assign(
        static_cast<std::size_t>(GetBlockPlace(this->Grid.Width, 0, this->Grid.Height - 1) +
          GetBlockPlace(this->Grid.Width, 0, BlockHeight)),
        0);
      in.InexactBlocks = marks.data();
    }
    const RayCastKernel kernel =
      ChooseKernel(this->Set, IsWide(this->Options, this->Choices), this->Choices);
    const TileGrid tiles{ this->Grid.Width, this->Grid.Height, RayTileSize };
    statistics.Aborted =
      !ForEachTile(tiles, this->GetNumberOfThreads(), this->MakeProgress(0, mixed ? FirstShare : 1),
        [&](const Tile& tile, int thread) { this->CastTile(in, kernel, tile, thread); });
    if (mixed && !statistics.Aborted)
    {
      this->CastMarked(in, marks, statistics);
    }
    statistics.InstructionSet = GetName(this->Set);
    statistics.Rays = static_cast<std::int64_t>(this->Grid.Width) * this->Grid.Height;
    statistics.DoubleRays += this->Choices.DoublePrecision ? statistics.Rays : 0;
    Summarize(this->Threads, AddsPieces(this->Choices.Method) ? this->Scene.EstimatePieces() : 1.,
      this->Scene.EstimateLargestChannel(this->Choices.WorldRadius), statistics);
  }

private:
  /// Of the progress of a picture, what is reported before packets are cast in double precision.
  static constexpr double FirstShare = 0.95;

  int GetNumberOfThreads() const { return static_cast<int>(this->Threads.size()); }

  void Fill(const CastChoices& choices, OwningKernelInput& in)
  {
    FillKernelInput(this->Scene, this->Grid, this->Limits, this->Options, choices, in);
    in.Colors = this->Colors.data();
    in.Depths = this->Depths.data();
  }

  /// Reports shares of a part of the work.
  std::function<bool(double)> MakeProgress(double from, double to) const
  {
    if (!this->Options.Progress || (from == 0 && to == 1))
    {
      return this->Options.Progress;
    }
    return [this, from, to](double share)
    { return this->Options.Progress(from + share * (to - from)); };
  }

  void CastTile(const KernelInput& in, RayCastKernel kernel, const Tile& tile, int thread)
  {
    ThreadMemory& memory = this->Threads[thread];
    kernel(in, tile.X0, tile.Y0, tile.X1, tile.Y1, { &memory.Crossings[0], &memory.Crossings[1] },
      memory.Counts);
  }

  /// Casts the blocks that single precision left out.
  void CastMarked(
    const KernelInput& single, const RawVector<std::uint8_t>& marks, RayCastStatistics& statistics)
  {
    std::vector<Tile> blocks;
    for (int y = 0; y < this->Grid.Height; y += BlockHeight)
    {
      for (int x = 0; x < this->Grid.Width; x += BlockWidth)
      {
        if (marks[GetBlockPlace(this->Grid.Width, x, y)] != 0)
        {
          blocks.push_back({ x, y, std::min(x + BlockWidth, this->Grid.Width),
            std::min(y + BlockHeight, this->Grid.Height) });
        }
      }
    }
    if (blocks.empty())
    {
      if (this->Options.Progress)
      {
        this->Options.Progress(1);
      }
      return;
    }
    CastChoices choices = this->Choices;
    choices.DoublePrecision = true;
    SceneNeeds needs;
    needs.DoublePoints = true;
    this->Scene.Prepare(needs);
    OwningKernelInput in;
    this->Fill(choices, in);
    in.TileFaces = single.TileFaces;
    in.TileBegins = single.TileBegins;
    in.TileColumns = single.TileColumns;
    const RayCastKernel kernel = ChooseKernel(this->Set, IsWide(this->Options, choices), choices);
    // A row of blocks, each a tile of one.
    const TileGrid row{ static_cast<int>(blocks.size()), 1, 1 };
    statistics.Aborted = !ForEachTile(row, this->GetNumberOfThreads(),
      this->MakeProgress(FirstShare, 1),
      [&](const Tile& block, int thread) { this->CastTile(in, kernel, blocks[block.X0], thread); });
    for (const Tile& block : blocks)
    {
      statistics.DoubleRays +=
        static_cast<std::int64_t>(block.X1 - block.X0) * (block.Y1 - block.Y0);
    }
  }

  VolumeScene& Scene;
  const RayGrid& Grid;
  const RayLimits& Limits;
  const RayCastOptions& Options;
  const CastChoices& Choices;
  Span<float> Colors, Depths;
  InstructionSet Set;
  std::vector<ThreadMemory> Threads;
  BoundaryTiles Boundary;
};

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
    Casting(scene, grid, limits, options, choices, colors, depths).Cast(statistics);
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
