// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshLimits_h
#define tetralux_MeshLimits_h

#include <cstdint>
#include <limits>

namespace tetralux
{

/// The most that a TetrahedralMesh holds: see there.
constexpr std::int64_t MaximumPoints = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t MaximumCells = (std::int64_t(1) << 29) - 1;

} // namespace tetralux

#endif
