// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ShaderError_h
#define tetralux_ShaderError_h

#include "Scene/GeometryError.h"

namespace tetralux
{

/// RayFrameDec.glsl rounds points across a ray to whole numbers of 2^-22 radii. Scalars are as in
/// the tables.
constexpr GeometryRounding RayShaderRounding = { 1. / (1 << 22), SingleRounding.Scalar };

/// ProjectedCellFS.glsl evaluates the faces and the scalar of each cell as functions that are
/// linear in the pixel, by three rounded coefficients each. Measured: errors are up to four times
/// those of SingleRounding across, and twice those of scalars.
constexpr GeometryRounding CellShaderRounding = { 4 * SingleRounding.Across,
  2 * SingleRounding.Scalar };

} // namespace tetralux

#endif
