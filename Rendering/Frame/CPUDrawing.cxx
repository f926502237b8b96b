// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/CPUDrawing.h"

#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/MapperFrame.h"
#include "Frame/OpaqueDistances.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace tetralux
{

void CPUDrawing::Draw(
  MapperFrame& frame, const RayDistances& distances, const PictureMaker& makePicture)
{
  CPUPicture picture;
  picture.SampleDistance = this->ChooseSampleDistance(frame, distances);
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
    const Stopwatch stopwatch;
    picture.OpaqueDistances = std::make_shared<const std::vector<float>>(
      ReadOpaqueDistances(this->Opaque, frame.Window, rays));
    frame.Seconds.emplace_back("depth_buffer", stopwatch.GetSeconds());
  }
  frame.Opaque = picture.OpaqueDistances && !picture.OpaqueDistances->empty();
  picture.Limits.MaximumDistances = frame.Opaque ? picture.OpaqueDistances->data() : nullptr;

  const PixelRectangle& visible = rays.GetVisible();
  const int width = picture.Grid.Width;
  const int height = picture.Grid.Height;
  picture.IsWindowSized = width == visible.Width && height == visible.Height;
  const Stopwatch castStopwatch;
  MapperFrame::PrepareImage(frame.Image, width, height, picture.Colors, picture.Depths);
  const PixelRectangle covered = makePicture(frame, picture);
  const double seconds = castStopwatch.GetSeconds();
  frame.Seconds.emplace_back("cast", seconds);
  if (frame.Aborted)
  {
    return;
  }
  this->SecondsPerRay = seconds / (static_cast<double>(width) * height);

  if (covered.Width > 0)
  {
    const Stopwatch stopwatch;
    this->Composite(frame, picture, visible, covered);
    frame.Seconds.emplace_back("composite", stopwatch.GetSeconds());
  }
}

void CPUDrawing::Composite(const MapperFrame& frame, const CPUPicture& picture,
  const PixelRectangle& visible, const PixelRectangle& covered)
{
  const int width = picture.Grid.Width;
  const int height = picture.Grid.Height;
  const float* depths = frame.WindowDepths.data();
  if (!frame.WindowColors.empty())
  {
    this->Compositor.CompositeOpaque(
      frame.Window, visible, frame.WindowColors.data(), depths, width, height, covered);
    return;
  }
  if (!frame.WindowDepths.empty())
  {
    this->Compositor.WriteDepth(frame.Window, visible, depths, width, height, covered);
  }
  this->Compositor.Composite(frame.Window, visible, picture.Colors.data(), width, height, covered);
}

void CPUDrawing::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Compositor.ReleaseGraphicsResources(window);
  this->Opaque.ReleaseGraphicsResources(window);
}

double CPUDrawing::ChooseSampleDistance(
  const MapperFrame& frame, const RayDistances& distances) const
{
  if (!distances.Automatic)
  {
    return distances.Fixed;
  }
  const PixelRectangle whole = FindDrawnViewport(frame.Renderer).Whole;
  const double fullSeconds = this->SecondsPerRay * whole.Width * whole.Height;
  const double distance = std::sqrt(fullSeconds / frame.Volume->GetAllocatedRenderTime());
  return std::max(std::min(distance, distances.Maximum), distances.Minimum);
}

} // namespace tetralux
