// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastLight_h
#define tetralux_RayCastLight_h

// Gradients of cells, or interpolated between those of points, that lights shine on.

#include "Lighting/LaneLights.h"
#include "RayCast/RayCastGather.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The gradient of points or cells, in coordinates of the mesh.
TETRALUX_INLINE LaneVector LoadGradient(const KernelLighting& lighting, Int8 id)
{
  // Points of imaginary cells have none.
  const Int8 row = Select(Int8(lighting.NumberOfGradients) > id, id, Int8(0));
  LaneVector gradient;
  Float8 unused;
  GatherRows(&lighting.Gradients->X, row, gradient.C[0], gradient.C[1], gradient.C[2], unused);
  return gradient;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
