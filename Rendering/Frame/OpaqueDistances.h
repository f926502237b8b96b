// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OpaqueDistances_h
#define tetralux_OpaqueDistances_h

#include "Frame/CameraRays.h"
#include "TetraluxRenderingModule.h"

#include <vector>

class vtkRenderer;

namespace tetralux
{

/// For each ray the distance to the opaque geometry that was drawn before, from the depth buffer at
/// the pixel that the ray goes through; infinite where there is none. Empty where there is none at
/// all. Throws std::runtime_error where the depth buffer can't be read.
TETRALUXRENDERING_EXPORT std::vector<float> ReadOpaqueDistances(
  vtkRenderer* renderer, const CameraRays& rays);

} // namespace tetralux

#endif
