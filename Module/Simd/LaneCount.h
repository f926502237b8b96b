// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LaneCount_h
#define tetralux_LaneCount_h

namespace tetralux
{

/// Lanes of a vector: how many numbers the kernels compute at once. The same for every instruction
/// set, so that one packet of rays serves all kernels. The vector types carry it in their names.
constexpr int LaneCount = 8;

/// One bit for each lane.
constexpr unsigned AllLanes = (1u << LaneCount) - 1;

} // namespace tetralux

#endif
