// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OpaqueEnds_h
#define tetralux_OpaqueEnds_h

#include "Frame/CameraRays.h"
#include "Frame/OpaqueDepth.h"
#include "TetraluxRenderingModule.h"

#include <vector>

class vtkOpenGLRenderWindow;

namespace tetralux
{

/// For each ray the depth, 0..1, of the opaque geometry that was drawn before, from the depth
/// buffer at the pixel that the ray goes through. Empty where there is none at all. depth: keeps
/// the copy that is read. Throws what OpaqueDepth::Copy does.
TETRALUXRENDERING_EXPORT std::vector<float> ReadOpaqueDepths(
  OpaqueDepth& depth, vtkOpenGLRenderWindow* window, const CameraRays& rays);

/// The distances along rays to these depths, infinite where nothing is.
TETRALUXRENDERING_EXPORT std::vector<float> FindOpaqueDistances(
  const CameraRays& rays, const std::vector<float>& depths);

} // namespace tetralux

#endif
