// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayPacket_h
#define tetralux_RayPacket_h

#include "Simd/LaneCount.h"

#include <cstdint>

namespace tetralux
{

/// Bounds of rays in a RayFrame.
struct RayBounds
{
  double LowU, HighU, LowV, HighV;
};

/// Rays of one RayFrame that are traced together (Wald et al. 2007, section 5.2), in chunks of
/// LaneCount rays that lie near each other.
struct alignas(64) RayPacket : RayBounds ///< of all rays that take part
{
  /// Pixels along the edge of a packet of primary rays.
  static constexpr int Edge = 16;
  static constexpr int MaximumRays = Edge * Edge;
  static constexpr int MaximumChunks = MaximumRays / LaneCount;

  /// Pixels of a chunk: nearly square, so that few chunks touch a small polygon.
  static constexpr int ChunkWidth = 4;
  static constexpr int ChunkHeight = LaneCount / ChunkWidth;

  double U[MaximumRays];
  double V[MaximumRays];

  /// Keys of hits are above Far, which a hit raises, and below Near. A ray whose Far is infinite
  /// takes no part.
  ///@{
  double Far[MaximumRays];
  double Near[MaximumRays];
  ///@}

  /// What the ray hit last, or -1.
  std::int64_t Hit[MaximumRays];

  /// Bounds of a chunk's rays that take part, and of their Far; rounded outward.
  ///@{
  float ChunkLowU[MaximumChunks];
  float ChunkHighU[MaximumChunks];
  float ChunkLowV[MaximumChunks];
  float ChunkHighV[MaximumChunks];
  float ChunkFar[MaximumChunks];
  ///@}
};

} // namespace tetralux

#endif
