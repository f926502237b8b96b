// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityArrows_h
#define tetralux_VisibilityArrows_h

#include "Base/Span.h"
#include "Visibility/VisibilityGeometry.h"
#include "Visibility/VisibilityView.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Bits that VisibilityArrows::Point sets for a cell. Bit i of the lowest four: the cell occludes
/// the cell behind its face i.
constexpr std::uint8_t HidingFaces = 0xf;
/// The viewer sees a boundary face of the cell from outside: rays enter here.
constexpr std::uint8_t EnteredCell = 0x10;

/// Which cells occlude their neighbours: the arrows of Williams, Visibility Ordering Meshed
/// Polyhedra, 1992, section 4. Of two cells with a common face, the one on the viewer's side of its
/// plane occludes the other. There is no arrow if the viewer is in that plane.
///
/// The sign of a cell's volume, which is exact, says on which side of its faces it lies. A flat
/// cell has no sign, and a slightly inverted one the wrong sign. Both lie between larger cells and
/// pass on the order among those, if they are turned as these are: where two neighbours do not
/// agree about a face, the larger one turns the smaller one. Cells that overlap beyond that, and
/// flat cells that have only flat neighbours, have no arrows through these faces.
class VisibilityArrows
{
public:
  /// What geometry refers to must outlive this. Parallel, except for cells that are turned. The
  /// same result for any number of threads.
  explicit VisibilityArrows(const VisibilityGeometry& geometry);

  /// Fills one byte for each cell: HidingFaces and EnteredCell. Parallel.
  void Point(const VisibilityView& view, Span<std::uint8_t> arrows) const;

  /// The side of a boundary face on which its cell lies: 1 if the face's points run
  /// counter-clockwise as seen from there, -1 if clockwise, 0 if that is not known.
  int GetBoundarySide(const WalkEntry& entry) const;

  std::size_t GetSize() const { return this->Sides.size(); } ///< bytes

private:
  class ClearTurns;
  void TurnCells();
  void JoinFaces();

  VisibilityGeometry Geometry;
  /// For each cell: the lowest four bits are set if face i has a neighbour that agrees about it.
  /// The bits above hold the sign of its volume, and whether it has faces on the boundary.
  std::vector<std::uint8_t> Sides;
};

} // namespace tetralux

#endif
