// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellKind_h
#define tetralux_CellKind_h

#include <cstddef>

namespace tetralux
{

/// How cells of a type are split into tetrahedra.
enum class CellKind
{
  LowerDimensional,
  Tetrahedron,
  Voxel,
  Hexahedron,
  Wedge,
  Pyramid,
  Faceted,
  Polyhedron,
  ConvexPointSet,
  Unsupported
};

/// The linear type that a cell is of. Lagrange and Bezier cells of order 1 have the points of a
/// linear cell; Bezier cells are linear only without rational weights. Any other type is itself.
int GetLinearType(int cellType, std::size_t numberOfPoints, bool hasRationalWeights);

/// Whether the points of a type stand in another order than those of its linear type: the triangles
/// of a vtkLagrangeWedge turn the other way.
bool IsTurnedWedge(int cellType);

/// The kind of a type as in vtkCellType.h.
CellKind ClassifyCellType(int cellType);

/// Points that a cell of a kind must have at least.
std::size_t GetRequiredPoints(CellKind kind, int cellType);

} // namespace tetralux

#endif
