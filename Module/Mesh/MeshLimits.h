// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshLimits_h
#define tetralux_MeshLimits_h

#include <cstdint>
#include <limits>

namespace tetralux
{

/// The largest numbers of points and of tetrahedra in a TetrahedralMesh, so that point ids and
/// 4 * cell + face fit an int32.
constexpr std::int64_t MaximumPoints = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t MaximumCells = (std::int64_t(1) << 29) - 1;

/// The largest number of cells of any kind that tetrahedra may come from, so that their ids fit an
/// int32.
constexpr std::int64_t MaximumInputCells = std::numeric_limits<std::int32_t>::max();

} // namespace tetralux

#endif
