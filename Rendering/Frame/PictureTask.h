// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PictureTask_h
#define tetralux_PictureTask_h

#include "Base/Span.h"
#include "Frame/CameraRays.h"
#include "Frame/DrawnViewport.h"
#include "View/DepthMap.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <memory>
#include <vector>

namespace tetralux
{

/// A picture that a mapper has to bring into memory. A copy of it can be kept, and be made later.
struct PictureTask
{
  RayGrid Grid;
  bool IsWindowSized = false; ///< a ray is a pixel, which has one sample
  bool OfSamples = false; ///< of samples at edges of the picture made before; most rays are empty

  /// Of opaque geometry at the rays, as the depth buffer has them, 0..1; at 0 nothing of the ray is
  /// seen. nullptr: there is none.
  std::shared_ptr<const std::vector<float>> OpaqueDepths;
  DepthPlaces Places; ///< of these depths

  std::shared_ptr<const std::vector<float>> OpaqueDistances; ///< the same; what Limits point to
  RayLimits Limits;                                          ///< opaque geometry included
  double SampleDistance = 1;                                 ///< pixels from ray to ray
  Span<float> Colors; ///< to be filled: four a ray, premultiplied
  DepthMap Depth;     ///< of the window
  Span<float> Depths; ///< to be filled: distance along the ray, -1 where there is nothing
};

/// The smallest rectangle of rays with all that contributes; empty if nothing does.
PixelRectangle FindCovered(const PictureTask& picture);

/// The same by colours alone.
PixelRectangle FindColored(const PictureTask& picture);

/// How much interpolated colours of rays that are coarser than pixels may be off: the largest
/// difference of a channel from a ray to the next ones.
double FindLargestStep(const PictureTask& picture);

} // namespace tetralux

#endif
