// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageSample_h
#define tetralux_ImageSample_h

#include "Simd/Lanes.h"
#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/VoxelLanes.h"

#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The largest finite number: scalars beyond are empty.
constexpr float LargestScalar = std::numeric_limits<float>::max();

/// A value as the intervals of the transfer function map it.
TETRALUX_INLINE Float8 FindScalar(const ImageKernelInput& in, Float8 value)
{
  return Fma(value, Float8(in.ValueScale), Float8(in.ValueOffset));
}

/// Where the rays of a vector have a sample, and what they know of it.
struct ImageSample
{
  Int8 Index;      ///< of the first value of the cell
  Float8 Place[3]; ///< where in the cell, 0..1
  Float8 Cell[3];  ///< which cell, counted along each axis
  Mask8 Active;    ///< rays that have a sample here
  std::int32_t Slab;
  Mask8 Begins;  ///< it is the first one of its part of the ray
  Float8 Front;  ///< slab position of where its stretch begins
  Float8 Middle; ///< slab position of the sample itself
  Float8 Share;  ///< of a slab that its stretch has, 0..1
  Float8 Length; ///< of its stretch, in unit distances

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
    return FindScalar(in, this->GetValue<Value>(in));
  }
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
