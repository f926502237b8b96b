// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PacketRays_h
#define tetralux_PacketRays_h

// Points along the rays of a frame, and the bounds of a packet. In a namespace of the instruction
// set, as all that kernels call: no function may be shared between instruction sets.

#include "Isosurface/RayFrame.h"
#include "Isosurface/RayPacket.h"
#include "Simd/Lanes.h"

#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

constexpr double InfiniteKey = std::numeric_limits<double>::infinity();

TETRALUX_INLINE double GetDepth(const RayFrame& frame, double key)
{
  return frame.Parallel ? -key : 1 / key;
}

TETRALUX_INLINE double GetKey(const RayFrame& frame, double depth)
{
  return frame.Parallel ? -depth : 1 / depth;
}

/// X, Y and depth of a point.
TETRALUX_INLINE void Transform(const RayFrame& frame, const double (&point)[3], double (&result)[3])
{
  for (int r = 0; r < 3; ++r)
  {
    const double* row = frame.Rows[r];
    result[r] = row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3];
  }
}

/// The point of the ray (u, v) with a key.
TETRALUX_INLINE void GetPoint(
  const RayFrame& frame, double u, double v, double key, double (&point)[3])
{
  const double depth = GetDepth(frame, key);
  const double scale = frame.Parallel ? 1 : depth;
  for (int a = 0; a < 3; ++a)
  {
    point[a] = frame.Origin[a] + (u * frame.Axes[0][a] + v * frame.Axes[1][a]) * scale +
      depth * frame.Axes[2][a];
  }
}

/// Where the first ray of a chunk of primary rays has its pixel; the others follow row by row.
///@{
TETRALUX_INLINE int GetChunkColumn(int chunk)
{
  constexpr int Columns = RayPacket::Edge / RayPacket::ChunkWidth;
  return chunk % Columns * RayPacket::ChunkWidth;
}
TETRALUX_INLINE int GetChunkRow(int chunk)
{
  constexpr int Columns = RayPacket::Edge / RayPacket::ChunkWidth;
  return chunk / Columns * RayPacket::ChunkHeight;
}
///@}

/// A key in single precision, rounded down: at most the largest finite number.
TETRALUX_INLINE float RoundDown(double key)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  constexpr float Rounding = 1.f / (1 << 23); // twice that of single precision
  const auto rounded = static_cast<float>(key < Largest ? key : Largest);
  return rounded - Rounding * (rounded < 0 ? -rounded : rounded) -
    std::numeric_limits<float>::min();
}

/// What single precision rounds u and v by, where their largest size is that.
TETRALUX_INLINE float GetPacketMargin(double largest)
{
  constexpr double Rounding = 1. / (1 << 22); // of two floats
  return static_cast<float>(Rounding * largest);
}

/// The least Far of a chunk.
TETRALUX_INLINE void UpdateChunkFar(RayPacket& packet, int chunk)
{
  const double* far = packet.Far + chunk * LaneCount;
  double least = InfiniteKey;
#pragma omp simd reduction(min : least)
  for (int i = 0; i < LaneCount; ++i)
  {
    least = far[i] < least ? far[i] : least;
  }
  packet.ChunkFar[chunk] = RoundDown(least);
}

/// The same of all chunks.
TETRALUX_INLINE void UpdateChunksFar(RayPacket& packet)
{
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    UpdateChunkFar(packet, chunk);
  }
}

/// The least Far of a packet, rounded down.
TETRALUX_INLINE float GetLeastFar(const RayPacket& packet)
{
  Float8 least = LoadFloat8(packet.ChunkFar);
  for (int first = LaneCount; first < RayPacket::MaximumChunks; first += LaneCount)
  {
    least = Min(LoadFloat8(packet.ChunkFar + first), least);
  }
  float keys[LaneCount];
  Store(keys, least);
  float key = keys[0];
  for (int i = 1; i < LaneCount; ++i)
  {
    key = keys[i] < key ? keys[i] : key;
  }
  return key;
}

/// Stores the bounds of a chunk, and widens those of the packet.
TETRALUX_INLINE void SetChunkBounds(
  RayPacket& packet, int chunk, double lowU, double highU, double lowV, double highV, float margin)
{
  packet.ChunkLowU[chunk] = static_cast<float>(lowU) - margin;
  packet.ChunkLowV[chunk] = static_cast<float>(lowV) - margin;
  packet.ChunkHighU[chunk] = static_cast<float>(highU) + margin;
  packet.ChunkHighV[chunk] = static_cast<float>(highV) + margin;
  packet.LowU = lowU < packet.LowU ? lowU : packet.LowU;
  packet.LowV = lowV < packet.LowV ? lowV : packet.LowV;
  packet.HighU = highU > packet.HighU ? highU : packet.HighU;
  packet.HighV = highV > packet.HighV ? highV : packet.HighV;
}

TETRALUX_INLINE void ClearBounds(RayBounds& packet)
{
  packet.LowU = packet.LowV = InfiniteKey;
  packet.HighU = packet.HighV = -InfiniteKey;
}

/// Fits the bounds of a packet to the rays that take part. Returns whether any does. margin: what
/// single precision rounds u and v by.
TETRALUX_INLINE bool FitBounds(RayPacket& packet, float margin)
{
  ClearBounds(packet);
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    const double* us = packet.U + chunk * LaneCount;
    const double* vs = packet.V + chunk * LaneCount;
    const double* far = packet.Far + chunk * LaneCount;
    double lowU = InfiniteKey, lowV = InfiniteKey, highU = -InfiniteKey, highV = -InfiniteKey;
    double least = InfiniteKey;
#pragma omp simd reduction(min : lowU, lowV, least) reduction(max : highU, highV)
    for (int i = 0; i < LaneCount; ++i)
    {
      const bool active = far[i] < InfiniteKey;
      const double u0 = active ? us[i] : InfiniteKey;
      const double v0 = active ? vs[i] : InfiniteKey;
      const double u1 = active ? us[i] : -InfiniteKey;
      const double v1 = active ? vs[i] : -InfiniteKey;
      lowU = u0 < lowU ? u0 : lowU;
      lowV = v0 < lowV ? v0 : lowV;
      highU = u1 > highU ? u1 : highU;
      highV = v1 > highV ? v1 : highV;
      least = far[i] < least ? far[i] : least;
    }
    SetChunkBounds(packet, chunk, lowU, highU, lowV, highV, margin);
    packet.ChunkFar[chunk] = RoundDown(least);
  }
  return packet.LowU <= packet.HighU;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
