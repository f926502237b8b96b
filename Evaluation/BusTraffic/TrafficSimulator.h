// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TrafficSimulator_h
#define tetralux_TrafficSimulator_h

#include "Base/Span.h"
#include "BusTraffic/TrafficFrame.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

enum class TrafficOrder
{
  Triangles, ///< all P-triangles of an S-triangle, front to back, before the next S-triangle
  Planes     ///< one plane after the other, back to front (section 5.1)
};

/// The cache between texturing unit and texture memory.
struct TextureCacheKind
{
  bool Banked = true;  ///< BankedCache, else SetCache
  int Bytes = 1 << 10; ///< banked: 1024 or 8192, with voxels of 2 bytes
  int Ways = 1;        ///< of a SetCache
};

/// What 8-bit values are looked up in after interpolation: the opacity of a raypoint, in 255ths.
using OpacityTable = std::array<std::uint8_t, 256>;

struct TrafficRun
{
  TrafficOrder Order = TrafficOrder::Triangles;
  TextureCacheKind Cache;

  /// TT: an S-triangle ends when all its pixels are opaque. In the order of S-triangles only.
  bool EndTriangles = false;

  /// OP: raypoints of pixels that are opaque bring nothing into the texture cache (section 3.2).
  /// They are processed all the same. In the order of S-triangles only.
  bool SkipFills = false;

  OpacityTable Opacity = {}; ///< counts if one of the two above is used
};

/// The columns of the paper's tables 2 and 3. A raypoint is a pixel of a P-triangle whose point is
/// within the volume.
struct TrafficCounts
{
  std::int64_t PTriangles = 0;
  std::int64_t STriangles = 0;
  std::int64_t Pixels = 0; ///< of P-triangles, also outside of the volume
  std::int64_t Raypoints = 0;
  std::int64_t Hits = 0; ///< voxels; 8 Raypoints = Hits + Misses
  std::int64_t Misses = 0;
  std::int64_t TextureBytes = 0; ///< read; for each miss a line, but not where SkipFills saves it
  std::int64_t FrameBytesRead = 0;
  std::int64_t FrameBytesWritten = 0;

  std::int64_t GetBytes() const
  {
    return this->TextureBytes + this->FrameBytesRead + this->FrameBytesWritten;
  }

  /// MB/s at 30 frames a second.
  double GetBandwidth() const { return 30e-6 * static_cast<double>(this->GetBytes()); }
};

/// A pixel is opaque when its translucency is below this (section 5).
constexpr double OpaqueTranslucency = 1. / 255;

/// Simulates caches while a frame is drawn, each run on its own. Parallel over runs; the counts do
/// not depend on the number of threads.
std::vector<TrafficCounts> SimulateTraffic(const TrafficFrame& frame, Span<const TrafficRun> runs);

} // namespace tetralux

#endif
