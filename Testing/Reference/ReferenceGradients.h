// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceGradients_h
#define tetralux_ReferenceGradients_h

#include "ReferenceClipping.h"
#include "ReferenceMesh.h"
#include "ReferenceVector.h"

#include <vector>

namespace tetralux
{
namespace reference
{

/// Along the gradient of the scalar in a cell, in mesh coordinates, of any length.
Vector FindGradient(const Cell& cell);

/// The mean gradient of the cells at each point, weighted by their volumes.
std::vector<Vector> FindPointGradients(const ReferenceMesh& mesh);

/// Between the gradients of a cell's points, at a position.
Vector InterpolateGradient(
  const Cell& cell, const std::vector<Vector>& pointGradients, const Vector& position);

} // namespace reference
} // namespace tetralux

#endif
