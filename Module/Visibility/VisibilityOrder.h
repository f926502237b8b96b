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
  /// By the faces that cells have in common, exactly: meshed polyhedra visibility ordering (MPVO)
  /// of Williams, Visibility Ordering Meshed Polyhedra, 1992, section 4. Where there is empty space
  /// between cells, nothing says which of them is in front, unless imaginary cells fill it
  /// (WalkMesh::MakeConvex): exact for meshes that are convex or were made so.
  Meshed,

  /// The same for meshes that are not convex (MPVONC, section 6): what is seen first are those
  /// cells that rays enter, ordered by the distances of their centroids. Exact across common faces;
  /// across empty space a guess, which is wrong where a cell that is entered has a nearer centroid
  /// than what is in front of it, or lies behind a part that is entered in several places.
  MeshedNonConvex,

  /// Exact for any mesh: by common faces, and by pairs of boundary faces of which rays leave the
  /// mesh by one and enter it by the other (VisibilityGaps.h). They are found anew for each view,
  /// which takes several times what everything else takes; a mesh that can be made convex is
  /// ordered faster by Meshed. As MeshedNonConvex, which GetUsedMethod tells, where there are more
  /// than 64 such pairs for each boundary face.
  MeshedAcrossGaps,

  /// By the distances of the cells' centroids: the fastest, and right for no pair of cells but by
  /// chance; equal distances in the order of the cells.
  CentroidDistance
};

enum class VisibilityDirection
{
  FrontToBack,
  BackToFront
};

/// In which order cells have to be drawn: of each two of which one hides a part of the other, the
/// one in front comes before the other, or behind it.
///
/// Of two cells with a common face, the one on the viewer's side of the face's plane is in front:
/// exact signs decide that, from the coordinates in double precision, so an order is never a matter
/// of tolerances. A viewer in the plane of a face sees nothing through it, and it orders nothing.
/// Cells of zero volume and slightly inverted ones take part as if they had a little volume; where
/// cells overlap, the order among them is not defined. With the viewer inside the mesh, the cells
/// around are ordered as well.
class TETRALUXCORE_EXPORT VisibilityOrder
{
public:
  /// imaginaryCells: whether to use the convex tables of the mesh, where it has some; it
  /// must be made convex before, and outlive this. A byte a cell, and a copy of the
  /// imaginary cells. Parallel.
  explicit VisibilityOrder(const WalkMesh& mesh, bool imaginaryCells = true);
  ~VisibilityOrder();
  VisibilityOrder(VisibilityOrder&&) noexcept;
  VisibilityOrder& operator=(VisibilityOrder&&) noexcept;

  /// The cells in order. drawn: one flag for each cell of the mesh, whether it is wanted in the
  /// result; empty: all. The others order their neighbours all the same (but not by
  /// CentroidDistance). Imaginary cells are never in the result. Valid until the next call.
  ///
  /// Linear time. Nine bytes a cell (CentroidDistance: 20), kept for the next call, and 16 more
  /// where there are cycles. The same result for any number of threads.
  const std::vector<std::int32_t>& Sort(const VisibilityView& view, VisibilityMethod method,
    VisibilityDirection direction, Span<const std::uint8_t> drawn = {});

  /// By which method the last Sort was made.
  VisibilityMethod GetUsedMethod() const { return this->UsedMethod; }

  /// What kept the last Sort from being right. None by CentroidDistance, which does not
  /// look for them.
  const VisibilityCycles& GetCycles() const { return this->Cycles; }

  /// Whether Meshed is exact: the mesh is convex, or its imaginary cells are used. Nobody knows
  /// before the mesh was tried to make convex.
  bool IsConvex() const;

  std::size_t GetSize() const; ///< bytes of all tables and buffers

private:
  class Internals;
  std::unique_ptr<Internals> Tables;
  VisibilityCycles Cycles;
  VisibilityMethod UsedMethod = VisibilityMethod::Meshed;
  std::vector<std::int32_t> Order;
};

} // namespace tetralux

#endif
