// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WalkTables_h
#define tetralux_WalkTables_h

#include "Base/RawVector.h"
#include "Base/Span.h"
#include "Hierarchy/BoundaryBvh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A point as the walk reads it: in one load. Coordinates relative to the mesh's centre, in units
/// of its radius; the scalar as SetPointScalars was asked for.
template <class Real>
struct alignas(4 * sizeof(Real)) WalkPoint
{
  Real X, Y, Z, S;
};

/// What lies behind one face of a cell, in one load of eight bytes.
struct WalkFace
{
  std::int32_t Cell; ///< the cell behind (a_{t,i} of the paper), or ~b at boundary face b
  /// That cell's point opposite to the face; at the boundary that of the face's own cell.
  std::int32_t Point;
};

/// A boundary face and the cell it belongs to. Points ascending.
struct WalkEntry
{
  std::int32_t Points[3];
  std::int32_t Cell;
  std::int32_t Opposite; ///< the cell's fourth point
};

/// The topology that rays are walked through: of all cells, or of those that can be seen.
struct WalkTables
{
  RawVector<WalkFace> Faces;      ///< four for each cell, face i opposite to its i-th point
  std::vector<WalkEntry> Entries; ///< the boundary faces
  BoundaryBvh Bvh;                ///< over the entries

  std::size_t GetSize() const; ///< bytes
};

/// Numbers the boundary of the cells that are selected, and finds the way in. In faces, Cell is
/// negative on the boundary of the mesh; a face with a cell behind it that is not selected becomes
/// boundary, too. cells: four ascending point ids each. selected: one flag a cell; empty: all.
/// Parallel but for the tree, the same result for any number of threads.
TETRALUXCORE_EXPORT WalkTables MakeWalkTables(RawVector<WalkFace> faces,
  Span<const std::int32_t> cells, Span<const WalkPoint<float>> points,
  Span<const std::uint8_t> selected = {});

/// Fits the boxes over the boundary to points that moved; all else stays.
TETRALUXCORE_EXPORT void RefitWalkTables(WalkTables& tables, Span<const WalkPoint<float>> points);

} // namespace tetralux

#endif
