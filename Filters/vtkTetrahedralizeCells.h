// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedralizeCells
 * @brief   turn any three-dimensional cells into tetrahedra whose faces agree
 *
 * Splits the cells of a data set, or of all data sets of a composite, into the tetrahedra that the
 * mappers of Tetralux render. Two cells that share a face cut it alike.
 *
 * Accepts vtkUnstructuredGrid, vtkStructuredGrid, vtkRectilinearGrid, vtkImageData, any other
 * vtkDataSet, and composites (multi-block, partitioned, AMR) of these, whose blocks are put one
 * after the other without merging points. Cells may be tetrahedra, voxels, hexahedra, wedges,
 * pyramids, pentagonal and hexagonal prisms, polyhedra, convex point sets and all quadratic cells.
 * Linear cells other than polyhedra get no new points; prisms and polyhedra only where they must;
 * quadratic cells, whose nodes are all kept, one in the middle, with interpolated point data.
 *
 * Polyhedra need not be convex. Where no point inside sees all faces of one, tetrahedra between its
 * corners are cut off until there is such a point of the rest. Where that can't be done either, its
 * tetrahedra overlap, and a warning counts them.
 *
 * Skips, and counts: ghost cells and blanked cells (vtkGhostType DUPLICATECELL; HIDDENCELL,
 * REFINEDCELL or a HIDDENPOINT corner), cells of lower dimension, cells that name points that do
 * not exist, and cells of types that it can't split (Lagrange, Bezier), about which it warns.
 *
 * The output has all points of the input, in its order and with its precision, then the added ones;
 * point data and cell data are carried over (of a composite: the arrays that all blocks have), and
 * two arrays of vtkIdType lead back to the input: OriginalPointIds, with -1 for an added point, and
 * OriginalCellIds; ids of a composite count through its blocks.
 *
 * Linear time, parallel through vtkSMPTools; the output does not depend on the number of threads.
 *
 * @warning Fails, with an error, on more than 2^31 - 1 points or 2^29 - 1 tetrahedra.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkDataSetTriangleFilter
 */
#ifndef vtkTetrahedralizeCells_h
#define vtkTetrahedralizeCells_h

#include "TetraluxFiltersModule.h"
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for std::string

namespace tetralux
{
struct TetrahedraIntakeReport;
}

class TETRALUXFILTERS_EXPORT vtkTetrahedralizeCells : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTetrahedralizeCells* New();
  vtkTypeMacro(vtkTetrahedralizeCells, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set whether the output has the point array OriginalPointIds and the cell array OriginalCellIds.
   * Default on.
   */
  vtkSetMacro(PassOriginalIds, vtkTypeBool);
  vtkGetMacro(PassOriginalIds, vtkTypeBool);
  vtkBooleanMacro(PassOriginalIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Return how many cells the last update left out; 0 before the first update. Skipped cells are
   * three-dimensional cells of types that can't be split. The description of the class has what
   * ghost, blanked, lower-dimensional and invalid cells are.
   */
  vtkGetMacro(NumberOfSkippedCells, vtkIdType);
  vtkGetMacro(NumberOfGhostCells, vtkIdType);
  vtkGetMacro(NumberOfBlankedCells, vtkIdType);
  vtkGetMacro(NumberOfLowerDimensionalCells, vtkIdType);
  vtkGetMacro(NumberOfInvalidCells, vtkIdType);
  ///@}

  /**
   * Return the types of the skipped cells with their numbers, as "12 vtkLagrangeHexahedron"; empty
   * if none was skipped.
   */
  vtkGetCharFromStdStringMacro(SkippedCellTypes);

  /**
   * Return how many points the last update added in the middle of cells.
   */
  vtkGetMacro(NumberOfAddedPoints, vtkIdType);

protected:
  vtkTetrahedralizeCells() = default;
  ~vtkTetrahedralizeCells() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTetrahedralizeCells(const vtkTetrahedralizeCells&) = delete;
  void operator=(const vtkTetrahedralizeCells&) = delete;

  void SetReport(const tetralux::TetrahedraIntakeReport& report);

  vtkTypeBool PassOriginalIds = 1;
  vtkIdType NumberOfSkippedCells = 0;
  vtkIdType NumberOfGhostCells = 0;
  vtkIdType NumberOfBlankedCells = 0;
  vtkIdType NumberOfLowerDimensionalCells = 0;
  vtkIdType NumberOfInvalidCells = 0;
  std::string SkippedCellTypes;
  vtkIdType NumberOfAddedPoints = 0;
};

#endif
