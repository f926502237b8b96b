// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WalkTexels_h
#define tetralux_WalkTexels_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkTables.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// The boundary of a mesh as a graphics card reads it. The rest of a walk's tables is read as it
/// is: WalkTables::Faces as texels of two integers, 32 bytes a tetrahedron, and WalkPoint<float> as
/// texels of four floats, 16 bytes a point.
struct WalkTexels
{
  /// Four for each boundary face, in the order of the hierarchy's leaves: its points, and its index
  /// in WalkTables::Faces. A ray comes in through a face whose points are counter-clockwise in a
  /// right-handed frame with z along the ray, and leaves where they are clockwise.
  std::vector<std::int32_t> Entries;

  /// Two texels of four floats for each node of the hierarchy, depth first: middle and half edges
  /// of its box, and two that are 0.
  std::vector<float> Boxes;

  /// Two for each node: of an inner one its second child, the first one being the next node, and 0;
  /// of a leaf 0, and 8 x its first entry + their number.
  std::vector<std::int32_t> Links;
};

/// cells: four ascending point ids each. positive: as OrientCells tells; empty: all faces keep
/// their ascending points, where it does not matter whether rays come in or leave.
TETRALUXCORE_EXPORT WalkTexels MakeWalkTexels(
  const WalkTables& tables, Span<const std::uint8_t> positive);

} // namespace tetralux

#endif
