// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceTracer.h"

#include "Base/ParallelTiles.h"
#include "Base/Stopwatch.h"
#include "Integral/ErrorBudget.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/IsosurfaceSteps.h"
#include "Isosurface/LightSamples.h"
#include "Isosurface/LimitsOfMesh.h"
#include "Isosurface/PictureKey.h"
#include "Isosurface/PictureMean.h"
#include "Isosurface/PlacedTrees.h"
#include "Isosurface/TracedScene.h"
#include "Isosurface/TracerMemory.h"
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

/// Polygons for a pixel up to which they are prepared once for all packets of shadow rays. Measured
/// on the blunt fin and on rings of up to 10 million cells.
constexpr double LargestPlacedShare = 0.1;

/// How far ambient light is blocked from, in radii of the mesh, unless that is chosen: a part of
/// the mesh whose size shows in a picture.
constexpr double AutomaticOcclusionRadius = 0.2;

/// What is nearer blocks no ambient light, in radii of the mesh, as for shadows.
constexpr double OcclusionOffset = 1e-6;

IsosurfaceKernels GetKernels(InstructionSet set)
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  switch (set)
  {
    case InstructionSet::Avx512:
      return GetIsosurfaceKernelsAvx512();
    case InstructionSet::Avx2:
      return GetIsosurfaceKernelsAvx2();
    default:
      break;
  }
#else
  static_cast<void>(set);
#endif
  return GetIsosurfaceKernelsGeneric();
}

InstructionSet ChooseInstructionSet(const IsosurfaceOptions& options)
{
  return options.Kernels.value_or(GetWidestInstructionSet());
}

double Dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// What the kernel reads that neither the scene nor the caller owns.
struct OwningInput : IsosurfaceInput
{
  std::vector<std::int32_t> Steps;
  std::vector<float> ColorsOfSurfaces;
  KernelLighting Light{};
  std::vector<KernelLight> Lights;
  std::vector<ShadowSource> ShadowSources;
  std::vector<OcclusionSample> OcclusionSamples;

  OwningInput()
    : IsosurfaceInput{}
  {
  }
  // The base points into this object.
  OwningInput(const OwningInput&) = delete;
  OwningInput& operator=(const OwningInput&) = delete;
};

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

void FillTree(const VolumeScene& scene, const IsosurfaceStep& step,
  const IsosurfaceOptions& options, OwningInput& in)
{
  const bool precomputed = options.Polygons == Isopolygons::Precomputed;
  const std::vector<MinMaxTree::Node>& nodes =
    precomputed ? step.Active.Get().Nodes : step.Tree->Nodes;
  for (const double value : step.Values)
  {
    in.Steps.push_back(step.Ranges.GetStep(value));
  }
  in.Tree.Nodes = nodes.empty() ? nullptr : nodes.data();
  in.Tree.Polygons = precomputed ? step.Active.Get().Polygons.data() : nullptr;
  in.Tree.Ranges = step.Ranges.Nodes.data();
  in.Tree.LeafCells = step.Tree->Cells.data();
  in.Tree.ValueSteps = in.Steps.data();
  in.Tree.Source = MakeIsopolygonSource(scene, step.Values);
}

void FillColors(const VolumeScene& scene, const IsosurfaceStep& step,
  const IsosurfaceOptions& options, OwningInput& in)
{
  for (const Isosurface& surface : ListVisible(scene))
  {
    in.ColorsOfSurfaces.insert(in.ColorsOfSurfaces.end(),
      { surface.Color[0], surface.Color[1], surface.Color[2],
        std::clamp(surface.Opacity, 0.f, 1.f) });
  }
  in.SurfaceColors = in.ColorsOfSurfaces.data();
  if (scene.Mesh.GetColorScalars().empty())
  {
    return;
  }
  const IntervalTable& function = scene.Optics.GetIntervalTable();
  in.ColorScalars = scene.Mesh.GetColorScalars().data();
  in.ColorFields =
    options.Polygons == Isopolygons::Precomputed ? step.Colors.Get().data() : nullptr;
  in.Intervals = function.Intervals.data();
  in.NumberOfIntervals = static_cast<int>(function.Intervals.size());
  in.FunctionOffset = function.Offset;
  in.FunctionScale = function.Scale;
}

void FillLight(const VolumeScene& scene, const IsosurfaceStep& step, const RayGrid& grid,
  const IsosurfaceOptions& options, const SampleRange& samples, OwningInput& in)
{
  const MeshFrame mesh = GetMeshFrame(scene);
  const double worldRadius = mesh.Radius * MeasureMeshToWorld(grid.MeshFromWorld).Largest;
  FillKernelLighting(options.Lights, options.Surface, grid, worldRadius, in.Light, in.Lights);
  in.Light.OfPoints = options.SmoothShading;
  if (options.Polygons == Isopolygons::Precomputed)
  {
    in.Gradients = options.SmoothShading ? step.Gradients.Get().data() : nullptr;
    in.CellGradients = options.SmoothShading ? nullptr : step.CellGradients.Get().data();
  }
  else
  {
    const std::vector<GradientRow>& gradients =
      options.SmoothShading ? scene.Mesh.GetPointGradients() : scene.Mesh.GetCellGradients();
    in.Light.Gradients = gradients.data();
    in.Light.NumberOfGradients = static_cast<std::int32_t>(gradients.size());
  }
  in.Lighting = &in.Light;
  if (options.Shadows && samples.Count > 0)
  {
    in.ShadowSources =
      MakeShadowSources(options.Lights, grid, mesh, options.ShadowSoftness, samples);
    in.Shadows = in.ShadowSources.data();
    in.NumberOfShadows = static_cast<int>(in.ShadowSources.size());
  }
  if (options.AmbientOcclusion && samples.Count > 0)
  {
    in.OcclusionSamples = MakeOcclusionSamples(grid, mesh, samples);
    in.Occlusion = in.OcclusionSamples.data();
    in.NumberOfOcclusionSamples = static_cast<int>(in.OcclusionSamples.size());
    in.OcclusionRadius = options.OcclusionRadius > 0 ? options.OcclusionRadius
                                                     : AutomaticOcclusionRadius * worldRadius;
    in.OcclusionOffset = OcclusionOffset * worldRadius;
  }
}

/// Whether a picture is one of several whose mean is shown.
bool IsSampled(const VolumeScene& scene, const IsosurfaceOptions& options)
{
  return IsLit(scene, options) &&
    (options.AmbientOcclusion || (options.Shadows && options.ShadowSoftness > 0));
}

/// Whether rays from a common origin with |u| and |v| up to 1 may meet a box.
bool SeesBox(const RayFrame& frame, const MinMaxTree::Node& box)
{
  unsigned beyond = 31; // sides that all corners are beyond
  for (int corner = 0; corner < 8; ++corner)
  {
    double placed[3];
    for (int r = 0; r < 3; ++r)
    {
      const double(&row)[4] = frame.Rows[r];
      placed[r] = row[3];
      for (int a = 0; a < 3; ++a)
      {
        placed[r] += row[a] * ((corner >> a & 1) != 0 ? box.Upper[a] : box.Lower[a]);
      }
    }
    const bool ofCorner[5] = { placed[0] > placed[2], -placed[0] > placed[2], placed[1] > placed[2],
      -placed[1] > placed[2], placed[2] < 0 };
    for (int side = 0; side < 5; ++side)
    {
      beyond &= ofCorner[side] ? ~0u : ~(1u << side);
    }
  }
  return beyond == 0;
}

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

class IsosurfaceTracer::Internals
{
public:
  SampleRange ChooseSamples(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
    const IsosurfaceOptions& options);
  void PlacePolygons(
    const ActiveTree& active, const IsosurfaceOptions& options, int threads, OwningInput& in);
  void TraceTiles(const OwningInput& in, const IsosurfaceOptions& options, int threads,
    IsosurfaceStatistics& statistics);

  IsosurfaceSteps Steps;
  PictureMean Mean;
  PlacedTrees Placed;
};

/// The samples of the next picture of a mean: none when the mean is of all.
SampleRange IsosurfaceTracer::Internals::ChooseSamples(const VolumeScene& scene,
  const RayGrid& grid, const RayLimits& limits, const IsosurfaceOptions& options)
{
  SampleRange samples;
  samples.Count = std::min(options.SamplesPerFrame, options.MaximumSamples);
  if (IsSampled(scene, options))
  {
    this->Mean.Start(MakePictureKey(scene, grid, limits, options));
    const int frames = options.MaximumSamples / samples.Count;
    samples.First = this->Mean.GetCount() * samples.Count;
    samples.Count = this->Mean.GetCount() < frames ? samples.Count : 0;
  }
  else
  {
    this->Mean.Reset();
  }
  return samples;
}

void IsosurfaceTracer::Internals::PlacePolygons(
  const ActiveTree& active, const IsosurfaceOptions& options, int threads, OwningInput& in)
{
  const MinMaxTree::Node& box = active.Nodes.front();
  // Points of the mesh are within a radius of 1, and rays to them.
  const double ofLight[4] = { -1, -1, 1, 1 };
  this->Placed.Start(active);
  for (ShadowSource& source : in.ShadowSources)
  {
    for (int side = 0; side < (source.Positional ? 6 : 1); ++side)
    {
      const RayFrame& frame = source.Frames[side];
      if (frame.Parallel || SeesBox(frame, box))
      {
        source.Placed[side] = this->Placed.Add(frame, in.ShadowLimits, ofLight);
      }
    }
  }
  for (OcclusionSample& sample : in.OcclusionSamples)
  {
    sample.Placed = this->Placed.Add(sample.Frame, in.ShadowLimits, ofLight);
  }
  this->Placed.Fill(in.Tree, GetKernels(ChooseInstructionSet(options)).Place, threads);
}

void IsosurfaceTracer::Internals::TraceTiles(const OwningInput& in,
  const IsosurfaceOptions& options, int threads, IsosurfaceStatistics& statistics)
{
  const InstructionSet set = ChooseInstructionSet(options);
  const DrawKernel kernel = GetKernels(set).Draw;
  std::vector<std::unique_ptr<TracerMemory>> memory;
  for (int t = 0; t < threads; ++t)
  {
    memory.push_back(std::make_unique<TracerMemory>());
    memory.back()->Visible.assign(
      in.NumberOfShadows > 0 ? options.Lights.size() * RayPacket::MaximumRays : 0, 1.f);
    memory.back()->Scratch.Visible =
      in.NumberOfShadows > 0 ? memory.back()->Visible.data() : nullptr;
  }
  const TileGrid tiles{ in.Grid->Width, in.Grid->Height, RayBlock::Edge };
  statistics.Aborted = !ForEachTile(tiles, threads, options.Progress,
    [&](const Tile& tile, int thread)
    {
      TracerMemory& own = *memory[thread];
      const std::int64_t hits = own.Counts.Hits;
      kernel(in, tile.X0, tile.Y0, tile.X1, tile.Y1, own.Scratch, own.Counts);
      if (own.Counts.Hits > hits)
      {
        own.Covered = Unite(own.Covered, tile);
      }
    });
  for (const std::unique_ptr<TracerMemory>& thread : memory)
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
  statistics.NumberOfThreads = threads;
  statistics.InstructionSet = GetName(set);
}

IsosurfaceTracer::IsosurfaceTracer()
  : Private(std::make_unique<Internals>())
{
}

IsosurfaceTracer::~IsosurfaceTracer() = default;

IsosurfaceStatistics IsosurfaceTracer::Trace(VolumeScene& scene, const RayGrid& grid,
  const RayLimits& limits, const IsosurfaceOptions& options, Span<float> colors, Span<float> depths)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  const bool forWindow = !options.WindowColors.empty();
  if (forWindow ? options.WindowColors.size() != 4 * pixels || options.WindowDepths.size() != pixels
                : colors.size() != 4 * pixels || depths.size() != pixels)
  {
    throw std::invalid_argument("the image arrays do not have the size of the ray grid");
  }
  scene.CheckComplete();
  IsosurfaceStatistics statistics;
  const int threads = options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads();
  const bool precomputed = options.Polygons == Isopolygons::Precomputed;
  const bool lit = IsLit(scene, options);
  SceneNeeds needs;
  needs.PointGradients = lit && options.SmoothShading && !precomputed;
  needs.CellGradients = lit && !options.SmoothShading && !precomputed;
  scene.Prepare(needs);
  const IsosurfaceStep& step = this->Private->Steps.Update(scene, options, threads, statistics);

  const Stopwatch stopwatch;
  const MeshFrame mesh = GetMeshFrame(scene);
  OwningInput in;
  in.Frame = MakeRayFrame(grid, mesh);
  in.Grid = &grid;
  const LimitsOfMesh limitsOfMesh(limits, grid, in.Frame, mesh, step.Tree->Nodes);
  in.Limits = limitsOfMesh.Get();
  in.ShadowLimits = limitsOfMesh.GetForLight();
  in.MaximumDistances = limits.MaximumDistances;
  FillTree(scene, step, options, in);
  FillColors(scene, step, options, in);
  const SampleRange samples = this->Private->ChooseSamples(scene, grid, limits, options);
  if (lit)
  {
    FillLight(scene, step, grid, options, samples, in);
  }
  ErrorSpending spending;
  spending.EndsEarly = true;
  statistics.TerminationError = MakeErrorBudget(options.MaximumError, spending).Termination;
  in.MaximumOpacity = static_cast<float>(1 - statistics.TerminationError);
  in.MaximumLayers =
    options.MaximumLayers > 0 ? options.MaximumLayers : std::numeric_limits<int>::max();
  in.Colors = colors.data();
  in.Depths = depths.data();
  in.WindowColors = forWindow ? options.WindowColors.data() : nullptr;
  if (!options.WindowDepths.empty())
  {
    in.WindowDepths = options.WindowDepths.data();
    FillDepthFactors(grid, in.Frame, options.Depth.Depth, in.DepthFactors);
    FillDepthFactors(grid, in.Frame, options.Depth.Divisor, in.DivisorFactors);
  }
  if (precomputed && in.Tree.Nodes &&
    options.PlaceOnce.value_or(static_cast<double>(step.Active.Get().Polygons.size()) <
      LargestPlacedShare * static_cast<double>(pixels)))
  {
    this->Private->PlacePolygons(step.Active.Get(), options, threads, in);
  }
  else
  {
    this->Private->Placed = PlacedTrees();
  }
  this->Private->TraceTiles(in, options, threads, statistics);
  if (IsSampled(scene, options) && !statistics.Aborted)
  {
    if (samples.Count > 0)
    {
      this->Private->Mean.Add(colors);
    }
    else
    {
      this->Private->Mean.CopyTo(colors);
    }
    statistics.Samples = samples.First + samples.Count;
  }
  if (precomputed)
  {
    statistics.ActiveNodes = static_cast<std::int64_t>(step.Active.Get().Nodes.size());
    statistics.Polygons = static_cast<std::int64_t>(step.Active.Get().Polygons.size());
  }
  statistics.TraceSeconds = stopwatch.GetSeconds();
  return statistics;
}

} // namespace tetralux
