// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LargestScalarError_h
#define tetralux_LargestScalarError_h

// What rounding does to a picture of OpticalModel::MaximumIntensity, as a sample of the mesh's rays
// tells.
//
// A ray's largest scalar is that of a place on a face. It changes by its own rounding, and by the
// rounding across the ray times the face's gradient: that across the ray, and that along the ray
// times the slope of the face. Cells between faces that are close to each other have steep
// gradients. The error is what colour and opacity change by between the least and the most that the
// largest scalar may be; no other ray averages it out.
//
// Of cells of constant scalar only the scalar is rounded, in the same way as the nodes of the
// function: it never comes below a node.
//
// The error of a picture follows from those of rays as in GeometryError.h. Steps that fewer rays
// than one in a thousand come near are not covered, nor are rays that graze the boundary.

#include "Integral/RaySegments.h"
#include "Optics/TransferFunction.h"
#include "Scene/GeometryError.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Estimated largest error of a channel of a picture by rounding; at most the largest value of a
/// channel. rays: DrawMeshRays. function: opacities for attenuations. ofCells: scalars are constant
/// in cells.
TETRALUXCORE_EXPORT double EstimateLargestScalarError(const RaySample& rays, const RayUnits& units,
  const TransferFunction& function, bool ofCells, const GeometryRounding& rounding);

} // namespace tetralux

#endif
