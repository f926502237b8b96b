// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellOrientation_h
#define tetralux_CellOrientation_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkTables.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Orients the cells of a mesh, so that neighbours see the face that they share from opposite
/// sides, inverted cells and those of no volume among them: for each cell 1 where the order of its
/// ascending points is the positive one, 0 where it is the negative one; empty where there is no
/// such orientation (cells in a ring that comes back mirrored, which no mesh in space without
/// overlaps has). Of each connected part most of the volume is oriented as it is in space.
///
/// A ray that walks from cell to cell crosses every face in the direction of this orientation: it
/// comes in through boundary faces that are seen from one side and leaves through those seen from
/// the other, whatever the cells between them look like.
///
/// points: three coordinates each. cells: four ascending point ids each. faces: as in WalkTables,
/// of the whole mesh. Linear time; parallel where every cell has a volume and none is inverted.
TETRALUXCORE_EXPORT std::vector<std::uint8_t> OrientCells(
  Span<const double> points, Span<const std::int32_t> cells, Span<const WalkFace> faces);

} // namespace tetralux

#endif
