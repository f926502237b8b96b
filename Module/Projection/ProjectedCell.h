// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProjectedCell_h
#define tetralux_ProjectedCell_h

// What CellProjection.h makes of a cell.

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

} // namespace tetralux

#endif
