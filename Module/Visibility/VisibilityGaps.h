// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityGaps_h
#define tetralux_VisibilityGaps_h

#include "Visibility/VisibilityArrows.h"
#include "Visibility/VisibilityGeometry.h"
#include "Visibility/VisibilityView.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Which cells hide which others across empty space: one for each pair of boundary faces of which a
/// ray leaves the mesh by one and then enters it by the other.
struct VisibilityGaps
{
  std::vector<std::int32_t>
    Begins; ///< for each cell where its arrows begin, and the end of the last
  std::vector<std::int32_t> Cells; ///< those that are hidden, ascending for each cell
  std::vector<float> Sizes; ///< how large the common part of the faces looks, see MeasureTriangle
};

/// Finds them all, which makes the order of any mesh exact, also one that can't be made convex
/// (after Silva, Mitchell and Williams, An Exact Interactive Time Visibility Ordering Algorithm for
/// Polyhedral Cell Complexes, 1998, who sweep the picture): what is in the cone behind each face
/// that rays leave by, by the hierarchy over the boundary, and clipped by the cone. In double
/// precision with tolerances, which nothing but slivers depends on. Parallel, the same result for
/// any number of threads.
///
/// False, and nothing, where there are more than LargestNumberOfGaps for each boundary face.
bool FindGaps(const VisibilityGeometry& geometry, const VisibilityArrows& arrows,
  const VisibilityView& view, VisibilityGaps& gaps);

constexpr std::int64_t LargestNumberOfGaps = 64;

} // namespace tetralux

#endif
