// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraCPUMapper.h"

#include "Base/Stopwatch.h"
#include "Frame/CPUPicture.h"
#include "Frame/CameraRays.h"
#include "Frame/ImageCompositor.h"
#include "Frame/MapperFrame.h"
#include "Frame/OpaqueDistances.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <vector>

using tetralux::CameraRays;
using tetralux::MapperFrame;

//------------------------------------------------------------------------------------------------
class vtkTetrahedraCPUMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraCPUMapper* self)
    : Self(self)
  {
  }

  void DrawFrame(MapperFrame& frame);

  tetralux::ImageCompositor Compositor;

private:
  double ChooseSampleDistance(const MapperFrame& frame) const;

  vtkTetrahedraCPUMapper* Self;
  double SecondsPerRay = 0; ///< of the last picture; 0: none yet
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::Internals::DrawFrame(MapperFrame& frame)
{
  tetralux::CPUPicture picture;
  picture.SampleDistance = this->ChooseSampleDistance(frame);
  const CameraRays rays(frame.Renderer, picture.SampleDistance);
  if (rays.GetVisible().Width == 0)
  {
    frame.Image->Initialize(); // a tile that shows nothing of the viewport
    return;
  }
  picture.Grid = frame.MakeGrid(rays);
  picture.Limits = frame.MakeLimits(rays);
  picture.Depth = rays.GetDepthMap();
  if (frame.HasOpaqueGeometry())
  {
    const tetralux::Stopwatch stopwatch;
    picture.OpaqueDistances = std::make_shared<const std::vector<float>>(
      tetralux::ReadOpaqueDistances(frame.Renderer, rays));
    frame.Seconds.emplace_back("depth_buffer", stopwatch.GetSeconds());
  }
  frame.Opaque = picture.OpaqueDistances && !picture.OpaqueDistances->empty();
  picture.Limits.MaximumDistances = frame.Opaque ? picture.OpaqueDistances->data() : nullptr;

  const tetralux::PixelRectangle& visible = rays.GetVisible();
  const int width = picture.Grid.Width;
  const int height = picture.Grid.Height;
  picture.IsWindowSized = width == visible.Width && height == visible.Height;
  const tetralux::Stopwatch castStopwatch;
  MapperFrame::PrepareImage(frame.Image, width, height, picture.Colors, picture.Depths);
  const tetralux::PixelRectangle covered = this->Self->MakePicture(frame, picture);
  const double seconds = castStopwatch.GetSeconds();
  frame.Seconds.emplace_back("cast", seconds);
  if (frame.Aborted)
  {
    return;
  }
  this->SecondsPerRay = seconds / (static_cast<double>(width) * height);

  if (covered.Width > 0)
  {
    const tetralux::Stopwatch stopwatch;
    const float* depths = frame.WindowDepths.data();
    if (!frame.WindowColors.empty())
    {
      this->Compositor.CompositeOpaque(
        frame.Window, visible, frame.WindowColors.data(), depths, width, height, covered);
    }
    else
    {
      if (!frame.WindowDepths.empty())
      {
        this->Compositor.WriteDepth(frame.Window, visible, depths, width, height, covered);
      }
      this->Compositor.Composite(
        frame.Window, visible, picture.Colors.data(), width, height, covered);
    }
    frame.Seconds.emplace_back("composite", stopwatch.GetSeconds());
  }
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraCPUMapper::Internals::ChooseSampleDistance(const MapperFrame& frame) const
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
vtkTetrahedraCPUMapper::vtkTetrahedraCPUMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraCPUMapper::~vtkTetrahedraCPUMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::DrawFrame(MapperFrame& frame) { this->Private->DrawFrame(frame); }

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Private->Compositor.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, NumberOfThreads, int);
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, ImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, MinimumImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, MaximumImageSampleDistance, float);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("NumberOfThreads", this->NumberOfThreads);
  printer.Print("ImageSampleDistance", this->ImageSampleDistance);
  printer.Print("MinimumImageSampleDistance", this->MinimumImageSampleDistance);
  printer.Print("MaximumImageSampleDistance", this->MaximumImageSampleDistance);
  printer.Print("AutoAdjustSampleDistances", this->AutoAdjustSampleDistances);
}
