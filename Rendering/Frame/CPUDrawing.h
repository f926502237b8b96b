// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CPUDrawing_h
#define tetralux_CPUDrawing_h

#include "Base/Cached.h"
#include "Base/Span.h"
#include "Frame/CPUPicture.h"
#include "Frame/ImageCompositor.h"
#include "Frame/OpaqueDepth.h"
#include "TetraluxRenderingModule.h"

#include "vtkType.h"

#include <cstdint>
#include <functional>

class vtkWindow;

namespace tetralux
{

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

  /// What the last frame brought into the window. The memory is that of its picture and its mapper.
  struct LastPicture
  {
    CacheStamp Stamp;
    vtkMTimeType ImageTime = 0; ///< of the frame's Image
    PixelRectangle Covered;
    Span<const float> Depths;
    Span<const std::uint8_t> Colors;
  };

  ImageCompositor Compositor;
  OpaqueDepth Opaque;
  LastPicture Last;
  double SecondsPerRay = 0; ///< of the last picture; 0: none yet
};

} // namespace tetralux

#endif
