// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityOrder_h
#define tetralux_VisibilityOrder_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "Visibility/VisibilityReport.h"
#include "Visibility/VisibilityView.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tetralux
{

class WalkMesh;

/// How cells are ordered.
enum class VisibilityMethod
{
  /// By common faces, exactly: meshed polyhedra visibility ordering (MPVO) of Williams, Visibility
  /// Ordering Meshed Polyhedra, 1992, section 4. Exact for meshes that are convex or were made so.
  /// Nothing orders cells across empty space, unless imaginary cells fill it
  /// (WalkMesh::MakeConvex).
  Meshed,

  /// The same for meshes that are not convex (MPVONC, section 6). Exact across common faces. Across
  /// empty space a guess: cells that rays enter come first, ordered by the distances of their
  /// centroids. The guess is wrong if such a cell has a nearer centroid than what is in front of
  /// it, or if it lies behind a part that rays enter in several places.
  MeshedNonConvex,

  /// By common faces, and by pairs of boundary faces of which rays leave the mesh by one and enter
  /// it by the other (VisibilityGaps.h). Exact for any mesh, also where cells touch without sharing
  /// points; but for slivers where those are off by the rounding of single precision. The pairs are
  /// found anew for each view, which takes several times as long as the rest; Meshed is faster for
  /// a mesh that can be made convex. Falls back to MeshedNonConvex, which GetUsedMethod tells, if
  /// there are more than 64 pairs for each boundary face.
  MeshedAcrossGaps,

  /// By the distances of the cells' centroids; equal distances in the order of the cells. The
  /// fastest method. Guarantees the order of no pair of cells.
  CentroidDistance
};

enum class VisibilityDirection
{
  FrontToBack,
  BackToFront
};

/// Sorts the cells of a mesh into visibility order: of two cells of which one occludes a part of
/// the other, the one in front comes first (FrontToBack) or last (BackToFront).
///
/// Of two cells with a common face, the one on the viewer's side of the face's plane is in front.
/// The sign is exact for the coordinates in double precision, without tolerances. A viewer in
/// the plane of a face sees nothing through it, and the face orders nothing. Cells without volume
/// and slightly inverted cells take part as if they had a little volume. The viewer may be inside
/// the mesh.
///
/// Cells that overlap have no order that is right for all rays. What neither faces nor gaps order
/// is ordered as in MeshedNonConvex: the cell that rays enter whose centroid is farthest is placed
/// behind all others, with all that it hides, then of those that are left the next one. What rays
/// enter nowhere, as around a viewer who is inside of all parts, comes in the order of the cells.
class TETRALUXCORE_EXPORT VisibilityOrder
{
public:
  /// imaginaryCells: whether to use the convex tables of the mesh, if it has some. The mesh must be
  /// made convex before, and must outlive this. Takes a byte a cell, and a copy of the imaginary
  /// cells. Parallel.
  explicit VisibilityOrder(const WalkMesh& mesh, bool imaginaryCells = true);
  ~VisibilityOrder();
  VisibilityOrder(VisibilityOrder&&) noexcept;
  VisibilityOrder& operator=(VisibilityOrder&&) noexcept;

  /// Returns the cells in order, without imaginary cells. Valid until the next call.
  ///
  /// drawn: one flag for each cell of the mesh, whether the result has it; empty: all. The other
  /// cells still order their neighbours, except by CentroidDistance.
  ///
  /// Linear time. Keeps nine bytes a cell (CentroidDistance: 20) for the next call, and 16 more if
  /// there are cycles. The same result for any number of threads.
  const std::vector<std::int32_t>& Sort(const VisibilityView& view, VisibilityMethod method,
    VisibilityDirection direction, Span<const std::uint8_t> drawn = {});

  /// The method by which the last Sort was made.
  VisibilityMethod GetUsedMethod() const { return this->UsedMethod; }

  /// The cycles that the last Sort met. CentroidDistance does not look for them.
  const VisibilityCycles& GetCycles() const { return this->Cycles; }

  /// How many faces the last Sort looked at to find gaps: what that took.
  std::int64_t GetLooksForGaps() const { return this->LooksForGaps; }

  /// Whether Meshed is exact: the mesh is convex, or its imaginary cells are used. False before
  /// WalkMesh::MakeConvex was tried.
  bool IsConvex() const;

  std::size_t GetSize() const; ///< bytes of all tables and buffers

private:
  class Internals;
  std::unique_ptr<Internals> Tables;
  VisibilityCycles Cycles;
  VisibilityMethod UsedMethod = VisibilityMethod::Meshed;
  std::int64_t LooksForGaps = 0;
  std::vector<std::int32_t> Order;
};

} // namespace tetralux

#endif
