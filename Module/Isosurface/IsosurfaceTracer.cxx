// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceTracer.h"

#include "Base/ParallelTiles.h"
#include "Base/Stopwatch.h"
#include "Integral/ErrorBudget.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/LightSamples.h"
#include "View/MeshToWorld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <omp.h>

namespace tetralux
{
namespace
{

/// Cells of a leaf. Measured on the blunt fin and a ring of 3 million cells.
constexpr int LeafSize = 8;

/// Polygons for a pixel up to which they are gathered for blocks. Measured on the blunt fin and on
/// rings of up to 10 million cells.
constexpr double LargestBlockShare = 0.25;

/// How far ambient light is blocked from, in radii of the mesh, unless that is chosen: a part of
/// the mesh whose size shows in a picture.
constexpr double AutomaticOcclusionRadius = 0.2;

/// What is nearer blocks no ambient light, in radii of the mesh, as for shadows.
constexpr double OcclusionOffset = 1e-6;

IsosurfaceKernel GetKernel(InstructionSet set)
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  switch (set)
  {
    case InstructionSet::Avx512:
      return GetIsosurfaceKernelAvx512();
    case InstructionSet::Avx2:
      return GetIsosurfaceKernelAvx2();
    default:
      break;
  }
#else
  static_cast<void>(set);
#endif
  return GetIsosurfaceKernelGeneric();
}

MeshFrame GetMeshFrame(const WalkMesh& mesh)
{
  MeshFrame frame;
  std::copy_n(mesh.GetCenter(), 3, frame.Center);
  frame.Radius = mesh.GetRadius();
  return frame;
}

double Dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Half-spaces and cropping in the mesh's frame, with the memory of the planes.
class MeshLimits
{
public:
  MeshLimits(
    const RayLimits& limits, const RayGrid& grid, const RayFrame& frame, const MeshFrame& mesh)
  {
    const double* steps[3] = { frame.Parallel ? grid.OriginStepX : grid.DirectionStepX,
      frame.Parallel ? grid.OriginStepY : grid.DirectionStepY, grid.Direction };
    for (std::size_t p = 0; p < limits.Planes.size(); ++p)
    {
      const std::array<double, 4>& plane = limits.Planes[p];
      std::array<double, 4> result = { 0, 0, 0, Dot(plane.data(), grid.Origin) + plane[3] };
      for (int r = 0; r < 3; ++r)
      {
        const double along = Dot(plane.data(), steps[r]);
        for (int a = 0; a < 4; ++a)
        {
          result[a] += along * frame.Rows[r][a];
        }
      }
      // Whether it cuts the mesh, which is within a sphere of radius 1.
      if (!(result[3] > std::hypot(result[0], result[1], result[2])))
      {
        this->Planes.push_back(result);
        this->NumberOfCameraPlanes += p < static_cast<std::size_t>(limits.NumberOfCameraPlanes);
      }
    }
    this->Result.Cropping = limits.Cropping;
    this->Result.CroppingFlags = limits.CroppingFlags;
    for (int i = 0; i < 6; ++i)
    {
      this->Result.CroppingPlanes[i] =
        (limits.CroppingPlanes[i] - mesh.Center[i / 2]) / mesh.Radius;
    }
  }
  MeshLimits(const MeshLimits&) = delete;
  MeshLimits& operator=(const MeshLimits&) = delete;

  TraceLimits Get() const
  {
    TraceLimits result = this->Result;
    static_assert(sizeof(std::array<double, 4>) == sizeof(double[4]), "rows of four");
    result.Planes = reinterpret_cast<const double(*)[4]>(this->Planes.data());
    result.NumberOfPlanes = static_cast<int>(this->Planes.size());
    return result;
  }

  /// The same for light: without the camera's planes.
  TraceLimits GetForLight() const
  {
    TraceLimits result = this->Get();
    result.Planes += this->NumberOfCameraPlanes;
    result.NumberOfPlanes -= this->NumberOfCameraPlanes;
    return result;
  }

private:
  std::vector<std::array<double, 4>> Planes;
  int NumberOfCameraPlanes = 0;
  TraceLimits Result;
};

/// What the kernel reads of lights, with its memory.
struct Illumination
{
  KernelLighting Lighting{};
  std::vector<KernelLight> Lights;
  std::vector<ShadowSource> Shadows;
  std::vector<OcclusionSample> Occlusion;
};

void FillIllumination(const VolumeScene& scene, const RayGrid& grid,
  const IsosurfaceOptions& options, const MeshFrame& mesh, const SampleRange& samples,
  Illumination& result)
{
  const double unit = mesh.Radius * MeasureMeshToWorld(grid.MeshFromWorld).Largest;
  FillKernelLighting(options.Lights, options.Surface, grid, unit, result.Lighting, result.Lights);
  const std::vector<GradientRow>& gradients =
    options.SmoothShading ? scene.Mesh.GetPointGradients() : scene.Mesh.GetCellGradients();
  result.Lighting.Gradients = gradients.data();
  result.Lighting.NumberOfGradients = static_cast<std::int32_t>(gradients.size());
  result.Lighting.OfPoints = options.SmoothShading;
  if (options.Shadows)
  {
    result.Shadows = MakeShadowSources(options.Lights, grid, mesh, options.ShadowSoftness, samples);
  }
  if (options.AmbientOcclusion)
  {
    result.Occlusion = MakeOcclusionSamples(grid, mesh, samples);
  }
}

/// All that a picture follows from, but for the samples of light.
CacheKey MakePictureKey(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const IsosurfaceOptions& options, std::uint64_t polygons, std::uint64_t ranges)
{
  CacheKey key = CacheKey::Of(polygons, ranges, scene.Mesh.GetPointsVersion(),
    scene.Mesh.GetColorScalarsVersion(), scene.Optics.GetFunctionVersion(),
    scene.Optics.GetSurfacesVersion(), grid.Width, grid.Height, limits.Cropping,
    limits.CroppingFlags, options.MaximumError, options.SmoothShading, options.Shadows,
    options.ShadowSoftness, options.AmbientOcclusion, options.OcclusionRadius,
    options.SamplesPerFrame, options.MaximumLayers, options.Polygons);
  const auto add = [&key](const auto& numbers)
  {
    for (const auto number : numbers)
    {
      key.Add(number);
    }
  };
  add(grid.Origin);
  add(grid.OriginStepX);
  add(grid.OriginStepY);
  add(grid.Direction);
  add(grid.DirectionStepX);
  add(grid.DirectionStepY);
  for (const auto& row : grid.MeshFromWorld)
  {
    add(row);
  }
  for (const auto& plane : limits.Planes)
  {
    add(plane);
  }
  add(limits.CroppingPlanes);
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  for (std::size_t i = 0; limits.MaximumDistances && i < pixels; ++i)
  {
    key.Add(limits.MaximumDistances[i]);
  }
  const Material& surface = options.Surface;
  add(std::array<float, 4>{
    surface.Ambient, surface.Diffuse, surface.Specular, surface.SpecularPower });
  for (const Light& light : options.Lights)
  {
    key.Add(light.Positional);
    add(light.Position);
    add(light.Ambient);
    add(light.Diffuse);
    add(light.Specular);
    add(light.Attenuation);
    add(light.Axis);
    key.Add(light.ConeCosine);
    key.Add(light.Exponent);
  }
  return key;
}

/// row: of a DepthMap.
void FillDepthFactors(
  const RayGrid& grid, const RayFrame& frame, const double (&row)[4], double (&factors)[4])
{
  factors[0] = Dot(row, frame.Parallel ? grid.OriginStepX : grid.DirectionStepX);
  factors[1] = Dot(row, frame.Parallel ? grid.OriginStepY : grid.DirectionStepY);
  const double along = Dot(row, grid.Direction);
  factors[2] = frame.Parallel ? -along : row[3];
  factors[3] = frame.Parallel ? row[3] : along;
}

/// The surfaces that a picture may show; the others block no light either.
std::vector<Isosurface> ListVisible(const VolumeScene& scene)
{
  std::vector<Isosurface> visible;
  for (const Isosurface& surface : scene.Optics.GetIsosurfaces())
  {
    if (surface.Opacity > 0 || !scene.Mesh.GetColorScalars().empty())
    {
      visible.push_back(surface);
    }
  }
  return visible;
}

std::vector<float> GetColors(const std::vector<Isosurface>& surfaces)
{
  std::vector<float> colors;
  for (const Isosurface& surface : surfaces)
  {
    colors.insert(colors.end(),
      { surface.Color[0], surface.Color[1], surface.Color[2],
        std::clamp(surface.Opacity, 0.f, 1.f) });
  }
  return colors;
}

/// BlockMemory with its memory.
class OwningBlockMemory : public BlockMemory
{
public:
  OwningBlockMemory()
  {
    this->Grow = [](BlockMemory& block, int count)
    { static_cast<OwningBlockMemory&>(block).Reserve(count); };
  }
  OwningBlockMemory(const OwningBlockMemory&) = delete;
  OwningBlockMemory& operator=(const OwningBlockMemory&) = delete;

private:
  struct alignas(64) Room
  {
    char Bytes[PlacedPolygonBytes];
  };

  void Reserve(int count)
  {
    this->Capacity = std::max(count, 2 * this->Capacity);
    this->Rooms.resize(this->Capacity);
    this->Polygons = this->Rooms.data();
    float** bounds[4] = { &this->LowU, &this->HighU, &this->LowV, &this->HighV };
    for (int b = 0; b < 4; ++b)
    {
      this->Bounds[b].resize(this->Capacity);
      *bounds[b] = this->Bounds[b].data();
    }
  }

  std::vector<Room> Rooms;
  std::vector<float> Bounds[4];
};

/// What a thread writes while it traces.
struct ThreadMemory
{
  IsosurfaceScratch Scratch;
  OwningBlockMemory Block;
  IsosurfaceCounts Counts;
  std::vector<float> Visible;
  Tile Covered{ 0, 0, 0, 0 };
};

/// An empty tile adds nothing.
Tile Unite(const Tile& a, const Tile& b)
{
  if (a.X0 == a.X1 || b.X0 == b.X1)
  {
    return a.X0 == a.X1 ? b : a;
  }
  return { std::min(a.X0, b.X0), std::min(a.Y0, b.Y0), std::max(a.X1, b.X1), std::max(a.Y1, b.Y1) };
}

} // namespace

void IsosurfaceTracer::Prepare(VolumeScene& scene, const IsosurfaceOptions& options, int threads,
  IsosurfaceStatistics& statistics)
{
  const WalkMesh& walk = *scene.Mesh.GetMesh();
  const TetrahedralMesh& mesh = walk.GetMesh();
  const auto bytesPerCell = [&mesh](std::size_t bytes)
  { return static_cast<double>(bytes) / std::max<std::size_t>(1, mesh.GetNumberOfCells()); };
  {
    const Stopwatch stopwatch;
    CacheKey key = CacheKey::Of(scene.Mesh.GetCellsVersion(), options.Build);
    if (!this->TreeStamp.Has(key))
    {
      MinMaxTreeOptions build;
      build.Build = options.Build;
      build.LeafSize = LeafSize;
      build.NumberOfThreads = threads;
      this->Tree = BuildMinMaxTree(mesh, walk.GetCenter(), walk.GetRadius(), build);
      this->TreeStamp.Set(std::move(key));
      statistics.Rebuilt.emplace_back("tree");
    }
    else if (this->TreePoints != scene.Mesh.GetPointsVersion())
    {
      RefitMinMaxTree(this->Tree, mesh, walk.GetCenter(), walk.GetRadius(), threads);
      statistics.Rebuilt.emplace_back("boxes");
    }
    this->TreePoints = scene.Mesh.GetPointsVersion();
    statistics.TreeSeconds = stopwatch.GetSeconds();
  }
  {
    const Stopwatch stopwatch;
    const bool made = this->Ranges.Update(
      CacheKey::Of(this->TreeStamp.GetVersion(), scene.Mesh.GetScalarsVersion()),
      [&] { return MakeMinMaxRanges(this->Tree, mesh, scene.Mesh.GetScalars(), threads); });
    if (made)
    {
      statistics.Rebuilt.emplace_back("ranges");
    }
    statistics.RangesSeconds = stopwatch.GetSeconds();
  }
  this->Values.clear();
  CacheKey key = CacheKey::Of(this->Ranges.GetVersion(), this->TreePoints);
  for (const Isosurface& surface : ListVisible(scene))
  {
    this->Values.push_back(surface.Value);
    key.Add(surface.Value);
  }
  const IsopolygonSource source{ GetMeshFrame(walk), mesh.Points.data(), mesh.Cells.data(),
    scene.Mesh.GetScalars().data(), this->Values.data(), static_cast<int>(this->Values.size()) };
  if (options.Polygons == Isopolygons::Precomputed)
  {
    const Stopwatch stopwatch;
    const bool made = this->Active.Update(std::move(key),
      [&] { return MakeActiveTree(this->Tree, this->Ranges.Get(), source, threads); });
    if (made)
    {
      statistics.Rebuilt.emplace_back("isopolygons");
    }
    statistics.PolygonsSeconds = stopwatch.GetSeconds();
  }
  if (options.Polygons == Isopolygons::Precomputed && options.Shaded && options.SmoothShading)
  {
    const Stopwatch stopwatch;
    const bool made = this->Gradients.Update(CacheKey::Of(this->Active.GetVersion()),
      [&]
      {
        return MakeGradientFields(
          this->Active.Get(), source, scene.Mesh.GetPointGradients().data(), threads);
      });
    if (made)
    {
      statistics.Rebuilt.emplace_back("gradients");
    }
    statistics.PolygonsSeconds += stopwatch.GetSeconds();
  }
  else
  {
    this->Gradients.Reset();
  }
  const std::vector<double>& colorScalars = scene.Mesh.GetColorScalars();
  if (options.Polygons == Isopolygons::Precomputed && !colorScalars.empty())
  {
    const Stopwatch stopwatch;
    const bool made = this->Colors.Update(
      CacheKey::Of(this->Active.GetVersion(), scene.Mesh.GetColorScalarsVersion()),
      [&] { return MakeScalarFields(this->Active.Get(), source, colorScalars.data(), threads); });
    if (made)
    {
      statistics.Rebuilt.emplace_back("colours");
    }
    statistics.PolygonsSeconds += stopwatch.GetSeconds();
  }
  else
  {
    this->Colors.Reset();
  }
  statistics.Nodes = static_cast<std::int64_t>(this->Tree.Nodes.size());
  statistics.TreeBytes = bytesPerCell(this->Tree.Nodes.size() * sizeof(MinMaxTree::Node) +
    this->Tree.Cells.size() * sizeof(std::int32_t));
  statistics.StepBytes = bytesPerCell(this->Ranges.Get().Nodes.size() * sizeof(MinMaxTree::Range) +
    scene.Mesh.GetScalars().size() * sizeof(double));
}

IsosurfaceStatistics IsosurfaceTracer::Trace(VolumeScene& scene, const RayGrid& grid,
  const RayLimits& limits, const IsosurfaceOptions& options, Span<float> colors, Span<float> depths)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  if (colors.size() != 4 * pixels || depths.size() != pixels)
  {
    throw std::invalid_argument("the image arrays do not have the size of the ray grid");
  }
  scene.CheckComplete();
  IsosurfaceStatistics statistics;
  const int threads = options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads();
  const bool lit = options.Shaded && !scene.Mesh.HasCellScalars();
  SceneNeeds needs;
  needs.PointGradients = lit && options.SmoothShading;
  needs.CellGradients = lit && !options.SmoothShading;
  scene.Prepare(needs);
  this->Prepare(scene, options, threads, statistics);

  const Stopwatch stopwatch;
  const WalkMesh& walk = *scene.Mesh.GetMesh();
  const TetrahedralMesh& mesh = walk.GetMesh();
  const MeshFrame frame = GetMeshFrame(walk);
  const bool precomputed = options.Polygons == Isopolygons::Precomputed;
  const std::vector<MinMaxTree::Node>& nodes =
    precomputed ? this->Active.Get().Nodes : this->Tree.Nodes;
  std::vector<std::int32_t> steps;
  for (const double value : this->Values)
  {
    steps.push_back(this->Ranges.Get().GetStep(value));
  }

  IsosurfaceInput in{};
  in.Frame = MakeRayFrame(grid, frame);
  in.Grid = &grid;
  in.Tree.Nodes = nodes.empty() ? nullptr : nodes.data();
  in.Tree.Polygons = precomputed ? this->Active.Get().Polygons.data() : nullptr;
  in.Tree.Ranges = this->Ranges.Get().Nodes.data();
  in.Tree.LeafCells = this->Tree.Cells.data();
  in.Tree.ValueSteps = steps.data();
  in.Tree.Source = IsopolygonSource{ frame, mesh.Points.data(), mesh.Cells.data(),
    scene.Mesh.GetScalars().data(), this->Values.data(), static_cast<int>(this->Values.size()) };
  const MeshLimits meshLimits(limits, grid, in.Frame, frame);
  in.Limits = meshLimits.Get();
  in.ShadowLimits = meshLimits.GetForLight();
  in.MaximumDistances = limits.MaximumDistances;
  const std::vector<float> surfaceColors = GetColors(ListVisible(scene));
  in.SurfaceColors = surfaceColors.data();
  if (!scene.Mesh.GetColorScalars().empty())
  {
    const IntervalTable& function = scene.Optics.GetIntervalTable();
    in.ColorScalars = scene.Mesh.GetColorScalars().data();
    in.ColorFields = this->Colors.Get().empty() ? nullptr : this->Colors.Get().data();
    in.Intervals = function.Intervals.data();
    in.NumberOfIntervals = static_cast<int>(function.Intervals.size());
    in.FunctionOffset = function.Offset;
    in.FunctionScale = function.Scale;
  }
  // Frames that only refine light.
  const bool sampled =
    lit && (options.AmbientOcclusion || (options.Shadows && options.ShadowSoftness > 0));
  SampleRange samples;
  samples.Count = options.SamplesPerFrame;
  if (sampled)
  {
    this->Mean.Start(MakePictureKey(
      scene, grid, limits, options, this->Active.GetVersion(), this->Ranges.GetVersion()));
    const int frames = std::max(1, options.MaximumSamples / options.SamplesPerFrame);
    samples.First = std::min(this->Mean.GetCount(), frames - 1) * options.SamplesPerFrame;
  }
  else
  {
    this->Mean.Reset();
  }
  Illumination illumination;
  if (lit)
  {
    FillIllumination(scene, grid, options, frame, samples, illumination);
    in.Lighting = &illumination.Lighting;
    in.Gradients = this->Gradients.Get().empty() ? nullptr : this->Gradients.Get().data();
    in.Shadows = illumination.Shadows.data();
    in.NumberOfShadows = static_cast<int>(illumination.Shadows.size());
    const double worldRadius = frame.Radius * MeasureMeshToWorld(grid.MeshFromWorld).Largest;
    in.Occlusion = illumination.Occlusion.empty() ? nullptr : illumination.Occlusion.data();
    in.NumberOfOcclusionSamples = static_cast<int>(illumination.Occlusion.size());
    in.OcclusionRadius = options.OcclusionRadius > 0 ? options.OcclusionRadius
                                                     : AutomaticOcclusionRadius * worldRadius;
    in.OcclusionOffset = OcclusionOffset * worldRadius;
  }
  ErrorSpending spending;
  spending.EndsEarly = true;
  statistics.TerminationError = MakeErrorBudget(options.MaximumError, spending).Termination;
  in.MaximumOpacity = static_cast<float>(1 - statistics.TerminationError);
  in.MaximumLayers =
    options.MaximumLayers > 0 ? options.MaximumLayers : std::numeric_limits<int>::max();
  in.Blocks = precomputed &&
    options.Blocks.value_or(static_cast<double>(this->Active.Get().Polygons.size()) <
      LargestBlockShare * static_cast<double>(pixels));
  in.Colors = colors.data();
  in.Depths = depths.data();
  if (!options.WindowDepths.empty())
  {
    in.WindowDepths = options.WindowDepths.data();
    FillDepthFactors(grid, in.Frame, options.Depth.Depth, in.DepthFactors);
    FillDepthFactors(grid, in.Frame, options.Depth.Divisor, in.DivisorFactors);
  }

  const InstructionSet set = options.Kernels.value_or(GetWidestInstructionSet());
  const IsosurfaceKernel kernel = GetKernel(set);
  std::vector<std::unique_ptr<ThreadMemory>> memory;
  for (int t = 0; t < threads; ++t)
  {
    memory.push_back(std::make_unique<ThreadMemory>());
    memory.back()->Visible.assign(
      in.NumberOfShadows > 0 ? options.Lights.size() * RayPacket::MaximumRays : 0, 1.f);
    memory.back()->Scratch.Block = &memory.back()->Block;
    memory.back()->Scratch.Visible =
      in.NumberOfShadows > 0 ? memory.back()->Visible.data() : nullptr;
  }
  const TileGrid tiles{ grid.Width, grid.Height, BlockEdge };
  statistics.Aborted = !ForEachTile(tiles, threads, options.Progress,
    [&](const Tile& tile, int thread)
    {
      ThreadMemory& own = *memory[thread];
      const std::int64_t hits = own.Counts.Hits;
      kernel(in, tile.X0, tile.Y0, tile.X1, tile.Y1, own.Scratch, own.Counts);
      if (own.Counts.Hits > hits)
      {
        own.Covered = Unite(own.Covered, tile);
      }
    });
  if (sampled && !statistics.Aborted)
  {
    this->Mean.Add(colors, samples.First / options.SamplesPerFrame);
    statistics.Samples = samples.First + samples.Count;
  }
  for (const std::unique_ptr<ThreadMemory>& thread : memory)
  {
    const IsosurfaceCounts& counts = thread->Counts;
    statistics.Primary.Add(counts.Primary);
    statistics.Shadow.Add(counts.Shadow);
    statistics.Hits += counts.Hits;
    statistics.LostRays += counts.LostRays;
    statistics.Covered = Unite(statistics.Covered, thread->Covered);
    // What a ray that ends at the last layer lets through.
    statistics.TerminationError = std::max(statistics.TerminationError, counts.LostOpacity);
  }
  if (precomputed)
  {
    statistics.ActiveNodes = static_cast<std::int64_t>(this->Active.Get().Nodes.size());
    statistics.Polygons = static_cast<std::int64_t>(this->Active.Get().Polygons.size());
  }
  statistics.NumberOfThreads = threads;
  statistics.InstructionSet = GetName(set);
  statistics.TraceSeconds = stopwatch.GetSeconds();
  return statistics;
}

} // namespace tetralux
