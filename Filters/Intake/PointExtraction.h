// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PointExtraction_h
#define tetralux_PointExtraction_h

#include "Intake/TetrahedraIntake.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxFiltersModule.h"

#include <vector>

class vtkDataObject;

namespace tetralux
{

/// The coordinates of the points of a mesh, three each, taken anew from an input whose cells are
/// those that TakeInTetrahedra made the mesh of; also after points were reordered. Added points are
/// the weighted mean of their sources. Parallel.
TETRALUXFILTERS_EXPORT std::vector<double> ExtractPoints(
  vtkDataObject* input, const TetrahedralMesh& mesh);

/// Whether the tetrahedra of an input depend on where its points are: it has polyhedra, prisms of
/// more than three sides or convex point sets. Those of all other cells follow from point ids
/// alone.
TETRALUXFILTERS_EXPORT bool DependsOnPoints(const TetrahedraIntakeReport& report);

/// The largest distance, along an axis, of points at the same place that were rounded apart, as a
/// share of the largest coordinate: some roundings in the precision of the input's arrays, the
/// coarsest of all blocks.
TETRALUXFILTERS_EXPORT double GetPointTolerance(vtkDataObject* input);

} // namespace tetralux

#endif
