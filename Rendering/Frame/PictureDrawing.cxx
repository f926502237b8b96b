// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/PictureDrawing.h"

#include "Base/Digest.h"
#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/MapperFrame.h"
#include "Frame/OpaqueEnds.h"
#include "View/ViewKey.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

/// Whether each ray is the middle of a pixel.
bool IsOfPixels(const CameraRays& rays)
{
  return rays.GetGrid().Width == rays.GetVisible().Width &&
    rays.GetGrid().Height == rays.GetVisible().Height;
}

/// The rays of samples; their depths are not read yet.
OpaqueSamples MakeSamples(const CameraRays& rays, std::size_t samples)
{
  OpaqueSamples result;
  result.Width = rays.GetGrid().Width;
  result.Height = rays.GetGrid().Height;
  result.Samples = static_cast<int>(samples);
  result.PixelWidth = rays.GetWidth();
  result.GetDistance = [&rays](int x, int y, double depth)
  { return rays.GetDistance(x, y, depth); };
  return result;
}

/// The smallest rectangle with all of the pixels, y width + x, of which there is one at least.
PixelRectangle FindBounds(const std::vector<std::int32_t>& pixels, int width)
{
  int left = width;
  int right = 0;
  for (const std::int32_t pixel : pixels) // by rows
  {
    left = std::min(left, pixel % width);
    right = std::max(right, pixel % width);
  }
  const int lower = pixels.front() / width;
  return { left, lower, right + 1 - left, pixels.back() / width + 1 - lower };
}

FrameDemand GetDemand(const MapperFrame& frame)
{
  const PixelRectangle whole = FindDrawnViewport(frame.Renderer).Whole;
  FrameDemand demand;
  demand.Pixels = static_cast<double>(whole.Width) * whole.Height;
  demand.Seconds = frame.Volume->GetAllocatedRenderTime();
  demand.Interactive = frame.IsInteractive();
  return demand;
}

/// Moves the rays of a picture, in pixels.
void ShiftRays(double x, double y, PictureTask& picture)
{
  picture.Places.Shift(x, y);
  RayGrid& grid = picture.Grid;
  DepthMap& map = picture.Depth;
  for (int c = 0; c < 3; ++c)
  {
    const double move = x * grid.OriginStepX[c] + y * grid.OriginStepY[c];
    grid.Origin[c] += move;
    grid.Direction[c] += x * grid.DirectionStepX[c] + y * grid.DirectionStepY[c];
    map.Depth[3] += map.Depth[c] * move;
    map.Divisor[3] += map.Divisor[c] * move;
  }
}

} // namespace

bool PictureDrawing::Draw(MapperFrame& frame, const RayDistances& distances,
  const PictureMaker& makePicture, const WindowDrawer& drawIntoWindow)
{
  const FrameDemand demand = GetDemand(frame);
  PictureTask picture;
  picture.SampleDistance = this->Pace.ChooseDistance(distances, demand);
  const CameraRays rays(frame.Renderer, picture.SampleDistance);
  if (rays.GetVisible().Width == 0)
  {
    frame.MakeEmptyPicture(rays);
    this->Last = LastPicture();
    return true;
  }
  // Of frame buffers that are not multisampled, and where rays are not pixels: none.
  const SamplePlaces places = IsOfPixels(rays) ? FindSamplePlaces() : SamplePlaces();
  if (drawIntoWindow && IsOfPixels(rays) && places.empty())
  {
    this->Last = LastPicture();
    drawIntoWindow(frame, rays);
    this->RecordPace(frame, rays);
    return false;
  }
  picture.Grid = frame.MakeGrid(rays);
  picture.Limits = frame.MakeLimits(rays);
  picture.Depth = rays.GetDepthMap();
  picture.Places = rays.GetDepthPlaces();
  OpaqueSamples samples = MakeSamples(rays, places.size());
  if (frame.HasOpaqueGeometry())
  {
    const Stopwatch stopwatch;
    std::vector<float> depths = this->FindOpaqueDepths(frame, rays, places, samples);
    if (!depths.empty())
    {
      picture.OpaqueDistances =
        std::make_shared<const std::vector<float>>(FindOpaqueDistances(rays, depths));
      picture.OpaqueDepths = std::make_shared<const std::vector<float>>(std::move(depths));
    }
    frame.Seconds.emplace_back("depth_buffer", stopwatch.GetSeconds());
  }
  frame.Opaque = picture.OpaqueDistances != nullptr;
  picture.Limits.MaximumDistances = frame.Opaque ? picture.OpaqueDistances->data() : nullptr;

  frame.AddViewToKey(rays, picture.Grid, picture.Limits);
  frame.Key.Add(places.size());
  if (!samples.Depths.empty())
  {
    Digester depths;
    depths.Add(samples.Depths.data(), sizeof(float) * samples.Depths.size());
    AddNumbersTo(frame.Key, depths.Get());
  }
  if (frame.Opaque)
  {
    Digester depths;
    depths.Add(picture.OpaqueDepths->data(), sizeof(float) * picture.OpaqueDepths->size());
    AddNumbersTo(frame.Key, depths.Get());
  }

  const PixelRectangle& visible = rays.GetVisible();
  const int width = picture.Grid.Width;
  const int height = picture.Grid.Height;
  picture.IsWindowSized = IsOfPixels(rays) && places.empty();
  const bool sampled = !places.empty() && this->Pace.HasTimeForEdges(demand);
  frame.Key.Add(sampled);
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
      return true;
    }
    frame.RaySeconds = frame.RaySeconds > 0 ? frame.RaySeconds : seconds;
    this->RecordPace(frame, rays);
    this->Last.Depths = frame.WindowDepths;
    this->Last.Colors = frame.WindowColors;
    if (width < visible.Width || height < visible.Height)
    {
      frame.CoarseRaysError = FindLargestStep(picture);
    }
    bool complete = frame.Final;
    if (sampled && this->Last.Covered.Width > 0 && frame.Final)
    {
      const Stopwatch samplesStopwatch;
      complete = this->CastSamples(frame, rays, picture, places, samples, makePicture);
      const double edgeSeconds = samplesStopwatch.GetSeconds();
      frame.Seconds.emplace_back("edges", edgeSeconds);
      this->Pace.RecordEdges(edgeSeconds);
    }
    if (complete)
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
  return true;
}

void PictureDrawing::RecordPace(const MapperFrame& frame, const CameraRays& rays)
{
  if (!frame.Aborted && !frame.Kept)
  {
    this->Pace.Record(static_cast<double>(rays.GetGrid().Width) * rays.GetGrid().Height,
      frame.RaySeconds, frame.FixedSeconds);
  }
}

/// Whether the picture would be the last one again, and that is still there.
bool PictureDrawing::IsKept(const MapperFrame& frame) const
{
  return frame.HasPicture && this->Last.Stamp.Has(frame.Key) &&
    (!this->Last.Colors.empty() || this->Last.ImageTime == frame.Image->GetMTime());
}

void PictureDrawing::Composite(
  const MapperFrame& frame, const PictureTask& picture, const PixelRectangle& visible)
{
  const LastPicture& last = this->Last;
  MemoryPicture drawn;
  drawn.Width = picture.Grid.Width;
  drawn.Height = picture.Grid.Height;
  drawn.Depths = last.Depths.data();
  if (last.Colors.empty())
  {
    drawn.Colors = last.Samples.Pixels.empty() ? picture.Colors.data() : this->OtherColors.data();
  }
  else
  {
    drawn.Bytes = last.Colors.data();
  }
  this->Compositor.Composite(frame.Window, visible, drawn, last.Covered);
  if (!last.Samples.Pixels.empty())
  {
    this->EdgeCompositor.Composite(frame.Window, visible, last.Samples);
  }
}

/// Reads what ends rays, and of a multisampled frame buffer what its samples have.
std::vector<float> PictureDrawing::FindOpaqueDepths(const MapperFrame& frame,
  const CameraRays& rays, const SamplePlaces& places, OpaqueSamples& samples)
{
  if (places.empty())
  {
    return ReadOpaqueDepths(this->Opaque, frame.Window, rays);
  }
  samples.Depths =
    this->OpaqueOfSamples.Read(frame.Window, rays.GetVisible(), static_cast<int>(places.size()));
  std::vector<float> depths = tetralux::FindOpaqueDepths(samples);
  if (depths.empty())
  {
    samples.Depths.clear();
  }
  return depths;
}

/// Casts pixels at edges again, sample by sample. Returns false after an abort: then none is there.
bool PictureDrawing::CastSamples(MapperFrame& frame, const CameraRays& rays,
  const PictureTask& picture, const SamplePlaces& places, const OpaqueSamples& opaque,
  const PictureMaker& makePicture)
{
  const int width = picture.Grid.Width;
  const std::size_t size = picture.Depths.size();
  PixelSamples& result = this->Last.Samples;
  result.Samples = opaque.Samples;
  result.Pixels = FindEdges(opaque, picture.Colors.data());
  Json section;
  section["samples"] = result.Samples;
  section["pixels_at_edges"] = result.Pixels.size();
  frame.Sections.emplace_back("multisampling", section);
  if (result.Pixels.empty())
  {
    return true;
  }
  this->SetEdgesApart(frame, picture);

  // Other rays of the rectangle end before they begin.
  const PixelRectangle part = FindBounds(result.Pixels, width);
  const auto findPlace = [&part, width](std::int32_t pixel) {
    return static_cast<std::size_t>(pixel / width - part.Y) * part.Width + pixel % width - part.X;
  };
  const std::size_t rayCount = static_cast<std::size_t>(part.Width) * part.Height;
  this->SampleColors.resize(4 * rayCount);
  this->SampleDistances.resize(rayCount);
  this->SampleEnds.assign(rayCount, -Infinity);
  const auto endDepths = std::make_shared<std::vector<float>>(rayCount, 0.f);
  for (std::size_t sample = 0; sample < places.size(); ++sample)
  {
    const double x = places[sample][0] - 0.5;
    const double y = places[sample][1] - 0.5;
    for (const std::int32_t pixel : result.Pixels)
    {
      const int column = pixel % width;
      const int row = pixel / width;
      const float depth =
        opaque.Depths.empty() ? 1 : opaque.Depths[sample * size + static_cast<std::size_t>(pixel)];
      (*endDepths)[findPlace(pixel)] = depth;
      this->SampleEnds[findPlace(pixel)] =
        depth < 1 ? static_cast<float>(rays.GetDistance(column + x, row + y, depth)) : Infinity;
    }
    PictureTask ofSample = picture;
    ShiftRays(part.X + x, part.Y + y, ofSample);
    ofSample.Grid.Width = part.Width;
    ofSample.Grid.Height = part.Height;
    ofSample.OfSamples = true;
    ofSample.OpaqueDistances = nullptr;
    ofSample.OpaqueDepths = endDepths;
    ofSample.Limits.MaximumDistances = this->SampleEnds.data();
    ofSample.Colors = this->SampleColors;
    ofSample.Depths = this->SampleDistances;
    MapperFrame drawn = frame;
    drawn.Progress = frame.IsMean ? frame.Progress : nullptr; // which may take long
    makePicture(drawn, ofSample);
    if (drawn.Aborted)
    {
      result = PixelSamples();
      this->Last.Depths = frame.WindowDepths;
      return false;
    }
    for (const std::int32_t pixel : result.Pixels)
    {
      const std::size_t place = findPlace(pixel);
      const float* color = &this->SampleColors[4 * place];
      result.Colors.insert(result.Colors.end(), color, color + 4);
      if (!drawn.WindowDepths.empty())
      {
        result.Depths.push_back(drawn.WindowDepths[place]);
      }
    }
  }
  return true;
}

/// Takes pixels at edges out of copies of what the window gets of all pixels.
void PictureDrawing::SetEdgesApart(const MapperFrame& frame, const PictureTask& picture)
{
  std::vector<float>& colors = this->OtherColors;
  std::vector<float>& depths = this->OtherDepths;
  colors.assign(picture.Colors.begin(), picture.Colors.end());
  depths.assign(frame.WindowDepths.begin(), frame.WindowDepths.end());
  for (const std::int32_t pixel : this->Last.Samples.Pixels)
  {
    const auto place = static_cast<std::size_t>(pixel);
    std::fill_n(&colors[4 * place], 4, 0.f);
    if (!depths.empty())
    {
      depths[place] = 1;
    }
  }
  this->Last.Depths = depths;
}

void PictureDrawing::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Compositor.ReleaseGraphicsResources(window);
  this->EdgeCompositor.ReleaseGraphicsResources(window);
  this->Opaque.ReleaseGraphicsResources(window);
  this->OpaqueOfSamples.ReleaseGraphicsResources(window);
}

} // namespace tetralux
