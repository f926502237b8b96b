// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PerspectiveShift_h
#define tetralux_PerspectiveShift_h

#include "Base/Span.h"
#include "Mesh/TetrahedralMesh.h"
#include "Projection/ScreenFrame.h"
#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

/// How far, in the coordinates of the mesh, interpolation without perspective correction (Kraus et
/// al. 2004, section 2) takes a value from beside the ray. Between two points whose depths have the
/// ratio r, the place whose value is taken is off by at most (sqrt(r) - 1) / (sqrt(r) + 1) of their
/// distance: of the largest over all cells. points: of the mesh, as Project has them. cells: one
/// flag a cell; empty: all. Infinite if a cell reaches behind the eye. Parallel.
TETRALUXCORE_EXPORT double FindPerspectiveShift(const ScreenFrame& frame,
  Span<const ScreenPoint> points, const TetrahedralMesh& mesh, Span<const std::uint8_t> cells);

} // namespace tetralux

#endif
