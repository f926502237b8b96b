// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PlacedTrees_h
#define tetralux_PlacedTrees_h

#include "Base/RawVector.h"
#include "Isosurface/ActiveTree.h"
#include "Isosurface/IsosurfaceKernel.h"

#include <cstddef>
#include <cstdint>
#include <deque>

namespace tetralux
{

/// The PlacedTrees of a picture, in memory that those of the next picture use again.
class PlacedTrees
{
public:
  /// Forgets the trees of the picture before. active: not empty; must outlive the trees.
  void Start(const ActiveTree& active);

  /// Adds a tree, to be filled: nullptr if there is no room for it. frame and limits must outlive
  /// Fill. bounds: of all rays, least u and v, then largest u and v.
  const PlacedTree* Add(
    const RayFrame& frame, const TraceLimits& limits, const double (&bounds)[4]);

  /// Fills the trees. tree: that of active. threads is at least 1; the trees are the same for any
  /// number.
  void Fill(const TraceTree& tree, PlaceKernel kernel, int threads);

private:
  struct alignas(64) Room
  {
    char Bytes[PlacedPolygonBytes];
  };

  struct Entry
  {
    const RayFrame* Frame;
    const TraceLimits* Limits;
    double Bounds[4]; ///< of rays
    PlacedTree Tree;
    RawVector<PlacedBounds> BoundsOfNodes;
    RawVector<PlacedBounds> BoundsOfPolygons;
    RawVector<Room> Polygons;
  };

  std::deque<Entry> Entries; ///< the first Count are of this picture
  std::size_t Count = 0;
  std::size_t Nodes = 0;    ///< of each tree
  std::size_t Polygons = 0; ///< the same
};

} // namespace tetralux

#endif
