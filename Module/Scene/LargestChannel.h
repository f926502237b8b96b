// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LargestChannel_h
#define tetralux_LargestChannel_h

// How bright a picture is where it is brightest: sums of floating point numbers are rounded in
// proportion to what they have come to.

#include "Integral/RaySegments.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Largest absolute value of a channel on its way to that of a picture, at least 1. Where there is
/// absorption it is that of a colour. OpticalModel::EmissionOnly: the largest sum of a sample's
/// rays. rays: DrawMeshRays. lengthScale: world length of a unit of RaySegment::Length. Without
/// lights. Parallel, the same for any number of threads.
TETRALUXCORE_EXPORT double EstimateLargestChannel(
  const RaySample& rays, double lengthScale, const TransferFunction& function, OpticalModel model);

} // namespace tetralux

#endif
