// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraVolumeMapper.h"

#include "Base/Stopwatch.h"
#include "Frame/MapperFrame.h"
#include "Frame/RendererLights.h"
#include "Intake/DataSetBlocks.h"
#include "Preparation/ScenePreparation.h"
#include "Preparation/SceneReport.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "Report/Json.h"
#include "Report/OnceWarning.h"
#include "Walk/WalkMesh.h"

#include "Intake/TetrahedraIntake.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGridBase.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>

using tetralux::Json;
using tetralux::MapperFrame;

namespace
{

/// No picture in single precision is expected to be better: the header says so.
constexpr double SmallestMaximumError = 1e-6;

/// Frames that are to take less than this belong to an interaction, seconds.
constexpr double InteractiveSeconds = 1;

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
  {
  }

  /// Throws what the stages throw.
  void DrawFrame(vtkRenderer* renderer, vtkVolume* volume);

  /// Empties what the last frame left, where the next one fails.
  void Clear();

  /// One error for each cause: not again until a frame succeeds.
  void ReportOnce(const std::string& error);

  vtkTetrahedraVolumeMapper* Self;
  tetralux::ScenePreparation Preparation;
  vtkNew<vtkImageData> Image;
  std::function<void(vtkImageData*)> ReadPicture; ///< into Image; empty: it is there
  double ErrorEstimate = 0;
  std::string Statistics = "{}";
  std::string LastError;
  tetralux::OnceWarning ReentryWarning;

private:
  tetralux::MapperSettings MakeSettings() const;
  void WriteStatistics(MapperFrame& frame, double seconds);
  void WarnOfError(const MapperFrame& frame);

  tetralux::OnceWarning ErrorWarning;
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::DrawFrame(vtkRenderer* renderer, vtkVolume* volume)
{
  const tetralux::Stopwatch stopwatch;
  this->ReadPicture = nullptr;
  const tetralux::MapperSettings settings = this->MakeSettings();
  MapperFrame frame;
  frame.Settings = settings.Frame;
  frame.MaximumError = settings.MaximumError;
  frame.Renderer = renderer;
  frame.Volume = volume;
  frame.Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!frame.Window)
  {
    throw std::invalid_argument("the renderer has no OpenGL render window");
  }
  const auto report = [&](unsigned long event, double fraction)
  {
    this->Self->InvokeEvent(event, &fraction);
    return !frame.Window->CheckAbortStatus();
  };
  tetralux::SceneInput input;
  input.Data = this->Self->GetDataObjectInput();
  input.Property = volume->GetProperty();
  input.Matrix = volume->GetMatrix();
  input.Interactive = volume->GetAllocatedRenderTime() < InteractiveSeconds;
  if (volume->GetProperty()->GetShade(0))
  {
    frame.Lights = tetralux::GetRendererLights(renderer);
    frame.Surface = tetralux::GetMaterial(volume->GetProperty());
    input.LightVaries = tetralux::FindLighting(true, frame.Settings.SmoothShading, frame.Lights) ==
      tetralux::Lighting::Varying;
  }
  const bool ready = this->Preparation.Update(
    settings, input, [&](double fraction) { return report(vtkCommand::ProgressEvent, fraction); });
  frame.Progress = [&](double fraction)
  { return report(vtkCommand::VolumeMapperRenderProgressEvent, fraction); };
  frame.Scene = &this->Preparation.Scene;
  frame.Image = this->Image;
  if (ready)
  {
    frame.Shaded = this->Preparation.IsShaded(volume->GetProperty());
    this->Self->DrawFrame(frame);
    this->ReadPicture = frame.ReadPicture;
  }
  else
  {
    this->Image->Initialize();
    frame.Aborted = true;
  }
  if (frame.Scene->Mesh.GetMesh())
  {
    this->WriteStatistics(frame, stopwatch.GetSeconds());
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
  vtkPlaneCollection* planes = self->GetClippingPlanes();
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    vtkPlane* plane = planes->GetItem(i);
    const double* normal = plane->GetNormal();
    frame.ClippingPlanes.push_back(
      { normal[0], normal[1], normal[2], -vtkMath::Dot(normal, plane->GetOrigin()) });
  }
  frame.Cropping = self->Cropping != 0;
  self->GetCroppingRegionPlanes(frame.CroppingRegionPlanes);
  frame.CroppingRegionFlags = static_cast<std::uint32_t>(self->CroppingRegionFlags);
  self->AddSettings(settings);
  return settings;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::WriteStatistics(MapperFrame& frame, double seconds)
{
  const tetralux::VolumeScene& scene = *frame.Scene;

  Json times;
  DescribeSeconds(this->Preparation, times);
  for (const auto& [name, value] : frame.Seconds)
  {
    times[name] = value;
  }
  times["frame"] = seconds;

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
  this->ErrorEstimate = 0;
  for (const auto& [name, value] : frame.Errors)
  {
    this->ErrorEstimate += value;
  }
  Json budget;
  budget["transfer_function"] = frame.Budget.Functions;
  budget["geometry"] = frame.Budget.Geometry;
  budget["rounding"] = frame.Budget.Rounding;
  budget["early_termination"] = frame.Budget.Termination;
  budget["table"] = frame.Budget.Table;
  budget["buffer"] = frame.Budget.Buffer;
  budget["light"] = frame.Budget.Light;
  Json error;
  error["maximum"] = this->Self->MaximumError;
  error["budget"] = budget;
  error["estimate"] = this->ErrorEstimate;
  for (const auto& [name, value] : frame.Errors)
  {
    error[name] = value;
  }

  const bool cellData = scene.Mesh.HasCellScalars();
  frame.ReportOmission(frame.Settings.ClippingPlanes.empty(), "clipping planes", "there are none");
  frame.ReportOmission(!frame.Settings.Cropping, "cropping", "it is off");
  frame.ReportOmission(!frame.Opaque, "opaque geometry", "nothing opaque was drawn before");
  frame.ReportOmission(frame.Scene->Optics.GetFunctionError() == 0, "subdivided transfer function",
    "it is piecewise linear");
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
    frame.Volume->GetProperty()->GetShade(0) ? "it needs a gradient, and composite or isosurface "
                                               "blending"
                                             : "Shade is off");

  Json statistics;
  statistics["method"] = frame.Method;
  statistics["aborted"] = frame.Aborted;
  statistics["rebuilt"] = this->Preparation.GetLast().Rebuilt;
  statistics["seconds"] = times;
  statistics["input"] = DescribeInput(this->Preparation);
  statistics["tables"] = DescribeTables(this->Preparation);
  statistics["segments"] = DescribeSegments(this->Preparation, frame.Integration);
  for (const auto& [name, section] : frame.Sections)
  {
    statistics[name] = section;
  }
  statistics["error"] = error;
  statistics["left_out"] = frame.LeftOut;
  this->Statistics = statistics.dump(2);
  this->WarnOfError(frame);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::WarnOfError(const MapperFrame& frame)
{
  const double asked = this->Self->MaximumError;
  if (frame.Aborted || this->Self->IsMaximumErrorKept())
  {
    this->ErrorWarning.Update(this->Self, "");
    return;
  }
  const auto largest = std::max_element(frame.Errors.begin(), frame.Errors.end(),
    [](const auto& a, const auto& b) { return a.second < b.second; });
  std::ostringstream warning;
  warning << "the estimated error " << this->ErrorEstimate << " is above the MaximumError " << asked
          << ": " << largest->second << " of it by '" << largest->first << "'";
  this->ErrorWarning.Update(this->Self, warning.str(), largest->first);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::Clear()
{
  this->ReadPicture = nullptr;
  this->Image->Initialize();
  this->ErrorEstimate = 0;
  this->Statistics = "{}";
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::ReportOnce(const std::string& error)
{
  if (error != this->LastError)
  {
    this->LastError = error;
    vtkErrorWithObjectMacro(this->Self, << error);
  }
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
  const tetralux::Stopwatch stopwatch;
  this->InvokeEvent(vtkCommand::VolumeMapperRenderStartEvent);
  std::string error;
  try
  {
    this->GetInputAlgorithm()->Update();
    this->Private->DrawFrame(renderer, volume);
    this->Private->LastError.clear();
  }
  catch (const std::bad_alloc&)
  {
    error = "there is not enough memory";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  if (!error.empty())
  {
    this->Private->Clear();
    this->Private->ReportOnce(error);
  }
  this->TimeToDraw = stopwatch.GetSeconds();
  this->InvokeEvent(vtkCommand::VolumeMapperRenderEndEvent);
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
  return this->Bounds;
}

//------------------------------------------------------------------------------------------------
vtkImageData* vtkTetrahedraVolumeMapper::GetOutputImage()
{
  if (this->Private->ReadPicture)
  {
    // Moved out first: a failing read is not tried again.
    const auto read = std::move(this->Private->ReadPicture);
    this->Private->ReadPicture = nullptr;
    try
    {
      read(this->Private->Image);
    }
    catch (const std::exception& exception)
    {
      this->Private->Image->Initialize();
      vtkErrorMacro(<< exception.what());
    }
  }
  return this->Private->Image;
}

//------------------------------------------------------------------------------------------------
std::string vtkTetrahedraVolumeMapper::GetStatistics() { return this->Private->Statistics; }

//------------------------------------------------------------------------------------------------
double vtkTetrahedraVolumeMapper::GetErrorEstimate() { return this->Private->ErrorEstimate; }

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraVolumeMapper::IsMaximumErrorKept()
{
  return this->MaximumError < SmallestMaximumError ||
    this->Private->ErrorEstimate <= this->MaximumError;
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
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::PrintResults(ostream& os, vtkIndent indent)
{
  os << indent << "ErrorEstimate: " << this->GetErrorEstimate() << "\n"
     << indent << "NumberOfSkippedCells: " << this->GetNumberOfSkippedCells() << "\n"
     << indent << "NumberOfRemovedCells: " << this->GetNumberOfRemovedCells() << "\n"
     << indent << "NumberOfBlankCells: " << this->GetNumberOfBlankCells() << "\n"
     << indent << "Statistics:\n";
  std::istringstream lines(this->GetStatistics());
  for (std::string line; std::getline(lines, line);)
  {
    os << indent.GetNextIndent() << line << "\n";
  }
}
