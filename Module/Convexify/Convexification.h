// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Convexification_h
#define tetralux_Convexification_h

#include "Mesh/FaceNeighbors.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tetralux
{

/// What fills the space between the boundary of a mesh and its convex hull (Weiler et al.
/// 2003, section 3.4, after Williams 1992): a walk from cell to cell then leaves the whole
/// only through the hull.
struct Convexification
{
  /// Coordinates of the points that had to be added, three each, in the units of the mesh. The k-th
  /// has the id mesh.GetNumberOfPoints() + k. All lie strictly inside the empty space.
  std::vector<double> SteinerPoints;

  /// The imaginary cells: four point ids each, of positive volume in VTK's order of a tetrahedron's
  /// points (exactly: the sign is that of the coordinates as given).
  std::vector<std::int32_t> Cells;

  /// The boundary is its own convex hull: nothing was added, and nothing more was measured than
  /// BoundaryFaces and the test's time.
  bool Convex = false;

  /// Empty where the space was filled and the result verified; else one line that says why not and
  /// where, with the input's ids of cells (OriginalCells). There are no cells and points then.
  std::string Refusal;

  /// Where it was refused: a point, in the units of the mesh, and the cells of the mesh whose
  /// boundary faces meet there, -1 where there is none or only one.
  std::array<double, 3> RefusalPoint = { 0, 0, 0 };
  std::array<std::int32_t, 2> RefusalCells = { -1, -1 };

  /// The caller's progress returned false.
  bool Aborted = false;

  std::int64_t BoundaryFaces = 0; ///< of the mesh
  /// Boundary faces that are on the hull only to rounding, with no cells between them and the hull.
  /// There the space could not be filled with the points that it has, and its volume is at most its
  /// surface times 16 roundings of the largest coordinate. Planes that are turned away from the
  /// axes give such faces.
  std::int64_t FlatPocketFaces = 0;

  std::int64_t MissingFaces = 0; ///< those of them that are no faces of the Delaunay triangulation

  /// Volumes in cubed units of the mesh: each found by itself, so that
  /// HullVolume = MeshVolume + ImaginaryVolume checks them. MeshVolume is what the boundary
  /// encloses.
  double HullVolume = 0;
  double MeshVolume = 0;
  double ImaginaryVolume = 0;

  /// Seconds of each phase: the test for convexity and all before it, the triangulation of the
  /// boundary's points, the search for the pockets beside the boundary, filling them, and verifying
  /// the result.
  double ConvexTestSeconds = 0;
  double TriangulationSeconds = 0;
  double PocketSeconds = 0;
  double FillSeconds = 0;
  double VerificationSeconds = 0;

  std::int64_t GetNumberOfCells() const
  {
    return static_cast<std::int64_t>(this->Cells.size() / 4);
  }
  std::int64_t GetNumberOfSteinerPoints() const
  {
    return static_cast<std::int64_t>(this->SteinerPoints.size() / 3);
  }
  double GetSeconds() const
  {
    return this->ConvexTestSeconds + this->TriangulationSeconds + this->PocketSeconds +
      this->FillSeconds + this->VerificationSeconds;
  }
};

/// What is done with cells that touch at the same place without sharing points.
enum class TouchingCells
{
  Join,  ///< they count as neighbours: of a shape
  Refuse ///< of a mesh that is walked from cell to cell by the ids of points
};

/// Whether a walk that leaves a mesh never enters it again: the boundary is its whole convex hull,
/// and no cells touch without sharing points. False for meshes that Convexify refuses. Exact; takes
/// as long as finding the boundary.
TETRALUXCORE_EXPORT bool IsConvex(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors);

/// Fills the space between the boundary of a mesh and its convex hull with imaginary cells.
///
/// mesh: as RemoveUnusableCells leaves it. neighbors: those of FindFaceNeighbors. Cells may have
/// zero or negative volume and any order of points: matching faces give the boundary, and the
/// orientation that neighbouring cells share says where outside is.
///
/// The mesh and the imaginary cells conform: each boundary face that is not on the hull is a face
/// of exactly one imaginary cell. Every other face of an imaginary cell is one of another imaginary
/// cell or lies on the hull. This is verified with exact signs.
///
/// Refuses, with a line in Refusal:
/// - a boundary that meets itself elsewhere than in common points and edges;
/// - three or more cells at one face, also if their points only are at the same places;
/// - a boundary face without area;
/// - cells whose neighbours can't be oriented alike;
/// - cells that touch without sharing points, if touching says so;
/// - more cells or points than a TetrahedralMesh holds;
/// - pockets that could not be filled within the limits of the search.
///
/// progress, if given, is called from the calling thread with a fraction 0..1 now and then. When it
/// returns false the work ends with Aborted set.
///
/// Time grows as n log n in the number of boundary faces if pockets stay small. The same result for
/// any number of threads. Uses CGAL's Triangulation_3, which is under the GPL.
TETRALUXCORE_EXPORT Convexification Convexify(const TetrahedralMesh& mesh,
  const FaceNeighbors& neighbors, TouchingCells touching,
  const std::function<bool(double)>& progress = {});

} // namespace tetralux

#endif
