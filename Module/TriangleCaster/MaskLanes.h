// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MaskLanes_h
#define tetralux_MaskLanes_h

// Labels of points, and what of a volume is hidden.

#include "TriangleCaster/ImageSample.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A byte of the point nearest to each sample; halfway between two, of the one behind.
TETRALUX_INLINE Int8 LoadNearest(
  const ImageKernelInput& in, const ImageSample& sample, const unsigned char* bytes)
{
  const Float8 half = 0.5f;
  const Int8 zero = 0;
  const Int8 row = sample.Index + Select(half <= sample.Place[1], Int8(in.Row), zero) +
    Select(half <= sample.Place[2], Int8(in.Slice), zero);
  const Int8 pair = LoadBytes(bytes, row);
  return ShiftRight(Select(half <= sample.Place[0], pair, ShiftLeft(pair, 8)), 24);
}

/// Samples that neither a mask nor a hidden cell hides.
TETRALUX_NOINLINE Mask8 FindShown(const ImageKernelInput& in, const ImageSample& sample)
{
  const Int8 zero = 0;
  Mask8 shown = zero == zero;
  if (in.Mask)
  {
    shown = LoadNearest(in, sample, in.Mask) > zero;
  }
  if (in.HiddenCells)
  {
    const Int8 hidden = ShiftRight(ShiftLeft(LoadBytes(in.HiddenCells, sample.Index), 8), 24);
    shown = shown & (hidden == zero);
  }
  return shown;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
