// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/ImageCompositor.h"
#include "Frame/MapperFrame.h"
#include "Frame/OpaqueDistances.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "RayCast/RayCaster.h"
#include "View/MeshToWorld.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using tetralux::CameraRays;
using tetralux::Json;
using tetralux::MapperFrame;

namespace
{

void Describe(const tetralux::RayCastStatistics& rays, const tetralux::RayGrid& grid,
  double sampleDistance, MapperFrame& frame)
{
  Json section;
  section["width"] = grid.Width;
  section["height"] = grid.Height;
  section["sample_distance"] = sampleDistance;
  section["rays"] = rays.Rays;
  section["segments"] = rays.Segments;
  section["paths"] = rays.Paths;
  section["reentry"] = rays.ImaginaryCells ? "imaginary cells" : "boundary hierarchy";
  section["transparent_tetrahedra_left_out"] = rays.TransparentCells;
  section["lane_use"] = rays.LaneUse;
  section["precision"] = rays.DoublePrecision ? "double" : "single";
  section["instruction_set"] = rays.InstructionSet;
  section["threads"] = rays.NumberOfThreads;
  frame.Sections.emplace_back("rays", section);

  frame.Budget = rays.Budget;
  frame.Brightness = rays.Brightness;
  frame.Errors = { { "early_termination", rays.TerminationError },
    { "integrals", rays.IntegralError }, { "summation", rays.SummationError },
    { "table", rays.TableError }, { "geometry", rays.GeometryError } };

  frame.ReportOmission(
    !rays.DoublePrecision, "double precision", "single precision is right enough");
  frame.ReportOmission(
    rays.TransparentCells > 0, "transparent tetrahedra", "nothing of them is seen");
  frame.ReportOmission(!rays.ImaginaryCells, "imaginary cells", "rays enter by the boundary");
}

} // namespace

//------------------------------------------------------------------------------------------------
class vtkTetrahedraRayCastMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraRayCastMapper* self)
    : Self(self)
  {
  }

  void DrawFrame(MapperFrame& frame);

  tetralux::ImageCompositor Compositor;

private:
  double ChooseSampleDistance(const MapperFrame& frame) const;
  tetralux::RayCastOptions MakeOptions(const MapperFrame& frame) const;

  vtkTetrahedraRayCastMapper* Self;
  double SecondsPerRay = 0; ///< of the last frame that was cast; 0: none yet
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::DrawFrame(MapperFrame& frame)
{
  frame.Method = "ray-cast";
  const double sampleDistance = this->ChooseSampleDistance(frame);
  const CameraRays rays(frame.Renderer, sampleDistance);
  if (rays.GetVisible().Width == 0)
  {
    frame.Image->Initialize(); // a tile that shows nothing of the viewport
    return;
  }
  const tetralux::RayGrid grid = frame.MakeGrid(rays);
  tetralux::VolumeScene::CheckWorldRadius(frame.Scene->Mesh.GetMesh()->GetRadius() *
    tetralux::MeasureMeshToWorld(grid.MeshFromWorld).Largest);
  tetralux::RayLimits limits = frame.MakeLimits(rays);
  std::vector<float> opaqueDistances;
  if (frame.HasOpaqueGeometry())
  {
    const tetralux::Stopwatch stopwatch;
    opaqueDistances = tetralux::ReadOpaqueDistances(frame.Renderer, rays);
    frame.Seconds.emplace_back("depth_buffer", stopwatch.GetSeconds());
  }
  frame.Opaque = !opaqueDistances.empty();
  limits.MaximumDistances = opaqueDistances.empty() ? nullptr : opaqueDistances.data();

  const tetralux::Stopwatch castStopwatch;
  tetralux::Span<float> colors, depths;
  MapperFrame::PrepareImage(frame.Image, grid.Width, grid.Height, colors, depths);
  const tetralux::RayCastStatistics statistics =
    CastRays(*frame.Scene, grid, limits, this->MakeOptions(frame), colors, depths);
  const double seconds = castStopwatch.GetSeconds();
  frame.Seconds.emplace_back("cast", seconds);
  frame.Integration = statistics.Integration;
  frame.Aborted = statistics.Aborted;
  Describe(statistics, grid, sampleDistance, frame);
  this->Self->WarnOfReentry(*frame.Scene->Mesh.GetMesh());
  if (frame.Aborted)
  {
    return;
  }
  this->SecondsPerRay = seconds / (static_cast<double>(grid.Width) * grid.Height);

  if (statistics.Paths > 0) // else there is nothing in the picture
  {
    const tetralux::Stopwatch stopwatch;
    this->Compositor.Composite(
      frame.Window, rays.GetVisible(), colors.data(), grid.Width, grid.Height);
    frame.Seconds.emplace_back("composite", stopwatch.GetSeconds());
  }
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraRayCastMapper::Internals::ChooseSampleDistance(const MapperFrame& frame) const
{
  if (!this->Self->AutoAdjustSampleDistances)
  {
    return this->Self->ImageSampleDistance;
  }
  int width, height;
  frame.Renderer->GetTiledSize(&width, &height);
  const double fullSeconds = this->SecondsPerRay * width * height;
  const double distance = std::sqrt(fullSeconds / frame.Volume->GetAllocatedRenderTime());
  return std::max<double>(std::min<double>(distance, this->Self->MaximumImageSampleDistance),
    this->Self->MinimumImageSampleDistance);
}

//------------------------------------------------------------------------------------------------
tetralux::RayCastOptions vtkTetrahedraRayCastMapper::Internals::MakeOptions(
  const MapperFrame& frame) const
{
  tetralux::RayCastOptions options;
  options.MaximumError = frame.MaximumError;
  options.NumberOfThreads = this->Self->NumberOfThreads;
  options.Arithmetic = this->Self->Precision == SINGLE_PRECISION ? tetralux::Precision::Single
    : this->Self->Precision == DOUBLE_PRECISION                  ? tetralux::Precision::Double
                                                                 : tetralux::Precision::Automatic;
  options.ReentryBy = this->Self->Reentry == IMAGINARY_CELLS_REENTRY ? tetralux::Reentry::Imaginary
                                                                     : tetralux::Reentry::Boundary;
  options.Shaded = frame.Shaded;
  options.SmoothShading = frame.Settings.SmoothShading;
  options.Lights = frame.Lights;
  options.Surface = frame.Surface;
  options.Progress = [&frame](double fraction) { return frame.ReportProgress(fraction); };
  return options;
}

//------------------------------------------------------------------------------------------------
vtkStandardNewMacro(vtkTetrahedraRayCastMapper);

//------------------------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::vtkTetrahedraRayCastMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::DrawFrame(MapperFrame& frame) { this->Private->DrawFrame(frame); }

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Private->Compositor.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
tetraluxSetNumberMacro(vtkTetrahedraRayCastMapper, NumberOfThreads, int);
tetraluxEnumerationMacro(vtkTetrahedraRayCastMapper, Precision);
tetraluxSetNumberMacro(vtkTetrahedraRayCastMapper, ImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraRayCastMapper, MinimumImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraRayCastMapper, MaximumImageSampleDistance, float);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("NumberOfThreads", this->NumberOfThreads);
  printer.Print("Precision", this->Precision);
  printer.Print("ImageSampleDistance", this->ImageSampleDistance);
  printer.Print("MinimumImageSampleDistance", this->MinimumImageSampleDistance);
  printer.Print("MaximumImageSampleDistance", this->MaximumImageSampleDistance);
  printer.Print("AutoAdjustSampleDistances", this->AutoAdjustSampleDistances);
}
