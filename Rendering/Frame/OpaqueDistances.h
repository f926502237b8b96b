// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OpaqueDistances_h
#define tetralux_OpaqueDistances_h

#include "Frame/CameraRays.h"
#include "Frame/OpaqueDepth.h"
#include "TetraluxRenderingModule.h"

#include <vector>

class vtkOpenGLRenderWindow;

namespace tetralux
{

/// For each ray the distance to the opaque geometry that was drawn before, from the depth buffer at
/// the pixel that the ray goes through; infinite where there is none. Empty where there is none at
/// all. depth: keeps the copy that is read. Throws what OpaqueDepth::Copy does.
TETRALUXRENDERING_EXPORT std::vector<float> ReadOpaqueDistances(
  OpaqueDepth& depth, vtkOpenGLRenderWindow* window, const CameraRays& rays);

} // namespace tetralux

#endif
