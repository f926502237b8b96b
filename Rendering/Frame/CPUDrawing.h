// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CPUDrawing_h
#define tetralux_CPUDrawing_h

#include "Base/Cached.h"
#include "Base/Span.h"
#include "Frame/CPUPicture.h"
#include "Frame/ImageCompositor.h"
#include "Frame/OpaqueDepth.h"
#include "Frame/PixelSamples.h"
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

/// Distances from ray to ray, in pixels.
struct RayDistances
{
  bool Automatic = true; ///< by the time that the renderer allocates
  double Fixed = 1;      ///< where it is not automatic
  double Minimum = 1;    ///< of the automatic one
  double Maximum = 10;
};

/// What all mappers do with a frame whose picture a processor makes: the rays of the camera and
/// what limits them before, the way into the window after. Where the picture would be the last one
/// again, that is composited. Keeps how long the last picture took, and graphics resources of one
/// window.
///
/// Where the frame buffer is multisampled and a ray is a pixel, pixels at edges are cast again for
/// each sample, through the sample's own place and up to its own opaque depth. All others have the
/// ray through their middle.
class TETRALUXRENDERING_EXPORT CPUDrawing
{
public:
  /// Fills colours and distances of the picture, and tells the frame about it, also whether it was
  /// aborted. Returns the rays beyond which nothing is in the picture, empty where nothing is.
  using PictureMaker = std::function<PixelRectangle(MapperFrame&, const CPUPicture&)>;

  /// Throws what the maker throws, and std::invalid_argument or std::runtime_error, with one line,
  /// where the camera has no rays, or depths can't be read, or nothing can be drawn.
  void Draw(MapperFrame& frame, const RayDistances& distances, const PictureMaker& makePicture);

  /// window: the one that goes away.
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  double ChooseSampleDistance(const MapperFrame& frame, const RayDistances& distances) const;
  void Composite(
    const MapperFrame& frame, const CPUPicture& picture, const PixelRectangle& visible);
  bool IsKept(const MapperFrame& frame) const;

  using SamplePlaces = std::vector<std::array<double, 2>>;
  std::vector<float> FindOpaqueDistances(const MapperFrame& frame, const CameraRays& rays,
    const SamplePlaces& places, OpaqueSamples& samples);
  void CastSamples(MapperFrame& frame, const CameraRays& rays, const CPUPicture& picture,
    const SamplePlaces& places, const OpaqueSamples& opaque, const PictureMaker& makePicture);
  void SetEdgesApart(const MapperFrame& frame, const CPUPicture& picture);

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
  double SecondsPerRay = 0; ///< of the last picture; 0: none yet

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
