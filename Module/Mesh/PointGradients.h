// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PointGradients_h
#define tetralux_PointGradients_h

#include "Base/Span.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <vector>

namespace tetralux
{

/// A gradient at a point, in one load.
struct alignas(16) PointGradient
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
TETRALUXCORE_EXPORT std::vector<PointGradient> MakePointGradients(
  const TetrahedralMesh& mesh, Span<const double> scalars, double length, double scalar);

} // namespace tetralux

#endif
