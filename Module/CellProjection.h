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

#include "FaceScalar.h"
#include "PointGradients.h"
#include "ScreenFrame.h"
#include "Span.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// How cells are projected.
struct ProjectionSettings
{
  int Width = 0; ///< of the picture, pixels
  int Height = 0;

  /// How far silhouettes are widened, pixels: more than graphics cards may move their corners.
  double Margin = 1. / 256;

  /// By how much rays pass beside the centres of pixels, pixels, see FindShift.
  double Shift = 0;

  /// Perspective interpolation (Kraus et al. 2004, section 2.2). Off: depths and scalars are
  /// interpolated linearly on the screen, by the rasteriser, which is wrong in a perspective.
  bool Interpolate = true;
};

/// A projected cell as the vertex shader reads it: four corners, of which the first one has with it
/// what is the same for the whole cell, distributed over the four. A triangle has three corners.
///
/// With dx, dy the pixel's distance from Reference, and f(dx, dy) = f[0] + f[1] dx + f[2] dy:
///
///   base     Base(dx, dy), the least steep face's z
///   e_k      Faces[k](dx, dy), the differences of the other faces to it, times Sign
///   near     min(0, e_k of the first Entries of the faces)
///   far      max(e_k of the others)
///   z        base + Sign near where the ray goes through the one face, base + Sign far at the other:
///            enters by the former where Sign is 1, leaves by it where it is -1
///   scalar   (Scalar(dx, dy) + ScalarSlope near) / z at the former, likewise with far at the latter;
///            without perspective not divided by z. Rounded otherwise than by the cell on the other
///            side of the face: where that matters, see FaceScalar
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
    float Own[3];       ///< see CellData
  } Fourth;
};
static_assert(sizeof(ProjectedCell) == 4 * 32, "corners are 32 bytes apart");

/// A projected cell in a perspective without perspective interpolation: what is linear on the screen,
/// by its values at the corners, for the rasteriser to interpolate. That is cheaper than functions for
/// fragments to evaluate, and less exact where cells are thin, as it was before the paper.
struct InterpolatedCell
{
  struct Corner
  {
    float X, Y;
    float Scalar;   ///< on the base
    float Faces[3]; ///< e_k
    float Base;
    float Own[2]; ///< what is the same for the whole cell, as in ProjectedCell: ScalarSlope, Code;
                  ///< ScalarRange; Reference; Own[0], Own[1]
  } Corners[4];
};
static_assert(sizeof(InterpolatedCell) == 4 * 36, "corners are 36 bytes apart");

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

/// The smallest ProjectionSettings::Shift by which no ray that is meant to run exactly along faces
/// seen from the side meets the cells on both sides, or none, by rounding of single precision: in
/// proportion to the largest extent of a cell on the picture; 2e-5 pixels for 40. cells: four point
/// ids each. Parallel.
TETRALUXCORE_EXPORT double FindShift(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells);

/// Projected cells in the order of drawing, ready to be sent to a graphics card.
struct ProjectedCells
{
  /// One more than are drawn: what the last corner's attributes reach into. In a perspective without
  /// perspective interpolation InterpolatedCells in their place; the others are empty.
  std::vector<ProjectedCell> Cells;
  std::vector<InterpolatedCell> InterpolatedCells;
  std::int64_t GetNumberOfCells() const
  {
    return static_cast<std::int64_t>(this->Cells.size() + this->InterpolatedCells.size()) - 1;
  }

  /// Those of Cells where they are asked for, else empty.
  std::vector<ProjectedGradient> Gradients;

  /// Four for each cell that is drawn, where they are asked for, else empty: of the base, Face0, Face1
  /// and Face2.
  std::vector<FaceScalar> FaceScalars;

  /// Three for each triangle, of corners: corner k of cell i is 4 i + k. The last one is the cell's
  /// first corner, which has the data of the cell with it.
  std::vector<std::uint32_t> Triangles;
};

/// What fragments get to know of their cell.
struct CellData
{
  /// A number of the cell's own in its Code, 0..LargestCellKey, that looks random.
  bool Keys = false;

  /// The cell's id in Own: CellIdBase Own[0] + Own[1].
  bool Ids = false;

  /// ProjectedCells::FaceScalars.
  bool FaceScalars = false;

  /// Gradients in the coordinates of the mesh, of any length.
  enum class Gradient
  {
    None,
    Cells, ///< of each cell
    Points ///< interpolated between points
  };
  Gradient Gradients = Gradient::None;
  Span<const PointGradient> PointGradients;
  Span<const double> Coordinates; ///< of the points, three each: for gradients of cells
};

constexpr int LargestCellKey = (1 << 12) - 1;
constexpr std::int32_t CellIdBase = 1 << 12;

/// Projects cells in an order. points: of the whole mesh. cells: four point ids each. order: the
/// cells to be projected; those that are not seen are missing from the result. Parallel; the same
/// result for any number of threads.
TETRALUXCORE_EXPORT void ProjectCells(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells, Span<const std::int32_t> order,
  const CellData& data, ProjectedCells& result);

} // namespace tetralux

#endif
