// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SpatialOrder_h
#define tetralux_SpatialOrder_h

#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Renumbers points and cells along a space-filling curve so that what a ray visits together lies
/// together in memory, drops points that no cell uses, and sorts the four points of each cell by
/// ascending id (what the walk relies on, see RayCastKernel.h). OriginalPoints and OriginalCells
/// afterwards map every point and cell back to the input's ids.
/// Requires a mesh that went through RemoveUnusableCells. Radix sort, parallel, deterministic.
TETRALUXCORE_EXPORT void OrderSpatially(TetrahedralMesh& mesh);

} // namespace tetralux

#endif
