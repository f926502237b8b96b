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

#include "Projection/ProjectionSettings.h"
#include "Projection/ScreenFrame.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// A projected cell as the vertex shader reads it: four corners, of which the first one has with it
/// what is the same for the whole cell, distributed over the four. A triangle has three corners.
///
/// With dx, dy the pixel's distance from Reference, and f(dx, dy) = f[0] + f[1] dx + f[2] dy:
///
///   base     Base(dx, dy), the least steep face's z
///   e_k      Faces[k](dx, dy), the differences of the other faces to it, times Sign
///   near     min(0, e_k of the first Entries of the faces)
///   far      max(e_k of the others)
///   z        base + Sign near at the one face, base + Sign far at the other. The ray enters by the
///            former if Sign is 1, and leaves by it if Sign is -1.
///   scalar   (Scalar(dx, dy) + ScalarSlope near) / z at the former, and with far at the latter;
///            without perspective not divided by z. The cell on the other side of the face rounds
///            otherwise: where that matters, see FaceScalar.
///
/// The ray misses the cell where near <= far.
struct ProjectedCell
{
  struct Corner0
  {
    float X, Y;
    float Base[3];
    float Face0[3];
  } First;
  struct Corner1
  {
    float X, Y;
    float Face1[3];
    float Face2[3];
  } Second;
  struct Corner2
  {
    float X, Y;
    float Scalar[3];
    float ScalarSlope;
    float ScalarRange[2]; ///< of the cell's points
  } Third;
  struct Corner3
  {
    float X, Y;
    float Reference[2]; ///< centre of a pixel, in the coordinates of gl_FragCoord
    float Code;         ///< Entries where Sign is 1, Entries + 4 where it is -1; plus 8 times a key
    float Own[3];       ///< see CellData in ProjectedCells.h
  } Fourth;
};
static_assert(sizeof(ProjectedCell) == 4 * 32, "corners are 32 bytes apart");

/// The gradient in a projected cell, spread over its four corners as well: its three components are
/// found as the scalar is, by Gradient(dx, dy) + Slope near and far, divided by z in a perspective.
struct ProjectedGradient
{
  float Base[3];
  float SlopeX[3], SlopeY[3]; ///< of the base
  float Slope[3];
};

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
