// SPDX-License-Identifier: BSD-3-Clause
#include "RayCaster.h"

#include "RayCastKernel.h"
#include "SegmentIntegral.h"
#include "VisibleCells.h"

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

/// Leaving transparent cells out takes tables of its own; below this share of the cells it is not
/// tried.
constexpr double MinimumTransparentShare = 0.1;

/// What finding a way in costs, in cells walked through: leaving transparent cells out saves these
/// and makes more boundary.
constexpr double EntryCost = 4;

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

/// The cheapest way of integrating that is exact for the model, or by table, and its name in
/// statistics.
Integrator ChooseIntegrator(OpticalModel model, bool constantColor, bool table, std::string& name)
{
  switch (model)
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
  if (constantColor)
  {
    name = "optical depth";
    return Integrator::OpticalDepth;
  }
  name = table ? "table" : "closed form";
  return table ? Integrator::Table : Integrator::ClosedForm;
}

/// Isosurfaces as the kernels read them.
struct SurfaceTables
{
  std::vector<std::array<float, 2>> Neighbors;
  std::vector<float> Colors;

  template <class MapT>
  SurfaceTables(const std::vector<Isosurface>& surfaces, MapT map)
  {
    // Beyond all scalars of the tables, which are bounded.
    float below = -std::numeric_limits<float>::infinity();
    for (const Isosurface& surface : surfaces)
    {
      const float value = map(surface.Value);
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
  this->FloatScalars = this->DoubleScalars = ScalarMap();
  this->CellValuesValid = this->VisibleTablesValid = this->PlanValid = false;
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
  this->FloatScalars = this->DoubleScalars = ScalarMap();
  this->CellValuesValid = this->VisibleTablesValid = this->PlanValid = false;

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

void RayCaster::SetOpticalModel(OpticalModel model)
{
  if (model != this->Model)
  {
    this->Model = model;
    this->CellValuesValid = this->VisibleTablesValid = this->PlanValid = false;
  }
}

void RayCaster::SetTransferFunction(const TransferFunction& function)
{
  this->Table = MakeIntervalTable(function);
  this->Function = function;
  this->SetTable(nullptr, 0);
  this->CellValuesValid = this->VisibleTablesValid = this->PlanValid = false;
}

void RayCaster::SetTable(std::shared_ptr<const PreIntegrationTable> table, double pictureError)
{
  this->SegmentTable = std::move(table);
  this->SegmentTableError = pictureError;
  this->Texels.clear();
  if (!this->SegmentTable || this->SegmentTable->Settings.Format == TexelFormat::Float)
  {
    return;
  }
  const int n = this->SegmentTable->Scalars.GetSize();
  const int lengths = this->SegmentTable->Lengths.Size;
  this->Texels.resize(4 * static_cast<std::size_t>(n) * n * lengths);
#pragma omp parallel for schedule(static)
  for (int length = 0; length < lengths; ++length)
  {
    float* texel = &this->Texels[4 * static_cast<std::size_t>(n) * n * length];
    for (int back = 0; back < n; ++back)
    {
      for (int front = 0; front < n; ++front, texel += 4)
      {
        this->SegmentTable->GetTexel(front, back, length, texel);
      }
    }
  }
}

void RayCaster::SetIsosurfaces(std::vector<Isosurface> surfaces)
{
  for (const Isosurface& surface : surfaces)
  {
    const float* c = surface.Color;
    if (!std::isfinite(surface.Value) || !std::isfinite(c[0] + c[1] + c[2] + surface.Opacity))
    {
      throw std::invalid_argument("values, colours and opacities of isosurfaces must be finite");
    }
  }
  std::stable_sort(surfaces.begin(), surfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Value < b.Value; });
  this->Surfaces.clear();
  for (const Isosurface& surface : surfaces)
  {
    if (!this->Surfaces.empty() && this->Surfaces.back().Value == surface.Value)
    {
      this->Surfaces.pop_back();
    }
    this->Surfaces.push_back(surface);
  }
  this->VisibleTablesValid = this->VisibleTablesValid && this->Model != OpticalModel::Isosurfaces;
}

RayCaster::ScalarMap RayCaster::GetScalarMap() const
{
  if (this->Model != OpticalModel::Isosurfaces)
  {
    return { this->Table.Offset, this->Table.Scale };
  }
  // Halved before they are added, so that no sum overflows.
  const double lo = 0.5 * this->ScalarRange[0];
  const double hi = 0.5 * this->ScalarRange[1];
  return { lo + hi, hi - lo > 0 ? hi - lo : 1 };
}

double RayCaster::GetLargestMappedScalar() const
{
  const ScalarMap map = this->GetScalarMap();
  return std::max({ 1., std::abs((this->ScalarRange[0] - map.Offset) / map.Scale),
    std::abs((this->ScalarRange[1] - map.Offset) / map.Scale) });
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

double RayCaster::EstimateGeometryError(double worldRadius) const
{
  switch (this->Model)
  {
    case OpticalModel::Isosurfaces:
      return 0;
    case OpticalModel::MaximumIntensity:
    {
      // Between three corners a scalar is interpolated with a few roundings.
      constexpr double ScalarRounding = 1. / (1 << 22);
      return ScalarRounding * this->GetLargestMappedScalar() * FindSteepestColor(this->Table);
    }
    default:
      return EstimateGeometryError(this->Table, worldRadius, this->GetLargestMappedScalar());
  }
}

void RayCaster::UpdatePointScalars(bool doublePrecision)
{
  const ScalarMap map = this->GetScalarMap();
  ScalarMap& present = doublePrecision ? this->DoubleScalars : this->FloatScalars;
  if (present == map)
  {
    return;
  }
  if (doublePrecision)
  {
    this->Mesh->SetPointScalars<double>(this->Scalars, map.Offset, map.Scale);
  }
  else
  {
    this->Mesh->SetPointScalars<float>(this->Scalars, map.Offset, map.Scale);
  }
  present = map;
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
    if (this->Model == OpticalModel::MaximumIntensity)
    {
      value.Attenuation = std::isfinite(this->Scalars[t])
        ? static_cast<float>((this->Scalars[t] - this->Table.Offset) / this->Table.Scale)
        : std::numeric_limits<float>::quiet_NaN();
    }
    else if (std::isfinite(this->Scalars[t]))
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
  std::vector<std::uint8_t> visible;
  switch (this->Model)
  {
    case OpticalModel::MaximumIntensity: // the largest scalar may be where it is transparent
      break;
    case OpticalModel::Isosurfaces:
      visible = FindCrossedCells(this->Surfaces, cells, this->Scalars);
      break;
    default:
      visible = FindVisibleCells(this->Function, cells, this->Scalars, this->ScalarsOfCells);
  }
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

const IntegrationPlan& RayCaster::GetPlan()
{
  if (!this->PlanValid)
  {
    this->Plan = this->Model == OpticalModel::Isosurfaces
      ? IntegrationPlan()
      : MakeIntegrationPlan(this->Model, this->Function, this->ScalarRange);
    this->PlanValid = true;
  }
  return this->Plan;
}

const WalkTables& RayCaster::ChooseTables(
  const RayCastOptions& options, RayCastStatistics& statistics)
{
  if (options.ReentryBy == Reentry::Imaginary)
  {
    this->Mesh->MakeConvex(options.Progress);
    statistics.Aborted = !this->Mesh->GetConvexification();
    if (!this->Mesh->GetConvexTables().Faces.empty())
    {
      statistics.ImaginaryCells = true;
      return this->Mesh->GetConvexTables();
    }
  }
  this->UpdateVisibleTables();
  return this->NumberOfTransparentCells > 0 ? this->VisibleTables : this->Mesh->GetTables();
}

RayCastStatistics RayCaster::Cast(const RayGrid& grid, const RayLimits& limits,
  const RayCastOptions& options, Span<float> colors, Span<float> depths)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  if (colors.size() != 4 * pixels || depths.size() != pixels)
  {
    throw std::invalid_argument("the image arrays do not have the size of the ray grid");
  }
  const bool isosurfaces = this->Model == OpticalModel::Isosurfaces;
  if (!this->Mesh || (this->Table.Intervals.empty() && !isosurfaces))
  {
    throw std::invalid_argument("a mesh and a transfer function must be set before rays are cast");
  }
  if (this->Scalars.size() !=
    (this->ScalarsOfCells ? this->Mesh->GetMesh().GetNumberOfCells()
                          : this->Mesh->GetMesh().GetNumberOfPoints()))
  {
    throw std::invalid_argument("scalars must be set after the mesh and before rays are cast");
  }

  if (isosurfaces && this->ScalarsOfCells && !this->Scalars.empty())
  {
    throw std::invalid_argument("isosurfaces need scalars at points: at cells they are constant");
  }

  RayCastStatistics statistics;
  const Integrator integrator = ChooseIntegrator(this->Model, this->GetPlan().ConstantColor,
    this->SegmentTable && !this->ScalarsOfCells, statistics.Integration);
  const double worldRadius = GetWorldRadius(*this->Mesh, grid);
  const double geometryError = this->EstimateGeometryError(worldRadius);
  // Half of the error may come from ending rays early, a quarter from rounding.
  statistics.DoublePrecision = options.Arithmetic == Precision::Double ||
    !(SmallestSingleRadius <= worldRadius && worldRadius <= LargestSingleRadius) ||
    (options.Arithmetic == Precision::Automatic && geometryError > 0.25 * options.MaximumError);
  const bool endsEarly =
    this->Model != OpticalModel::EmissionOnly && this->Model != OpticalModel::MaximumIntensity;
  statistics.TerminationError = endsEarly ? 0.5 * options.MaximumError : 0;
  const bool hasWeights =
    this->Model != OpticalModel::MaximumIntensity && this->Model != OpticalModel::Isosurfaces;
  statistics.IntegralError = hasWeights ? SegmentWeightError : 0;
  statistics.GeometryError = statistics.DoublePrecision ? 0 : geometryError;
  statistics.TableError = integrator == Integrator::Table ? this->SegmentTableError : 0;
  statistics.ErrorEstimate = statistics.TerminationError + statistics.IntegralError +
    statistics.TableError + statistics.GeometryError;

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

  const WalkTables& tables = this->ChooseTables(options, statistics);
  if (statistics.Aborted)
  {
    return statistics;
  }

  KernelInput in{};
  in.Points = statistics.DoublePrecision ? static_cast<const void*>(this->Mesh->GetPoints<double>())
                                         : static_cast<const void*>(this->Mesh->GetPoints<float>());
  in.Faces = tables.Faces.data();
  in.Entries = tables.Entries.data();
  in.Nodes = tables.Bvh.Nodes.empty() ? nullptr : tables.Bvh.Nodes.data();
  in.Triangles = tables.Bvh.Triangles.data();
  in.NumberOfCells = this->Mesh->GetNumberOfCells();
  std::copy_n(this->Mesh->GetCenter(), 3, in.Center);
  in.Radius = this->Mesh->GetRadius();
  in.Intervals = this->Table.Intervals.data();
  in.NumberOfIntervals = static_cast<int>(this->Table.Intervals.size());
  in.CellValues = this->CellValues.data();
  const ScalarMap map = this->GetScalarMap();
  const SurfaceTables surfaces(isosurfaces ? this->Surfaces : std::vector<Isosurface>(),
    [&map](double value) { return static_cast<float>((value - map.Offset) / map.Scale); });
  in.SurfaceNeighbors = surfaces.Neighbors.data();
  in.SurfaceColors = surfaces.Colors.data();
  const SurfaceShading shading{ &this->Mesh->GetMesh(), this->Scalars.data(), grid.MeshFromWorld,
    options.Lights, options.Surface };
  in.Shading = options.Shaded ? &shading : nullptr;
  in.DistanceRounding =
    worldRadius * (statistics.DoublePrecision ? DoubleDistanceRounding : SingleDistanceRounding);
  KernelTable table{};
  if (integrator == Integrator::Table)
  {
    const PreIntegrationTable& t = *this->SegmentTable;
    table.Texels = this->Texels.empty() ? reinterpret_cast<const float*>(t.Texels.GetData())
                                        : this->Texels.data();
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
  in.MaximumOpacity = static_cast<float>(1 - statistics.TerminationError);
  in.MaximumDepth = static_cast<float>(-std::log(statistics.TerminationError));
  if (this->Model == OpticalModel::EmissionAbsorption && this->Plan.ConstantColor)
  {
    std::copy_n(this->Plan.Color, 3, in.Color);
  }
  in.Colors = colors.data();
  in.Depths = depths.data();

  const InstructionSet set = GetInstructionSet(options.PortableKernels);
  const RayCastKernels::Pair& kernels = this->ScalarsOfCells
    ? set.Kernels.Cells[static_cast<int>(integrator)]
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
  statistics.TransparentCells = statistics.ImaginaryCells ? 0 : this->NumberOfTransparentCells;
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
