// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PixelStore_h
#define tetralux_PixelStore_h

// Stores the pixels of a packet in a picture of floats, or as a window holds them.

#include "Isosurface/IsosurfaceKernel.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Where the rays of a part of a chunk have their pixels.
struct PixelRow
{
  std::int64_t Pixel; ///< the first one
  int First;          ///< ray
  int Count;
};

/// Calls store with each row of each chunk that has pixels.
template <class Store>
TETRALUX_INLINE void ForEachPixelRow(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, const Store& store)
{
  for (int chunk = 0; chunk < RayPacket::MaximumChunks; ++chunk)
  {
    const int x = x0 + GetChunkColumn(chunk);
    const int width = x1 - x < RayPacket::ChunkWidth ? x1 - x : RayPacket::ChunkWidth;
    for (int row = 0; row < RayPacket::ChunkHeight; ++row)
    {
      const int y = y0 + GetChunkRow(chunk) + row;
      if (y < y1 && width > 0)
      {
        store(PixelRow{ static_cast<std::int64_t>(y) * in.Grid->Width + x,
          chunk * LaneCount + row * RayPacket::ChunkWidth, width });
      }
    }
  }
}

/// Stores the packet's part of the picture as a window holds it.
TETRALUX_INLINE void StoreWindowPixels(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, const IsosurfaceScratch& scratch)
{
  std::uint8_t bytes[4][RayPacket::MaximumRays];
  for (int c = 0; c < 4; ++c)
  {
#pragma omp simd
    for (int i = 0; i < RayPacket::MaximumRays; ++i)
    {
      const float channel = 255.f * scratch.Colors[c][i] + 0.5f;
      bytes[c][i] = static_cast<std::uint8_t>(static_cast<int>(channel));
    }
  }
  ForEachPixelRow(in, x0, y0, x1, y1,
    [&](const PixelRow& row)
    {
      for (int i = 0; i < row.Count; ++i)
      {
        for (int c = 0; c < 4; ++c)
        {
          in.WindowColors[4 * (row.Pixel + i) + c] = bytes[c][row.First + i];
        }
      }
    });
}

TETRALUX_INLINE void StoreWindowDepths(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, const IsosurfaceScratch& scratch)
{
  ForEachPixelRow(in, x0, y0, x1, y1,
    [&](const PixelRow& row)
    {
      for (int i = 0; i < row.Count; ++i)
      {
        in.WindowDepths[row.Pixel + i] = scratch.WindowDepths[row.First + i];
      }
    });
}

/// Stores the packet's part of the picture.
TETRALUX_INLINE void StorePixels(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, const IsosurfaceScratch& scratch)
{
  if (in.WindowDepths)
  {
    StoreWindowDepths(in, x0, y0, x1, y1, scratch);
  }
  if (in.WindowColors)
  {
    StoreWindowPixels(in, x0, y0, x1, y1, scratch);
    return;
  }
  ForEachPixelRow(in, x0, y0, x1, y1,
    [&](const PixelRow& row)
    {
      for (int i = 0; i < row.Count; ++i)
      {
        for (int c = 0; c < 4; ++c)
        {
          in.Colors[4 * (row.Pixel + i) + c] = scratch.Colors[c][row.First + i];
        }
        in.Depths[row.Pixel + i] = scratch.Depths[row.First + i];
      }
    });
}

/// Stores pixels where nothing is.
TETRALUX_INLINE void StoreEmptyPixels(const IsosurfaceInput& in, int x0, int y0, int x1, int y1)
{
  for (int y = y0; y < y1; ++y)
  {
    const std::int64_t row = static_cast<std::int64_t>(y) * in.Grid->Width;
    for (std::int64_t i = 4 * (row + x0); i < 4 * (row + x1); ++i)
    {
      if (in.WindowColors)
      {
        in.WindowColors[i] = 0;
      }
      else
      {
        in.Colors[i] = 0;
      }
    }
    for (std::int64_t i = row + x0; i < row + x1; ++i)
    {
      if (in.WindowDepths)
      {
        in.WindowDepths[i] = 1;
      }
      if (!in.WindowColors)
      {
        in.Depths[i] = -1;
      }
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
