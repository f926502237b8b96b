// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityReport_h
#define tetralux_VisibilityReport_h

#include <cstdint>
#include <vector>

namespace tetralux
{

/// The cycles of a visibility order. A cycle is a set of cells in which each cell occludes the next
/// and the last occludes the first: no order is right for it. To get one, the order ignores some of
/// the faces between these cells.
///
/// Cells that touch without sharing points, and whose coordinates are off by their rounding, may
/// hide slivers of each other in a circle. Without the slivers they have an order, so they are no
/// cycle.
struct VisibilityCycles
{
  /// The cells of all cycles, one cycle after the other, ascending in each. Cycles that have cells
  /// in common are one. Imaginary cells come behind those of the mesh.
  std::vector<std::int32_t> Cells;
  std::vector<std::int64_t> Begins; ///< where each cycle begins in Cells, and the end of the last

  /// Ignored faces, and ignored pairs of boundary faces (MeshedAcrossGaps). Rays through them meet
  /// the two cells in the wrong order. The faces that look smallest are chosen, one by one.
  std::int64_t IgnoredFaces = 0;

  /// How large the ignored faces look: their solid angle in a perspective view, their projected
  /// area in a parallel one.
  double IgnoredArea = 0;

  std::int64_t GetNumberOfCycles() const
  {
    return static_cast<std::int64_t>(this->Begins.empty() ? 0 : this->Begins.size() - 1);
  }
};

} // namespace tetralux

#endif
