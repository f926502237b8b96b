// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageSample_h
#define tetralux_ImageSample_h

#include "Simd/Lanes.h"
#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/VoxelLanes.h"

#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Where the rays of a vector have a sample, and what they know of it.
struct ImageSample
{
  Int8 Index;      ///< of the first value of the cell
  Float8 Place[3]; ///< where in the cell, 0..1
  Float8 Cell[3];  ///< which cell, counted along each axis
  Mask8 Active;    ///< rays that have a sample here
  Float8 Front;    ///< slab position of where its stretch begins
  Float8 Share;    ///< of a slab that its stretch has, 0..1
  Float8 Length;   ///< of its stretch, in unit distances

  /// The value there.
  template <class Value>
  TETRALUX_INLINE Float8 GetValue(const ImageKernelInput& in) const
  {
    return Interpolate<Value>(in.Values, this->Index, in.Row, in.Slice, this->Place);
  }
  /// The same, as the intervals of the transfer function map it.
  template <class Value>
  TETRALUX_INLINE Float8 GetScalar(const ImageKernelInput& in) const
  {
    return Fma(this->GetValue<Value>(in), Float8(in.ValueScale), Float8(in.ValueOffset));
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
