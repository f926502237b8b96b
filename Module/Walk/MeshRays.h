// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshRays_h
#define tetralux_MeshRays_h

#include "Base/Span.h"
#include "Integral/RaySegments.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkMesh.h"

namespace tetralux
{

/// Straight lines through a mesh: through any place in random cells, in random directions, so that
/// more of them pass where cells are small, as where a camera looks closely. Of a thousand rays, or
/// fewer where they have 100,000 segments in all. Cells that touch a scalar which is not finite are
/// left out. scalars: one for each point of WalkMesh::GetMesh(), or ofCells, one for each cell.
/// scale: world units of a length in the mesh. The same lines for the same mesh, for any number of
/// threads. Some 20 milliseconds of one thread.
TETRALUXCORE_EXPORT RaySample DrawMeshRays(
  const WalkMesh& mesh, Span<const double> scalars, double scale, bool ofCells = false);

} // namespace tetralux

#endif
