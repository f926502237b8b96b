// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoundaryBvh_h
#define tetralux_BoundaryBvh_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A bounding volume hierarchy over the boundary triangles of a mesh. Where a ray enters and leaves
/// a mesh, of any shape, is found with it.
struct BoundaryBvh
{
  /// Depth of the tree is at most this, so that a traversal's stack has a fixed size: below
  /// MaximumSahDepth nodes are halved by number, which ends after 31 more levels.
  static constexpr int MaximumSahDepth = 40;
  static constexpr int MaximumDepth = MaximumSahDepth + 32;

  /// Box of a node by its middle and half edges. Count > 0: a leaf with Triangles[First ...
  /// First + Count). Count == 0: an inner node; its children are the next node and node First.
  struct alignas(32) Node
  {
    float Center[3];
    float Half[3];
    std::int32_t First;
    std::int32_t Count;
  };

  std::vector<Node> Nodes;             ///< depth first, the root first; empty without triangles
  std::vector<std::int32_t> Triangles; ///< triangle ids in the order of the leaves
};

/// Builds the tree by the surface area heuristic over 16 bins (Wald, On fast Construction of
/// SAH-based Bounding Volume Hierarchies, 2007).
/// points: four floats each, x y z and one that is not looked at. triangles: three point ids each.
/// margin: what every box is grown by on each side, in the units of the points.
/// Parallel; the same tree for any number of threads.
TETRALUXCORE_EXPORT BoundaryBvh BuildBoundaryBvh(
  Span<const float> points, Span<const std::int32_t> triangles, float margin);

/// Fits the boxes of a tree to points that moved; which triangles a node has stays. The tree is as
/// right as a new one, and slower as far as triangles of a node moved apart. Linear time.
/// points, triangles, margin: as for BuildBoundaryBvh.
TETRALUXCORE_EXPORT void RefitBoundaryBvh(
  BoundaryBvh& bvh, Span<const float> points, Span<const std::int32_t> triangles, float margin);

} // namespace tetralux

#endif
