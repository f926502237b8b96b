// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoundaryTiles_h
#define tetralux_BoundaryTiles_h

// The boundary of a mesh as a picture's tiles see it, made for each frame.
//
// Where a ray crosses the boundary is decided by the exact tests of RayCastCrossings.h alone. What
// is here only tells which faces the rays of a block have to test: all that any of them may cross
// or come close to. So a picture has the same bits by tiles and by the hierarchy over the boundary.

#include "Base/RawVector.h"
#include "Base/Tile.h"
#include "View/RayGrid.h"
#include "Walk/WalkMesh.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Pixels of a block: of the smallest packet of rays that kernels cast together.
///@{
constexpr int BlockWidth = 4;
constexpr int BlockHeight = 2;
///@}

/// Pixels along a tile's edge: rays of a tile share cells in the first-level cache, and there are
/// enough tiles to balance threads.
constexpr int RayTileSize = 16;

/// Blocks of a tile, row by row.
///@{
constexpr int BlocksAcrossTile = RayTileSize / BlockWidth;
constexpr int BlocksOfTile = BlocksAcrossTile * (RayTileSize / BlockHeight);
///@}
static_assert(BlocksOfTile <= 32, "a bit for each block");

/// A boundary face, and the blocks of one tile whose rays have to test it.
struct TileFace
{
  std::int32_t Entry; ///< index into WalkTables::Entries
  std::uint32_t Blocks;
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
