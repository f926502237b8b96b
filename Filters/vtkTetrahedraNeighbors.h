// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraNeighbors
 * @brief   which cell lies behind each face of tetrahedra, their boundary, and their defects
 *
 * Takes a vtkUnstructuredGrid of tetrahedra, or a composite of such grids, each on its own. Face i
 * of a tetrahedron is the one opposite to its point i (Weiler et al., Hardware-Based Ray Casting
 * for Tetrahedral Meshes, 2003, section 3.2).
 *
 * The first output is the input, no id or order of points and cells changed, with two more cell
 * arrays of four components (arrays of the same name are replaced):
 * - Neighbors (vtkIdType): the id of the cell behind face i, or OUTSIDE (-1), or, in all four,
 *   LEFT_OUT (-2) for a cell that has no neighbours because it is none itself, see below;
 * - NeighborFaces (signed char): which face of that neighbour the face is, 0..3; -1 where there is
 *   no neighbour.
 * Faces are matched by their point ids: coincident points are not merged. A face that three or more
 * cells share is outside for each of them, so that a walk from cell to cell always leads from one
 * boundary face to another.
 *
 * The second output is the boundary: a vtkPolyData of triangles, seen counter-clockwise from
 * outside, also those of inverted cells; with the points and the point data of the input (all of
 * them, so that ids agree), the cell data of the cells, and two more cell arrays, CellIds
 * (vtkIdType) and FaceIds (signed char), which say where each triangle came from. They ascend.
 *
 * Left out, and counted, are lower-dimensional cells, blanked cells (vtkGhostType HIDDENCELL,
 * REFINEDCELL or a HIDDENPOINT corner), and tetrahedra that name a point twice or one that does not
 * exist, that have a coordinate that is not finite, or the same four points as an earlier cell.
 * Ghost cells (DUPLICATECELL) are neighbours as all others, so that the border to another piece is
 * not taken for the outside, but give no triangles. Flat and inverted cells are kept, since they
 * connect their neighbours, and counted.
 *
 * Other three-dimensional cells are refused, with an error: vtkTetrahedralizeCells makes tetrahedra
 * of them. So are more than 2^31 - 1 points or 2^29 - 1 cells, and blocks of a composite that are
 * data sets but no unstructured grids. Linear time; the output does not depend on the number of
 * threads.
 *
 * @sa vtkTetrahedralizeCells, vtkConvexifyTetrahedra
 */
#ifndef vtkTetrahedraNeighbors_h
#define vtkTetrahedraNeighbors_h

#include "TetraluxFiltersModule.h"
#include "vtkUnstructuredGridAlgorithm.h"

class vtkPolyData;

class TETRALUXFILTERS_EXPORT vtkTetrahedraNeighbors : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTetrahedraNeighbors* New();
  vtkTypeMacro(vtkTetrahedraNeighbors, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What the array Neighbors has in place of a cell id.
   */
  enum NoNeighbor
  {
    OUTSIDE = -1,
    LEFT_OUT = -2
  };

  /**
   * The second output; nullptr where the input is a composite, use GetOutputDataObject(1) then.
   */
  vtkPolyData* GetBoundary();

  ///@{
  /**
   * What the last update found; of a composite, the sums over its blocks. All 0 before the first
   * update and after one that failed.
   *
   * Boundary faces: triangles of the second output. Components: parts connected through faces.
   * Non-manifold faces: shared by three or more cells. Zero-volume cells: not distinguishable from
   * flat by more than rounding. Inverted cells: of negative volume, in VTK's order of points.
   */
  vtkGetMacro(NumberOfBoundaryFaces, vtkIdType);
  vtkGetMacro(NumberOfComponents, vtkIdType);
  vtkGetMacro(NumberOfNonManifoldFaces, vtkIdType);
  vtkGetMacro(NumberOfZeroVolumeCells, vtkIdType);
  vtkGetMacro(NumberOfInvertedCells, vtkIdType);
  vtkGetMacro(NumberOfGhostCells, vtkIdType);
  ///@}

  ///@{
  /**
   * Cells that the last update left out; each is counted once, under the first reason that applies.
   * Invalid: name a point that does not exist, or have too few. Collapsed: name one twice.
   */
  vtkGetMacro(NumberOfBlankedCells, vtkIdType);
  vtkGetMacro(NumberOfLowerDimensionalCells, vtkIdType);
  vtkGetMacro(NumberOfInvalidCells, vtkIdType);
  vtkGetMacro(NumberOfNonFiniteCells, vtkIdType);
  vtkGetMacro(NumberOfCollapsedCells, vtkIdType);
  vtkGetMacro(NumberOfDuplicateCells, vtkIdType);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkTetrahedraNeighbors();
  ~vtkTetrahedraNeighbors() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTetrahedraNeighbors(const vtkTetrahedraNeighbors&) = delete;
  void operator=(const vtkTetrahedraNeighbors&) = delete;

  struct Counts;
  void SetCounts(const Counts& counts);

  vtkIdType NumberOfBoundaryFaces = 0;
  vtkIdType NumberOfComponents = 0;
  vtkIdType NumberOfNonManifoldFaces = 0;
  vtkIdType NumberOfZeroVolumeCells = 0;
  vtkIdType NumberOfInvertedCells = 0;
  vtkIdType NumberOfGhostCells = 0;
  vtkIdType NumberOfBlankedCells = 0;
  vtkIdType NumberOfLowerDimensionalCells = 0;
  vtkIdType NumberOfInvalidCells = 0;
  vtkIdType NumberOfNonFiniteCells = 0;
  vtkIdType NumberOfCollapsedCells = 0;
  vtkIdType NumberOfDuplicateCells = 0;
};

#endif
