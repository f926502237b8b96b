// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MinMaxTree_h
#define tetralux_MinMaxTree_h

#include "Base/Span.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A bounding volume hierarchy over the tetrahedra of a mesh. With MinMaxRanges it is the implicit
/// hierarchy of Wald, Friedrich, Knoll and Hansen, Interactive Isosurface Ray Tracing of
/// Time-Varying Tetrahedral Volumes, 2007, section 5: one tree finds the cells of any isosurface.
struct MinMaxTree
{
  /// Depth of the tree is at most this, so that a traversal's stack has a fixed size; the root's is
  /// 0. A mesh has less than 2^29 cells, which 29 levels halve by number down to one cell. That
  /// leaves 35 levels where cells are divided unevenly.
  static constexpr int MaximumDepth = 64;

  /// A box around cells. Count > 0: a leaf with Cells[First ... First + Count). Count == 0: an
  /// inner node; its children are the next node and node First.
  struct alignas(32) Node
  {
    float Lower[3];
    float Upper[3];
    std::int32_t First;
    std::int32_t Count;
  };

  /// The least and the largest scalar of a node's cells, in the steps of MinMaxRanges. Least >
  /// Largest: no cell has finite scalars.
  struct Range
  {
    std::uint16_t Least;
    std::uint16_t Largest;
  };

  std::vector<Node> Nodes;         ///< depth first, the root first; empty without cells
  std::vector<std::int32_t> Cells; ///< cell ids in the order of the leaves
};

/// The ranges of one time step, apart from the boxes: steps of a mesh that does not move share one
/// tree, and cost 4 bytes a node each (section 6 of the paper).
struct MinMaxRanges
{
  /// Steps of finite scalars are in 0 ... LargestStep.
  static constexpr std::int32_t LargestStep = 65534;

  /// The step of a scalar is (scalar - Offset) * Scale, rounded down. Both are finite. A difference
  /// that overflows is cut to the largest number.
  double Offset = 0;
  double Scale = 1;

  std::vector<MinMaxTree::Range> Nodes; ///< one for each node of the tree

  /// The step of any value, cut to -1 ... LargestStep + 1; -1 for what is not a number. The larger
  /// of two values never has the smaller step, so that a value between two scalars has a step
  /// between theirs.
  TETRALUXCORE_EXPORT std::int32_t GetStep(double value) const;

  /// Whether a node may have cells that the surface of a value crosses. false only if each of its
  /// cells has all scalars below the value or all above it, or one that is not finite.
  static bool Holds(MinMaxTree::Range range, std::int32_t stepOfValue)
  {
    return range.Least <= stepOfValue && stepOfValue <= range.Largest;
  }
};

/// How the cells of a node are divided.
enum class TreeBuild
{
  /// At the middle of the longest edge of the box around the cells' middles, in the style of
  /// Waechter and Keller, Instant Ray Tracing: The Bounding Interval Hierarchy, 2006.
  SpatialMedian,
  /// Where the surface area heuristic expects the least cost, among 15 planes along each axis
  /// (Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007). The paper sweeps
  /// over all cells instead, which takes a sort at each node.
  SurfaceArea
};

struct MinMaxTreeOptions
{
  TreeBuild Build = TreeBuild::SpatialMedian;
  int LeafSize = 8;        ///< cells of a leaf at most; at least 1
  int NumberOfThreads = 0; ///< 0: as many as OpenMP offers
};

/// Builds the tree over all cells of a mesh whose points are finite.
/// center, radius: boxes are of (x - center) / radius, in single precision, rounded outward. radius
/// is more than 0, in the units of the mesh. The same tree for any number of threads.
TETRALUXCORE_EXPORT MinMaxTree BuildMinMaxTree(const TetrahedralMesh& mesh, const double center[3],
  double radius, const MinMaxTreeOptions& options);

/// Fits the boxes to points that moved; which cells a node has stays. The tree is as right as a new
/// one, and slower as far as cells of a node moved apart. mesh: with the cells that the tree was
/// built from. Linear time.
/// center, radius, numberOfThreads: as for BuildMinMaxTree.
TETRALUXCORE_EXPORT void RefitMinMaxTree(MinMaxTree& tree, const TetrahedralMesh& mesh,
  const double center[3], double radius, int numberOfThreads);

/// Finds the ranges of all nodes. scalars: one for each point of the mesh. A cell that touches a
/// scalar which is not finite counts for nothing. Linear time; the same ranges for any number of
/// threads, where 0 is as many as OpenMP offers.
TETRALUXCORE_EXPORT MinMaxRanges MakeMinMaxRanges(const MinMaxTree& tree,
  const TetrahedralMesh& mesh, Span<const double> scalars, int numberOfThreads);

} // namespace tetralux

#endif
