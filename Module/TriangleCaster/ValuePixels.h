// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ValuePixels_h
#define tetralux_ValuePixels_h

// Pixels that show one scalar of each ray.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/TransferLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

template <class Intervals>
inline PixelLanes FindValuePixels(const TransferLookup& transfer, Mask8 exists, Float8 x)
{
  const Float8 zero = 0.f;
  const Intervals intervals(transfer, Keep(exists, x));
  const Float8 opacity = Min(intervals.GetOpacity(), Float8(1.f));
  const Mask8 visible = exists & (zero < opacity);
  Float8 color[3];
  intervals.GetColor(color);
  PixelLanes pixels;
  for (int c = 0; c < 3; ++c)
  {
    pixels.Color[c] = Keep(visible, color[c] * opacity);
  }
  pixels.Opacity = Keep(visible, opacity);
  return pixels;
}

/// Colour and scalar opacity at x in the intervals of the transfer function, with a depth unless
/// that is transparent. front: slab position of the scalar.
inline PixelLanes GetValuePixels(const ImageKernelInput& in, Mask8 exists, Float8 x, Float8 front)
{
  PixelLanes pixels = in.Transfer.Count <= TransferLookup::MostFew
    ? FindValuePixels<FewIntervals<TransferLookup::MostFew>>(in.Transfer, exists, x)
    : FindValuePixels<ManyIntervals>(in.Transfer, exists, x);
  pixels.Front = Select(Float8(0.f) < pixels.Opacity, front, Float8(-1.f));
  return pixels;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
