// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProjectedCells_h
#define tetralux_ProjectedCells_h

// Cells of a mesh, projected all at once, see CellProjection.h, as they are sent to a
// graphics card.

#include "Base/Span.h"
#include "Mesh/Gradients.h"
#include "Projection/CellDivision.h"
#include "Projection/CellProjection.h"
#include "Projection/FaceScalar.h"
#include "Projection/ProjectionSettings.h"
#include "Projection/ScreenFrame.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// The smallest ProjectionSettings::Shift by which no ray that is meant to run exactly along faces
/// seen from the side meets the cells on both sides, or none, by rounding of single precision: in
/// proportion to the largest extent of a cell on the picture; 2e-5 pixels for 40. cells: four point
/// ids each. Parallel.
TETRALUXCORE_EXPORT double FindShift(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells);

/// A projected cell in a perspective without perspective interpolation: what is linear on
/// the screen, by its values at the corners, for the rasteriser to interpolate. That is
/// cheaper than functions for fragments to evaluate, and less exact where cells are thin, as
/// it was before the paper.
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

/// Projected cells in the order of drawing, ready to be sent to a graphics card.
struct ProjectedCells
{
  /// One more than are drawn: what the last corner's attributes reach into. In a perspective
  /// without perspective interpolation InterpolatedCells in their place; the others are empty. A
  /// cell that is divided is there once for each slice of its parts.
  std::vector<ProjectedCell> Cells;
  std::vector<InterpolatedCell> InterpolatedCells;
  std::int64_t GetNumberOfCells() const
  {
    return static_cast<std::int64_t>(this->Cells.size() + this->InterpolatedCells.size()) - 1;
  }

  /// Those of Cells where they are asked for, else empty.
  std::vector<ProjectedGradient> Gradients;

  /// Four for each cell that is drawn, where they are asked for, else empty: of the base,
  /// Face0, Face1 and Face2.
  std::vector<FaceScalar> FaceScalars;

  /// Cells are sent and drawn in parts of so many, the last one smaller: some megabytes for a
  /// driver to keep, and corners that are numbered in 16 bits.
  static constexpr std::int64_t PartSize = 1 << 14;
  static_assert(4 * PartSize <= 1 << 16, "corners are numbered in 16 bits");

  std::int64_t NumberOfTetrahedra = 0; ///< that are drawn, as a whole or in parts

  /// Three for each triangle, of corners: corner k of the i-th cell of a part is 4 i + k. The last
  /// one is the cell's first corner, which has the data of the cell with it.
  std::vector<std::uint16_t> Triangles;

  /// Where the triangles of each part begin in Triangles, and the end of the last one.
  std::vector<std::size_t> PartBegins;
  std::int64_t GetNumberOfParts() const
  {
    return static_cast<std::int64_t>(this->PartBegins.size()) - 1;
  }

  std::size_t GetNumberOfBytes() const ///< that are allocated
  {
    return this->Cells.capacity() * sizeof(ProjectedCell) +
      this->InterpolatedCells.capacity() * sizeof(InterpolatedCell) +
      this->Gradients.capacity() * sizeof(ProjectedGradient) +
      this->FaceScalars.capacity() * sizeof(FaceScalar) +
      this->Triangles.capacity() * sizeof(std::uint16_t);
  }
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

  /// Draws the slices of each cell's parts, without face scalars, gradients and ids, and with
  /// perspective interpolation. Own[0] is a slice's interval; Own[1] 1 where that is open below,
  /// and 2 more where it is open above; Own[2] its index, and SliceBase times how many there are.
  const CellDivision* Division = nullptr;
  bool FrontToBack = true; ///< order of the slices of a cell

  /// Gradients in the coordinates of the mesh, of any length.
  enum class Gradient
  {
    None,
    Cells, ///< of each cell
    Points ///< interpolated between points
  };
  Gradient Gradients = Gradient::None;
  Span<const GradientRow> PointGradients;
  Span<const double> Coordinates; ///< of the points, three each: for gradients of cells
};

constexpr int LargestCellKey = (1 << 12) - 1;
constexpr std::int32_t CellIdBase = 1 << 12;
constexpr int SliceBase = CellDivision::MostSlices;

/// Projects cells in an order. points: of the whole mesh. cells: four point ids each. order: the
/// cells to be projected; those that are not seen are missing from the result. Parallel; the same
/// result for any number of threads.
TETRALUXCORE_EXPORT void ProjectCells(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells, Span<const std::int32_t> order,
  const CellData& data, ProjectedCells& result);

} // namespace tetralux

#endif
