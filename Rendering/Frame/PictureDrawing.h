// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PictureDrawing_h
#define tetralux_PictureDrawing_h

#include "Base/Cached.h"
#include "Base/Span.h"
#include "Frame/ImageCompositor.h"
#include "Frame/OpaqueDepth.h"
#include "Frame/PictureTask.h"
#include "Frame/PixelSamples.h"
#include "Frame/RayPace.h"
#include "Frame/SampleCompositor.h"
#include "Frame/SampleDepths.h"
#include "TetraluxRenderingModule.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

class vtkWindow;

namespace tetralux
{

class CameraRays;
struct MapperFrame;

/// What all mappers do with a frame: the rays of the camera and what limits them before, the way of
/// a picture in memory into the window after. Where the picture would be the last one again, that
/// is composited. Keeps how long the last picture took, and graphics resources of one window.
///
/// Where the frame buffer is multisampled and a ray is a pixel, pixels at edges are cast again for
/// each sample, through the sample's own place and up to its own opaque depth. All others have the
/// ray through their middle. A picture that frames refine has its edges when it is the last one.
class TETRALUXRENDERING_EXPORT PictureDrawing
{
public:
  /// Fills colours and distances of the picture, and tells the frame about it, also whether it was
  /// aborted. Returns the rays beyond which nothing is in the picture, empty where nothing is.
  using PictureMaker = std::function<PixelRectangle(MapperFrame&, const PictureTask&)>;

  /// Draws into the window itself, where each ray is the middle of a pixel of one sample: mappers
  /// whose picture is on the graphics card.
  using WindowDrawer = std::function<void(MapperFrame&, const CameraRays&)>;

  /// drawIntoWindow: called in place of all the rest where it can be; empty: never. Returns whether
  /// it was not, so that the picture went through memory. Throws what these throw, and
  /// std::invalid_argument or std::runtime_error, with one line, where the camera has no rays, or
  /// depths can't be read, or nothing can be drawn.
  bool Draw(MapperFrame& frame, const RayDistances& distances, const PictureMaker& makePicture,
    const WindowDrawer& drawIntoWindow = {});

  /// window: the one that goes away.
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Composite(
    const MapperFrame& frame, const PictureTask& picture, const PixelRectangle& visible);
  bool IsKept(const MapperFrame& frame) const;
  void RecordPace(const MapperFrame& frame, const CameraRays& rays);

  using SamplePlaces = std::vector<std::array<double, 2>>;
  std::vector<float> FindOpaqueDepths(const MapperFrame& frame, const CameraRays& rays,
    const SamplePlaces& places, OpaqueSamples& samples);
  bool CastSamples(MapperFrame& frame, const CameraRays& rays, const PictureTask& picture,
    const SamplePlaces& places, const OpaqueSamples& opaque, const PictureMaker& makePicture);
  void SetEdgesApart(const MapperFrame& frame, const PictureTask& picture);

  /// What the last frame brought into the window. The memory is that of its picture and its mapper.
  struct LastPicture
  {
    CacheStamp Stamp;
    vtkMTimeType ImageTime = 0; ///< of the frame's Image
    PixelRectangle Covered;
    Span<const float> Depths;
    Span<const std::uint8_t> Colors;

    PixelSamples Samples; ///< of a multisampled frame buffer, at edges of the picture
  };

  ImageCompositor Compositor;
  SampleCompositor EdgeCompositor;
  OpaqueDepth Opaque;
  SampleDepths OpaqueOfSamples;
  LastPicture Last;
  RayPace Pace;

  // Kept, since making memory takes as long as casting: what the window gets of pixels that are not
  // at edges, of all, and one sample of those at edges.
  std::vector<float> OtherColors;
  std::vector<float> OtherDepths;
  std::vector<float> SampleColors;
  std::vector<float> SampleDistances;
  std::vector<float> SampleEnds;
};

} // namespace tetralux

#endif
