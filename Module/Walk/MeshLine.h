// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshLine_h
#define tetralux_MeshLine_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// What a straight line goes through of one cell. Lengths are those of the mesh's tables.
struct LinePassage
{
  std::int32_t Cell;

  /// Where the line meets the faces of the cell: distances from its point. Of an inverted cell the
  /// end is before the begin, and of one that is seen edge-on they may be the same.
  double Begin, End;

  double Front, Back; ///< scalars there; that of the cell where scalars are of cells

  /// Tangents of the angles between the line and the normals of both faces.
  double FrontSlope, BackSlope;

  double Gradient; ///< change of the scalar across the line
  double Volume;   ///< of the cell, six times
  bool First;      ///< the line enters the mesh here
  bool Last;       ///< and leaves it here
};

/// A straight line through a mesh, in double precision: the walk of RayCastKernel.inl for one line,
/// by the sides on which it passes edges. Signs are exact for the corners as the line sees them.
/// A line through an edge or a vertex is taken as one beside it, always on the same side, so it
/// goes through each cell of its way once.
/// Real: which table of the points it reads. All that is passed must outlive it.
template <class Real>
class MeshLine
{
public:
  /// point, and direction of length 1, as the tables of the mesh have them. scalars: one for each
  /// point of WalkMesh::GetMesh(), or ofCells, one for each cell.
  MeshLine(const WalkMesh& mesh, Span<const double> scalars, bool ofCells,
    const std::array<double, 3>& point, const std::array<double, 3>& direction);

  /// The cells that the line goes through, in its order: from where it enters the mesh until it
  /// leaves it, and again from the nearest place where it enters what is left.
  std::vector<LinePassage> Walk() const;

private:
  struct Corner;
  struct Crossing;
  struct Place;
  struct CellShape;

  Corner See(std::int32_t id) const;
  std::vector<Crossing> FindCrossings() const;
  std::int32_t WalkFrom(std::int32_t entryId, std::vector<LinePassage>& passages) const;

  const WalkMesh& Mesh;
  const WalkPoint<Real>* Points;
  Span<const double> Scalars;
  bool ScalarsOfCells;
  std::array<double, 3> Origin, Along, AcrossX, AcrossY;
};

extern template class TETRALUXCORE_EXPORT MeshLine<float>;
extern template class TETRALUXCORE_EXPORT MeshLine<double>;

} // namespace tetralux

#endif
