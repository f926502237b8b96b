// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayBlock_h
#define tetralux_RayBlock_h

#include "Isosurface/RayPacket.h"

#include <cstdint>

namespace tetralux
{

/// What the pixels of a packet show so far.
struct PacketPixels
{
  double StartFar[RayPacket::MaximumRays]; ///< Far, before anything was hit
  float Colors[4][RayPacket::MaximumRays]; ///< premultiplied
  float Depths[RayPacket::MaximumRays];
  float WindowDepths[RayPacket::MaximumRays];
};

/// The primary rays of a square of pixels, which a thread draws at a time: packets in rows. Rays of
/// a packet are pixels, chunk by chunk.
struct RayBlock
{
  static constexpr int Packets = 4; ///< along an edge
  static constexpr int MaximumPackets = Packets * Packets;
  static constexpr int Edge = Packets * RayPacket::Edge; ///< pixels

  int X0, Y0, X1, Y1; ///< pixels [X0, X1) x [Y0, Y1)

  /// The packets whose rays are filled, and those that have pixels, one bit each.
  ///@{
  std::uint32_t Started;
  std::uint32_t Drawn;
  ///@}

  /// The least Far of each packet, rounded down: infinite where no ray takes part, and below all
  /// keys where none is filled yet.
  float Far[MaximumPackets];

  RayPacket Rays[MaximumPackets];
  PacketPixels Pixels[MaximumPackets];
};

} // namespace tetralux

#endif
