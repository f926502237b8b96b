// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PixelProjection_h
#define tetralux_PixelProjection_h

#include "TetraluxRenderingModule.h"
#include "View/RayGrid.h"

namespace tetralux
{

/// Which pixel's ray a point of a mesh is on, by the rays of a grid.
struct TETRALUXRENDERING_EXPORT PixelProjection
{
  /// center and radius: of the mesh, see WalkMesh.
  PixelProjection(const RayGrid& grid, const double center[3], double radius);

  /// Homogeneous position in pixels, with centres at halves, of a point (x, y, z, 1) in radii from
  /// the centre.
  double Rows[3][4];

  /// Whether the whole mesh is in front of the eye, or all of it behind, so that each of its
  /// triangles has the pixels between its corners.
  bool Regular = false;
};

} // namespace tetralux

#endif
