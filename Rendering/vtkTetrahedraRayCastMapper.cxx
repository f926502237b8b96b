// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "Frame/MapperFrame.h"
#include "Frame/PictureTask.h"
#include "Preparation/MapperSettings.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "RayCast/RayCaster.h"
#include "View/MeshToWorld.h"

#include "vtkObjectFactory.h"

using tetralux::Json;
using tetralux::MapperFrame;

namespace
{

void Describe(
  const tetralux::RayCastStatistics& rays, const tetralux::PictureTask& picture, MapperFrame& frame)
{
  Json section;
  section["width"] = picture.Grid.Width;
  section["height"] = picture.Grid.Height;
  section["sample_distance"] = picture.SampleDistance;
  section["rays"] = rays.Rays;
  section["segments"] = rays.Segments;
  section["paths"] = rays.Paths;
  section["reentry"] = rays.ImaginaryCells ? "imaginary cells" : "boundary hierarchy";
  section["transparent_tetrahedra_left_out"] = rays.TransparentCells;
  section["lane_use"] = rays.LaneUse;
  section["boundary"] = rays.BoundaryTiles ? "tiles" : "hierarchy";
  section["rays_in_double_precision"] = rays.DoubleRays;
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
vtkStandardNewMacro(vtkTetrahedraRayCastMapper);

//------------------------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::AddSettings(tetralux::MapperSettings& settings)
{
  settings.DrawsComponents = true;
}

//------------------------------------------------------------------------------------------------
tetralux::PixelRectangle vtkTetrahedraRayCastMapper::MakePicture(
  MapperFrame& frame, const tetralux::PictureTask& picture)
{
  frame.Method = "ray-cast";
  tetralux::VolumeScene::CheckWorldRadius(frame.Scene->Mesh.GetMesh()->GetRadius() *
    tetralux::MeasureMeshToWorld(picture.Grid.MeshFromWorld).Largest);
  tetralux::RayCastOptions options;
  options.MaximumError = frame.MaximumError;
  options.NumberOfThreads = this->NumberOfThreads;
  options.Arithmetic = this->Precision == SINGLE_PRECISION ? tetralux::Precision::Single
    : this->Precision == DOUBLE_PRECISION                  ? tetralux::Precision::Double
                                                           : tetralux::Precision::Automatic;
  options.ReentryBy = this->Reentry == IMAGINARY_CELLS_REENTRY ? tetralux::Reentry::Imaginary
                                                               : tetralux::Reentry::Boundary;
  options.Shaded = frame.Shaded;
  options.SmoothShading = frame.Settings.SmoothShading;
  options.Lights = frame.Lights;
  options.Surface = frame.Surface;
  options.Progress = [&frame](double fraction) { return frame.ReportProgress(fraction); };
  const tetralux::RayCastStatistics statistics =
    CastRays(*frame.Scene, picture.Grid, picture.Limits, options, picture.Colors, picture.Depths);
  frame.Integration = statistics.Integration;
  frame.Aborted = statistics.Aborted;
  Describe(statistics, picture, frame);
  this->WarnOfReentry(*frame.Scene->Mesh.GetMesh());
  return frame.Aborted ? tetralux::PixelRectangle() : FindCovered(picture);
}

//------------------------------------------------------------------------------------------------
tetraluxEnumerationMacro(vtkTetrahedraRayCastMapper, Precision);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("Precision", this->Precision);
}
