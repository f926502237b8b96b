// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTriangleCasterMapper.h"

#include "Base/Stopwatch.h"
#include "Frame/FrameRecord.h"
#include "Frame/HeldContents.h"
#include "Frame/MapperFrame.h"
#include "Frame/PictureDrawing.h"
#include "Frame/RendererLights.h"
#include "ImagePreparation/ChosenDistance.h"
#include "ImagePreparation/ImageBlends.h"
#include "ImagePreparation/ImageObstacles.h"
#include "ImagePreparation/ImagePreparation.h"
#include "Integral/ErrorBudget.h"
#include "Optics/LightKey.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "Report/Json.h"
#include "TriangleCaster/ImageCaster.h"
#include "TriangleCaster/ImageError.h"
#include "View/MeshToWorld.h"
#include "View/ViewKey.h"

#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using tetralux::Json;
using tetralux::MapperFrame;
using tetralux::PixelRectangle;

namespace
{

/// Slices of an interaction are this much farther apart, where nothing else is set.
constexpr double InteractiveFactor = 2;

/// SampleDistanceByError begins with slices this much farther apart.
constexpr double CoarsestFactor = 4;

tetralux::LightSum ToLightSum(int sum)
{
  switch (sum)
  {
    case vtkTriangleCasterMapper::NEAREST_ENTRY_SUM:
      return tetralux::LightSum::NearestEntry;
    case vtkTriangleCasterMapper::INTERPOLATED_SUM:
      return tetralux::LightSum::Interpolated;
    default: // SetLightSum refuses all others
      return tetralux::LightSum::Direct;
  }
}

/// Sets a colour; refuses numbers that are not finite.
void SetFactors(
  vtkTriangleCasterMapper* self, const char* name, double color[3], const double factors[3])
{
  if (!std::all_of(factors, factors + 3, [](double factor) { return std::isfinite(factor); }))
  {
    vtkErrorWithObjectMacro(self, << name << ": factors of colours are finite");
    return;
  }
  if (!std::equal(factors, factors + 3, color))
  {
    std::copy_n(factors, 3, color);
    self->Modified();
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
class vtkTriangleCasterMapper::Internals
{
public:
  explicit Internals(vtkTriangleCasterMapper* self)
    : Self(self)
    , Preparation(self)
    , Record(self)
  {
  }

  /// Throws what the stages throw.
  void DrawFrame(MapperFrame& frame);

  tetralux::ScalarSelection SelectScalars() const;

  /// What slices add to the error of the last frame; 0 where it is known, or can't be known any
  /// more.
  double MeasureSlices();

  /// The same of the last picture, whose input is there.
  double EstimateSlices();

  vtkTriangleCasterMapper* Self;
  tetralux::ImagePreparation Preparation;
  tetralux::FrameRecord Record;
  tetralux::PictureDrawing Drawing;

private:
  void SetUp(MapperFrame& frame) const;
  void SetUpLights(MapperFrame& frame) const;
  void AddSceneToKey(MapperFrame& frame) const;
  PixelRectangle MakePicture(MapperFrame& frame, const tetralux::PictureTask& picture);
  tetralux::ImageCasterOptions MakeOptions(const tetralux::RayGrid& grid, MapperFrame& frame) const;
  double FindBrightness(const tetralux::RayGrid& grid, const MapperFrame& frame) const;
  /// What slices are laid through, in indices of the input's points.
  tetralux::IndexBox FindSlicedBox() const;
  double FindSampleDistance(const MapperFrame& frame) const;
  double ChooseSampleDistance(const tetralux::RayGrid& grid, const tetralux::RayLimits& limits,
    const tetralux::ImageCasterOptions& options, const MapperFrame& frame);
  void Describe(const tetralux::ImageCastStatistics& statistics,
    const tetralux::ImageCasterOptions& options, const tetralux::PictureTask& picture,
    MapperFrame& frame) const;

  tetralux::ChosenDistance Chosen;  ///< by the error, of frames without an interaction
  std::vector<std::string> Rebuilt; ///< by the present frame, for the statistics

  /// The last picture, as far as it takes to measure its error.
  struct LastPicture
  {
    tetralux::RayGrid Grid;
    tetralux::RayLimits Limits;
    std::shared_ptr<const std::vector<float>> OpaqueDistances; ///< what Limits point to
    tetralux::ImageCasterOptions Options;
    tetralux::Span<const float> Colors;
    vtkWeakPointer<vtkDataObject> Input;
    vtkMTimeType InputTime = 0;
  };
  std::optional<LastPicture> Last;     ///< until it was measured
  vtkWeakPointer<vtkDataObject> Input; ///< of the last frame
  vtkMTimeType InputTime = 0;          ///< when that frame began
  double SliceError = 0;               ///< beside what the record has
  double SliceDistance = 0;            ///< of the last picture
};

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::Internals::DrawFrame(MapperFrame& frame)
{
  const tetralux::Stopwatch stopwatch;
  // Of now: what an observer changes later is for the next frame.
  frame.Key.Add(this->Self->GetMTime());
  frame.Key.Add(frame.Property);
  frame.Key.Add(frame.Property->GetMTime());
  this->SetUp(frame);
  tetralux::ImageInput input;
  const vtkSmartPointer<vtkDataObject> data = this->Self->GetDataObjectInput();
  const vtkSmartPointer<vtkImageData> mask = this->Self->MaskInput;
  // Values are read where they are.
  const vtkSmartPointer<vtkDataObject> contents = tetralux::HoldContents(data);
  const vtkSmartPointer<vtkDataObject> maskContents = tetralux::HoldContents(mask);
  this->Input = data;
  this->InputTime = data ? data->GetMTime() : 0;
  input.Data = data;
  input.Property = frame.Property;
  input.Matrix = frame.Volume->GetMatrix();
  input.Scalars = this->SelectScalars();
  input.Mask = mask;
  input.Type = this->Self->MaskType == BinaryMaskType ? tetralux::MaskType::Binary
                                                      : tetralux::MaskType::Labels;
  input.LabelShare = this->Self->MaskBlendFactor;
  input.Blend = tetralux::GetImageBlend(this->Self->BlendMode);
  std::copy_n(this->Self->AverageIPScalarRange, 2, input.AverageRange);
  input.Opacity = this->Self->OpacityModel == POWER_OPACITY ? tetralux::StepOpacity::Power
                                                            : tetralux::StepOpacity::Attenuation;
  input.Norm = this->Self->GradientNorm == EUCLIDEAN_NORM ? tetralux::GradientNorm::Euclidean
                                                          : tetralux::GradientNorm::Sum;
  input.MaximumError = frame.MaximumError;
  this->Preparation.Update(input);
  this->Rebuilt = this->Preparation.GetRebuilt();
  if (!this->Rebuilt.empty())
  {
    this->Chosen.Reset();
  }
  this->SetUpLights(frame);
  this->AddSceneToKey(frame);

  tetralux::RayDistances distances;
  distances.Automatic = this->Self->AutoAdjustSampleDistances != 0;
  distances.Fixed = this->Self->ImageSampleDistance;
  distances.Minimum = this->Self->MinimumImageSampleDistance;
  distances.Maximum = this->Self->MaximumImageSampleDistance;
  this->Drawing.Draw(frame, distances,
    [this](MapperFrame& drawn, const tetralux::PictureTask& picture)
    { return this->MakePicture(drawn, picture); });

  Json sections;
  sections["input"] = this->Preparation.DescribeInput();
  this->Record.Write(
    frame, this->Rebuilt, this->Preparation.DescribeSeconds(), stopwatch.GetSeconds(), sections);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::Internals::SetUp(MapperFrame& frame) const
{
  frame.Method = "triangle-caster";
  frame.MaximumError = this->Self->MaximumError;
  tetralux::FrameSettings& settings = frame.Settings;
  settings.IntermixIntersectingGeometry = this->Self->IntermixIntersectingGeometry != 0;
  settings.ClippingPlanes = tetralux::GetClippingPlanes(this->Self);
  settings.Cropping = this->Self->Cropping != 0;
  std::copy_n(this->Self->CroppingRegionPlanes, 6, settings.CroppingRegionPlanes);
  settings.CroppingRegionFlags = static_cast<std::uint32_t>(this->Self->CroppingRegionFlags);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::Internals::SetUpLights(MapperFrame& frame) const
{
  vtkVolumeProperty* property = frame.Property;
  const auto& others = this->Preparation.GetOtherComponents();
  const bool litModes =
    this->Self->BlendMode == COMPOSITE_BLEND || this->Self->BlendMode == ISOSURFACE_BLEND;
  frame.Shaded = litModes &&
    (property->GetShade(0) != 0 ||
      std::any_of(others.begin(), others.end(),
        [](const tetralux::ComponentOptics& other) { return other.Shaded; }));
  if (frame.Shaded)
  {
    frame.Lights = tetralux::GetRendererLights(frame.Renderer);
    frame.Surface = tetralux::GetMaterial(property);
  }
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::Internals::AddSceneToKey(MapperFrame& frame) const
{
  frame.Key.Add(this->Preparation.GetVersion());
  for (const auto& row : this->Preparation.GetPlacement().IndexFromData)
  {
    tetralux::AddNumbersTo(frame.Key, row);
  }
  frame.Key.Add(frame.Shaded);
  if (frame.Shaded)
  {
    tetralux::AddLightsTo(frame.Key, frame.Lights);
  }
}

//------------------------------------------------------------------------------------------------
tetralux::ScalarSelection vtkTriangleCasterMapper::Internals::SelectScalars() const
{
  tetralux::ScalarSelection scalars;
  scalars.ScalarMode = this->Self->GetScalarMode();
  scalars.ArrayAccessMode = this->Self->GetArrayAccessMode();
  scalars.ArrayId = this->Self->GetArrayId();
  scalars.ArrayName = this->Self->GetArrayName() ? this->Self->GetArrayName() : "";
  scalars.VectorMode = this->Self->VectorMode;
  scalars.VectorComponent = this->Self->VectorComponent;
  return scalars;
}

//------------------------------------------------------------------------------------------------
PixelRectangle vtkTriangleCasterMapper::Internals::MakePicture(
  MapperFrame& frame, const tetralux::PictureTask& picture)
{
  const tetralux::ImagePlacement& placement = this->Preparation.GetPlacement();
  const tetralux::RayGrid grid = ToIndices(placement, picture.Grid);
  const tetralux::RayLimits limits = ToIndices(placement, picture.Limits);
  tetralux::ImageCasterOptions options = this->MakeOptions(grid, frame);
  if (picture.OfSamples)
  {
    options.SampleDistance = this->SliceDistance;
    this->Preparation.Caster.Cast(grid, limits, options, picture.Colors, picture.Depths);
    return tetralux::FindCovered(picture);
  }
  this->Last.reset();
  this->SliceError = 0;
  this->SliceDistance = this->ChooseSampleDistance(grid, limits, options, frame);
  options.SampleDistance = this->SliceDistance;
  const tetralux::ImageCastStatistics statistics =
    this->Preparation.Caster.Cast(grid, limits, options, picture.Colors, picture.Depths);
  frame.Aborted = statistics.Aborted;
  this->Describe(statistics, options, picture, frame);
  if (!frame.Aborted)
  {
    options.Progress = nullptr; // of the frame
    this->Last = { grid, limits, picture.OpaqueDistances, options,
      tetralux::Span<const float>(picture.Colors), this->Input, this->InputTime };
    if (this->Self->SampleDistanceByError != 0 && !frame.IsInteractive())
    {
      frame.Errors.emplace_back("slices", this->EstimateSlices());
      this->Last.reset(); // in the record now
    }
  }
  return frame.Aborted ? PixelRectangle() : tetralux::FindCovered(picture);
}

//------------------------------------------------------------------------------------------------
tetralux::ImageCasterOptions vtkTriangleCasterMapper::Internals::MakeOptions(
  const tetralux::RayGrid& grid, MapperFrame& frame) const
{
  tetralux::ErrorSpending spending;
  spending.Approximated = this->Preparation.GetFunctionError() > 0;
  spending.Sliced = this->Self->SampleDistanceByError != 0;
  const bool composites =
    this->Self->BlendMode == COMPOSITE_BLEND || this->Self->BlendMode == ISOSURFACE_BLEND;
  spending.EndsEarly = composites && (this->Self->EndTriangles != 0 || this->Self->SkipPixels != 0);
  frame.Budget = tetralux::MakeErrorBudget(frame.MaximumError, spending);
  frame.Brightness = this->FindBrightness(grid, frame);

  tetralux::ImageCasterOptions options;
  options.Shape = this->Self->SliceShape == PLANE_SLICES ? tetralux::SliceShape::Planes
                                                         : tetralux::SliceShape::Shells;
  options.Whole = this->FindSlicedBox();
  options.CorrectOpacity = this->Self->CorrectOpacity != 0;
  options.PreIntegrated = this->Self->PreIntegration != 0;
  options.Shaded = frame.Shaded && frame.Property->GetShade(0) != 0;
  options.Lights = frame.Lights;
  options.Surface = frame.Surface;
  options.Gradients = this->Self->GradientSource == ON_THE_FLY_GRADIENTS
    ? tetralux::GradientSource::OnTheFly
    : tetralux::GradientSource::Bytes;
  options.SumOfLights = ToLightSum(this->Self->LightSum);
  for (int c = 0; c < 3; ++c)
  {
    options.NearColor[c] = static_cast<float>(this->Self->NearColor[c]);
    options.FarColor[c] = static_cast<float>(this->Self->FarColor[c]);
  }
  options.Threshold = frame.Budget.Termination / frame.Brightness;
  options.EndTriangles = this->Self->EndTriangles != 0;
  options.SkipPixels = this->Self->SkipPixels != 0;
  options.SkipEmptySpace = this->Self->SkipEmptySpace != 0;
  options.TileSize = this->Self->TileSize;
  options.Triangles = this->Self->CastTriangles != 0;
  options.NumberOfThreads = this->Self->NumberOfThreads;
  options.Progress = [&frame](double fraction) { return frame.ReportProgress(fraction); };
  return options;
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterMapper::Internals::FindBrightness(
  const tetralux::RayGrid& grid, const MapperFrame& frame) const
{
  double cue = 1;
  for (int c = 0; c < 3; ++c)
  {
    cue = std::max({ cue, std::abs(this->Self->NearColor[c]), std::abs(this->Self->FarColor[c]) });
  }
  const double colors = cue * std::max(1., this->Preparation.GetLargestColor());
  if (!frame.Shaded)
  {
    return colors;
  }
  const int* size = this->Preparation.GetScalars().GetVolume().Dimensions;
  const double center[3] = { 0.5 * (size[0] - 1), 0.5 * (size[1] - 1), 0.5 * (size[2] - 1) };
  const auto findBrightness = [&](const tetralux::Material& surface)
  {
    return tetralux::FindLargestBrightness(frame.Lights, surface, grid.MeshFromWorld, center,
      std::hypot(center[0], center[1], center[2]),
      tetralux::MeasureMeshToWorld(grid.MeshFromWorld).Smallest);
  };
  double brightness = findBrightness(frame.Surface);
  for (const tetralux::ComponentOptics& other : this->Preparation.GetOtherComponents())
  {
    brightness = std::max(brightness, findBrightness(other.Surface));
  }
  return colors * brightness;
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterMapper::Internals::MeasureSlices()
{
  if (this->Last)
  {
    const LastPicture& last = *this->Last;
    if (last.Input && last.Input == this->Self->GetDataObjectInput() &&
      last.Input->GetMTime() == last.InputTime)
    {
      this->SliceError = this->EstimateSlices();
    }
    this->Last.reset();
  }
  return this->SliceError;
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterMapper::Internals::EstimateSlices()
{
  const LastPicture& last = *this->Last;
  return tetralux::EstimateImageError(
    this->Preparation.Caster, last.Grid, last.Limits, last.Options, last.Colors)
    .Largest;
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterMapper::Internals::ChooseSampleDistance(const tetralux::RayGrid& grid,
  const tetralux::RayLimits& limits, const tetralux::ImageCasterOptions& options,
  const MapperFrame& frame)
{
  const double distance = this->FindSampleDistance(frame);
  if (this->Self->SampleDistanceByError == 0 || frame.IsInteractive())
  {
    return distance;
  }
  tetralux::ImageCasterOptions coarsest = options;
  coarsest.SampleDistance = CoarsestFactor * distance;
  if (this->Chosen.Update(this->Preparation.Caster, grid, limits, coarsest, frame.Budget.Slices))
  {
    this->Rebuilt.emplace_back("distance of slices");
  }
  return this->Chosen.Get();
}

//------------------------------------------------------------------------------------------------
tetralux::IndexBox vtkTriangleCasterMapper::Internals::FindSlicedBox() const
{
  tetralux::IndexBox box = GetIndexBox(this->Preparation.GetScalars().GetVolume());
  const int* whole = this->Self->WholeExtent;
  auto* image = vtkImageData::SafeDownCast(this->Self->GetDataObjectInput());
  if (image && whole[0] <= whole[1] && whole[2] <= whole[3] && whole[4] <= whole[5])
  {
    const int* extent = image->GetExtent();
    for (int a = 0; a < 3; ++a)
    {
      box.Low[a] = whole[2 * a] - extent[2 * a];
      box.High[a] = whole[2 * a + 1] - extent[2 * a];
    }
  }
  return box;
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterMapper::Internals::FindSampleDistance(const MapperFrame& frame) const
{
  double distance = this->Self->SampleDistance;
  if (distance == 0)
  {
    double steps[3];
    MeasureSteps(this->Preparation.GetPlacement(), frame.Volume->GetMatrix(), steps);
    const tetralux::IndexBox box = this->FindSlicedBox();
    int extent[6];
    for (int a = 0; a < 3; ++a)
    {
      extent[2 * a] = static_cast<int>(box.Low[a]);
      extent[2 * a + 1] = static_cast<int>(box.High[a]);
    }
    distance = this->Self->SpacingAdjustedSampleDistance(steps, extent);
  }
  if (!this->Self->AutoAdjustSampleDistances || !frame.IsInteractive())
  {
    return distance;
  }
  return this->Self->InteractiveSampleDistance > 0 ? this->Self->InteractiveSampleDistance
                                                   : InteractiveFactor * distance;
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::Internals::Describe(const tetralux::ImageCastStatistics& statistics,
  const tetralux::ImageCasterOptions& options, const tetralux::PictureTask& picture,
  MapperFrame& frame) const
{
  Json rays;
  rays["width"] = picture.Grid.Width;
  rays["height"] = picture.Grid.Height;
  rays["sample_distance"] = picture.SampleDistance;
  rays["rays"] = statistics.Rays;
  rays["samples"] = statistics.Samples;
  rays["instruction_set"] = statistics.InstructionSet;
  rays["threads"] = statistics.NumberOfThreads;
  frame.Sections.emplace_back("rays", rays);

  Json slices;
  slices["shape"] = this->Self->GetSliceShapeAsString();
  slices["blend_mode"] = this->Self->GetBlendModeAsString();
  slices["gradient_source"] = this->Self->GetGradientSourceAsString();
  slices["light_sum"] = this->Self->GetLightSumAsString();
  slices["opacity_model"] = this->Self->GetOpacityModelAsString();
  slices["pre_integration"] = options.PreIntegrated && this->Self->BlendMode == COMPOSITE_BLEND;
  slices["distance"] = options.SampleDistance;
  slices["slices"] = statistics.Slices;
  slices["tile_size"] = options.TileSize;
  slices["triangles"] = statistics.Triangles;
  frame.Sections.emplace_back("slices", slices);

  // A sum is rounded once for each sample of a ray.
  constexpr double HalfRounding = std::numeric_limits<float>::epsilon() / 2;
  const double samples = statistics.Rays > 0
    ? static_cast<double>(statistics.Samples) / static_cast<double>(statistics.Rays)
    : 0;
  frame.Errors = { { "early_termination", frame.Brightness * statistics.TerminationError },
    { "summation", frame.Brightness * samples * HalfRounding },
    { "transfer_function", this->Preparation.GetFunctionError() } };
  frame.ReportOmission(
    options.Threshold == 0, "early termination", "MaximumError and BlendMode allow none");
  frame.ReportOmission(
    !options.SkipEmptySpace, "empty space", "SkipEmptySpace is off, so all of it is sampled");
  const bool composite = this->Self->BlendMode == COMPOSITE_BLEND;
  constexpr const char* CompositeOnly = "composite blending has it only";
  frame.ReportOmission(!frame.Shaded, "shading",
    composite || this->Self->BlendMode == ISOSURFACE_BLEND
      ? "Shade is off"
      : "composite and isosurface blending have it only");
  frame.ReportOmission(!this->Preparation.HasGradientOpacity(), "gradient opacity",
    composite ? "the property has none" : CompositeOnly);
  frame.ReportOmission(this->Preparation.GetFunctionError() == 0, "subdivided transfer function",
    "it is piecewise linear");
  frame.ReportOmission(this->Preparation.GetScalars().GetNumberOfCopiedBytes() == 0,
    "copy of the values", "they are read in place");
}

//------------------------------------------------------------------------------------------------
vtkStandardNewMacro(vtkTriangleCasterMapper);

//------------------------------------------------------------------------------------------------
vtkTriangleCasterMapper::vtkTriangleCasterMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTriangleCasterMapper::~vtkTriangleCasterMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  if (renderer->GetSelector())
  {
    return;
  }
  this->Private->Record.Render(
    renderer, volume, [this](MapperFrame& frame) { this->Private->DrawFrame(frame); },
    this->TimeToDraw);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Private->Record.MayRelease(window))
  {
    this->Private->Drawing.ReleaseGraphicsResources(window);
    this->Superclass::ReleaseGraphicsResources(window);
  }
}

//------------------------------------------------------------------------------------------------
double* vtkTriangleCasterMapper::GetBounds()
{
  // Who observes the update may take the input away, or let the mapper go.
  const vtkSmartPointer<vtkObject> self = this;
  if (this->GetDataSetInput())
  {
    this->Update();
  }
  if (vtkDataSet* input = this->GetDataSetInput())
  {
    input->GetBounds(this->Bounds);
  }
  else
  {
    vtkMath::UninitializeBounds(this->Bounds);
  }
  return self->GetReferenceCount() > 1 ? this->Bounds : nullptr;
}

//------------------------------------------------------------------------------------------------
std::string vtkTriangleCasterMapper::GetObstacle()
{
  return tetralux::FindObstacle(this->GetDataObjectInput(), this->Private->SelectScalars());
}

//------------------------------------------------------------------------------------------------
vtkImageData* vtkTriangleCasterMapper::GetOutputImage()
{
  return this->Private->Record.GetPicture();
}

//------------------------------------------------------------------------------------------------
std::string vtkTriangleCasterMapper::GetStatistics()
{
  return this->Private->Record.GetStatistics();
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterMapper::GetErrorEstimate()
{
  return this->Private->Record.GetErrorEstimate() + this->Private->MeasureSlices();
}

//------------------------------------------------------------------------------------------------
bool vtkTriangleCasterMapper::IsMaximumErrorKept()
{
  return this->Private->Record.IsErrorKept(this->MaximumError, this->Private->MeasureSlices());
}

//------------------------------------------------------------------------------------------------
tetraluxEnumerationMacro(vtkTriangleCasterMapper, BlendMode);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, MaximumError, double);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, SampleDistance, double);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, InteractiveSampleDistance, double);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, SliceShape);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, OpacityModel);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, GradientNorm);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, GradientSource);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, LightSum);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, TileSize, int);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, NumberOfThreads, int);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, ImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, MinimumImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, MaximumImageSampleDistance, float);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, VectorMode);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, VectorComponent, int);
tetraluxEnumerationMacro(vtkTriangleCasterMapper, MaskType);
tetraluxSetNumberMacro(vtkTriangleCasterMapper, MaskBlendFactor, float);

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetMaskInput(vtkImageData* mask)
{
  if (this->MaskInput != mask)
  {
    this->MaskInput = mask;
    this->Modified();
  }
}

//------------------------------------------------------------------------------------------------
vtkImageData* vtkTriangleCasterMapper::GetMaskInput() { return this->MaskInput; }

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetAverageIPScalarRange(double least, double largest)
{
  if (std::isnan(least) || std::isnan(largest))
  {
    vtkErrorMacro("AverageIPScalarRange: nan is not a scalar");
    return;
  }
  this->Superclass::SetAverageIPScalarRange(least, largest);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetAverageIPScalarRange(const double range[2])
{
  this->SetAverageIPScalarRange(range[0], range[1]);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetNearColor(double red, double green, double blue)
{
  const double color[3] = { red, green, blue };
  this->SetNearColor(color);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetNearColor(const double color[3])
{
  SetFactors(this, "NearColor", this->NearColor, color);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetFarColor(double red, double green, double blue)
{
  const double color[3] = { red, green, blue };
  this->SetFarColor(color);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetFarColor(const double color[3])
{
  SetFactors(this, "FarColor", this->FarColor, color);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetCroppingRegionPlanes(
  double xMin, double xMax, double yMin, double yMax, double zMin, double zMax)
{
  const double planes[6] = { xMin, xMax, yMin, yMax, zMin, zMax };
  this->SetCroppingRegionPlanes(planes);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::SetCroppingRegionPlanes(const double planes[6])
{
  if (std::any_of(planes, planes + 6, [](double plane) { return std::isnan(plane); }))
  {
    vtkErrorMacro("CroppingRegionPlanes: nan is not a place of a plane");
    return;
  }
  this->Superclass::SetCroppingRegionPlanes(
    planes[0], planes[1], planes[2], planes[3], planes[4], planes[5]);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  // Not the superclass's, which prints numbers of enumerations.
  // NOLINTNEXTLINE(bugprone-parent-virtual-call)
  this->vtkAbstractVolumeMapper::PrintSelf(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("BlendMode", this->BlendMode);
  printer.Print(
    "AverageIPScalarRange", this->AverageIPScalarRange[0], this->AverageIPScalarRange[1]);
  printer.Print("MaximumError", this->MaximumError);
  printer.Print("SampleDistance", this->SampleDistance);
  const int* whole = this->WholeExtent;
  os << indent << "WholeExtent: " << whole[0] << ", " << whole[1] << ", " << whole[2] << ", "
     << whole[3] << ", " << whole[4] << ", " << whole[5] << "\n";
  printer.Print("SampleDistanceByError", this->SampleDistanceByError);
  printer.Print("InteractiveSampleDistance", this->InteractiveSampleDistance);
  printer.Print("SliceShape", this->SliceShape);
  printer.Print("OpacityModel", this->OpacityModel);
  printer.Print("GradientNorm", this->GradientNorm);
  printer.Print("GradientSource", this->GradientSource);
  printer.Print("LightSum", this->LightSum);
  printer.Print("NearColor", this->NearColor[0], this->NearColor[1], this->NearColor[2]);
  printer.Print("FarColor", this->FarColor[0], this->FarColor[1], this->FarColor[2]);
  printer.Print("PreIntegration", this->PreIntegration);
  printer.Print("CorrectOpacity", this->CorrectOpacity);
  printer.Print("EndTriangles", this->EndTriangles);
  printer.Print("SkipPixels", this->SkipPixels);
  printer.Print("SkipEmptySpace", this->SkipEmptySpace);
  printer.Print("TileSize", this->TileSize);
  printer.Print("CastTriangles", this->CastTriangles);
  printer.Print("NumberOfThreads", this->NumberOfThreads);
  printer.Print("ImageSampleDistance", this->ImageSampleDistance);
  printer.Print("MinimumImageSampleDistance", this->MinimumImageSampleDistance);
  printer.Print("MaximumImageSampleDistance", this->MaximumImageSampleDistance);
  printer.Print("AutoAdjustSampleDistances", this->AutoAdjustSampleDistances);
  printer.Print("VectorMode", this->VectorMode);
  printer.Print("VectorComponent", this->VectorComponent);
  os << indent << "MaskInput: " << this->MaskInput << "\n";
  printer.Print("MaskType", this->MaskType);
  printer.Print("MaskBlendFactor", this->MaskBlendFactor);
  printer.Print("IntermixIntersectingGeometry", this->IntermixIntersectingGeometry);
  printer.Print("Cropping", this->Cropping);
  const double* planes = this->CroppingRegionPlanes;
  printer.Print(
    "CroppingRegionPlanes", planes[0], planes[1], planes[2], planes[3], planes[4], planes[5]);
  printer.Print("CroppingRegionFlags", this->CroppingRegionFlags);
  os << indent << "ErrorEstimate: " << this->GetErrorEstimate() << "\n";
  this->Private->Record.PrintStatistics(os, indent);
}
