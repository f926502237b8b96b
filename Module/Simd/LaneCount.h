// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LaneCount_h
#define tetralux_LaneCount_h

namespace tetralux
{
#ifndef TETRALUX_LANE_COUNT // else 16, of kernels for AVX-512 that share no packets with others
#define TETRALUX_LANE_COUNT 8
#endif
constexpr int LaneCount = TETRALUX_LANE_COUNT; ///< of a vector: the same for each instruction set

/// One bit for each lane.
constexpr unsigned AllLanes = (1u << LaneCount) - 1;

} // namespace tetralux

#endif
