// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceMesh_h
#define tetralux_ReferenceMesh_h

#include "Base/Span.h"

#include <cstdint>

namespace tetralux
{

/// A mesh as the reference renderer reads it; it owns nothing.
struct ReferenceMesh
{
  Span<const double> Points;      ///< three for each point
  Span<const std::int32_t> Cells; ///< four point ids for each tetrahedron, in any orientation
  Span<const double> Scalars;     ///< one for each point, or one for each cell
  bool CellScalars = false;       ///< Scalars holds one value for each cell
};

} // namespace tetralux

#endif
