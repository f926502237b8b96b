// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CoincidentPoints_h
#define tetralux_CoincidentPoints_h

#include "Base/Span.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Points of an input that are at the place of an earlier one.
struct CoincidentPoints
{
  std::vector<std::int64_t> Points; ///< ids of the input, ascending
  std::vector<std::int64_t> Firsts; ///< for each the point with the smallest id at that place
  double Distance = 0; ///< what coordinates were allowed to differ by, units of the mesh

  bool operator==(const CoincidentPoints& other) const
  {
    return this->Points == other.Points && this->Firsts == other.Firsts;
  }
};

/// Finds which points of a mesh are at the same place as others. candidates: ids of the mesh, each
/// once. Added points (TetrahedralMesh::OriginalPoints below 0) and points with a coordinate that
/// is not finite are left out. tolerance: largest difference of a coordinate, as a share of the
/// largest coordinate of the candidates; points that differ by more are together where others
/// connect them. If a cell would lose a point by that, only points whose coordinates are the same
/// exactly are together. Linear time but where many points are within a few tolerances of each
/// other; deterministic.
TETRALUXCORE_EXPORT CoincidentPoints FindCoincidentPoints(
  const TetrahedralMesh& mesh, Span<const std::int32_t> candidates, double tolerance);

} // namespace tetralux

#endif
