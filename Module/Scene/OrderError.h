// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OrderError_h
#define tetralux_OrderError_h

#include "Integral/RaySegments.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Estimated largest error of a channel where cells of a ray are composited in a wrong order, as
/// those of a cycle are. Two segments of opacities a and b that change places change a channel by a
/// b |difference of their colours|. Of a sample's rays it is the largest change by one such pair:
/// the cells of a cycle that follow each other on a ray are few. rays: DrawMeshRays. lengthScale:
/// world length of a unit of RaySegment::Length. Parallel.
TETRALUXCORE_EXPORT double EstimateOrderError(
  const RaySample& rays, double lengthScale, const TransferFunction& function);

} // namespace tetralux

#endif
