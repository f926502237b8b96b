// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ModelRays_h
#define tetralux_ModelRays_h

#include "Walk/MeshRays.h"

namespace tetralux
{

/// What rays may look like where there is no mesh.
struct RayModel
{
  double PathLength = 1; ///< longest way through the volume, world units
  double ScalarRange[2] = { 0, 1 };
  double LongestSegment = 1;
};

/// Rays whose scalar wanders over the range (reflected at its ends), by slow, middling and fast
/// steps from segment to segment, and whose lengths are drawn evenly from 0 to the longest, a
/// quarter and a sixteenth of it, until the path is as long as asked for or the ray has 400
/// segments. The same rays for the same model.
RaySample DrawModelRays(const RayModel& model);

} // namespace tetralux

#endif
