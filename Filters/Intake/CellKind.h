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

/// The kind of a type as in vtkCellType.h.
CellKind ClassifyCellType(int cellType);

/// Points that a cell of a kind must have at least.
std::size_t GetRequiredPoints(CellKind kind, int cellType);

} // namespace tetralux

#endif
