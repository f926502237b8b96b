// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshCleaning_h
#define tetralux_MeshCleaning_h

#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

/// What RemoveUnusableCells took out, one count for each reason; a cell is counted once, under the
/// first reason that applies in the order of the members.
struct RemovedCells
{
  std::int64_t InvalidPointIds = 0;      ///< names a point that does not exist
  std::int64_t NonFiniteCoordinates = 0; ///< a corner is infinite or not a number
  std::int64_t RepeatedPoints = 0;       ///< two corners are the same point id
  std::int64_t Duplicates = 0;           ///< the same four points as an earlier cell, in any order
  std::int64_t Total() const
  {
    return this->InvalidPointIds + this->NonFiniteCoordinates + this->RepeatedPoints +
      this->Duplicates;
  }
};

/// Removes the cells that no ray can be walked through, keeping the order of the others; points
/// stay (their ids do not change). OriginalCells is filled when something is removed. Cells of zero
/// or negative volume are kept: they connect their neighbours.
/// Linear expected time, parallel, the same result for any number of threads.
TETRALUXCORE_EXPORT RemovedCells RemoveUnusableCells(TetrahedralMesh& mesh);

} // namespace tetralux

#endif
