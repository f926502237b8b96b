// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkConvexifyTetrahedra
 * @brief   fill the space between tetrahedra and their convex hull with imaginary cells
 *
 * Takes a vtkUnstructuredGrid of tetrahedra and makes it convex (Weiler et al.,
 * Hardware-Based Ray Casting for Tetrahedral Meshes, 2003, section 3.4; Williams, Visibility
 * Ordering Meshed Polyhedra, 1992). A ray caster that walks from cell to cell then leaves the
 * mesh only once, and an exact visibility order needs only the cells' own faces. Fills holes
 * through the mesh, closed cavities, and the space between its parts, too. Each block of a
 * composite is made convex on its own.
 *
 * The output has the points and the cells of the input first, unchanged in every id, coordinate and
 * array. The imaginary cells follow, tetrahedra of positive volume. The cell array Imaginary
 * (unsigned char) is 1 for them and 0 for the others; an array of that name in the input keeps its
 * marks. Mesh and imaginary cells conform: each boundary face of the mesh that is not on the hull
 * is a face of one imaginary cell, by its point ids, or, if points are at the same place, by the
 * smallest of their ids. This is verified with exact signs.
 *
 * If the points do not suffice, points are added, strictly inside the empty space; the points of
 * the output are then in double precision. In other cell arrays imaginary cells have 0 (an empty
 * string). In point arrays an added point has the values of a point of a cell with it. Global ids
 * continue after the largest one; they are left out if their type has no room for the new ones.
 * Field data is passed on.
 *
 * A mesh that is convex passes through, with the array Imaginary.
 *
 * Cells of lower dimension and blanked cells (vtkGhostType HIDDENCELL, REFINEDCELL or a HIDDENPOINT
 * corner) are kept in the output but count as empty space; so do tetrahedra that name a point twice
 * or one that does not exist, that have a coordinate that is not finite, or the same four points as
 * an earlier cell. Flat and inverted cells are part of the mesh.
 *
 * Fails, with an error that says why and where, on other three-dimensional cells
 * (vtkTetrahedralizeCells makes tetrahedra of them), on a mesh whose boundary intersects itself or
 * whose cells overlap, and on more points or cells than 2^31 - 1 or 2^29 - 1. See GetRefusal.
 *
 * Uses CGAL's three-dimensional triangulations, which are under the GPL.
 *
 * @sa vtkTetrahedralizeCells, vtkTetrahedraNeighbors, vtkTetrahedraRayCastMapper
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
   * What the last update found; of a composite, in the last block. All 0 before the first update
   * and after one that failed.
   *
   * Missing faces: boundary faces that the Delaunay triangulation of the boundary's points lacks.
   * Flat pocket faces: boundary faces that are on the hull only to rounding, with no cell behind
   * them, since there is no room for one.
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
   * Volumes of the last update, in cubed units of the points. Each is measured on its own: the
   * hull's is the sum of the others. 0 if the mesh was convex already.
   */
  vtkGetMacro(HullVolume, double);
  vtkGetMacro(MeshVolume, double);
  vtkGetMacro(ImaginaryVolume, double);
  ///@}

  ///@{
  /**
   * Seconds of the last update: of the test for convexity and self-intersections, the Delaunay
   * triangulation, the search for what it leaves unfilled, filling that, and verifying.
   */
  vtkGetMacro(ConvexTestSeconds, double);
  vtkGetMacro(TriangulationSeconds, double);
  vtkGetMacro(PocketSeconds, double);
  vtkGetMacro(FillSeconds, double);
  vtkGetMacro(VerificationSeconds, double);
  ///@}

  /**
   * Why the last mesh could not be made convex, and where; empty if it could.
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
