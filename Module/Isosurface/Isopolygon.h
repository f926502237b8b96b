// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Isopolygon_h
#define tetralux_Isopolygon_h

// The polygon in which a surface of constant scalar crosses a tetrahedron (Wald et al. 2007,
// section 4.1).

#include "Isosurface/RayFrame.h"

#include <cstdint>

namespace tetralux
{

/// A triangle or a quadrilateral; of a triangle the last corner is there twice. Corners follow each
/// other around it, in any direction. Two cache lines, whose rows are loaded as vectors.
struct alignas(64) Isopolygon
{
  double X[4], Y[4], Z[4]; ///< of the corners, in the mesh's frame
  std::int32_t Cell;
  std::int32_t Surface; ///< index of its value
};

/// A mesh as isopolygons are made from it.
struct IsopolygonSource
{
  MeshFrame Frame;
  const double* Points;      ///< three each, in the units of the mesh
  const std::int32_t* Cells; ///< four ascending point ids each
  const double* Scalars;     ///< of points
  const double* Values;      ///< ascending
  int NumberOfValues;
};

} // namespace tetralux

#endif
