// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntakeReport_h
#define tetralux_IntakeReport_h

#include "TetraluxFiltersModule.h"

#include <cstdint>
#include <map>
#include <string>

namespace tetralux
{

/// What the intake found in its input and what it left out. Every cell of the input is in
/// CellsByType; those that gave no tetrahedra are in exactly one of the other counts but
/// FoldedCells.
struct TetrahedraIntakeReport
{
  /// Cells of the input by their type as in vtkCellType.h.
  std::map<int, std::int64_t> CellsByType;

  /// Three-dimensional cells of types that can't be rendered (Lagrange and Bezier cells of a
  /// higher order, ...), by type.
  std::map<int, std::int64_t> SkippedByType;

  std::int64_t NumberOfPoints = 0;        ///< of the input, all blocks together
  std::int64_t NumberOfCells = 0;         ///< of the input, all blocks together
  std::int64_t GhostCells = 0;            ///< vtkGhostType says DUPLICATECELL
  std::int64_t BlankedCells = 0;          ///< HIDDENCELL, REFINEDCELL, or a corner is a HIDDENPOINT
  std::int64_t LowerDimensionalCells = 0; ///< vertices, lines, faces, empty cells
  std::int64_t InvalidCells = 0; ///< too few points, ids that don't exist, or nothing between them
  std::int64_t Blocks = 0;       ///< data sets that were read
  /// Polyhedra no point of which sees all faces from inside, not even of what tetrahedra between
  /// their corners leave: their tetrahedra overlap.
  std::int64_t FoldedCells = 0;
  std::int64_t SkippedBlocks = 0; ///< leaves of a composite that are no data sets, as tables

  /// The sum over SkippedByType.
  TETRALUXFILTERS_EXPORT std::int64_t GetNumberOfSkippedCells() const;

  /// "12 vtkLagrangeHexahedron, 3 vtkBezierWedge", empty where nothing was skipped.
  TETRALUXFILTERS_EXPORT std::string DescribeSkippedCells() const;
};

/// VTK's class name of a cell type, as "vtkTetra"; "cell type 66" where it has none.
TETRALUXFILTERS_EXPORT std::string GetCellTypeName(int cellType);

} // namespace tetralux

#endif
