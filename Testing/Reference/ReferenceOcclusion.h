// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceOcclusion_h
#define tetralux_ReferenceOcclusion_h

#include "Base/Span.h"
#include "Mesh/TetrahedralMesh.h"
#include "Visibility/VisibilityView.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Two cells, the first of which is met before the second by some ray.
struct OccludedPair
{
  std::int32_t Front, Back;

  bool operator==(const OccludedPair& other) const
  {
    return this->Front == other.Front && this->Back == other.Back;
  }
  bool operator<(const OccludedPair& other) const
  {
    return this->Front != other.Front ? this->Front < other.Front : this->Back < other.Back;
  }
};

/// Which cells hide which, by brute force: rays go from the viewer through random points
/// of each cell, and are clipped by every cell on its own, in extended precision. Each
/// pair once, ascending. No rays go through cells that are thinner than shortestPart: they may lie
/// in faces of others, where both sides count.
///
/// Parts of a ray inside a cell count from a length of shortestPart on, in diagonals of the mesh's
/// box; so do parts that two cells have in common, for which there is no order.
std::vector<OccludedPair> FindOccludedPairs(const TetrahedralMesh& mesh, const VisibilityView& view,
  int raysPerCell, std::uint64_t seed, double shortestPart = 1e-9);

/// Those pairs that order, front to back, puts the wrong way round; all cells of the
/// pairs must be in it.
std::vector<OccludedPair> FindWrongPairs(
  const std::vector<OccludedPair>& pairs, Span<const std::int32_t> order);

} // namespace tetralux

#endif
