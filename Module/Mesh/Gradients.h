// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Gradients_h
#define tetralux_Gradients_h

#include "Base/Span.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A gradient, in one load.
struct alignas(16) GradientRow
{
  float X, Y, Z, Unused;
};

/// Gradients of a scalar at the points of a mesh, to be interpolated between them where lighting is
/// to be smooth: at each point the mean of its cells' gradients, weighted by volume. Exact where
/// the scalar is linear. Cells that touch a scalar which is not finite do not count; a point
/// without any cell that does has no gradient, 0.
///
/// length, scalar: units, more than 0; the gradient is that of scalars / scalar over coordinates /
/// length, so that it can be held in single precision. The same result for any number of threads.
TETRALUXCORE_EXPORT std::vector<GradientRow> MakePointGradients(
  const TetrahedralMesh& mesh, Span<const double> scalars, double length, double scalar);

/// Gradients of a scalar in the cells of a mesh, in the same units; of a flat cell the direction
/// alone, and 0 where a scalar is not finite.
TETRALUXCORE_EXPORT std::vector<GradientRow> MakeCellGradients(
  const TetrahedralMesh& mesh, Span<const double> scalars, double length, double scalar);

/// MakeCellGradients of one cell.
TETRALUXCORE_EXPORT GradientRow MakeCellGradient(const TetrahedralMesh& mesh,
  Span<const double> scalars, std::int64_t cell, double length, double scalar);

} // namespace tetralux

#endif
