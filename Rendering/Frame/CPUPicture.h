// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CPUPicture_h
#define tetralux_CPUPicture_h

#include "Base/Span.h"
#include "Frame/DrawnViewport.h"
#include "View/DepthMap.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <memory>
#include <vector>

namespace tetralux
{

/// A picture that a processor has to make. A copy of it can be kept, and be made later.
struct CPUPicture
{
  RayGrid Grid;
  bool IsWindowSized = false; ///< a ray is a pixel, which has one sample
  bool OfSamples = false; ///< of samples at edges of the picture made before; most rays are empty
  std::shared_ptr<const std::vector<float>> OpaqueDistances; ///< what Limits point to
  RayLimits Limits;                                          ///< opaque geometry included
  double SampleDistance = 1;                                 ///< pixels from ray to ray
  Span<float> Colors; ///< to be filled: four a ray, premultiplied
  DepthMap Depth;     ///< of the window
  Span<float> Depths; ///< to be filled: distance along the ray, -1 where there is nothing
};

/// The smallest rectangle of rays with all that contributes; empty if nothing does.
PixelRectangle FindCovered(const CPUPicture& picture);

} // namespace tetralux

#endif
