// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraFilter
 * @brief   turn any three-dimensional cells into tetrahedra whose faces agree
 *
 * Splits the cells of a data set, or of all data sets of a composite, into the tetrahedra that the
 * mappers of this module render, so that two cells that share a face cut it alike.
 *
 * Accepts vtkUnstructuredGrid, vtkStructuredGrid, vtkRectilinearGrid, vtkImageData, any other
 * vtkDataSet, and composites (multi-block, partitioned, AMR) of these, whose blocks are put one
 * after the other without merging points. Cells may be tetrahedra, voxels, hexahedra, wedges,
 * pyramids, pentagonal and hexagonal prisms, polyhedra, convex point sets and all quadratic cells.
 * Linear cells other than polyhedra get no new points; prisms and polyhedra only where they must;
 * quadratic cells, whose nodes are all kept, one in the middle, with interpolated point data.
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
 * Fails, with an error, on more than 2^31 - 1 points or 2^29 - 1 tetrahedra. Linear time, parallel
 * through vtkSMPTools; the output does not depend on the number of threads.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkDataSetTriangleFilter
 */
#ifndef vtkTetrahedraFilter_h
#define vtkTetrahedraFilter_h

#include "TetraluxFiltersModule.h"
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for std::string

namespace tetralux
{
struct TetrahedraIntakeReport;
}

class TETRALUXFILTERS_EXPORT vtkTetrahedraFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTetrahedraFilter* New();
  vtkTypeMacro(vtkTetrahedraFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether the output has the point array OriginalPointIds and the cell array OriginalCellIds.
   * On by default.
   */
  vtkSetMacro(PassOriginalIds, bool);
  vtkGetMacro(PassOriginalIds, bool);
  vtkBooleanMacro(PassOriginalIds, bool);
  ///@}

  ///@{
  /**
   * What the last update left out. Skipped: three-dimensional cells of types that can't be split.
   * Ghost, blanked, lower-dimensional and invalid cells are as in the description of the class.
   * All 0 before the first update.
   */
  vtkGetMacro(NumberOfSkippedCells, vtkIdType);
  vtkGetMacro(NumberOfGhostCells, vtkIdType);
  vtkGetMacro(NumberOfBlankedCells, vtkIdType);
  vtkGetMacro(NumberOfLowerDimensionalCells, vtkIdType);
  vtkGetMacro(NumberOfInvalidCells, vtkIdType);
  ///@}

  /**
   * The types of the skipped cells with their numbers, as "12 vtkLagrangeHexahedron"; empty where
   * none was skipped.
   */
  vtkGetCharFromStdStringMacro(SkippedCellTypes);

  /**
   * How many points the last update added in the middle of cells.
   */
  vtkGetMacro(NumberOfAddedPoints, vtkIdType);

protected:
  vtkTetrahedraFilter() = default;
  ~vtkTetrahedraFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTetrahedraFilter(const vtkTetrahedraFilter&) = delete;
  void operator=(const vtkTetrahedraFilter&) = delete;

  void SetReport(const tetralux::TetrahedraIntakeReport& report);

  bool PassOriginalIds = true;
  vtkIdType NumberOfSkippedCells = 0;
  vtkIdType NumberOfGhostCells = 0;
  vtkIdType NumberOfBlankedCells = 0;
  vtkIdType NumberOfLowerDimensionalCells = 0;
  vtkIdType NumberOfInvalidCells = 0;
  std::string SkippedCellTypes;
  vtkIdType NumberOfAddedPoints = 0;
};

#endif
