// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraVolumeMapper.h"

#include "Base/FreeMemory.h"
#include "Base/Stopwatch.h"
#include "Frame/FrameRecord.h"
#include "Frame/MapperFrame.h"
#include "Frame/RayPace.h"
#include "Frame/RendererLights.h"
#include "Intake/DataSetBlocks.h"
#include "OpenGL/EnteredContext.h"
#include "OpenGL/GraphicsCard.h"
#include "Optics/LightKey.h"
#include "Preparation/ScenePreparation.h"
#include "Preparation/SceneReport.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "Report/Json.h"
#include "Report/OnceWarning.h"
#include "Report/PeakMemory.h"
#include "Walk/WalkMesh.h"

#include "Intake/TetrahedraIntake.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGridBase.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

using tetralux::Json;
using tetralux::MapperFrame;

namespace
{

tetralux::OpticalModel GetOpticalModel(int blendMode)
{
  switch (blendMode)
  {
    case vtkTetrahedraVolumeMapper::MAXIMUM_INTENSITY_BLEND:
      return tetralux::OpticalModel::MaximumIntensity;
    case vtkTetrahedraVolumeMapper::ADDITIVE_BLEND:
      return tetralux::OpticalModel::EmissionOnly;
    case vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND:
      return tetralux::OpticalModel::Isosurfaces;
    case vtkTetrahedraVolumeMapper::ABSORPTION_BLEND:
      return tetralux::OpticalModel::AbsorptionOnly;
    default: // SetBlendMode refuses all others
      return tetralux::OpticalModel::EmissionAbsorption;
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
// The stages of a frame, what they keep and what they report.
class vtkTetrahedraVolumeMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraVolumeMapper* self)
    : Self(self)
    , Preparation(self)
    , Record(self)
  {
  }

  /// Throws what the stages throw.
  void DrawFrame(MapperFrame& frame);

  vtkTetrahedraVolumeMapper* Self;
  tetralux::ScenePreparation Preparation;
  tetralux::FrameRecord Record;
  tetralux::OnceWarning ReentryWarning;
  std::set<std::string> UnusedCalls; ///< that there was a warning of
  std::string SupportReason;

private:
  tetralux::MapperSettings MakeSettings() const;
  void AddSceneToKey(MapperFrame& frame) const;
  void WriteStatistics(MapperFrame& frame, double frameSeconds);

  void DescribeMemory(const MapperFrame& frame, Json& sections);

  std::int64_t PeakBeforeFrame = 0;                 ///< of the process's memory, bytes
  std::map<std::string, std::int64_t> LargestParts; ///< bytes that each part has held at most
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::DrawFrame(MapperFrame& frame)
{
  const tetralux::Stopwatch stopwatch;
  const tetralux::MapperSettings settings = this->MakeSettings();
  // Of now: what an observer changes later is for the next frame.
  frame.Key.Add(this->Self->GetMTime());
  frame.Key.Add(frame.Property);
  frame.Key.Add(frame.Property->GetMTime());
  frame.Settings = settings.Frame;
  frame.MaximumError = settings.MaximumError;
  tetralux::SceneInput input;
  input.Data = this->Self->GetDataObjectInput();
  input.Property = frame.Property;
  input.Matrix = frame.Volume->GetMatrix();
  input.Interactive = frame.IsInteractive();
  if (frame.Property->GetShade(0))
  {
    frame.Lights = tetralux::GetRendererLights(frame.Renderer);
    frame.Surface = tetralux::GetMaterial(frame.Property);
    input.LightVaries = tetralux::FindLighting(true, frame.Settings.SmoothShading, frame.Lights) ==
      tetralux::Lighting::Varying;
    input.Lights = &frame.Lights;
    input.Surface = &frame.Surface;
  }
  this->PeakBeforeFrame = tetralux::GetPeakMemory();
  const bool ready = this->Preparation.Update(settings, input,
    [&](double fraction)
    { return this->Record.ReportProgress(frame.Window, vtkCommand::ProgressEvent, fraction); });
  const std::vector<std::string>& rebuilt = this->Preparation.GetLast().Rebuilt;
  const bool madeMesh = std::find(rebuilt.begin(), rebuilt.end(), "mesh") != rebuilt.end();
  if (madeMesh)
  {
    tetralux::ReturnFreeMemory();
  }
  frame.Scene = &this->Preparation.Scene;
  if (ready)
  {
    frame.Shaded = this->Preparation.IsShaded(frame.Property);
    this->AddSceneToKey(frame);
    this->Self->DrawFrame(frame);
  }
  else
  {
    frame.Aborted = true;
  }
  if (madeMesh)
  {
    tetralux::ReturnFreeMemory(); // what drawing it for the first time took
  }
  if (frame.Scene->Mesh.GetMesh())
  {
    this->WriteStatistics(frame, stopwatch.GetSeconds());
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::AddSceneToKey(MapperFrame& frame) const
{
  const tetralux::MeshScene& mesh = frame.Scene->Mesh;
  const tetralux::SceneOptics& optics = frame.Scene->Optics;
  for (const std::uint64_t version : { mesh.GetCellsVersion(), mesh.GetPointsVersion(),
         mesh.GetScalarsVersion(), mesh.GetColorScalarsVersion(), optics.GetFunctionVersion(),
         optics.GetSurfacesVersion(), optics.GetTableVersion() })
  {
    frame.Key.Add(version);
  }
  frame.Key.Add(frame.Shaded);
  if (frame.Shaded)
  {
    tetralux::AddLightsTo(frame.Key, frame.Lights);
    tetralux::AddMaterialTo(frame.Key, frame.Surface);
  }
}

//------------------------------------------------------------------------------------------------
tetralux::MapperSettings vtkTetrahedraVolumeMapper::Internals::MakeSettings() const
{
  vtkTetrahedraVolumeMapper* self = this->Self;
  tetralux::MapperSettings settings;
  settings.MaximumError = self->MaximumError;
  settings.Model = GetOpticalModel(self->BlendMode);

  tetralux::ScalarSelection& scalars = settings.Scalars;
  scalars.ScalarMode = self->GetScalarMode();
  scalars.ArrayAccessMode = self->GetArrayAccessMode();
  scalars.ArrayId = self->GetArrayId();
  scalars.ArrayName = self->GetArrayName() ? self->GetArrayName() : "";
  scalars.VectorMode = self->VectorMode;
  scalars.VectorComponent = self->VectorComponent;

  settings.Merging = self->MergePoints == MERGE_OFF ? tetralux::PointMerging::Never
    : self->MergePoints == MERGE_ON                 ? tetralux::PointMerging::Always
                                                    : tetralux::PointMerging::Automatic;

  tetralux::TableWishes& table = settings.Table;
  table.Use = self->Integration == CLOSED_FORM_INTEGRATION ? tetralux::TableUse::Never
    : self->Integration == TABLE_INTEGRATION               ? tetralux::TableUse::Always
                                                           : tetralux::TableUse::Automatic;
  table.ScalarSize = self->TableScalarSize;
  table.LengthSize = self->TableLengthSize;
  table.MaximumBytes = static_cast<std::size_t>(self->TableMaximumBytes);
  if (self->TableLengthScale != AUTOMATIC_SCALE)
  {
    table.Scale = self->TableLengthScale == LINEAR_SCALE ? tetralux::LengthScale::Linear
                                                         : tetralux::LengthScale::Logarithmic;
  }
  if (self->TableScalarAxis != AUTOMATIC_AXIS)
  {
    table.Axis = self->TableScalarAxis == UNIFORM_AXIS ? tetralux::ScalarAxis::Uniform
                                                       : tetralux::ScalarAxis::Nodes;
  }
  if (self->TableFormat != AUTOMATIC_FORMAT)
  {
    table.Format = static_cast<tetralux::TexelFormat>(self->TableFormat - UNORM8_FORMAT);
  }

  tetralux::FrameSettings& frame = settings.Frame;
  frame.IntermixIntersectingGeometry = self->IntermixIntersectingGeometry != 0;
  frame.SmoothShading = self->SmoothShading != 0;
  frame.ClippingPlanes = tetralux::GetClippingPlanes(self);
  frame.Cropping = self->Cropping != 0;
  self->GetCroppingRegionPlanes(frame.CroppingRegionPlanes);
  frame.CroppingRegionFlags = static_cast<std::uint32_t>(self->CroppingRegionFlags);
  self->AddSettings(settings);
  return settings;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::WriteStatistics(MapperFrame& frame, double frameSeconds)
{
  const tetralux::VolumeScene& scene = *frame.Scene;

  for (auto& [name, value] : frame.Errors)
  {
    // What is behind a ray's end counts by the brightness already.
    value *= name == "early_termination" ? 1 : frame.Brightness;
  }
  frame.Errors.emplace_back("light",
    frame.Integration == tetralux::Integrator::VaryingLight
      ? tetralux::FindLightSteps(frame.Lights, frame.Surface, frame.Budget.Light).Error
      : 0);
  frame.Errors.emplace_back("transfer_function", frame.Scene->Optics.GetFunctionError());

  const bool cellData = scene.Mesh.HasCellScalars();
  frame.ReportOmission(frame.Scene->Optics.GetFunctionError() == 0,
    "approximated transfer function", "each of its intervals is exact");
  frame.ReportOmission(cellData, "scalars varying in cells", "the array is of cells");
  frame.ReportOmission(!cellData, "constant cells", "the array is of points");
  frame.ReportOmission(frame.Integration == tetralux::Integrator::OpticalDepth,
    "colours along rays",
    scene.Optics.GetModel() == tetralux::OpticalModel::AbsorptionOnly
      ? "absorption has none"
      : "all that is visible has one colour");
  frame.ReportOmission(!scene.Optics.GetTable(), "table",
    scene.GetPlan().ConstantColor ? "one colour needs none"
      : frame.Integration == tetralux::Integrator::VaryingLight
      ? "light varies in cells, and a table does not tell where in a cell its light comes from"
      : "see segments");
  frame.ReportOmission(!frame.Shaded, "shading",
    frame.Property->GetShade(0) ? "it needs a gradient, and composite or isosurface "
                                  "blending"
                                : "Shade is off");

  Json seconds;
  DescribeSeconds(this->Preparation, seconds);
  Json sections;
  sections["input"] = DescribeInput(this->Preparation);
  sections["tables"] = DescribeTables(this->Preparation);
  this->DescribeMemory(frame, sections);
  sections["segments"] = DescribeSegments(this->Preparation, frame.Integration);
  this->Record.Write(frame, this->Preparation.GetLast().Rebuilt, seconds, frameSeconds, sections);
}

//------------------------------------------------------------------------------------------------
/// What each part holds and has held at most, and the peak of the process by the end of each stage.
void vtkTetrahedraVolumeMapper::Internals::DescribeMemory(const MapperFrame& frame, Json& sections)
{
  Json& memory = sections["memory"];
  memory = tetralux::DescribeMemory(this->Preparation);
  for (const auto& [name, bytes] : frame.Memory)
  {
    memory[name] = bytes;
  }
  Json& largest = sections["memory_peaks"];
  for (const auto& [name, bytes] : memory.items())
  {
    std::int64_t& peak = this->LargestParts[name];
    peak = std::max(peak, bytes.get<std::int64_t>());
    largest[name] = peak;
  }
  Json& process = sections["process_peaks"];
  process["before_frame"] = this->PeakBeforeFrame;
  for (const auto& [stage, bytes] : this->Preparation.GetLast().Peaks)
  {
    process[stage] = bytes;
  }
  process["frame"] = tetralux::GetPeakMemory();
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraVolumeMapper::vtkTetrahedraVolumeMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraVolumeMapper::~vtkTetrahedraVolumeMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
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
void vtkTetrahedraVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Private->Record.MayRelease(window))
  {
    this->ReleaseResources(window);
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetInputData(vtkUnstructuredGridBase* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetInputData(vtkDataSet* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetInputData(vtkDataObject* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------------------------
int vtkTetrahedraVolumeMapper::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------------------------
double* vtkTetrahedraVolumeMapper::GetBounds()
{
  // Who observes the update may let the mapper go.
  const vtkSmartPointer<vtkObject> self = this;
  vtkBoundingBox box;
  if (this->GetDataObjectInput())
  {
    this->Update();
    for (const auto& block : tetralux::CollectDataSets(this->GetDataObjectInput()))
    {
      box.AddBounds(block.DataSet->GetBounds());
    }
  }
  if (box.IsValid())
  {
    box.GetBounds(this->Bounds);
  }
  else
  {
    vtkMath::UninitializeBounds(this->Bounds);
  }
  return self->GetReferenceCount() > 1 ? this->Bounds : nullptr;
}

//------------------------------------------------------------------------------------------------
vtkImageData* vtkTetrahedraVolumeMapper::GetOutputImage()
{
  return this->Private->Record.GetPicture();
}

//------------------------------------------------------------------------------------------------
std::string vtkTetrahedraVolumeMapper::GetStatistics()
{
  return this->Private->Record.GetStatistics();
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraVolumeMapper::GetErrorEstimate()
{
  return this->Private->Record.GetErrorEstimate();
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraVolumeMapper::IsMaximumErrorKept()
{
  return this->Private->Record.IsErrorKept(this->MaximumError);
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraVolumeMapper::IsSupported(vtkRenderWindow* window)
{
  auto* openGL = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!openGL)
  {
    this->SetSupportReason("the window is not one of OpenGL");
    return false;
  }
  openGL->Initialize();
  const tetralux::EnteredContext context(openGL);
  const tetralux::GraphicsCard card = tetralux::DescribeGraphicsCard(openGL);
  this->SetSupportReason(card.Renderer);
  if (std::make_pair(card.Version[0], card.Version[1]) < std::make_pair(3, 2))
  {
    this->SetSupportReason(card.Renderer + " has OpenGL " + std::to_string(card.Version[0]) + '.' +
      std::to_string(card.Version[1]) + ", and 3.2 is needed");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------------------------
std::string vtkTetrahedraVolumeMapper::GetSupportReason() { return this->Private->SupportReason; }

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetSupportReason(const std::string& reason)
{
  this->Private->SupportReason = reason;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetRayCastFunction(
  vtkUnstructuredGridVolumeRayCastFunction* function)
{
  if (function)
  {
    this->WarnOfCall("RayCastFunction", "rays go from cell to cell");
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetRayIntegrator(vtkUnstructuredGridVolumeRayIntegrator* integrator)
{
  if (integrator)
  {
    this->WarnOfCall("RayIntegrator", "segments are integrated as Integration says");
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::WarnOfCall(const std::string& property, const std::string& reason)
{
  if (this->Private->UnusedCalls.insert(property).second)
  {
    vtkWarningMacro(<< property << " is not used: " << reason);
  }
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumeMapper::GetNumberOfSkippedCells()
{
  return this->Private->Preparation.Intake.GetNumberOfSkippedCells();
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumeMapper::GetNumberOfRemovedCells()
{
  const tetralux::WalkMesh* mesh = this->Private->Preparation.Scene.Mesh.GetMesh();
  return mesh ? mesh->GetRemovedCells().Total() : 0;
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumeMapper::GetNumberOfBlankCells()
{
  return this->Private->Preparation.Scene.Mesh.GetNumberOfBlankCells();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::WarnOfReentry(const tetralux::WalkMesh& mesh)
{
  const tetralux::Convexification* convex = mesh.GetConvexification();
  const bool refused =
    this->Reentry == IMAGINARY_CELLS_REENTRY && convex && !convex->Refusal.empty();
  this->Private->ReentryWarning.Update(this,
    refused ? "the mesh can't be made convex, rays enter it by its boundary: " + convex->Refusal
            : "");
}

//------------------------------------------------------------------------------------------------
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, BlendMode);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, MaximumError, double);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, Integration);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, TableScalarSize, int);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, TableLengthSize, int);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, TableLengthScale);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, TableScalarAxis);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, TableFormat);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, TableMaximumBytes, vtkIdType);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, MergePoints);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, VectorMode);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, VectorComponent, int);
tetraluxEnumerationMacro(vtkTetrahedraVolumeMapper, Reentry);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, CroppingRegionFlags, int);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, ImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, MinimumImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraVolumeMapper, MaximumImageSampleDistance, float);

//------------------------------------------------------------------------------------------------
tetralux::RayDistances vtkTetrahedraVolumeMapper::GetRayDistances() const
{
  tetralux::RayDistances distances;
  distances.Automatic = this->AutoAdjustSampleDistances != 0;
  distances.Fixed = this->ImageSampleDistance;
  distances.Minimum = this->MinimumImageSampleDistance;
  distances.Maximum = this->MaximumImageSampleDistance;
  return distances;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetCroppingRegionPlanes(
  double xMin, double xMax, double yMin, double yMax, double zMin, double zMax)
{
  const double planes[6] = { xMin, xMax, yMin, yMax, zMin, zMax };
  this->SetCroppingRegionPlanes(planes);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::SetCroppingRegionPlanes(const double planes[6])
{
  if (std::any_of(planes, planes + 6, [](double plane) { return std::isnan(plane); }))
  {
    vtkErrorMacro("CroppingRegionPlanes: nan is not a place of a plane");
    return;
  }
  if (!std::equal(planes, planes + 6, this->CroppingRegionPlanes))
  {
    std::copy_n(planes, 6, this->CroppingRegionPlanes);
    this->Modified();
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  // Not the superclass's, which prints BlendMode as a number.
  // NOLINTNEXTLINE(bugprone-parent-virtual-call)
  this->vtkAbstractVolumeMapper::PrintSelf(os, indent);
  this->PrintProperties(os, indent);
  this->PrintResults(os, indent);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::AddSettings(tetralux::MapperSettings&) {}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("BlendMode", this->BlendMode);
  printer.Print("MaximumError", this->MaximumError);
  printer.Print("Integration", this->Integration);
  printer.Print("TableScalarSize", this->TableScalarSize);
  printer.Print("TableLengthSize", this->TableLengthSize);
  printer.Print("TableLengthScale", this->TableLengthScale);
  printer.Print("TableScalarAxis", this->TableScalarAxis);
  printer.Print("TableFormat", this->TableFormat);
  printer.Print("TableMaximumBytes", this->TableMaximumBytes);
  printer.Print("SmoothShading", this->SmoothShading);
  printer.Print("MergePoints", this->MergePoints);
  printer.Print("VectorMode", this->VectorMode);
  printer.Print("VectorComponent", this->VectorComponent);
  printer.Print("Reentry", this->Reentry);
  printer.Print("IntermixIntersectingGeometry", this->IntermixIntersectingGeometry);
  printer.Print("Cropping", this->Cropping);
  const double* planes = this->CroppingRegionPlanes;
  printer.Print(
    "CroppingRegionPlanes", planes[0], planes[1], planes[2], planes[3], planes[4], planes[5]);
  printer.Print("CroppingRegionFlags", this->CroppingRegionFlags);
  printer.Print("ImageSampleDistance", this->ImageSampleDistance);
  printer.Print("MinimumImageSampleDistance", this->MinimumImageSampleDistance);
  printer.Print("MaximumImageSampleDistance", this->MaximumImageSampleDistance);
  printer.Print("AutoAdjustSampleDistances", this->AutoAdjustSampleDistances);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::PrintResults(ostream& os, vtkIndent indent)
{
  os << indent << "SupportReason: " << this->GetSupportReason() << "\n"
     << indent << "ErrorEstimate: " << this->GetErrorEstimate() << "\n"
     << indent << "NumberOfSkippedCells: " << this->GetNumberOfSkippedCells() << "\n"
     << indent << "NumberOfRemovedCells: " << this->GetNumberOfRemovedCells() << "\n"
     << indent << "NumberOfBlankCells: " << this->GetNumberOfBlankCells() << "\n";
  this->Private->Record.PrintStatistics(os, indent);
}
