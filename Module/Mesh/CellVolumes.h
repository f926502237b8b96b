// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellVolumes_h
#define tetralux_CellVolumes_h

#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

/// Volumes and edges of a mesh, in the units of its coordinates.
struct CellVolumes
{
  double Total = 0; ///< sum of the unsigned volumes
  std::int64_t NumberOfZero =
    0; ///< not distinguishable from flat: |volume| below its rounding error
  std::int64_t NumberOfInverted = 0; ///< negative volume in VTK's order of a tetrahedron's points
  double ShortestEdge = 0; ///< shortest edge that is not of zero length; 0 in an empty mesh
  double LongestEdge = 0;
};

/// Differences of coordinates are taken before products, so that an offset of the whole mesh does
/// not cancel. NumberOfInverted counts the order of points as given: ask before OrderSpatially.
TETRALUXCORE_EXPORT CellVolumes MeasureCells(const TetrahedralMesh& mesh);

} // namespace tetralux

#endif
