// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibleHull_h
#define tetralux_VisibleHull_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// A rectangle on a plane of the grid: Low and High are equal along the normal's axis.
struct HullFace
{
  std::int32_t Low[3]; ///< indices of points of the volume
  std::int32_t High[3];
};

/// The surface between what is visible of an image volume and the rest (Knittel 1999, section 2.1).
/// It is closed.
struct VisibleHull
{
  int BlockSize = 1; ///< cells along the edge of a block; a face is one side of a block
  std::vector<HullFace> Faces;

  /// The box around all faces, indices of points. Without faces Low is above High.
  ///@{
  std::int32_t Low[3] = { 0, 0, 0 };
  std::int32_t High[3] = { -1, -1, -1 };
  ///@}

  std::size_t GetNumberOfTriangles() const { return 2 * this->Faces.size(); }
};

/// The hull of the blocks of blockSize^3 cells that have a visible cell. Blocks begin at cell 0 and
/// end where the volume does. With a block size of 1 it is the tight hull.
///
/// cells: along each axis, the volume's points less 1. visible: one byte a cell, x fastest, 0 for a
/// transparent one. Throws std::invalid_argument if there are other than
/// cells[0] cells[1] cells[2] bytes, or if blockSize is below 1.
TETRALUXCORE_EXPORT VisibleHull MakeVisibleHull(
  const int (&cells)[3], Span<const std::uint8_t> visible, int blockSize);

/// The hull of the smallest blocks of 2^k cells along each edge, k at least 0, that has at most
/// mostTriangles triangles. Where no blocks have so few, it is that of one block of all cells. It
/// contains the tight hull.
TETRALUXCORE_EXPORT VisibleHull MakeCoarseHull(
  const int (&cells)[3], Span<const std::uint8_t> visible, std::size_t mostTriangles);

/// The visible cells of one material, for a hull of its own: those with the label at a corner.
/// labels: one for each point of the volume, x fastest. Throws std::invalid_argument if a number of
/// labels or of visible cells is wrong.
TETRALUXCORE_EXPORT std::vector<std::uint8_t> SelectMaterial(const int (&cells)[3],
  Span<const std::uint8_t> visible, Span<const std::uint8_t> labels, std::uint8_t label);

} // namespace tetralux

#endif
