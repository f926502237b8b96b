// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityCycles_h
#define tetralux_VisibilityCycles_h

#include "Base/RadixSort.h"
#include "Base/Span.h"
#include "Visibility/VisibilityGaps.h"
#include "Visibility/VisibilityGeometry.h"
#include "Visibility/VisibilityReport.h"
#include "Visibility/VisibilityView.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Sorts all cells of a mesh, farthest first, although their arrows form cycles.
///
/// Cells of a cycle come one after the other. Among them arrows are ignored until there is no
/// cycle: those into one cell at a time, the cell whose arrows look smallest together. So the order
/// is right for any two cells that are not both in one cycle. The smallest set of arrows would be a
/// minimum feedback arc set, which is NP-hard. This is the heuristic of Eades, Lin and Smyth, A
/// Fast and Effective Heuristic for the Feedback Arc Set Problem, 1993, with weights. Slivers
/// (VisibilityGaps.h) are ignored first; what is in order without them is no cycle.
///
/// gaps: arrows across empty space, or none. roots: cells to begin with, in this order, before the
/// others; see VisibilityOrder. Linear time, and n log n in the size of a cycle.
std::vector<std::int32_t> SortWithCycles(const VisibilityGeometry& geometry,
  const VisibilityView& view, Span<const std::uint8_t> arrows, const VisibilityGaps& gaps,
  Span<const KeyedItem> roots, VisibilityCycles& cycles);

} // namespace tetralux

#endif
