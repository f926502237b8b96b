// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOrderedVolume.h"

#include "AllProcesses.h"
#include "Base/Stopwatch.h"
#include "Compositing/OrderedPictures.h"
#include "Compositing/PictureCapture.h"
#include "Compositing/ProcessOrder.h"
#include "Frame/ImageCompositor.h"
#include "Frame/MemoryPicture.h"
#include "Geometry/SeparatingPlanes.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <exception>
#include <utility>

vtkStandardNewMacro(vtkOrderedVolume);

//------------------------------------------------------------------------------------------------
class vtkOrderedVolume::Internals
{
public:
  vtkSmartPointer<vtkVolume> Volume;
  double Bounds[6] = { 1, -1, 1, -1, 1, -1 }; ///< of all processes
  tetralux::PictureCapture Capture;
  tetralux::ImageCompositor Compositor;
  std::size_t Bytes = 0;
  double Seconds = 0;
  double DistributedBytes = 0;
  std::shared_ptr<const tetralux::SeparatingPlanes> Planes;

  /// All processes, the nearest one first.
  std::vector<int> FindOrder(vtkRenderer* renderer) const;
};

//------------------------------------------------------------------------------------------------
std::vector<int> vtkOrderedVolume::Internals::FindOrder(vtkRenderer* renderer) const
{
  vtkMatrix4x4* toWorld = this->Volume->GetMatrix();
  return this->Planes ? this->Planes->FindOrder(tetralux::FindEye(renderer, toWorld))
                      : tetralux::FindProcessOrder(renderer, toWorld);
}

//------------------------------------------------------------------------------------------------
vtkOrderedVolume::vtkOrderedVolume()
  : Private(std::make_unique<Internals>())
{
}

//------------------------------------------------------------------------------------------------
vtkOrderedVolume::~vtkOrderedVolume() = default;

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::SetVolume(vtkVolume* volume) { this->Private->Volume = volume; }

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::SetPlanes(std::shared_ptr<const tetralux::SeparatingPlanes> planes)
{
  this->Private->Planes = std::move(planes);
}

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::PrepareFrame(vtkRenderer* renderer, double distributed)
{
  this->Private->DistributedBytes = tetralux::Add(distributed);
  vtkVolume* volume = this->Private->Volume;
  tetralux::UniteBounds(
    volume->GetVisibility() ? volume->GetBounds() : nullptr, this->Private->Bounds);
  if (tetralux::IsParallel())
  {
    tetralux::LetAllProcessesDraw(renderer);
  }
}

//------------------------------------------------------------------------------------------------
vtkTypeInt64 vtkOrderedVolume::GetNumberOfBytes() const
{
  return static_cast<vtkTypeInt64>(this->Private->Bytes);
}

//------------------------------------------------------------------------------------------------
double vtkOrderedVolume::GetSeconds() const { return this->Private->Seconds; }

//------------------------------------------------------------------------------------------------
vtkTypeInt64 vtkOrderedVolume::GetNumberOfDistributedBytes() const
{
  return static_cast<vtkTypeInt64>(this->Private->DistributedBytes);
}

//------------------------------------------------------------------------------------------------
double* vtkOrderedVolume::GetBounds()
{
  double* bounds = this->Private->Bounds;
  return vtkMath::AreBoundsInitialized(bounds) ? bounds : nullptr;
}

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::GetVolumes(vtkPropCollection* volumes)
{
  this->Private->Volume->GetVolumes(volumes);
}

//------------------------------------------------------------------------------------------------
int vtkOrderedVolume::RenderOpaqueGeometry(vtkViewport* viewport)
{
  vtkVolume* volume = this->Private->Volume;
  return volume->GetVisibility() ? volume->RenderOpaqueGeometry(viewport) : 0;
}

//------------------------------------------------------------------------------------------------
int vtkOrderedVolume::RenderTranslucentPolygonalGeometry(vtkViewport* viewport)
{
  vtkVolume* volume = this->Private->Volume;
  return volume->GetVisibility() ? volume->RenderTranslucentPolygonalGeometry(viewport) : 0;
}

//------------------------------------------------------------------------------------------------
int vtkOrderedVolume::RenderVolumetricGeometry(vtkViewport* viewport)
{
  vtkVolume* volume = this->Private->Volume;
  int rendered = 0;
  const auto drawPart = [&]
  {
    if (volume->GetVisibility())
    {
      rendered = volume->RenderVolumetricGeometry(viewport);
    }
  };
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  const std::vector<int> ofParaView = tetralux::FindProcessOrder(renderer);
  this->Private->Bytes = 0;
  this->Private->Seconds = 0;
  if (ofParaView.size() < 2 || renderer->GetSelector())
  {
    drawPart();
    return rendered;
  }

  // Whatever fails in one process, the others wait for its picture.
  tetralux::PartialPicture mine;
  try
  {
    mine = this->Private->Capture.Draw(renderer, drawPart);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  const tetralux::Stopwatch stopwatch;
  const tetralux::OrderedPictures pictures = tetralux::CompositePictures(
    vtkMultiProcessController::GetGlobalController(), this->Private->FindOrder(renderer),
    ofParaView.front(), mine, tetralux::FindPictureOrigin(renderer));
  this->Private->Bytes = pictures.Bytes;
  const tetralux::PixelRectangle& shown = pictures.Whole.Rectangle;
  if (shown.Width > 0)
  {
    try
    {
      tetralux::MemoryPicture picture;
      picture.Width = shown.Width;
      picture.Height = shown.Height;
      picture.Colors = pictures.Whole.Colors.data();
      this->Private->Compositor.Composite(
        vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()), shown, picture,
        { 0, 0, shown.Width, shown.Height });
    }
    catch (const std::exception& error)
    {
      vtkErrorMacro(<< error.what());
    }
  }
  this->Private->Seconds = stopwatch.GetSeconds();
  return rendered;
}

//------------------------------------------------------------------------------------------------
vtkTypeBool vtkOrderedVolume::HasTranslucentPolygonalGeometry()
{
  vtkVolume* volume = this->Private->Volume;
  return volume->GetVisibility() && volume->HasTranslucentPolygonalGeometry();
}

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Private->Volume->ReleaseGraphicsResources(window);
  this->Private->Capture.ReleaseGraphicsResources(window);
  this->Private->Compositor.ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::SetAllocatedRenderTime(double seconds, vtkViewport* viewport)
{
  this->Superclass::SetAllocatedRenderTime(seconds, viewport);
  vtkVolume* volume = this->Private->Volume;
  if (volume->GetVisibility()) // else it may have no mapper, which is an error
  {
    volume->SetAllocatedRenderTime(seconds, viewport);
  }
}

//------------------------------------------------------------------------------------------------
vtkMTimeType vtkOrderedVolume::GetRedrawMTime()
{
  return std::max(this->Superclass::GetRedrawMTime(), this->Private->Volume->GetRedrawMTime());
}

//------------------------------------------------------------------------------------------------
void vtkOrderedVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Volume: " << this->Private->Volume.Get() << "\n";
  os << indent << "NumberOfBytes: " << this->GetNumberOfBytes() << "\n";
  os << indent << "Seconds: " << this->GetSeconds() << "\n";
  os << indent << "NumberOfDistributedBytes: " << this->GetNumberOfDistributedBytes() << "\n";
}
