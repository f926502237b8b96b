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

/// Which cells occlude others across empty space: one arrow for each pair of boundary faces of
/// which a ray leaves the mesh by one and then enters it by the other.
struct VisibilityGaps
{
  std::vector<std::int32_t>
    Begins; ///< for each cell where its arrows begin, and the end of the last
  std::vector<std::int32_t> Cells; ///< those that are hidden, ascending for each cell
  std::vector<float> Sizes; ///< how large the common part of the faces looks, see MeasureTriangle

  /// 1 where what the pair has in common, of faces or of rays through the cells, is no more than
  /// what coordinates in single precision may be off by; else 0.
  std::vector<std::uint8_t> Slivers;

  std::int64_t Looked = 0; ///< how many faces were looked at: what finding the gaps took
};

/// Finds all gaps of a view. With them the order of any mesh is exact, also of one that can't be
/// made convex (after Silva, Mitchell and Williams, An Exact Interactive Time Visibility Ordering
/// Algorithm for Polyhedral Cell Complexes, 1998, who sweep the picture).
///
/// Where a face that rays leave by has a twin (FindTwinFaces), that is all that is right behind it,
/// with exact signs. For the others, takes the boundary faces that are at the same place on the
/// picture (FaceBins), and clips them by the cone behind it; for a viewer inside or beside the
/// mesh, those in the cone, from the hierarchy over the boundary. In double precision; only slivers
/// depend on its tolerances. Parallel, the same result for any number of threads.
///
/// Returns false, and no gaps, if there are more than LargestNumberOfGaps for each boundary face.
bool FindGaps(const VisibilityGeometry& geometry, const VisibilityArrows& arrows,
  Span<const std::int32_t> twins, const VisibilityView& view, VisibilityGaps& gaps);

constexpr std::int64_t LargestNumberOfGaps = 64;

} // namespace tetralux

#endif
