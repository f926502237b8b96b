// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PaperTraversal_h
#define tetralux_PaperTraversal_h

#include "Hierarchy/MinMaxTree.h"
#include "Isosurface/Isopolygon.h"
#include "View/RayGrid.h"

#include <cstdint>

namespace tetralux
{

/// What a packet's traversal takes of Wald et al. 2007, section 5.2.
struct PaperIdeas
{
  /// I: nodes whose range does not hold a value are culled, and a packet goes down to the next node
  /// both of whose children hold one before it is tested against a box. Off: they are culled, but
  /// each node on the way is tested against its box.
  bool Bifurcations = true;

  /// II: a node is entered where the first active ray hits its box.
  bool SpeculativeDescent = true;

  /// III: a node is left where intervals of the rays' directions and distances miss its box. What
  /// is behind the farthest hit of all rays is missed. A polygon is left where the four corner rays
  /// are all outside of one edge (section 4.3).
  bool FrustumTest = true;

  /// IV: the first ray that hits a node's box is the first one tested below it. Off: a ray that
  /// hits is looked for among all of them, and all are tested below. With II off, too, each ray is
  /// tested against each box, as where one instruction does so for a small packet.
  bool FirstActiveRay = true;

  /// V: of a leaf's cells those are skipped whose own range does not hold a value. Off: each is
  /// extracted to see whether it has a polygon.
  bool CellRanges = true;
};

/// What packets did, in numbers of table 4. None depends on the threads.
struct PaperCounts
{
  std::int64_t Packets = 0;
  std::int64_t NodeRangeTests = 0; ///< by a packet
  std::int64_t CellRangeTests = 0; ///< the same, of the cells of leaves
  std::int64_t RayBoxTests = 0;    ///< by single rays
  std::int64_t BoxFrustumTests = 0;
  std::int64_t BoxFrustumMisses = 0;
  std::int64_t Extractions = 0;
  std::int64_t PolygonFrustumTests = 0;
  std::int64_t PolygonFrustumMisses = 0;
  std::int64_t RayPolygonTests = 0; ///< by single rays
  std::int64_t Hits = 0;            ///< rays with one

  void Add(const PaperCounts& other);
};

/// Traces a picture's rays to the first surface as the paper does, in packets of packetEdge^2 rays
/// of neighbouring pixels, and counts. It is a measuring tool: scalar code in double precision,
/// without the tracer's tricks. packetEdge: 1 ... MaximumPacketEdge.
///
/// Children are visited by the order of their middles along the first active ray. A leaf's box is
/// tested by III alone, and as that of any other node where III is off.
///
/// tree, ranges: with the coordinates of source.Frame. grid: of a common origin. But for rounding,
/// hits are the same for all packets and ideas. Throws std::invalid_argument if rays have no common
/// origin.
PaperCounts TraceAsPaper(const MinMaxTree& tree, const MinMaxRanges& ranges,
  const IsopolygonSource& source, const RayGrid& grid, int packetEdge, const PaperIdeas& ideas);

constexpr int MaximumPacketEdge = 32;

} // namespace tetralux

#endif
