// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PictureKey_h
#define tetralux_PictureKey_h

#include "Base/Cached.h"
#include "Isosurface/IsosurfaceOptions.h"
#include "Scene/VolumeScene.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

namespace tetralux
{

/// All that a picture follows from, but for the samples of light.
CacheKey MakePictureKey(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const IsosurfaceOptions& options);

} // namespace tetralux

#endif
