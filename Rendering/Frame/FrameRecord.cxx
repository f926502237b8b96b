// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/FrameRecord.h"

#include "Base/Stopwatch.h"
#include "Frame/MapperFrame.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDualDepthPeelingPass.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWindow.h"

#include <algorithm>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tetralux
{
namespace
{

/// No picture in single precision is expected to be better: the mappers' headers say so.
constexpr double SmallestMaximumError = 1e-6;

Json Describe(const ErrorBudget& budget)
{
  Json section;
  section["transfer_function"] = budget.Functions;
  section["geometry"] = budget.Geometry;
  section["rounding"] = budget.Rounding;
  section["early_termination"] = budget.Termination;
  section["table"] = budget.Table;
  section["buffer"] = budget.Buffer;
  section["light"] = budget.Light;
  section["slices"] = budget.Slices;
  return section;
}

/// Whether a pass is under way that peels the volume layer by layer.
bool IsPeeled(vtkVolume* volume)
{
  vtkInformation* keys = volume->GetPropertyKeys();
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  for (int k = 0; keys && k < keys->Length(passes); ++k)
  {
    if (vtkDualDepthPeelingPass::SafeDownCast(keys->Get(passes, k)))
    {
      return true;
    }
  }
  return false;
}

/// Keeps an object until an event that it is told of.
class Keeper : public vtkCommand
{
public:
  static Keeper* New() { return new Keeper; }
  void Execute(vtkObject* caller, unsigned long, void*) override { caller->RemoveObserver(this); }

  vtkSmartPointer<vtkObject> Kept;
};

/// VTK goes on with a volume after its mapper's frame, though an observer may have removed it
/// meanwhile from all that held it.
void KeepUntilEnd(vtkRenderWindow* window, vtkObject* object)
{
  vtkNew<Keeper> keeper;
  keeper->Kept = object;
  window->AddObserver(vtkCommand::EndEvent, keeper);
}

} // namespace

FrameRecord::FrameRecord(vtkAbstractVolumeMapper* mapper)
  : Mapper(mapper)
  , Context([this](vtkOpenGLRenderWindow*) { this->ClearPicture(); })
{
}

FrameRecord::~FrameRecord() = default;

void FrameRecord::Render(vtkRenderer* renderer, vtkVolume* volume,
  const std::function<void(MapperFrame&)>& draw, double& seconds)
{
  if (this->Drawing)
  {
    vtkWarningWithObjectMacro(this->Mapper,
      << "a frame that an observer asks for while this mapper draws another one is not drawn");
    return;
  }
  const Stopwatch stopwatch;
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = this->Mapper;
  const vtkSmartPointer<vtkRenderer> heldRenderer = renderer;
  const vtkSmartPointer<vtkRenderWindow> window = renderer->GetRenderWindow();
  const vtkSmartPointer<vtkVolume> heldVolume = volume;
  this->Drawing = true;
  mapper->InvokeEvent(vtkCommand::VolumeMapperRenderStartEvent);
  std::string error;
  bool kept = false;
  try
  {
    kept = this->Draw(renderer, volume, draw);
    this->LastError.clear();
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
    this->Clear();
    if (error != this->LastError)
    {
      this->LastError = error;
      vtkErrorWithObjectMacro(mapper, << error);
    }
  }
  seconds = kept ? seconds : stopwatch.GetSeconds();
  mapper->InvokeEvent(vtkCommand::VolumeMapperRenderEndEvent);
  this->Drawing = false;
  for (const auto& released : std::exchange(this->ToRelease, {}))
  {
    mapper->ReleaseGraphicsResources(released);
  }
  if (window && heldVolume->GetReferenceCount() == 1)
  {
    KeepUntilEnd(window, heldVolume);
  }
}

bool FrameRecord::Draw(
  vtkRenderer* renderer, vtkVolume* volume, const std::function<void(MapperFrame&)>& draw)
{
  vtkAlgorithm* const input = this->Mapper->GetInputAlgorithm();
  if (!input)
  {
    throw std::invalid_argument("there is no input");
  }
  input->Update();
  const vtkSmartPointer<vtkVolumeProperty> property = volume->GetProperty();
  MapperFrame frame = this->Begin(renderer, volume);
  frame.Property = property;
  draw(frame);
  return frame.Kept;
}

bool FrameRecord::MayRelease(vtkWindow* window)
{
  if (this->Drawing)
  {
    // Not a window that ends: the frame holds its own, and has nothing of others.
    if (window && window->GetReferenceCount() > 0)
    {
      this->ToRelease.emplace_back(window);
    }
    return false;
  }
  this->Context.Release(window);
  return true;
}

void FrameRecord::ClearPicture()
{
  this->HasPicture = false;
  this->ReadPicture = nullptr;
  this->Image->Initialize();
}

void FrameRecord::Clear()
{
  this->ClearPicture();
  this->ErrorEstimate = 0;
  this->Statistics = "{}";
}

MapperFrame FrameRecord::Begin(vtkRenderer* renderer, vtkVolume* volume)
{
  MapperFrame frame;
  frame.Renderer = renderer;
  frame.Volume = volume;
  frame.Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!frame.Window)
  {
    throw std::invalid_argument("the renderer has no OpenGL render window");
  }
  if (IsPeeled(volume))
  {
    throw std::invalid_argument("vtkDualDepthPeelingPass peels volumes through shaders that this "
                                "mapper does not have: set the renderer's "
                                "UseDepthPeelingForVolumes off, and give the pass no "
                                "VolumetricPass");
  }
  this->Context.Set(frame.Window);
  frame.Window->MakeCurrent(); // an observer may have rendered another one
  frame.Image = this->Image;
  frame.HasPicture = this->HasPicture;
  frame.Progress = [this, window = frame.Window](double fraction)
  { return this->ReportProgress(window, vtkCommand::VolumeMapperRenderProgressEvent, fraction); };
  return frame;
}

bool FrameRecord::ReportProgress(vtkRenderWindow* window, unsigned long event, double fraction)
{
  this->Mapper->InvokeEvent(event, &fraction);
  const bool goOn = !window->CheckAbortStatus();
  if (!window->IsCurrent())
  {
    window->MakeCurrent(); // an observer rendered another one
  }
  return goOn;
}

void FrameRecord::Write(MapperFrame& frame, const std::vector<std::string>& rebuilt, Json seconds,
  double frameSeconds, const Json& sections)
{
  for (const auto& [name, value] : frame.Seconds)
  {
    seconds[name] = value;
  }
  seconds["frame"] = frameSeconds;
  if (frame.Kept)
  {
    this->Sections["kept"] = true;
    for (auto& [name, section] : this->Sections.items())
    {
      // What was done for the picture was not done again.
      if (section.is_object() && section.contains("rebuilt"))
      {
        section["rebuilt"] = Json::array();
      }
      if (section.is_object() && section.contains("uploaded_bytes"))
      {
        section["uploaded_bytes"] = 0;
      }
    }
    this->Sections["rebuilt"] = rebuilt;
    this->Sections["seconds"] = seconds;
    this->Statistics = this->Sections.dump(2);
    return;
  }
  if (frame.Aborted)
  {
    this->ClearPicture(); // of which rays were not cast
  }
  else
  {
    this->ReadPicture = frame.ReadPicture;
    this->HasPicture = true;
  }

  this->ErrorEstimate = frame.CoarseRaysError;
  for (const auto& [name, value] : frame.Errors)
  {
    this->ErrorEstimate += value;
  }
  Json error;
  error["maximum"] = frame.MaximumError;
  error["budget"] = Describe(frame.Budget);
  error["estimate"] = this->ErrorEstimate;
  for (const auto& [name, value] : frame.Errors)
  {
    error[name] = value;
  }
  error["coarse_rays"] = frame.CoarseRaysError;

  frame.ReportOmission(frame.Settings.ClippingPlanes.empty(), "clipping planes", "there are none");
  frame.ReportOmission(!frame.Settings.Cropping, "cropping", "it is off");
  frame.ReportOmission(!frame.Opaque, "opaque geometry", "nothing opaque was drawn before");

  Json& statistics = this->Sections;
  statistics = Json();
  statistics["method"] = frame.Method;
  statistics["aborted"] = frame.Aborted;
  statistics["kept"] = false;
  statistics["rebuilt"] = rebuilt;
  statistics["seconds"] = seconds;
  for (const auto& [name, section] : sections.items())
  {
    statistics[name] = section;
  }
  for (const auto& [name, section] : frame.Sections)
  {
    statistics[name] = section;
  }
  statistics["error"] = error;
  statistics["left_out"] = frame.LeftOut;
  this->Statistics = statistics.dump(2);
  this->WarnOfError(frame);
}

void FrameRecord::WarnOfError(const MapperFrame& frame)
{
  if (frame.Aborted || this->IsErrorKept(frame.MaximumError, -frame.CoarseRaysError))
  {
    this->ErrorWarning.Update(this->Mapper, "");
    return;
  }
  const auto largest = std::max_element(frame.Errors.begin(), frame.Errors.end(),
    [](const auto& a, const auto& b) { return a.second < b.second; });
  std::ostringstream warning;
  warning << "the estimated error " << this->ErrorEstimate - frame.CoarseRaysError
          << " is above the MaximumError " << frame.MaximumError << ": " << largest->second
          << " of it by '" << largest->first << "'";
  this->ErrorWarning.Update(this->Mapper, warning.str(), largest->first);
}

vtkImageData* FrameRecord::GetPicture()
{
  if (this->Drawing)
  {
    return this->NoImage;
  }
  if (this->ReadPicture)
  {
    // Moved out first: a failing read is not tried again.
    const auto read = std::move(this->ReadPicture);
    this->ReadPicture = nullptr;
    try
    {
      read(this->Image);
    }
    catch (const std::exception& exception)
    {
      this->Image->Initialize();
      vtkErrorWithObjectMacro(this->Mapper, << exception.what());
    }
  }
  return this->Image;
}

void FrameRecord::PrintStatistics(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Statistics:\n";
  std::istringstream lines(this->Statistics);
  for (std::string line; std::getline(lines, line);)
  {
    os << indent.GetNextIndent() << line << "\n";
  }
}

bool FrameRecord::IsErrorKept(double maximumError, double further) const
{
  return maximumError < SmallestMaximumError || this->ErrorEstimate + further <= maximumError;
}

} // namespace tetralux
