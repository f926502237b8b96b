// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkConvexifyTetrahedra
 * @brief   fill the space between tetrahedra and their convex hull with imaginary cells
 *
 * Takes a vtkUnstructuredGrid of tetrahedra and makes it convex, so that a ray caster that walks
 * from cell to cell leaves it only for good, and an exact visibility order needs no more than the
 * cells' own faces (Weiler et al., Hardware-Based Ray Casting for Tetrahedral Meshes, 2003, section
 * 3.4; Williams, Visibility Ordering Meshed Polyhedra, 1992). Holes through the mesh, closed
 * cavities, and the space between its parts are filled, too. The blocks of a composite are made
 * convex each for itself.
 *
 * The output has the points and the cells of the input first, unchanged in every id, coordinate and
 * array; then the imaginary cells, tetrahedra of positive volume, and the cell array Imaginary
 * (unsigned char), which is 1 for them and 0 for the others. An array of that name in the input
 * keeps its marks. Mesh and imaginary cells conform: each face of the mesh's boundary that is not
 * on the hull is a face of one imaginary cell, by its point ids, or, where points are at the same
 * place, by the smallest id of these. This is verified with exact signs.
 *
 * Where the points do not suffice, points are added, strictly inside the empty space; the points of
 * the output are then in double precision. In the other cell arrays imaginary cells have 0 (an
 * empty string), in the point arrays an added point has what a point of a cell with it has; global
 * ids go on after the largest one. Field data is passed on.
 *
 * A mesh that is convex passes through, with the array Imaginary.
 *
 * Cells of lower dimension and blanked cells (vtkGhostType HIDDENCELL, REFINEDCELL or a HIDDENPOINT
 * corner) are kept in the output but count as empty space; so do tetrahedra that name a point twice
 * or one that does not exist, that have a coordinate that is not finite, or the same four points as
 * an earlier cell. Flat and inverted cells are part of the mesh.
 *
 * Fails, with an error that says why and where, on other three-dimensional cells
 * (vtkTetrahedraFilter makes tetrahedra of them), on a mesh whose boundary intersects itself or
 * whose cells overlap, and on more points or cells than 2^31 - 1 or 2^29 - 1. See GetRefusal.
 *
 * Uses CGAL's three-dimensional triangulations, which are under the GPL.
 *
 * @sa vtkTetrahedraFilter, vtkTetrahedraNeighbors, vtkTetrahedraRayCastMapper
 */
#ifndef vtkConvexifyTetrahedra_h
#define vtkConvexifyTetrahedra_h

#include "TetraluxFiltersModule.h"
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for std::string

namespace tetralux
{
struct Convexification;
}

class TETRALUXFILTERS_EXPORT vtkConvexifyTetrahedra : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkConvexifyTetrahedra* New();
  vtkTypeMacro(vtkConvexifyTetrahedra, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the last update found; of a composite, in the block that came last. All 0 before the first
   * update and after one that failed.
   *
   * Boundary faces: of the mesh; missing faces: those that are none of the Delaunay triangulation
   * of the boundary's points; flat pocket faces: those that have nothing behind them though they
   * are on the hull only to rounding, since there is no room for a cell.
   */
  vtkGetMacro(NumberOfBoundaryFaces, vtkIdType);
  vtkGetMacro(NumberOfMissingFaces, vtkIdType);
  vtkGetMacro(NumberOfFlatPocketFaces, vtkIdType);
  vtkGetMacro(NumberOfImaginaryCells, vtkIdType);
  vtkGetMacro(NumberOfSteinerPoints, vtkIdType);
  ///@}

  /**
   * Whether the mesh of the last update was convex already.
   */
  vtkGetMacro(InputIsConvex, bool);

  ///@{
  /**
   * Volumes of the last update, in cubed units of the points, each found by itself: the hull's is
   * that of the mesh and of the imaginary cells. 0 where the mesh was convex already.
   */
  vtkGetMacro(HullVolume, double);
  vtkGetMacro(MeshVolume, double);
  vtkGetMacro(ImaginaryVolume, double);
  ///@}

  ///@{
  /**
   * Seconds that passed in the last update: in the test for convexity and self-intersections, the
   * Delaunay triangulation, the search for what it leaves unfilled, filling that, and verifying.
   */
  vtkGetMacro(ConvexTestSeconds, double);
  vtkGetMacro(TriangulationSeconds, double);
  vtkGetMacro(PocketSeconds, double);
  vtkGetMacro(FillSeconds, double);
  vtkGetMacro(VerificationSeconds, double);
  ///@}

  /**
   * Why the last mesh could not be made convex, and where; empty where it could.
   */
  vtkGetCharFromStdStringMacro(Refusal);

protected:
  vtkConvexifyTetrahedra() = default;
  ~vtkConvexifyTetrahedra() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkConvexifyTetrahedra(const vtkConvexifyTetrahedra&) = delete;
  void operator=(const vtkConvexifyTetrahedra&) = delete;

  void SetResults(const tetralux::Convexification& results);

  vtkIdType NumberOfBoundaryFaces = 0;
  vtkIdType NumberOfMissingFaces = 0;
  vtkIdType NumberOfFlatPocketFaces = 0;
  vtkIdType NumberOfImaginaryCells = 0;
  vtkIdType NumberOfSteinerPoints = 0;
  bool InputIsConvex = false;
  double HullVolume = 0;
  double MeshVolume = 0;
  double ImaginaryVolume = 0;
  double ConvexTestSeconds = 0;
  double TriangulationSeconds = 0;
  double PocketSeconds = 0;
  double FillSeconds = 0;
  double VerificationSeconds = 0;
  std::string Refusal;
};

#endif
