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

/// Copies a part of a row. Whole: values of a row of a whole chunk, whose copy is one store.
template <int Whole, class Value>
TETRALUX_INLINE void CopyRow(const Value* values, int count, Value* result)
{
  if (count == Whole)
  {
    __builtin_memcpy(result, values, Whole * sizeof(Value));
    return;
  }
  __builtin_memcpy(result, values, count * sizeof(Value));
}

/// Stores the packet's part of the picture as a window holds it.
TETRALUX_INLINE void StoreWindowPixels(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, const IsosurfaceScratch& scratch)
{
  std::uint8_t bytes[4 * RayPacket::MaximumRays];
#pragma omp simd
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      const float channel = 255.f * scratch.Pixels->Colors[c][i] + 0.5f;
      bytes[4 * i + c] = static_cast<std::uint8_t>(static_cast<int>(channel));
    }
  }
  ForEachPixelRow(in, x0, y0, x1, y1,
    [&](const PixelRow& row)
    {
      CopyRow<4 * RayPacket::ChunkWidth>(
        bytes + 4 * row.First, 4 * row.Count, in.WindowColors + 4 * row.Pixel);
    });
}

TETRALUX_INLINE void StoreWindowDepths(
  const IsosurfaceInput& in, int x0, int y0, int x1, int y1, const IsosurfaceScratch& scratch)
{
  ForEachPixelRow(in, x0, y0, x1, y1,
    [&](const PixelRow& row)
    {
      CopyRow<RayPacket::ChunkWidth>(
        scratch.Pixels->WindowDepths + row.First, row.Count, in.WindowDepths + row.Pixel);
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
      float colors[4 * RayPacket::ChunkWidth];
      for (int i = 0; i < RayPacket::ChunkWidth; ++i)
      {
        for (int c = 0; c < 4; ++c)
        {
          colors[4 * i + c] = scratch.Pixels->Colors[c][row.First + i];
        }
      }
      CopyRow<4 * RayPacket::ChunkWidth>(colors, 4 * row.Count, in.Colors + 4 * row.Pixel);
      CopyRow<RayPacket::ChunkWidth>(
        scratch.Pixels->Depths + row.First, row.Count, in.Depths + row.Pixel);
    });
}

template <class Value>
TETRALUX_INLINE void FillRow(Value* row, int count, Value value)
{
  for (int i = 0; i < count; ++i)
  {
    row[i] = value;
  }
}

/// Stores pixels where nothing is.
TETRALUX_INLINE void StoreEmptyPixels(const IsosurfaceInput& in, int x0, int y0, int x1, int y1)
{
  const int width = x1 - x0;
  for (int y = y0; y < y1; ++y)
  {
    const std::int64_t first = static_cast<std::int64_t>(y) * in.Grid->Width + x0;
    if (in.WindowColors)
    {
      FillRow(in.WindowColors + 4 * first, 4 * width, std::uint8_t{ 0 });
    }
    else
    {
      FillRow(in.Colors + 4 * first, 4 * width, 0.f);
      FillRow(in.Depths + first, width, -1.f);
    }
    if (in.WindowDepths)
    {
      FillRow(in.WindowDepths + first, width, 1.f);
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
