// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchView.h"

#include "Bench/BenchScene.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/MessageCapture.h"
#include "Setup/SceneCamera.h"
#include "Setup/SceneOptions.h"
#include "Setup/VisitMapper.h"
#include "vtkHeadlessRenderWindow.h"

#include "vtkCamera.h"
#include "vtkDataArrayRange.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWindowToImageFilter.h"

#include <chrono>
#include <sstream>

namespace
{

BenchPicture MakePicture(vtkImageData* image, double scale)
{
  BenchPicture picture;
  picture.Width = image->GetDimensions()[0];
  picture.Height = image->GetDimensions()[1];
  const auto values = vtk::DataArrayValueRange<4>(image->GetPointData()->GetScalars());
  picture.Rgba.reserve(values.size());
  for (const double value : values)
  {
    picture.Rgba.push_back(static_cast<float>(scale * value));
  }
  return picture;
}

} // namespace

vtkSmartPointer<vtkHeadlessRenderWindow> MakeBenchWindow(const SceneOptions& view)
{
  auto window = vtkSmartPointer<vtkHeadlessRenderWindow>::New();
  window->SetSize(view.Width, view.Height);
  window->SetMultiSamples(0);
  window->SetAlphaBitPlanes(1);
  return window;
}

std::string GetOpenGLRenderer(vtkHeadlessRenderWindow* window)
{
  std::istringstream capabilities(window->ReportCapabilities());
  const std::string label = "OpenGL renderer string:";
  for (std::string line; std::getline(capabilities, line);)
  {
    const std::size_t found = line.find(label);
    if (found != std::string::npos)
    {
      return line.substr(line.find_first_not_of(' ', found + label.size()));
    }
  }
  return "unknown";
}

BenchView::BenchView(vtkHeadlessRenderWindow* window, const BenchScene& scene,
  vtkSmartPointer<vtkAbstractVolumeMapper> mapper, const SceneOptions& view)
  : Mapper(std::move(mapper))
  , Window(window)
{
  this->Mapper->SetInputDataObject(scene.GetData());
  this->Mapper->SetScalarMode(
    scene.CellData ? VTK_SCALAR_MODE_USE_CELL_DATA : VTK_SCALAR_MODE_USE_POINT_DATA);
  this->Volume->SetMapper(this->Mapper);
  this->Volume->SetProperty(scene.Property);
  this->Window->AddRenderer(this->Renderer);
  // VTK's Bunyk mapper reads the aspect before anything has computed it.
  const int* size = this->Window->GetSize();
  this->Renderer->SetAspect(static_cast<double>(size[0]) / size[1], 1);
  PlaceCamera(view, scene.GetData()->GetBounds(), this->Renderer);
  this->Window->Render();
  this->Renderer->AddVolume(this->Volume);
}

BenchView::~BenchView() { this->Window->RemoveRenderer(this->Renderer); }

double BenchView::Render()
{
  const MessageCapture messages;
  this->Renderer->GetActiveCamera()->Modified();
  if (this->Mapper->IsA("vtkTetrahedraVolumeMapper") ||
    this->Mapper->IsA("vtkTriangleCasterMapper"))
  {
    this->Mapper->Modified(); // else the picture is kept
  }
  const auto start = std::chrono::steady_clock::now();
  this->Window->Render();
  this->Window->WaitForCompletion();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (!messages.GetError().empty())
  {
    throw WorkError(messages.GetError());
  }
  return seconds.count();
}

BenchPicture BenchView::CaptureWindow() const
{
  vtkNew<vtkWindowToImageFilter> reader;
  reader->SetInput(this->Window);
  reader->ShouldRerenderOff();
  reader->ReadFrontBufferOff();
  reader->SetInputBufferTypeToRGBA();
  reader->Update();
  return MakePicture(reader->GetOutput(), 1.0 / 255);
}

BenchPicture BenchView::GetFloatPicture() const
{
  return VisitMapper(
    this->Mapper, [](auto* mapper) { return MakePicture(mapper->GetOutputImage(), 1); });
}

std::string BenchView::GetStatistics() const
{
  return VisitMapper(this->Mapper,
    [](auto* mapper) { return mapper ? mapper->GetStatistics() : std::string("{}"); });
}
