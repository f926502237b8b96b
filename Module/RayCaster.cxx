// SPDX-License-Identifier: BSD-3-Clause
#include "RayCaster.h"

#include "RayCastKernel.h"
#include "SegmentIntegral.h"
#include "VisibleCells.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
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

/// Leaving transparent cells out takes tables of its own; below this share of the cells it is not
/// tried.
constexpr double MinimumTransparentShare = 0.1;

/// What finding a way in costs, in cells walked through: leaving transparent cells out saves these
/// and makes more boundary.
constexpr double EntryCost = 4;

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

/// World radii of meshes for which single precision does: distances inside keep all their digits, as
/// do their products with attenuations that make them visible.
constexpr double SmallestSingleRadius = 1e-30;
constexpr double LargestSingleRadius = 1e30;

/// Radius of the mesh in the world: its longest extent, since MeshFromWorld may stretch.
double GetWorldRadius(const WalkMesh& mesh, const RayGrid& grid)
{
  // The shortest change in the mesh for one world unit bounds the scale from below; rows and
  // columns do for an estimate.
  double shortest = 0;
  for (int column = 0; column < 3; ++column)
  {
    const double length = std::hypot(
      grid.MeshFromWorld[0][column], grid.MeshFromWorld[1][column], grid.MeshFromWorld[2][column]);
    shortest = column == 0 ? length : std::min(shortest, length);
  }
  return shortest > 0 && std::isfinite(shortest) ? mesh.GetRadius() / shortest : mesh.GetRadius();
}

} // namespace

void RayCaster::SetMesh(std::shared_ptr<WalkMesh> mesh)
{
  this->Mesh = std::move(mesh);
  this->Scalars.clear();
  this->FloatScalarsValid = this->DoubleScalarsValid = this->CellValuesValid =
    this->VisibleTablesValid = false;
}

void RayCaster::SetPointScalars(std::vector<double> scalars)
{
  this->SetScalars(std::move(scalars), false);
}

void RayCaster::SetCellScalars(std::vector<double> scalars)
{
  this->SetScalars(std::move(scalars), true);
}

void RayCaster::SetScalars(std::vector<double> scalars, bool ofCells)
{
  if (!this->Mesh)
  {
    throw std::invalid_argument("the mesh must be set before its scalars");
  }
  const TetrahedralMesh& mesh = this->Mesh->GetMesh();
  const std::size_t expected = ofCells ? mesh.GetNumberOfCells() : mesh.GetNumberOfPoints();
  if (scalars.size() != expected)
  {
    throw std::invalid_argument(std::to_string(scalars.size()) + " scalars were given for " +
      std::to_string(expected) + (ofCells ? " cells" : " points"));
  }
  this->Scalars = std::move(scalars);
  this->ScalarsOfCells = ofCells;
  this->FloatScalarsValid = this->DoubleScalarsValid = this->CellValuesValid =
    this->VisibleTablesValid = false;

  bool allFinite = true;
  bool any = false;
  for (double s : this->Scalars)
  {
    if (!std::isfinite(s))
    {
      allFinite = false;
      continue;
    }
    this->ScalarRange[0] = any ? std::min(this->ScalarRange[0], s) : s;
    this->ScalarRange[1] = any ? std::max(this->ScalarRange[1], s) : s;
    any = true;
  }
  if (!any)
  {
    this->ScalarRange[0] = this->ScalarRange[1] = 0;
  }
  this->NumberOfBlankCells = 0;
  if (!allFinite)
  {
    this->CountBlankCells();
  }
}

void RayCaster::CountBlankCells()
{
  const std::vector<std::int32_t>& cells = this->Mesh->GetMesh().Cells;
  const std::int64_t n = static_cast<std::int64_t>(cells.size() / 4);
  for (std::int64_t t = 0; t < n; ++t)
  {
    const std::int32_t* p = &cells[4 * t];
    const bool finite = this->ScalarsOfCells
      ? std::isfinite(this->Scalars[t])
      : std::all_of(p, p + 4, [this](std::int32_t id) { return std::isfinite(this->Scalars[id]); });
    this->NumberOfBlankCells += !finite;
  }
}

void RayCaster::SetTransferFunction(const TransferFunction& function)
{
  IntervalTable table = MakeIntervalTable(function);
  // Scalars in the tables are mapped to the function's range; they stay where that stays.
  if (table.Offset != this->Table.Offset || table.Scale != this->Table.Scale)
  {
    this->FloatScalarsValid = this->DoubleScalarsValid = false;
  }
  this->Function = function;
  this->Table = std::move(table);
  this->CellValuesValid = this->VisibleTablesValid = false;
}

double RayCaster::GetLargestMappedScalar() const
{
  return std::max({ 1., std::abs((this->ScalarRange[0] - this->Table.Offset) / this->Table.Scale),
    std::abs((this->ScalarRange[1] - this->Table.Offset) / this->Table.Scale) });
}

double RayCaster::EstimateGeometryError(
  const IntervalTable& table, double worldRadius, double largestScalar)
{
  constexpr double FaceRounding = 1. / (1 << 23);
  constexpr double ScalarRounding = 1. / (1 << 24);
  const double faces = FaceRounding * (table.MaximumAttenuation + table.AttenuationVariation);
  // Scalars do not matter to a constant, however large they are.
  const double scalars = table.AttenuationVariation > 0
    ? ScalarRounding * largestScalar * table.AttenuationVariation
    : 0;
  const double error = faces + scalars;
  return error > 0 ? worldRadius * error : 0;
}

void RayCaster::UpdatePointScalars(bool doublePrecision)
{
  if (doublePrecision && !this->DoubleScalarsValid)
  {
    this->Mesh->SetPointScalars<double>(this->Scalars, this->Table.Offset, this->Table.Scale);
    this->DoubleScalarsValid = true;
  }
  else if (!doublePrecision && !this->FloatScalarsValid)
  {
    this->Mesh->SetPointScalars<float>(this->Scalars, this->Table.Offset, this->Table.Scale);
    this->FloatScalarsValid = true;
  }
}

void RayCaster::UpdateCellValues()
{
  if (this->CellValuesValid)
  {
    return;
  }
  const std::int64_t n = static_cast<std::int64_t>(this->Scalars.size());
  this->CellValues.resize(n);
#pragma omp parallel for schedule(static)
  for (std::int64_t t = 0; t < n; ++t)
  {
    CellValue value{};
    if (std::isfinite(this->Scalars[t]))
    {
      const TransferFunction::Value v = Evaluate(this->Function, this->Scalars[t]);
      value.Attenuation = static_cast<float>(v.Attenuation);
      for (int c = 0; c < 3; ++c)
      {
        value.Color[c] = static_cast<float>(v.Color[c]);
      }
    }
    this->CellValues[t] = value;
  }
  this->CellValuesValid = true;
}

void RayCaster::UpdateVisibleTables()
{
  if (this->VisibleTablesValid)
  {
    return;
  }
  this->VisibleTables = WalkTables();
  this->NumberOfTransparentCells = 0;
  const std::vector<std::int32_t>& cells = this->Mesh->GetMesh().Cells;
  const std::vector<std::uint8_t> visible =
    FindVisibleCells(this->Function, cells, this->Scalars, this->ScalarsOfCells);
  const std::int64_t transparent = std::count(visible.begin(), visible.end(), 0);
  if (transparent > MinimumTransparentShare * static_cast<double>(visible.size()))
  {
    const WalkTables& all = this->Mesh->GetTables();
    const Span<const WalkPoint<float>> points(
      this->Mesh->GetPoints<float>(), this->Mesh->GetMesh().GetNumberOfPoints());
    WalkTables tables = MakeWalkTables(all.Faces, cells, points, visible);
    const double cellsLess = static_cast<double>(transparent);
    const double entriesMore =
      static_cast<double>(tables.Entries.size()) - static_cast<double>(all.Entries.size());
    if (EntryCost * entriesMore < cellsLess)
    {
      this->VisibleTables = std::move(tables);
      this->NumberOfTransparentCells = transparent;
    }
  }
  this->VisibleTablesValid = true;
}

RayCastStatistics RayCaster::Cast(const RayGrid& grid, const RayLimits& limits,
  const RayCastOptions& options, Span<float> colors, Span<float> depths)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  if (colors.size() != 4 * pixels || depths.size() != pixels)
  {
    throw std::invalid_argument("the image arrays do not have the size of the ray grid");
  }
  if (!this->Mesh || this->Table.Intervals.empty())
  {
    throw std::invalid_argument("a mesh and a transfer function must be set before rays are cast");
  }
  if (this->Scalars.size() !=
    (this->ScalarsOfCells ? this->Mesh->GetMesh().GetNumberOfCells()
                          : this->Mesh->GetMesh().GetNumberOfPoints()))
  {
    throw std::invalid_argument("scalars must be set after the mesh and before rays are cast");
  }

  RayCastStatistics statistics;
  const double worldRadius = GetWorldRadius(*this->Mesh, grid);
  const double geometryError =
    EstimateGeometryError(this->Table, worldRadius, this->GetLargestMappedScalar());
  // Half of the error may come from ending rays early, a quarter from rounding.
  statistics.DoublePrecision = options.Arithmetic == Precision::Double ||
    !(SmallestSingleRadius <= worldRadius && worldRadius <= LargestSingleRadius) ||
    (options.Arithmetic == Precision::Automatic && geometryError > 0.25 * options.MaximumError);
  statistics.TerminationError = 0.5 * options.MaximumError;
  statistics.IntegralError = SegmentWeightError;
  statistics.GeometryError = statistics.DoublePrecision ? 0 : geometryError;
  statistics.ErrorEstimate =
    statistics.TerminationError + statistics.IntegralError + statistics.GeometryError;

  // Double precision coordinates are filled in together with the scalars.
  if (!this->ScalarsOfCells || statistics.DoublePrecision)
  {
    if (this->ScalarsOfCells)
    {
      if (!this->Mesh->GetPoints<double>())
      {
        const std::vector<double> none(this->Mesh->GetMesh().GetNumberOfPoints(), 0.);
        this->Mesh->SetPointScalars<double>(none, 0, 1);
      }
    }
    else
    {
      this->UpdatePointScalars(statistics.DoublePrecision);
    }
  }
  if (this->ScalarsOfCells)
  {
    this->UpdateCellValues();
  }

  this->UpdateVisibleTables();

  KernelInput in{};
  in.Points = statistics.DoublePrecision ? static_cast<const void*>(this->Mesh->GetPoints<double>())
                                         : static_cast<const void*>(this->Mesh->GetPoints<float>());
  const WalkTables& tables =
    this->NumberOfTransparentCells > 0 ? this->VisibleTables : this->Mesh->GetTables();
  in.Faces = tables.Faces.data();
  in.Entries = tables.Entries.data();
  in.Nodes = tables.Bvh.Nodes.empty() ? nullptr : tables.Bvh.Nodes.data();
  in.Triangles = tables.Bvh.Triangles.data();
  in.NumberOfCells = this->Mesh->GetNumberOfCells();
  std::copy_n(this->Mesh->GetCenter(), 3, in.Center);
  in.Radius = this->Mesh->GetRadius();
  in.Intervals = this->Table.Intervals.data();
  in.CellValues = this->CellValues.data();
  in.Grid = &grid;
  in.Planes = limits.Planes.empty() ? nullptr : &limits.Planes.front();
  in.NumberOfPlanes = static_cast<int>(limits.Planes.size());
  in.CroppingPlanes = limits.Cropping ? limits.CroppingPlanes : nullptr;
  in.CroppingFlags = limits.CroppingFlags;
  in.MaximumDistances = limits.MaximumDistances;
  in.MinimumTransmittance = static_cast<float>(statistics.TerminationError);
  in.Colors = colors.data();
  in.Depths = depths.data();

  const InstructionSet set = GetInstructionSet(options.PortableKernels);
  const RayCastKernel kernel = this->ScalarsOfCells
    ? (statistics.DoublePrecision ? set.Kernels.CellDouble : set.Kernels.CellFloat)
    : (statistics.DoublePrecision ? set.Kernels.PointDouble : set.Kernels.PointFloat);

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
  statistics.TransparentCells = this->NumberOfTransparentCells;
  statistics.LaneUse = counts.Steps
    ? static_cast<double>(counts.Segments) / (8. * static_cast<double>(counts.Steps))
    : 0;
  return statistics;
}

} // namespace tetralux
