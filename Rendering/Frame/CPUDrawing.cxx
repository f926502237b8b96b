// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/CPUDrawing.h"

#include "Base/Digest.h"
#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/MapperFrame.h"
#include "Frame/OpaqueDistances.h"
#include "View/ViewKey.h"

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
    frame.MakeEmptyPicture(rays);
    this->Last = LastPicture();
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

  frame.AddViewToKey(rays, picture.Grid, picture.Limits);
  if (frame.Opaque)
  {
    Digester distances;
    distances.Add(picture.OpaqueDistances->data(), sizeof(float) * picture.OpaqueDistances->size());
    AddNumbersTo(frame.Key, distances.Get());
  }

  const PixelRectangle& visible = rays.GetVisible();
  const int width = picture.Grid.Width;
  const int height = picture.Grid.Height;
  picture.IsWindowSized = width == visible.Width && height == visible.Height;
  frame.Kept = this->IsKept(frame);
  const Stopwatch castStopwatch;
  MapperFrame::PrepareImage(frame.Image, width, height, picture.Colors, picture.Depths);
  if (frame.Kept)
  {
    frame.ReportProgress(1); // too late to abort
  }
  else
  {
    this->Last = LastPicture();
    this->Last.Covered = makePicture(frame, picture);
    const double seconds = castStopwatch.GetSeconds();
    frame.Seconds.emplace_back("cast", seconds);
    if (frame.Aborted)
    {
      return;
    }
    this->SecondsPerRay = seconds / (static_cast<double>(width) * height);
    this->Last.Depths = frame.WindowDepths;
    this->Last.Colors = frame.WindowColors;
    if (frame.Final)
    {
      this->Last.Stamp.Set(frame.Key);
    }
  }
  this->Last.ImageTime = frame.Image->GetMTime();

  if (this->Last.Covered.Width > 0)
  {
    const Stopwatch stopwatch;
    this->Composite(frame, picture, visible);
    frame.Seconds.emplace_back("composite", stopwatch.GetSeconds());
  }
}

/// Whether the picture would be the last one again, and that is still there.
bool CPUDrawing::IsKept(const MapperFrame& frame) const
{
  return frame.HasPicture && this->Last.Stamp.Has(frame.Key) &&
    (!this->Last.Colors.empty() || this->Last.ImageTime == frame.Image->GetMTime());
}

void CPUDrawing::Composite(
  const MapperFrame& frame, const CPUPicture& picture, const PixelRectangle& visible)
{
  const LastPicture& last = this->Last;
  MemoryPicture drawn;
  drawn.Width = picture.Grid.Width;
  drawn.Height = picture.Grid.Height;
  drawn.Depths = last.Depths.data();
  if (last.Colors.empty())
  {
    drawn.Colors = picture.Colors.data();
  }
  else
  {
    drawn.Bytes = last.Colors.data();
  }
  this->Compositor.Composite(frame.Window, visible, drawn, last.Covered);
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
