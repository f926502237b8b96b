// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/IsosurfaceWindow.h"

#include "OpenGL/LoadedFunctions.h"

#include "Base/Stopwatch.h"
#include "Setup/SceneCamera.h"
#include "Setup/SceneOptions.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkMath.h"
#include "vtkOpenGLRenderer.h"
#include "vtkRenderPassCollection.h"
#include "vtkSequencePass.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include <algorithm>

namespace tetralux
{
namespace
{

// No colour of a lit surface.
constexpr std::array<unsigned char, 3> Background = { 51, 102, 153 };

/// Distance of the light from the middle, in radii of the bounding sphere.
constexpr double LightDistance = 3;

/// Half the opening of the light's cone in degrees, with shadow maps: the bounding sphere is within
/// asin(1 / LightDistance) = 19.5 degrees.
constexpr double LightConeAngle = 20;

/// Half the opening in degrees from which on VTK has no cone.
constexpr double NoConeAngle = 90;

} // namespace

IsosurfaceWindow::IsosurfaceWindow(const SceneOptions& options, const double bounds[6])
{
  this->Window->SetSize(options.Width, options.Height);
  this->Window->SetMultiSamples(0);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(Background[0] / 255., Background[1] / 255., Background[2] / 255.);
  PlaceCamera(options, bounds, this->Renderer);

  // From the left, above and behind the camera.
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  double forward[3], right[3], up[3], center[3];
  camera->GetDirectionOfProjection(forward);
  vtkMath::Cross(forward, camera->GetViewUp(), right);
  vtkMath::Normalize(right);
  vtkMath::Cross(right, forward, up);
  const vtkBoundingBox box(bounds);
  box.GetCenter(center);
  const double distance = LightDistance * box.GetDiagonalLength() / 2;
  for (int a = 0; a < 3; ++a)
  {
    const double direction = (-6 * right[a] + 6 * up[a] - 7 * forward[a]) / 11; // of length 1
    this->LightPosition[a] = center[a] + distance * direction;
  }
  this->Light->SetLightTypeToSceneLight();
  this->Light->PositionalOn();
  this->Light->SetPosition(this->LightPosition.data());
  this->Light->SetFocalPoint(center);
  this->Light->SetConeAngle(NoConeAngle);
  this->Renderer->AddLight(this->Light);
}

std::string IsosurfaceWindow::GetOpenGL()
{
  this->Window->Render();
  this->Window->MakeCurrent();
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name ? name : "";
}

void IsosurfaceWindow::SetShadows(bool shadows)
{
  this->Light->SetConeAngle(shadows ? LightConeAngle : NoConeAngle);
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
  if (vtkRenderPass* last = renderer->GetPass())
  {
    this->Window->MakeCurrent();
    last->ReleaseGraphicsResources(this->Window);
    renderer->SetPass(nullptr);
  }
  if (shadows)
  {
    const int* size = this->Window->GetSize();
    vtkNew<vtkShadowMapPass> receivers;
    receivers->GetShadowMapBakerPass()->SetResolution(std::max(size[0], size[1]));
    vtkNew<vtkRenderPassCollection> passes;
    passes->AddItem(receivers->GetShadowMapBakerPass());
    passes->AddItem(receivers);
    vtkNew<vtkSequencePass> sequence;
    sequence->SetPasses(passes);
    vtkNew<vtkCameraPass> pass;
    pass->SetDelegatePass(sequence);
    renderer->SetPass(pass);
  }
}

double IsosurfaceWindow::DrawFrame()
{
  this->Renderer->GetActiveCamera()->Modified();
  vtkVolumeCollection* volumes = this->Renderer->GetVolumes();
  vtkCollectionSimpleIterator next;
  for (volumes->InitTraversal(next); vtkVolume* volume = volumes->GetNextVolume(next);)
  {
    volume->GetMapper()->Modified(); // else the picture is kept
  }
  const Stopwatch stopwatch;
  this->Window->Render();
  this->Window->WaitForCompletion();
  return stopwatch.GetSeconds();
}

vtkIdType IsosurfaceWindow::CountCoveredPixels()
{
  const int* size = this->Window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0);
  vtkIdType covered = 0;
  for (vtkIdType pixel = 0; pixel < pixels->GetNumberOfTuples(); ++pixel)
  {
    covered += !std::equal(Background.begin(), Background.end(), pixels->GetPointer(3 * pixel));
  }
  return covered;
}

} // namespace tetralux
