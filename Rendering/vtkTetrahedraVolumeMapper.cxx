// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraVolumeMapper.h"

#include "Base/Stopwatch.h"
#include "Frame/MapperFrame.h"
#include "Frame/RendererLights.h"
#include "Preparation/ScenePreparation.h"
#include "Report/JsonObject.h"
#include "Report/OnceWarning.h"

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
#include "vtkRenderer.h"
#include "vtkUnstructuredGridBase.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>

using tetralux::JsonObject;
using tetralux::MapperFrame;

namespace
{

/// No picture in single precision is expected to be better: the header says so.
constexpr double SmallestMaximumError = 1e-6;

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

private:
  void WriteStatistics(MapperFrame& frame, double seconds);
  void WarnOfError(const MapperFrame& frame);

  tetralux::OnceWarning ErrorWarning;
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::DrawFrame(vtkRenderer* renderer, vtkVolume* volume)
{
  const tetralux::Stopwatch stopwatch;
  this->ReadPicture = nullptr;
  MapperFrame frame;
  frame.Mapper = this->Self;
  frame.Renderer = renderer;
  frame.Volume = volume;
  frame.Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!frame.Window)
  {
    throw std::invalid_argument("the renderer has no OpenGL render window");
  }
  const bool ready = this->Preparation.Update(volume,
    [&](double fraction)
    {
      this->Self->InvokeEvent(vtkCommand::ProgressEvent, &fraction);
      return !frame.Window->CheckAbortStatus();
    });
  frame.Scene = &this->Preparation.Scene;
  frame.Image = this->Image;
  if (ready)
  {
    frame.Shaded = this->Preparation.IsShaded(volume->GetProperty());
    if (frame.Shaded)
    {
      frame.Lights = tetralux::GetRendererLights(renderer);
      frame.Surface = tetralux::GetMaterial(volume->GetProperty());
    }
    this->Self->DrawFrame(frame);
    this->ReadPicture = frame.ReadPicture;
  }
  else
  {
    this->Image->Initialize();
    frame.Aborted = true;
  }
  if (frame.Scene->GetMesh())
  {
    this->WriteStatistics(frame, stopwatch.GetSeconds());
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::WriteStatistics(MapperFrame& frame, double seconds)
{
  tetralux::VolumeScene& scene = *frame.Scene;

  JsonObject times;
  this->Preparation.WriteSeconds(times);
  for (const auto& [name, value] : frame.Seconds)
  {
    times.Set(name, value);
  }
  times.Set("frame", seconds);

  frame.Errors.emplace_back("transfer_function", this->Preparation.GetFunctionError());
  this->ErrorEstimate = 0;
  for (const auto& [name, value] : frame.Errors)
  {
    this->ErrorEstimate += value;
  }
  JsonObject error;
  error.Set("maximum", this->Self->MaximumError);
  error.Set("estimate", this->ErrorEstimate);
  for (const auto& [name, value] : frame.Errors)
  {
    error.Set(name, value);
  }

  const bool cellData = scene.HasCellScalars();
  frame.LeaveOut(!frame.Clipped, "clipping planes", "there are none");
  frame.LeaveOut(!this->Self->Cropping, "cropping", "it is off");
  frame.LeaveOut(!frame.Opaque, "opaque geometry", "nothing opaque was drawn before");
  frame.LeaveOut(this->Preparation.GetFunctionError() == 0, "subdivided transfer function",
    "it is piecewise linear");
  frame.LeaveOut(cellData, "scalars varying in cells", "the array is of cells");
  frame.LeaveOut(!cellData, "constant cells", "the array is of points");
  frame.LeaveOut(frame.Integration == "optical depth", "colours along rays",
    scene.GetOpticalModel() == tetralux::OpticalModel::AbsorptionOnly
      ? "absorption has none"
      : "all that is visible has one colour");
  frame.LeaveOut(!scene.GetTable(), "table",
    scene.GetPlan().ConstantColor ? "one colour needs none" : "see segments");
  frame.LeaveOut(!frame.Shaded, "shading",
    frame.Volume->GetProperty()->GetShade(0) ? "it needs a gradient, and composite or isosurface "
                                               "blending"
                                             : "Shade is off");

  JsonObject statistics;
  statistics.Set("method", frame.Method);
  statistics.Set("aborted", frame.Aborted);
  statistics.Set("rebuilt", this->Preparation.GetRebuilt());
  statistics.Set("seconds", times);
  statistics.Set("input", this->Preparation.DescribeInput());
  statistics.Set("tables", this->Preparation.DescribeTables());
  statistics.Set("segments", this->Preparation.DescribeSegments(frame.Integration));
  for (const auto& [name, section] : frame.Sections)
  {
    statistics.Set(name, section);
  }
  statistics.Set("error", error);
  statistics.Set("left_out", frame.LeftOut);
  this->Statistics = statistics.ToString();
  this->WarnOfError(frame);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::Internals::WarnOfError(const MapperFrame& frame)
{
  const double asked = this->Self->MaximumError;
  if (frame.Aborted || asked < SmallestMaximumError || this->ErrorEstimate <= asked)
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
vtkIdType vtkTetrahedraVolumeMapper::GetNumberOfSkippedCells()
{
  return this->Private->Preparation.Intake.GetNumberOfSkippedCells();
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumeMapper::GetNumberOfRemovedCells()
{
  const tetralux::WalkMesh* mesh = this->Private->Preparation.Scene.GetMesh();
  return mesh ? mesh->GetRemovedCells().Total() : 0;
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumeMapper::GetNumberOfBlankCells()
{
  return this->Private->Preparation.Scene.GetNumberOfBlankCells();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* planes = this->CroppingRegionPlanes;
  os << indent << "MaximumError: " << this->MaximumError << "\n"
     << indent << "BlendMode: " << this->BlendMode << "\n"
     << indent << "Integration: " << this->Integration << "\n"
     << indent << "TableScalarSize: " << this->TableScalarSize << "\n"
     << indent << "TableLengthSize: " << this->TableLengthSize << "\n"
     << indent << "TableLengthScale: " << this->TableLengthScale << "\n"
     << indent << "TableScalarAxis: " << this->TableScalarAxis << "\n"
     << indent << "TableFormat: " << this->TableFormat << "\n"
     << indent << "TableMaximumBytes: " << this->TableMaximumBytes << "\n"
     << indent << "SmoothShading: " << this->SmoothShading << "\n"
     << indent << "VectorMode: " << this->VectorMode << "\n"
     << indent << "VectorComponent: " << this->VectorComponent << "\n"
     << indent << "IntermixIntersectingGeometry: " << this->IntermixIntersectingGeometry << "\n"
     << indent << "Cropping: " << this->Cropping << "\n"
     << indent << "CroppingRegionPlanes: " << planes[0] << ", " << planes[1] << ", " << planes[2]
     << ", " << planes[3] << ", " << planes[4] << ", " << planes[5] << "\n"
     << indent << "CroppingRegionFlags: " << this->CroppingRegionFlags << "\n"
     << indent << "Statistics: " << this->Private->Statistics << "\n";
}
