// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TetrahedraIntake_h
#define tetralux_TetrahedraIntake_h

#include "Intake/IntakeReport.h"
#include "Mesh/CoincidentPoints.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkDataObject;

namespace tetralux
{

/// The result of TakeInTetrahedra. Where Error is not empty the mesh is empty.
struct TetrahedraIntake
{
  TetrahedralMesh Mesh;
  TetrahedraIntakeReport Report;
  std::string Error; ///< one line
  bool Aborted = false;
};

/// Turns any data set, or composite of data sets, into tetrahedra. Point ids of the mesh are the
/// input's point ids (all points are kept, used or not), with the blocks of a composite one after
/// the other; points that a split had to add follow at the end.
///
/// Accepts
/// - tetrahedra: as they are;
/// - voxels, hexahedra, wedges, pyramids: without new points, diagonals at the smallest point id;
/// - image data, rectilinear and structured grids: five tetrahedra a cell, alternating;
/// - pentagonal and hexagonal prisms, polyhedra: faces fanned at their smallest point id, then a
///   cone from the cell's smallest point id where that makes positive tetrahedra, else from an
///   added point in the middle. A polyhedron that can't be seen completely from either gives
///   overlapping tetrahedra, some inverted;
/// - Lagrange cells of order 1, and Bezier cells of order 1 without rational weights: as the linear
///   cells that they are;
/// - quadratic cells: all their nodes are kept; faces are cut by a rule that depends on the face
///   alone, then a cone from the node in the middle or from an added point there, which has the
///   cell's own interpolation weights;
/// - convex point sets: the faces of their convex hull, then as polyhedra; points inside of the
///   hull, of a face or of an edge split the tetrahedra that they lie in.
///
/// Parts of collapsed cells (a point repeated) that have no volume are left out. Cells without a
/// tetrahedron, and why, are in the report.
///
/// Refuses an input that is no data set, one that lacks points or types of its cells, more than
/// 2^31 - 1 points and more than 2^29 - 1 tetrahedra, with a line in Error.
///
/// merged: points for which cells take the first one at their place. Tetrahedra that repeat a point
/// by that are left out. If seams or blocks do not alternate alike, cells of structured grids are
/// then split as hexahedra, so that faces are cut alike from both sides.
///
/// progress, where given, is called from the calling thread with a fraction 0..1 now and then; when
/// it returns false the work ends with Aborted set. Linear time, parallel through vtkSMPTools, the
/// same result for any number of threads.
TETRALUXFILTERS_EXPORT TetrahedraIntake TakeInTetrahedra(vtkDataObject* input,
  const std::function<bool(double)>& progress = {}, const CoincidentPoints& merged = {});

} // namespace tetralux

#endif
