// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellComplex_h
#define tetralux_CellComplex_h

#include "Convexify/FaceTable.h"
#include "Convexify/PocketFront.h"
#include "Convexify/PocketSearch.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Cells that come and go, and which of them have a face.
class CellComplex
{
public:
  explicit CellComplex(std::vector<Cell> cells);

  void Add(const std::vector<Cell>& cells);
  void Remove(const std::vector<std::int32_t>& cells);

  /// Takes the cells behind the triangles of a front into its pocket: notes their numbers and
  /// returns the front of both. They stay in the complex.
  Front Grow(const Front& front, std::vector<std::int32_t>& absorbed) const;

  const Cell& GetCell(std::int32_t number) const { return this->Cells[number]; }
  std::vector<Cell> GetCells() const;

  /// A front without what cells in front of it cover.
  static Front Advance(Front front, const std::vector<Cell>& cells);

private:
  static constexpr std::int32_t NoCell = -1;

  void AddFaces(std::int32_t number);

  std::vector<Cell> Cells;
  std::vector<bool> IsThere;
  FaceTable Faces; ///< the pair in CellsOfFaces
  std::vector<std::array<std::int32_t, 2>> CellsOfFaces;
};

} // namespace tetralux

#endif
