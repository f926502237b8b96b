// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/ImageCaster.h"

#include "Base/ParallelTiles.h"
#include "Optics/IntervalTable.h"
#include "Simd/InstructionSet.h"
#include "TriangleCaster/ContributingValues.h"
#include "TriangleCaster/EmptySpace.h"
#include "TriangleCaster/FunctionLookup.h"
#include "TriangleCaster/FunctionSet.h"
#include "TriangleCaster/GradientVoxels.h"
#include "TriangleCaster/HiddenCells.h"
#include "TriangleCaster/ImageBlending.h"
#include "TriangleCaster/ImageChecks.h"
#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/IntensityMap.h"
#include "TriangleCaster/SlabTable.h"
#include "TriangleCaster/TransferTableEvaluation.h"
#include "View/MeshToWorld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
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

/// A kernel, and what it is compiled for.
struct ChosenKernel
{
  ImageKernel Kernel;
  InstructionSet Set;
};

ChosenKernel ChooseKernel(const ImageCasterOptions& options, const ImageKernelInput& in)
{
  const bool components = in.Components > 1 || in.Labels;
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  if (!options.PortableKernels && options.WideKernels && !components && HasFastWideLanes())
  {
    const ImageKernel kernel = GetImageKernelAvx512(in);
    if (kernel)
    {
      return { kernel, InstructionSet::Avx512 };
    }
  }
  if (!options.PortableKernels && GetInstructionSet() == InstructionSet::Avx2)
  {
    return { components ? GetImageComponentKernelAvx2(in) : GetImageKernelAvx2(in),
      InstructionSet::Avx2 };
  }
#endif
  static_cast<void>(options);
  return { components ? GetImageComponentKernelGeneric(in) : GetImageKernelGeneric(in),
    InstructionSet::Generic };
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

/// Lights as a kernel reads them, of one material.
struct KernelLights
{
  KernelLighting Lighting{};
  std::vector<KernelLight> Lights;

  const KernelLighting* Fill(const std::vector<Light>& lights, const Material& surface,
    const RayGrid& grid, const ImageVolume& volume)
  {
    FillKernelLighting(
      lights, surface, grid, FindRadius(volume, grid), this->Lighting, this->Lights);
    return &this->Lighting;
  }
};

/// What rays go through, once the models' blending is filled. Models with samples in the middles of
/// slabs take whole slabs from the parts of an image; others, which look at both ends, go to the
/// sides of the part.
void FillBoxes(const IndexBox& volume, const ImageCasterOptions& options, ImageKernelInput& in)
{
  const bool middles =
    in.Blend != ImageBlend::Isosurfaces && in.Blend != ImageBlend::Slice && !in.Slab.Texels;
  in.Sliced = volume;
  in.Partial = false;
  for (int a = 0; a < 3; ++a)
  {
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    if (options.Whole && middles)
    {
      in.Sliced.Low[a] = std::min(volume.Low[a], options.Whole->Low[a]);
      in.Sliced.High[a] = std::max(volume.High[a], options.Whole->High[a]);
    }
    in.Own.Low[a] = in.Sliced.Low[a] < volume.Low[a] ? volume.Low[a] : -Infinity;
    in.Own.High[a] = in.Sliced.High[a] > volume.High[a] ? volume.High[a] : Infinity;
    in.Partial = in.Partial || std::isfinite(in.Own.Low[a]) || std::isfinite(in.Own.High[a]);
  }
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
  bool ShowsLabels() const { return tetralux::ShowsLabels(this->Volume, this->Optics); }
  bool ShowsParts() const
  {
    return this->Volume.Components > 1 && this->Optics.Components == ImageComponents::Independent;
  }
  /// Where a value lies in the intervals of a function.
  ///@{
  float GetValueScale(const IntervalTable& table) const
  {
    return static_cast<float>(this->Volume.Scale * (1 / table.Scale));
  }
  float GetValueOffset(const IntervalTable& table) const
  {
    return static_cast<float>((this->Volume.Offset - table.Offset) / table.Scale);
  }
  ///@}
  const BlockRanges& GetBlocks(int component, int threads);
  SpaceFunction MakeSpaceFunction(const ImageKernelInput& in, int component, int threads,
    const IntervalTable& table, BlockLabels::Set labels);
  std::vector<SpaceFunction> MakeSpaceFunctions(const ImageKernelInput& in, int threads);
  void PrepareHiddenCells(int threads);
  /// Finds out what in may skip. Hidden cells must be prepared.
  void PrepareSpace(int threads, ImageKernelInput& in);
  void PrepareSlabs(const ImageCasterOptions& options, int threads);
  void FillTable(ImageKernelInput& in) const;
  void FillGradients(const RayGrid& grid, ImageKernelInput& in) const;
  void PrepareGradients(const ImageCasterOptions& options, int threads, ImageKernelInput& in);
  void FillParts(ImageKernelInput& in);
  void FillLabels(ImageKernelInput& in);
  void FillRays(const RayGrid& grid, const RayLimits& limits, ImageKernelInput& in) const;
  ImageKernelInput MakeInput(
    const RayGrid& grid, const RayLimits& limits, const ImageCasterOptions& options);

  ImageVolume Volume;
  bool HasVolume = false;
  ImageOptics Optics;
  bool HasOptics = false;
  FunctionSet Functions;
  SurfaceTable Surfaces;

  SlabTable Slabs; ///< of Optics, and the scalars of Volume

  // What a kernel reads besides its input.
  std::vector<ComponentLookup> PartLookups; ///< of all components
  LabelsLookup LabelLookup;

  // Of Volume, if valid.
  std::vector<unsigned char> HiddenCells;
  bool HiddenCellsValid = false;
  BlockRanges Blocks[ImageVolume::MostComponents];
  bool BlocksValid[ImageVolume::MostComponents] = {};
  BlockLabels Labels;
  bool LabelsValid = false;

  EmptySpace Space;
  bool SpaceValid = false; ///< of Volume and Optics

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
  CheckMatch(this->Volume, this->Optics);
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareHiddenCells(int threads)
{
  if (!this->HiddenCellsValid)
  {
    this->HiddenCells = FindHiddenCells(this->Volume, threads);
    this->HiddenCellsValid = true;
  }
}

//------------------------------------------------------------------------------------------------
const BlockRanges& ImageCaster::Internals::GetBlocks(int component, int threads)
{
  if (!this->BlocksValid[component])
  {
    this->Blocks[component].Build(this->Volume, component, threads);
    this->BlocksValid[component] = true;
  }
  return this->Blocks[component];
}

//------------------------------------------------------------------------------------------------
SpaceFunction ImageCaster::Internals::MakeSpaceFunction(const ImageKernelInput& in, int component,
  int threads, const IntervalTable& table, BlockLabels::Set labels)
{
  return { &this->GetBlocks(component, threads),
    ContributingValues(in, table, this->GetValueScale(table), this->GetValueOffset(table)),
    labels };
}

//------------------------------------------------------------------------------------------------
std::vector<SpaceFunction> ImageCaster::Internals::MakeSpaceFunctions(
  const ImageKernelInput& in, int threads)
{
  constexpr BlockLabels::Set AnyLabel = ~static_cast<BlockLabels::Set>(0);
  std::vector<SpaceFunction> functions;
  if (this->ShowsParts())
  {
    for (int component = 0; component < this->Volume.Components; ++component)
    {
      const double weight =
        component == 0 ? this->Optics.Weight : this->Optics.OtherComponents[component - 1].Weight;
      functions.push_back(this->MakeSpaceFunction(in, component, threads,
        this->Functions.Parts[component].Function.Table, weight > 0 ? AnyLabel : 0));
    }
  }
  else if (this->ShowsLabels())
  {
    const std::vector<IntervalTable>& tables = this->Functions.LabelFunctions.Tables;
    const int labels = static_cast<int>(tables.size());
    BlockLabels::Set plain = BlockLabels::GetSet(0);
    for (int label = labels; label < 256; ++label)
    {
      plain |= BlockLabels::GetSet(label);
    }
    // Without labels of its own share, a function is seen everywhere.
    functions.push_back(this->MakeSpaceFunction(
      in, 0, threads, tables.front(), this->Optics.LabelShare < 1 ? AnyLabel : plain));
    for (int label = 1; label < std::min(labels, 256); ++label)
    {
      functions.push_back(
        this->MakeSpaceFunction(in, 0, threads, tables[label], BlockLabels::GetSet(label)));
    }
  }
  else
  {
    // Of dependent components the last one has the opacity.
    functions.push_back(this->MakeSpaceFunction(in, this->Volume.Components - 1, threads,
      this->Functions.GetFirst().Function.Table, AnyLabel));
  }
  return functions;
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareSpace(int threads, ImageKernelInput& in)
{
  if (!this->LabelsValid)
  {
    this->Labels.Build(this->Volume, this->HiddenCells, threads);
    this->LabelsValid = true;
  }
  if (!this->SpaceValid)
  {
    const std::vector<SpaceFunction> functions = this->MakeSpaceFunctions(in, threads);
    const std::vector<BlockLabels::Set>& sets = this->Labels.GetSets();
    // A surface may be between two samples that have something hidden between them.
    const bool hides = !sets.empty() && in.Blend != ImageBlend::Isosurfaces;
    this->Space.Build(functions.front().Blocks->GetSize(), threads,
      [&](std::int64_t block)
      {
        const BlockLabels::Set set = hides ? sets[block] : BlockLabels::GetSet(0);
        return std::any_of(functions.begin(), functions.end(),
          [&](const SpaceFunction& function) { return function.Contributes(block, set); });
      });
    this->SpaceValid = true;
  }
  in.Space = &this->Space;
  if (this->Volume.Components == 1)
  {
    in.Ranges = &this->GetBlocks(0, threads);
  }
  in.SpaceReach = in.Blend == ImageBlend::Isosurfaces ? 1 : 0;
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::PrepareSlabs(const ImageCasterOptions& options, int threads)
{
  const BlockRanges::Range range = this->GetBlocks(0, threads).GetRange();
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
  const IntervalTable& intervals = this->Functions.GetFirst().Function.Table;
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
    const FunctionLookup& function = this->Functions.GetFirst().GradientFunction;
    in.GradientTransfer = function.Lookup;
    in.GradientScale = static_cast<float>(function.GetScale());
    in.GradientOffset = static_cast<float>(function.GetOffset());
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
void ImageCaster::Internals::FillParts(ImageKernelInput& in)
{
  this->PartLookups.clear();
  const ImageOptics& optics = this->Optics;
  for (std::size_t k = 0; k < this->Functions.Parts.size(); ++k)
  {
    const FunctionLookup& function = this->Functions.Parts[k].Function;
    const FunctionLookup& gradientFunction = this->Functions.Parts[k].GradientFunction;
    ComponentLookup part{};
    part.Transfer = function.Lookup;
    part.ValueScale = this->GetValueScale(function.Table);
    part.ValueOffset = this->GetValueOffset(function.Table);
    part.LengthScale = k == 0
      ? 1.f
      : static_cast<float>(optics.UnitDistance / optics.OtherComponents[k - 1].UnitDistance);
    part.Weight = static_cast<float>(k == 0 ? optics.Weight : optics.OtherComponents[k - 1].Weight);
    part.GradientTransfer = gradientFunction.Lookup;
    part.GradientScale = static_cast<float>(gradientFunction.GetScale());
    part.GradientOffset = static_cast<float>(gradientFunction.GetOffset());
    this->PartLookups.push_back(part);
  }
  in.Parts = this->PartLookups.data();
}

//------------------------------------------------------------------------------------------------
void ImageCaster::Internals::FillLabels(ImageKernelInput& in)
{
  LabelsLookup& lookup = this->LabelLookup;
  lookup = LabelsLookup();
  lookup.Labels = this->Volume.Labels;
  const FunctionsLookup& functions = this->Functions.LabelFunctions;
  for (std::size_t label = 0; label < std::size(lookup.Rows); ++label)
  {
    lookup.Rows[label] = label < functions.Tables.size() ? static_cast<std::int32_t>(label) : 0;
  }
  lookup.Transfer = functions.Lookup;
  lookup.ValueScale = this->GetValueScale(functions.Tables.front());
  lookup.ValueOffset = this->GetValueOffset(functions.Tables.front());
  const FunctionsLookup& gradientFunctions = this->Functions.LabelGradientFunctions;
  lookup.GradientTransfer = gradientFunctions.Lookup;
  if (!gradientFunctions.Tables.empty())
  {
    lookup.GradientScale = static_cast<float>(gradientFunctions.GetScale());
    lookup.GradientOffset = static_cast<float>(gradientFunctions.GetOffset());
  }
  lookup.Share = static_cast<float>(this->Optics.LabelShare);
  in.Labels = &lookup;
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
  const bool uses = in.Blend == ImageBlend::Composite || in.Blend == ImageBlend::Isosurfaces;
  if (needed && uses && options.Gradients == GradientSource::Bytes)
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
  in.ValueScale = this->GetValueScale(this->Functions.GetFirst().Function.Table);
  in.ValueOffset = this->GetValueOffset(this->Functions.GetFirst().Function.Table);
  in.Mask = this->Volume.Mask;
  in.HiddenCells = this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
  in.Masked = in.Mask || in.HiddenCells;
  in.Transfer = this->Functions.GetFirst().Function.Lookup;
  FillBlending(this->Volume, this->Optics, this->Surfaces, in);
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
  FillBoxes(GetIndexBox(this->Volume), options, in);
  in.Slices = MakeSlicePlanes(options.Whole ? *options.Whole : GetIndexBox(this->Volume), grid,
    options.Shape, options.SampleDistance);
  this->FillRays(grid, limits, in);
  this->FillGradients(grid, in);
  FillCue(options, in);
  in.Components = this->Volume.Components;
  in.Dependent = this->Optics.Components == ImageComponents::Dependent;
  for (int c = 0; c < 3; ++c)
  {
    // From values instead of scalars.
    in.ColorScale[c] = static_cast<float>(this->Optics.ColorScale[c] * this->Volume.Scale);
    in.ColorOffset[c] = static_cast<float>(
      this->Optics.ColorOffset[c] + this->Optics.ColorScale[c] * this->Volume.Offset);
  }
  if (this->ShowsParts())
  {
    this->FillParts(in);
  }
  if (this->ShowsLabels())
  {
    this->FillLabels(in);
  }
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
  std::fill(
    this->Private->BlocksValid, this->Private->BlocksValid + ImageVolume::MostComponents, false);
  this->Private->LabelsValid = false;
  this->Private->HiddenCellsValid = false;
  this->Private->GradientsValid = false;
  this->Private->SpaceValid = false;
  this->Private->Slabs.Invalidate();
}

//------------------------------------------------------------------------------------------------
void ImageCaster::SetOptics(const ImageOptics& optics)
{
  CheckOptics(optics);
  // A function that is not valid changes nothing.
  this->Private->Functions = MakeFunctionSet(optics);
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
  CheckOptions(self.Volume, self.Optics, options);
  const int threads = options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads();
  self.PrepareHiddenCells(threads);
  if (options.PreIntegrated && self.Optics.Blend == ImageBlend::Composite)
  {
    self.PrepareSlabs(options, threads);
  }
  ImageKernelInput in = self.MakeInput(grid, limits, options);
  if (options.SkipEmptySpace)
  {
    self.PrepareSpace(threads, in);
  }
  in.Colors = colors.data();
  in.Depths = depths.data();
  KernelLights lights[ImageVolume::MostComponents];
  if (options.Shaded)
  {
    in.Lighting = lights[0].Fill(options.Lights, options.Surface, grid, self.Volume);
  }
  if (in.Parts)
  {
    self.PartLookups[0].Lighting = in.Lighting;
    for (std::size_t k = 0; k < self.Optics.OtherComponents.size(); ++k)
    {
      const ComponentOptics& other = self.Optics.OtherComponents[k];
      self.PartLookups[k + 1].Lighting = other.Shaded
        ? lights[k + 1].Fill(options.Lights, other.Surface, grid, self.Volume)
        : nullptr;
    }
  }
  self.PrepareGradients(options, threads, in);

  const ChosenKernel chosen = ChooseKernel(options, in);
  struct alignas(64) Counts : ImageKernelCounts
  {
  };
  std::vector<Counts> counts(threads);
  const TileGrid tiles{ grid.Width, grid.Height, std::max(WorkSize, in.TileSize) };
  ImageCastStatistics statistics;
  statistics.Aborted = !ForEachTile(tiles, threads, options.Progress,
    [&](const Tile& tile, int thread) { chosen.Kernel(in, tile, counts[thread]); });
  statistics.InstructionSet = GetName(chosen.Set);
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
