// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HullDepths_h
#define tetralux_HullDepths_h

// The front and the back of hulls in each S-triangle of a picture (Knittel 1999, section 2.1).

#include "Base/Span.h"
#include "Base/Tile.h"
#include "TetraluxCoreModule.h"
#include "TriangleCaster/SlicePlanes.h"
#include "TriangleCaster/VisibleHull.h"
#include "View/RayGrid.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace tetralux
{

/// Depths, as SlicePlanes counts them, that an S-triangle has something visible between.
struct DepthRange
{
  double Front = std::numeric_limits<double>::infinity();
  double Back = -std::numeric_limits<double>::infinity();

  bool IsEmpty() const { return this->Front > this->Back; }

  void Add(double nearest, double farthest)
  {
    this->Front = std::min(this->Front, nearest);
    this->Back = std::max(this->Back, farthest);
  }
};

/// The S-triangle of its tile that a pixel is in: 0 below the diagonal and on it, 1 above it.
/// x, y: from the tile's lower left pixel. Of a tile of 8 x 8 pixels, 36 and 28 are in each.
inline int GetTriangleOfPixel(int x, int y) { return x >= y ? 0 : 1; }

struct HullDepths
{
  TileGrid Tiles;
  std::vector<DepthRange> Triangles; ///< two for each tile
};

/// What the paper's two passes through a depth buffer yield: the nearest and the farthest point of
/// the hulls on the rays of each S-triangle's pixels. On a ray that starts in the box around a hull
/// and meets that hull, the nearest point is its start.
///
/// grid: rays that share their origin or their direction; grid.MeshFromWorld leads to indices of
/// points. planes: of that grid. threads: at least 1; the result does not depend on it. Throws
/// std::invalid_argument, with one line, if the rays share neither or lie in a plane.
TETRALUXCORE_EXPORT HullDepths FindDepthsOfRays(Span<const VisibleHull> hulls, const RayGrid& grid,
  const SlicePlanes& planes, int tileSize, int threads);

/// The same without gaps between rays: bounds of all points of the hulls, and of what they enclose,
/// that are seen in the squares of an S-triangle's pixels in front of the camera. They may be wider
/// than that, by what is seen within a pixel of the squares and by rounding, but never narrower.
TETRALUXCORE_EXPORT HullDepths FindDepthsOfPixels(Span<const VisibleHull> hulls,
  const RayGrid& grid, const SlicePlanes& planes, int tileSize, int threads);

} // namespace tetralux

#endif
