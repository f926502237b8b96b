// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/CellKind.h"

#include "Intake/FacetedCells.h"

#include "vtkCellType.h"

namespace tetralux
{

int GetLinearType(int cellType, std::size_t numberOfPoints, bool hasRationalWeights)
{
  struct HigherOrder
  {
    int Lagrange, Bezier, Linear;
  };
  constexpr HigherOrder Types[] = {
    { VTK_LAGRANGE_TETRAHEDRON, VTK_BEZIER_TETRAHEDRON, VTK_TETRA },
    { VTK_LAGRANGE_HEXAHEDRON, VTK_BEZIER_HEXAHEDRON, VTK_HEXAHEDRON },
    { VTK_LAGRANGE_WEDGE, VTK_BEZIER_WEDGE, VTK_WEDGE },
    { VTK_LAGRANGE_PYRAMID, VTK_BEZIER_PYRAMID, VTK_PYRAMID },
  };
  for (const HigherOrder& types : Types)
  {
    const bool isPolynomial =
      cellType == types.Lagrange || (cellType == types.Bezier && !hasRationalWeights);
    if (isPolynomial &&
      numberOfPoints == GetRequiredPoints(ClassifyCellType(types.Linear), types.Linear))
    {
      return types.Linear;
    }
  }
  return cellType;
}

bool IsTurnedWedge(int cellType)
{
  return cellType == VTK_LAGRANGE_WEDGE || cellType == VTK_BEZIER_WEDGE;
}

CellKind ClassifyCellType(int cellType)
{
  switch (cellType)
  {
    case VTK_TETRA:
      return CellKind::Tetrahedron;
    case VTK_VOXEL:
      return CellKind::Voxel;
    case VTK_HEXAHEDRON:
      return CellKind::Hexahedron;
    case VTK_WEDGE:
      return CellKind::Wedge;
    case VTK_PYRAMID:
      return CellKind::Pyramid;
    case VTK_POLYHEDRON:
      return CellKind::Polyhedron;
    case VTK_CONVEX_POINT_SET:
      return CellKind::ConvexPointSet;
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_TRIANGLE:
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_EDGE:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_QUAD:
    case VTK_QUADRATIC_POLYGON:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_CUBIC_LINE:
    case VTK_PARAMETRIC_CURVE:
    case VTK_PARAMETRIC_SURFACE:
    case VTK_PARAMETRIC_TRI_SURFACE:
    case VTK_PARAMETRIC_QUAD_SURFACE:
    case VTK_HIGHER_ORDER_EDGE:
    case VTK_HIGHER_ORDER_TRIANGLE:
    case VTK_HIGHER_ORDER_QUAD:
    case VTK_HIGHER_ORDER_POLYGON:
    case VTK_LAGRANGE_CURVE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_CURVE:
    case VTK_BEZIER_TRIANGLE:
    case VTK_BEZIER_QUADRILATERAL:
      return CellKind::LowerDimensional;
    default:
      return GetFacetedCellType(cellType) ? CellKind::Faceted : CellKind::Unsupported;
  }
}

std::size_t GetRequiredPoints(CellKind kind, int cellType)
{
  switch (kind)
  {
    case CellKind::Tetrahedron:
    case CellKind::Polyhedron:
    case CellKind::ConvexPointSet:
      return 4;
    case CellKind::Pyramid:
      return 5;
    case CellKind::Wedge:
      return 6;
    case CellKind::Voxel:
    case CellKind::Hexahedron:
      return 8;
    case CellKind::Faceted:
      return GetFacetedCellType(cellType)->NumberOfPoints;
    case CellKind::LowerDimensional:
    case CellKind::Unsupported:
      break;
  }
  return 0;
}

} // namespace tetralux
