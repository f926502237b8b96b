// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/ImageCaster.h"

#include "Base/ParallelTiles.h"
#include "Optics/IntervalTable.h"
#include "Simd/InstructionSet.h"
#include "TriangleCaster/ContributingValues.h"
#include "TriangleCaster/EmptySpace.h"
#include "TriangleCaster/GradientVoxels.h"
#include "TriangleCaster/ImageBlending.h"
#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/IntensityMap.h"
#include "TriangleCaster/SlabTable.h"
#include "TriangleCaster/TransferTableEvaluation.h"
#include "View/MeshToWorld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <omp.h>

namespace tetralux
{
namespace
{

/// Pixels along the edge of what a thread takes at once: enough of them to balance threads, and
/// large enough for neighbouring S-triangles to find voxels in the second-level cache.
constexpr int WorkSize = 32;

constexpr int SmallestTile = 4;
constexpr int LargestTile = 64;

ImageKernel GetKernel(InstructionSet set, const ImageKernelInput& in)
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  if (set == InstructionSet::Avx2)
  {
    return GetImageKernelAvx2(in);
  }
#endif
  static_cast<void>(set);
  return GetImageKernelGeneric(in);
}

void CheckVolume(const ImageVolume& volume)
{
  const char* const axes[] = { "x", "y", "z" };
  double values = 1;
  for (int a = 0; a < 3; ++a)
  {
    if (volume.Dimensions[a] < 2)
    {
      throw std::invalid_argument("the image has " + std::to_string(volume.Dimensions[a]) +
        " points along " + axes[a] + "; a volume has at least 2");
    }
    values *= volume.Dimensions[a];
  }
  if (values > std::numeric_limits<std::int32_t>::max())
  {
    throw std::invalid_argument(
      "the image has more than 2^31 - 1 points, the most that the triangle caster takes");
  }
  if (!volume.Values)
  {
    throw std::invalid_argument("the image has no values");
  }
  if (!std::isfinite(volume.Scale) || volume.Scale == 0 || !std::isfinite(volume.Offset))
  {
    throw std::invalid_argument("the scale of an image's values is 0, or not finite");
  }
}

/// For each bucket of equal width over [-1, 1] the interval that its lower end lies in, or one
/// below.
struct IntervalBuckets
{
  std::vector<std::int32_t> First;
  int MostSteps = 0; ///< the most intervals that a scalar of a bucket lies above that
};

IntervalBuckets MakeBuckets(const std::vector<IntervalTable::Interval>& intervals, int count)
{
  // The bucket of a scalar is rounded; a scalar may lie this far outside of its own.
  constexpr double Rounding = 1e-5; // of the whole range
  IntervalBuckets buckets;
  buckets.First.resize(count);
  std::size_t first = 0;
  std::size_t last = 0;
  for (int b = 0; b < count; ++b)
  {
    const double low = 2. * b / count - 1 - Rounding;
    const double high = 2. * (b + 1) / count - 1 + Rounding;
    while (intervals[first].Hi <= low)
    {
      ++first;
    }
    while (last + 1 < intervals.size() && intervals[last].Hi <= high)
    {
      ++last;
    }
    // The first and last bucket take what is beyond.
    const std::size_t begin = b == 0 ? 0 : first;
    const std::size_t end = b + 1 == count ? intervals.size() - 1 : last;
    buckets.First[b] = static_cast<std::int32_t>(begin);
    buckets.MostSteps = std::max(buckets.MostSteps, static_cast<int>(end - begin));
  }
  return buckets;
}

/// A transfer function, and what its lookup points to.
struct FunctionLookup
{
  IntervalTable Table;
  IntervalBuckets Buckets;
  TransferLookup Lookup;

  void Set(const TransferFunction& function);

  /// Where a scalar lies in the intervals: x = scale s + offset.
  ///@{
  double GetScale() const { return 1 / this->Table.Scale; }
  double GetOffset() const { return -this->Table.Offset / this->Table.Scale; }
  ///@}
};

void FunctionLookup::Set(const TransferFunction& function)
{
  this->Table = MakeIntervalTable(function);
  const std::vector<IntervalTable::Interval>& intervals = this->Table.Intervals;
  TransferLookup& transfer = this->Lookup;
  transfer = TransferLookup();
  transfer.Count = static_cast<int>(intervals.size());
  transfer.Intervals = intervals.data();
  for (int k = 0; k < TransferLookup::MostFew; ++k)
  {
    const IntervalTable::Interval& interval =
      intervals[std::min<std::size_t>(k, intervals.size() - 1)];
    transfer.Lower[k] = interval.Lo;
    transfer.Reference[k] = interval.Reference;
    transfer.Opacity[k] = interval.Attenuation;
    transfer.OpacitySlope[k] = interval.AttenuationSlope;
    for (int c = 0; c < 3; ++c)
    {
      transfer.Color[c][k] = interval.Color[c];
      transfer.ColorSlope[c][k] = interval.ColorSlope[c];
    }
  }
  if (transfer.Count > TransferLookup::MostFew)
  {
    // A step to the next interval costs as much as looking up a bucket; nodes that are closer
    // together than the smallest buckets cost more steps.
    constexpr int FewSteps = 2;
    constexpr int FirstCount = 1024;
    constexpr int LargestCount = 65536;
    for (int count = FirstCount; count <= LargestCount; count *= 4)
    {
      this->Buckets = MakeBuckets(intervals, count);
      if (this->Buckets.MostSteps <= FewSteps)
      {
        break;
      }
    }
    transfer.Buckets = this->Buckets.First.data();
    transfer.NumberOfBuckets = static_cast<float>(this->Buckets.First.size());
    transfer.MostSteps = this->Buckets.MostSteps;
  }
}

/// About half of the volume's size, in world units.
double FindRadius(const ImageVolume& volume, const RayGrid& grid)
{
  double squared = 0;
  for (const int points : volume.Dimensions)
  {
    squared += 0.25 * points * points;
  }
  return std::sqrt(squared) * MeasureMeshToWorld(grid.MeshFromWorld).Largest;
}

/// Whether a table takes the place of the function.
bool HasTable(const ImageOptics& optics)
{
  return optics.Blend == ImageBlend::Composite && !optics.Table.Entries.empty();
}

bool HasCue(const ImageCasterOptions& options)
{
  const auto isOne = [](float factor) { return factor == 1; };
  return !std::all_of(options.NearColor, options.NearColor + 3, isOne) ||
    !std::all_of(options.FarColor, options.FarColor + 3, isOne);
}

/// The factors of depth cueing, once in.Slices is filled.
void FillCue(const ImageCasterOptions& options, ImageKernelInput& in)
{
  const SlicePlanes& slices = in.Slices;
  in.Cued = HasCue(options);
  for (int c = 0; c < 3; ++c)
  {
    const double change = static_cast<double>(options.FarColor[c]) - options.NearColor[c];
    in.Cue[c] = options.NearColor[c];
    in.CueStep[c] = static_cast<float>(change * slices.Distance / (slices.Back - slices.Origin));
  }
}

PixelLinear MakeLinear(double value, double stepX, double stepY) { return { value, stepX, stepY }; }

PlaneAlongRays MakePlane(const RayGrid& grid, const std::array<double, 4>& plane)
{
  const auto apply = [&plane](const double v[3])
  { return plane[0] * v[0] + plane[1] * v[1] + plane[2] * v[2]; };
  return { MakeLinear(
             apply(grid.Origin) + plane[3], apply(grid.OriginStepX), apply(grid.OriginStepY)),
    MakeLinear(apply(grid.Direction), apply(grid.DirectionStepX), apply(grid.DirectionStepY)) };
}

} // namespace

//------------------------------------------------------------------------------------------------
class ImageCaster::Internals
{
public:
  void CheckReady() const;
  /// Where a value lies in the intervals of Function.
  ///@{
  float GetValueScale() const
  {
    return static_cast<float>(this->Volume.Scale * this->Function.GetScale());
  }
  float GetValueOffset() const
  {
    return static_cast<float>(
      (this->Volume.Offset - this->Function.Table.Offset) / this->Function.Table.Scale);
  }
  ///@}
  void PrepareBlocks(int threads);
  /// Finds out what in may skip. Blocks must be prepared.
  void PrepareSpace(ImageKernelInput& in);
  void PrepareSlabs(const ImageCasterOptions& options);
  void FillTable(ImageKernelInput& in) const;
  void FillGradients(const RayGrid& grid, ImageKernelInput& in) const;
  void PrepareGradients(const ImageCasterOptions& options, int threads, ImageKernelInput& in);
  void FillRays(const RayGrid& grid, const RayLimits& limits, ImageKernelInput& in) const;
  ImageKernelInput MakeInput(
    const RayGrid& grid, const RayLimits& limits, const ImageCasterOptions& options);

  ImageVolume Volume;
  bool HasVolume = false;
  ImageOptics Optics;
  bool HasOptics = false;
  FunctionLookup Function;
  FunctionLookup GradientFunction;
  SurfaceTable Surfaces;

  SlabTable Slabs; ///< of Optics, and the scalars of Volume

  BlockRanges Blocks;
  bool BlocksValid = false; ///< of Volume
  EmptySpace Space;
  bool SpaceValid = false; ///< of Blocks and Optics

  GradientVoxels Gradients;
  bool GradientsValid = false; ///< of Volume
  IntensityMap Intensities;
};

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::CheckReady() const
{
  if (!this->HasVolume || !this->HasOptics)
  {
    throw std::invalid_argument(
      this->HasVolume ? "the image caster has no optics" : "the image caster has no volume");
  }
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareBlocks(int threads)
{
  if (!this->BlocksValid)
  {
    this->Blocks.Build(this->Volume, threads);
    this->BlocksValid = true;
    this->SpaceValid = false;
    this->Slabs.Invalidate();
  }
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareSpace(ImageKernelInput& in)
{
  if (!this->SpaceValid)
  {
    const ContributingValues values(in);
    this->Space.Build(
      this->Blocks, [&](const BlockRanges::Range& range) { return values.Include(range); });
    this->SpaceValid = true;
  }
  in.Space = &this->Space;
  in.Ranges = &this->Blocks;
  in.SpaceReach = in.Blend == ImageBlend::Isosurfaces ? 1 : 0;
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareSlabs(const ImageCasterOptions& options)
{
  if (options.Shaded || !this->Optics.GradientOpacity.Nodes.empty() || HasTable(this->Optics))
  {
    throw std::invalid_argument(
      "pre-integrated slabs have no gradients: shading and gradient opacity need them off");
  }
  if (HasCue(options))
  {
    throw std::invalid_argument("pre-integrated slabs have no depth cueing");
  }
  const BlockRanges::Range range = this->Blocks.GetRange();
  const double a = this->Volume.Offset + this->Volume.Scale * range.Low;
  const double b = this->Volume.Offset + this->Volume.Scale * range.High;
  const double scalars[2] = { std::min(a, b), std::max(a, b) };
  this->Slabs.Update(this->Optics, options.SampleDistance, scalars);
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::FillRays(
  const RayGrid& grid, const RayLimits& limits, ImageKernelInput& in) const
{
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const auto apply = [row](const double v[3])
    { return row[0] * v[0] + row[1] * v[1] + row[2] * v[2]; };
    in.Start[a] =
      MakeLinear(apply(grid.Origin) + row[3], apply(grid.OriginStepX), apply(grid.OriginStepY));
    in.Direction[a] =
      MakeLinear(apply(grid.Direction), apply(grid.DirectionStepX), apply(grid.DirectionStepY));
    in.WorldDirection[a] =
      MakeLinear(grid.Direction[a], grid.DirectionStepX[a], grid.DirectionStepY[a]);
  }
  for (const std::array<double, 4>& plane : limits.Planes)
  {
    in.Planes.push_back(MakePlane(grid, plane));
  }
  in.SlicePlane = MakePlane(grid, this->Optics.SlicePlane);
  in.Limits = &limits;
  in.Grid = &grid;
  in.Width = grid.Width;
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::FillTable(ImageKernelInput& in) const
{
  const TransferTable& table = this->Optics.Table;
  TransferTableLookup& lookup = in.Table;
  lookup.Entries = table.Entries.data();
  lookup.Columns = table.Columns;
  lookup.LastColumn = static_cast<float>(table.Columns - 1);
  lookup.LastRow = static_cast<float>(table.Rows - 1);
  const IntervalTable& intervals = this->Function.Table;
  const double perScalar = (table.Columns - 1) / (table.LastScalar - table.FirstScalar);
  lookup.ColumnScale = static_cast<float>(perScalar * intervals.Scale);
  lookup.ColumnOffset = static_cast<float>(perScalar * (intervals.Offset - table.FirstScalar));
  const double perLength = (table.Rows - 1) / (table.LastLength - table.FirstLength);
  lookup.RowScale = static_cast<float>(perLength);
  lookup.RowOffset = static_cast<float>(-perLength * table.FirstLength);
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::FillGradients(const RayGrid& grid, ImageKernelInput& in) const
{
  if (HasTable(this->Optics))
  {
    this->FillTable(in);
  }
  else if (!this->Optics.GradientOpacity.Nodes.empty())
  {
    in.GradientTransfer = this->GradientFunction.Lookup;
    in.GradientScale = static_cast<float>(this->GradientFunction.GetScale());
    in.GradientOffset = static_cast<float>(this->GradientFunction.GetOffset());
  }
  in.Norm = this->Optics.Norm;
  const double factor = this->Volume.Scale * this->Optics.GradientLength;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      // Gradients are transformed by the transpose of what takes positions into the volume.
      in.WorldGradient[row][column] = static_cast<float>(factor * grid.MeshFromWorld[column][row]);
    }
  }
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareGradients(
  const ImageCasterOptions& options, int threads, ImageKernelInput& in)
{
  if (in.Lighting && options.SumOfLights != LightSum::Direct)
  {
    this->Intensities.Update(*in.Lighting, *in.Grid, threads);
    in.Intensities = this->Intensities.GetEntries().data();
    in.InterpolateIntensities = options.SumOfLights == LightSum::Interpolated;
  }
  const bool needed = in.Lighting || in.Table.Entries || in.GradientTransfer.Count > 0;
  if (needed && in.Blend == ImageBlend::Composite && options.Gradients == GradientSource::Bytes)
  {
    if (!this->GradientsValid)
    {
      this->Gradients.Build(this->Volume, threads);
      this->GradientsValid = true;
    }
    in.GradientWords = this->Gradients.GetWords().data();
    in.GradientWordScale = this->Gradients.GetScale();
  }
}

//------------------------------------------------------------------------------------------------
ImageKernelInput ImageCaster::Internals::MakeInput(
  const RayGrid& grid, const RayLimits& limits, const ImageCasterOptions& options)
{
  ImageKernelInput in{};
  in.Type = this->Volume.Type;
  in.Values = this->Volume.Values;
  in.Row = this->Volume.Dimensions[0];
  in.Slice = this->Volume.Dimensions[0] * this->Volume.Dimensions[1];
  for (int a = 0; a < 3; ++a)
  {
    in.LastCell[a] = this->Volume.Dimensions[a] - 2;
  }
  in.ValueScale = this->GetValueScale();
  in.ValueOffset = this->GetValueOffset();
  FillBlending(this->Volume, this->Optics, this->Surfaces, in);
  in.Transfer = this->Function.Lookup;
  if (options.PreIntegrated && in.Blend == ImageBlend::Composite)
  {
    in.Slab.Texels = this->Slabs.GetTexels();
    in.Slab.Size = SlabTable::Size;
    in.Slab.CoordinateScale = static_cast<float>(this->Volume.Scale * this->Slabs.GetScale());
    in.Slab.CoordinateOffset =
      static_cast<float>(this->Volume.Offset * this->Slabs.GetScale() + this->Slabs.GetOffset());
    in.Slab.PerLength = static_cast<float>(this->Optics.UnitDistance / this->Slabs.GetLength());
  }
  in.Power = this->Optics.Opacity == StepOpacity::Power;
  in.UnitDistance = this->Optics.UnitDistance;
  in.CorrectOpacity = options.CorrectOpacity;
  in.Threshold = static_cast<float>(std::max(options.Threshold, 0.));
  in.Slices = MakeSlicePlanes(this->Volume, grid, options.Shape, options.SampleDistance);
  this->FillRays(grid, limits, in);
  this->FillGradients(grid, in);
  FillCue(options, in);
  in.EndTriangles = options.EndTriangles;
  in.SkipPixels = options.SkipPixels;
  // Others change by what is transparent, too.
  const bool hulls = in.Blend == ImageBlend::Composite || in.Blend == ImageBlend::Additive;
  in.Hulls = hulls ? options.Hulls : nullptr;
  in.TileSize = std::clamp(options.TileSize, SmallestTile, LargestTile);
  in.Triangles = options.Triangles;
  return in;
}

//------------------------------------------------------------------------------------------------
ImageCaster::ImageCaster()
  : Private(std::make_unique<Internals>())
{
}

//------------------------------------------------------------------------------------------------
ImageCaster::~ImageCaster() = default;

//------------------------------------------------------------------------------------------------
void ImageCaster::SetVolume(const ImageVolume& volume)
{
  CheckVolume(volume);
  this->Private->Volume = volume;
  this->Private->HasVolume = true;
  this->Private->BlocksValid = false;
  this->Private->GradientsValid = false;
}

//------------------------------------------------------------------------------------------------
void ImageCaster::SetOptics(const ImageOptics& optics)
{
  if (!(optics.UnitDistance > 0) || !std::isfinite(optics.UnitDistance))
  {
    throw std::invalid_argument("the unit distance of opacity is not above 0");
  }
  if (!(optics.GradientLength > 0) || !std::isfinite(optics.GradientLength))
  {
    throw std::invalid_argument("the length that gradients are measured over is not above 0");
  }
  CheckBlending(optics);
  // A function that is not valid changes nothing.
  FunctionLookup function;
  FunctionLookup gradientFunction;
  if (HasTable(optics))
  {
    CheckTable(optics.Table);
    function.Set(FindVisibleScalars(optics.Table));
  }
  else
  {
    function.Set(optics.Function);
  }
  if (!optics.GradientOpacity.Nodes.empty())
  {
    gradientFunction.Set(optics.GradientOpacity);
  }
  // What lookups point to moves with them.
  this->Private->Function = std::move(function);
  this->Private->GradientFunction = std::move(gradientFunction);
  this->Private->Optics = optics;
  this->Private->HasOptics = true;
  this->Private->SpaceValid = false;
  this->Private->Slabs.Invalidate();
}

//------------------------------------------------------------------------------------------------
ImageCastStatistics ImageCaster::Cast(const RayGrid& grid, const RayLimits& limits,
  const ImageCasterOptions& options, Span<float> colors, Span<float> depths)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  if (colors.size() != 4 * pixels || depths.size() != pixels)
  {
    throw std::invalid_argument("the image arrays do not have the size of the ray grid");
  }
  Internals& self = *this->Private;
  self.CheckReady();
  const int threads = options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads();
  const bool slabs = options.PreIntegrated && self.Optics.Blend == ImageBlend::Composite;
  if (options.SkipEmptySpace || slabs)
  {
    self.PrepareBlocks(threads);
  }
  if (slabs)
  {
    self.PrepareSlabs(options);
  }
  ImageKernelInput in = self.MakeInput(grid, limits, options);
  if (options.SkipEmptySpace)
  {
    self.PrepareSpace(in);
  }
  in.Colors = colors.data();
  in.Depths = depths.data();
  KernelLighting lighting{};
  std::vector<KernelLight> lights;
  if (options.Shaded)
  {
    FillKernelLighting(
      options.Lights, options.Surface, grid, FindRadius(self.Volume, grid), lighting, lights);
    in.Lighting = &lighting;
  }
  self.PrepareGradients(options, threads, in);

  const InstructionSet set =
    options.PortableKernels ? InstructionSet::Generic : GetInstructionSet();
  const ImageKernel kernel = GetKernel(set, in);
  struct alignas(64) Counts : ImageKernelCounts
  {
  };
  std::vector<Counts> counts(threads);
  const TileGrid tiles{ grid.Width, grid.Height, std::max(WorkSize, in.TileSize) };
  ImageCastStatistics statistics;
  statistics.Aborted = !ForEachTile(tiles, threads, options.Progress,
    [&](const Tile& tile, int thread) { kernel(in, tile, counts[thread]); });
  statistics.InstructionSet = GetName(set);
  statistics.NumberOfThreads = threads;
  statistics.Slices = in.Slices.Count;
  for (const Counts& count : counts)
  {
    statistics.Triangles += count.Triangles;
    statistics.Samples += count.Samples;
    statistics.Rays += count.Rays;
  }
  statistics.TerminationError = in.Threshold;
  return statistics;
}

} // namespace tetralux
