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

/// Bits of what VisibilityArrows::Point says of a cell. The lowest four: the cell behind face i is
/// hidden by this one.
constexpr std::uint8_t HidingFaces = 0xf;
/// The viewer sees a face of the cell that is on the boundary from outside: rays enter here.
constexpr std::uint8_t EnteredCell = 0x10;

/// Which cells hide their neighbours: the arrows of Williams, Visibility Ordering Meshed Polyhedra,
/// 1992, section 4. Of two cells with a common face, the one on the viewer's side of its plane
/// hides the other. Where the viewer is in that plane there is no arrow.
///
/// On which side of its faces a cell lies is said by the sign of its volume, exactly. A flat cell
/// has none, and a slightly inverted one the wrong one: both lie between cells that are larger, and
/// pass on the order among those, if they are turned as these are. So where two neighbours do not
/// agree about a face, the larger one turns the smaller one. Cells that overlap beyond that, and
/// flat cells that have only flat neighbours, have no arrows through the faces in question.
class VisibilityArrows
{
public:
  /// Takes part of what geometry refers to, which must outlive this. Parallel but for the cells in
  /// question; the same result for any number of threads.
  explicit VisibilityArrows(const VisibilityGeometry& geometry);

  /// Fills one byte for each cell: HidingFaces and EnteredCell. Parallel.
  void Point(const VisibilityView& view, Span<std::uint8_t> arrows) const;

  /// On which side of a boundary face its cell lies: 1 where the face's points run
  /// counter-clockwise as seen from there, -1 where clockwise, 0 where that is not known.
  int GetBoundarySide(const WalkEntry& entry) const;

  std::size_t GetSize() const { return this->Sides.size(); } ///< bytes

private:
  class ClearTurns;
  void TurnCells();
  void JoinFaces();

  VisibilityGeometry Geometry;
  /// For each cell: the lowest four bits are set where face i has a neighbour that agrees about it;
  /// above them is how its volume is to be taken in the order of its points, and whether it has
  /// faces on the boundary.
  std::vector<std::uint8_t> Sides;
};

} // namespace tetralux

#endif
