// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceRuns_h
#define tetralux_ReferenceRuns_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// A cell that a ray passes: by which of its faces, the points of each ascending, and where.
struct CellPassage
{
  using Face = std::array<std::int32_t, 3>;
  std::array<Face, 2> Faces; ///< the nearer one first
  std::array<long double, 2> Distances;
};

/// The order in which a ray goes through cells, indices into passages. It goes through cells that
/// share faces until it leaves them: a run. Then it comes in where the nearest run begins of those
/// that are left. So runs that overlap come one after the other, by their begins. A run begins at
/// the nearer one of both faces at its ends, which belong to one of the cells, or to more than two;
/// runs that begin together come in the order of passages, and rings of cells without an end last.
std::vector<std::size_t> OrderPassages(const std::vector<CellPassage>& passages);

} // namespace tetralux

#endif
