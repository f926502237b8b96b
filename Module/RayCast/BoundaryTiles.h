// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoundaryTiles_h
#define tetralux_BoundaryTiles_h

// The boundary of a mesh as a picture's tiles see it, made for each frame.
//
// Where a ray crosses the boundary is decided by the exact tests of RayCastCrossings.h alone. What
// is here only tells which faces a packet has to test: all that any of its rays may cross or come
// close to. So a picture has the same bits by tiles and by the hierarchy over the boundary.

#include "Base/RawVector.h"
#include "Base/Tile.h"
#include "Simd/LaneCount.h"
#include "View/RayGrid.h"
#include "Walk/WalkMesh.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Pixels of a packet, whose rays are cast together, one in each lane. Nearly square, so that the
/// rays stay in the same cells for long.
///@{
constexpr int PacketWidth = 4;
constexpr int PacketHeight = LaneCount / PacketWidth;
///@}
static_assert(PacketWidth * PacketHeight == LaneCount, "a ray for each lane");

/// Pixels along a tile's edge: rays of a tile share cells in the first-level cache, and there are
/// enough tiles to balance threads.
constexpr int RayTileSize = 16;

/// Packets of a tile, row by row.
///@{
constexpr int PacketsAcrossTile = RayTileSize / PacketWidth;
constexpr int PacketsOfTile = PacketsAcrossTile * (RayTileSize / PacketHeight);
///@}
static_assert(PacketsOfTile <= 32, "a bit for each packet");

/// A boundary face, and the packets of one tile that have to test it.
struct TileFace
{
  std::int32_t Entry; ///< index into WalkTables::Entries
  std::uint32_t Packets;
};

struct BoundaryTiles
{
  TileGrid Grid;
  std::vector<std::int32_t> Begins; ///< of each tile's faces, and the end of the last one's
  RawVector<TileFace> Faces;
};

/// Sorts the boundary faces of tables into the tiles of a picture. Returns false where that is not
/// possible: a part of the mesh is beside or behind the eye, rays have neither an eye nor a
/// direction in common, or numbers overflow. Cost: about as much for 50 faces as casting a ray.
/// Parallel; the same result for any number of threads.
bool MakeBoundaryTiles(const WalkMesh& mesh, const WalkTables& tables, const RayGrid& grid,
  int threads, BoundaryTiles& tiles);

} // namespace tetralux

#endif
