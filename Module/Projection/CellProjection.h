// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellProjection_h
#define tetralux_CellProjection_h

// Projected tetrahedra (Shirley and Tuchman 1990; Kraus et al. 2004, section 2): what a cell covers
// of the picture, and what a fragment needs to tell where its ray enters and leaves the cell, and
// with which scalars.
//
// The paper's perspective interpolation rests on this: on the screen, 1 / depth on a plane and
// scalar / depth of a linear field are linear functions of the pixel. With z = 1 / depth (in a
// parallel projection, z = -depth: in both, more is nearer) the projected cell is a tetrahedron in
// (x, y, z), and its faces are linear functions z_i(x, y). A ray enters by the front face with the
// smallest z and leaves by the back face with the largest one.
//
// The paper decomposes the silhouette into three or four triangles, on each of which those two
// faces are the same, and has the rasteriser interpolate from their corners. Here the silhouette
// itself is drawn, one triangle (classes 1a and 1b) or two (class 2), and each fragment finds the
// two faces by comparisons: half as many triangles, and what a fragment gets depends on its pixel
// alone, not on how a graphics card rounds corners and interpolates. Silhouettes are widened by
// what cards may round corners by; where a ray misses the cell, it leaves before it enters.
//
// Accuracy: all is prepared in double precision and relative to the cell, so that single precision
// in the shader is relative to the cell, too. Cells thinner by a factor of a million than they are
// wide keep that: of the faces' functions only differences to the least steep of them count for the
// thickness.

#include "Projection/ProjectedCell.h"
#include "Projection/ProjectionSettings.h"
#include "Projection/ScreenFrame.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Projects one cell. Returns the number of its corners: 3 or 4, in the order of a fan, or 0 where
/// it covers no pixel's centre, has no volume, or touches a scalar that is not a number.
///
/// Cells that reach behind the eye are covered by a rectangle around all of them that is in front;
/// without perspective interpolation, which they have no meaning in, they are left out.
TETRALUXCORE_EXPORT int ProjectCell(const ScreenFrame& frame, const ProjectionSettings& settings,
  const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d,
  ProjectedCell& result);

/// The same with gradients at the points, three components each.
TETRALUXCORE_EXPORT int ProjectCell(const ScreenFrame& frame, const ProjectionSettings& settings,
  const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d,
  ProjectedCell& result, const double gradients[4][3], ProjectedGradient& gradient);

} // namespace tetralux

#endif
