// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraIsosurfaceMapper.h"

#include "Frame/MapperFrame.h"
#include "Frame/PictureTask.h"
#include "Isosurface/IsosurfaceTracer.h"
#include "Preparation/MapperSettings.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstdint>
#include <vector>

using tetralux::Json;
using tetralux::MapperFrame;

namespace
{

/// In the terms of table 4 of the paper.
Json Describe(const tetralux::TraceCounts& counts)
{
  Json section;
  section["packets"] = counts.Packets;
  section["range_tests"] = counts.RangeTests;
  section["node_tests"] = counts.NodeTests;
  section["nodes_missed"] = counts.NodeMisses;
  section["isopolygon_extractions"] = counts.Extractions;
  section["isopolygons"] = counts.Polygons;
  section["isopolygons_missed"] = counts.PolygonMisses;
  section["isopolygons_covering"] = counts.PolygonCovers;
  section["ray_isopolygon_tests"] = counts.RayPolygonTests;
  return section;
}

void Describe(const tetralux::IsosurfaceStatistics& statistics,
  const tetralux::PictureTask& picture, MapperFrame& frame)
{
  Json section;
  section["width"] = picture.Grid.Width;
  section["height"] = picture.Grid.Height;
  section["sample_distance"] = picture.SampleDistance;
  section["hits"] = statistics.Hits;
  section["light_samples"] = statistics.Samples;
  section["rays_ended_at_last_layer"] = statistics.LostRays;
  section["instruction_set"] = statistics.InstructionSet;
  section["threads"] = statistics.NumberOfThreads;
  frame.Sections.emplace_back("rays", section);

  Json hierarchy;
  hierarchy["rebuilt"] = statistics.Rebuilt;
  hierarchy["nodes"] = statistics.Nodes;
  hierarchy["time_steps"] = statistics.Steps;
  hierarchy["active_nodes"] = statistics.ActiveNodes;
  hierarchy["isopolygons"] = statistics.Polygons;
  hierarchy["bytes_per_tetrahedron"] = statistics.TreeBytes;
  hierarchy["bytes_per_tetrahedron_and_step"] = statistics.StepBytes;
  frame.Sections.emplace_back("hierarchy", hierarchy);
  frame.Memory.emplace_back("isosurface_trees", statistics.AllTreesBytes);
  frame.Memory.emplace_back("isosurface_steps", statistics.AllStepsBytes);

  Json traversal;
  traversal["primary"] = Describe(statistics.Primary);
  traversal["shadow"] = Describe(statistics.Shadow);
  frame.Sections.emplace_back("traversal", traversal);

  frame.Seconds.emplace_back("hierarchy", statistics.TreeSeconds);
  frame.Seconds.emplace_back("ranges", statistics.RangesSeconds);
  frame.Seconds.emplace_back("isopolygons", statistics.PolygonsSeconds);
  frame.Seconds.emplace_back("trace", statistics.TraceSeconds);
  frame.Errors = { { "early_termination", statistics.TerminationError } };
}

/// Whether any surface may be opaque.
bool HasOpaqueSurfaces(const tetralux::VolumeScene& scene)
{
  const std::vector<tetralux::Isosurface>& surfaces = scene.Optics.GetIsosurfaces();
  return !scene.Mesh.GetColorScalars().empty() ||
    std::any_of(surfaces.begin(), surfaces.end(),
      [](const tetralux::Isosurface& surface) { return surface.Opacity >= 1; });
}

/// Whether all that is seen is opaque.
bool HasOnlyOpaqueSurfaces(const tetralux::VolumeScene& scene)
{
  const std::vector<tetralux::Isosurface>& surfaces = scene.Optics.GetIsosurfaces();
  return scene.Mesh.GetColorScalars().empty() &&
    std::all_of(surfaces.begin(), surfaces.end(),
      [](const tetralux::Isosurface& surface)
      { return surface.Opacity >= 1 || surface.Opacity <= 0; });
}

} // namespace

//------------------------------------------------------------------------------------------------
class vtkTetrahedraIsosurfaceMapper::Internals
{
public:
  tetralux::IsosurfaceTracer Tracer;
  std::vector<float> WindowDepths;
  std::vector<std::uint8_t> WindowColors;
};

//------------------------------------------------------------------------------------------------
vtkStandardNewMacro(vtkTetrahedraIsosurfaceMapper);

//------------------------------------------------------------------------------------------------
vtkTetrahedraIsosurfaceMapper::vtkTetrahedraIsosurfaceMapper()
  : Private(std::make_unique<Internals>())
{
  this->BlendMode = ISOSURFACE_BLEND;
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraIsosurfaceMapper::~vtkTetrahedraIsosurfaceMapper()
{
  this->SetColorArrayName(nullptr);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceMapper::AddSettings(tetralux::MapperSettings& settings)
{
  if (this->ColorArrayName)
  {
    tetralux::ScalarSelection colors;
    colors.ScalarMode = VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
    colors.ArrayAccessMode = VTK_GET_ARRAY_BY_NAME;
    colors.ArrayName = this->ColorArrayName;
    colors.VectorMode = this->ColorArrayComponent < 0 ? MAGNITUDE_MODE : COMPONENT_MODE;
    colors.VectorComponent = std::max(0, this->ColorArrayComponent);
    settings.Colors = colors;
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceMapper::SetBlendMode(int mode)
{
  if (mode != ISOSURFACE_BLEND)
  {
    vtkErrorMacro("BlendMode: " << mode << " is not isosurface (5), the only one of this mapper");
  }
}

//------------------------------------------------------------------------------------------------
tetralux::PixelRectangle vtkTetrahedraIsosurfaceMapper::MakePicture(
  MapperFrame& frame, const tetralux::PictureTask& picture)
{
  frame.Method = "isosurface";
  tetralux::IsosurfaceOptions options;
  options.MaximumError = frame.MaximumError;
  options.Shaded = frame.Shaded;
  options.SmoothShading = frame.Settings.SmoothShading;
  options.Shadows = this->Shadows != 0;
  options.ShadowSoftness = vtkMath::RadiansFromDegrees(this->ShadowSoftness);
  options.AmbientOcclusion = this->AmbientOcclusion != 0;
  options.OcclusionRadius = this->AmbientOcclusionRadius;
  // Where a picture has edges, it is complete.
  options.SamplesPerFrame = picture.OfSamples ? this->MaximumSamples : this->SamplesPerFrame;
  options.MaximumSamples = this->MaximumSamples;
  options.StepCacheBytes = static_cast<std::size_t>(this->TimeStepCacheBytes);
  options.Lights = frame.Lights;
  options.Surface = frame.Surface;
  options.MaximumLayers = this->MaximumNumberOfPeels;
  options.NumberOfThreads = this->NumberOfThreads;
  options.Progress = [&frame](double fraction) { return frame.ReportProgress(fraction); };
  if (frame.Settings.IntermixIntersectingGeometry && HasOpaqueSurfaces(*frame.Scene))
  {
    this->Private->WindowDepths.resize(picture.Depths.size());
    options.Depth = picture.Depth;
    options.WindowDepths = this->Private->WindowDepths;
    frame.WindowDepths = this->Private->WindowDepths;
  }
  const bool sampled =
    frame.Shaded && (options.AmbientOcclusion || (options.Shadows && options.ShadowSoftness > 0));
  if (!frame.WindowDepths.empty() && picture.IsWindowSized && !sampled &&
    HasOnlyOpaqueSurfaces(*frame.Scene))
  {
    this->Private->WindowColors.resize(4 * picture.Depths.size());
    options.WindowColors = this->Private->WindowColors;
    frame.WindowColors = this->Private->WindowColors;
    // In single precision only for who asks for it.
    frame.ReadPicture = [this, scene = frame.Scene, picture, options](vtkImageData* image)
    {
      tetralux::IsosurfaceOptions inMemory = options;
      inMemory.Progress = nullptr;
      inMemory.WindowColors = {};
      inMemory.WindowDepths = {};
      tetralux::Span<float> colors, depths;
      MapperFrame::PrepareImage(image, picture.Grid.Width, picture.Grid.Height, colors, depths);
      this->Private->Tracer.Trace(*scene, picture.Grid, picture.Limits, inMemory, colors, depths);
    };
  }
  const tetralux::IsosurfaceStatistics statistics = this->Private->Tracer.Trace(
    *frame.Scene, picture.Grid, picture.Limits, options, picture.Colors, picture.Depths);
  frame.Integration = tetralux::Integrator::Isosurfaces;
  frame.Aborted = statistics.Aborted;
  frame.IsMean = statistics.Samples > 0;
  frame.Final =
    !frame.IsMean || statistics.Samples + options.SamplesPerFrame > options.MaximumSamples;
  Describe(statistics, picture, frame);
  frame.ReportOmission(!options.AmbientOcclusion, "ambient occlusion", "it is off");
  frame.ReportOmission(!options.Shadows, "shadows", "they are off");
  return { statistics.Covered.X0, statistics.Covered.Y0,
    statistics.Covered.X1 - statistics.Covered.X0, statistics.Covered.Y1 - statistics.Covered.Y0 };
}

//------------------------------------------------------------------------------------------------
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, ColorArrayComponent, int);
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, ShadowSoftness, double);
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, AmbientOcclusionRadius, double);
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, SamplesPerFrame, int);
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, MaximumSamples, int);
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, TimeStepCacheBytes, vtkIdType);
tetraluxSetNumberMacro(vtkTetrahedraIsosurfaceMapper, MaximumNumberOfPeels, int);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  os << indent << "ColorArrayName: " << (this->ColorArrayName ? this->ColorArrayName : "(none)")
     << "\n";
  printer.Print("ColorArrayComponent", this->ColorArrayComponent);
  printer.Print("Shadows", this->Shadows);
  printer.Print("ShadowSoftness", this->ShadowSoftness);
  printer.Print("AmbientOcclusion", this->AmbientOcclusion);
  printer.Print("AmbientOcclusionRadius", this->AmbientOcclusionRadius);
  printer.Print("SamplesPerFrame", this->SamplesPerFrame);
  printer.Print("MaximumSamples", this->MaximumSamples);
  printer.Print("TimeStepCacheBytes", this->TimeStepCacheBytes);
  printer.Print("MaximumNumberOfPeels", this->MaximumNumberOfPeels);
}
