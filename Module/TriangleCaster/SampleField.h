// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SampleField_h
#define tetralux_SampleField_h

// Values and gradients of samples, from wherever an input has them.

#include "TriangleCaster/GradientLanes.h"
#include "TriangleCaster/GradientVoxelLanes.h"

#include <cstdint>
#include <type_traits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The values of a vector's samples.
template <class Value>
struct ValueField
{
  /// As the intervals of the transfer function map them.
  TETRALUX_INLINE Float8 LoadScalar(const ImageKernelInput& in, const ImageSample& sample)
  {
    return sample.GetScalar<Value>(in);
  }
};

/// The values and gradients of a vector's samples.
template <class Value>
struct GradientField : ValueField<Value>
{
  /// In values for a step to the next point along each axis.
  TETRALUX_INLINE LaneVector GetGradient(const ImageKernelInput& in, const ImageSample& sample)
  {
    return FindGradient<Value>(in, sample);
  }
};

/// The same where gradients may be stored. Beside values, both come with the same eight words.
template <class Value>
class StoredField
{
public:
  TETRALUX_INLINE Float8 LoadScalar(const ImageKernelInput& in, const ImageSample& sample)
  {
    if constexpr (HasValues)
    {
      if (in.GradientWords)
      {
        this->Cell.Load(in, sample);
        return Fma(
          this->Cell.GetValue(sample.Place), Float8(in.ValueScale), Float8(in.ValueOffset));
      }
    }
    return sample.GetScalar<Value>(in);
  }

  /// After LoadScalar of the same sample.
  TETRALUX_INLINE LaneVector GetGradient(const ImageKernelInput& in, const ImageSample& sample)
  {
    if (!in.GradientWords)
    {
      return FindGradient<Value>(in, sample);
    }
    if constexpr (HasValues)
    {
      return this->Cell.GetGradient(in, sample.Place);
    }
    else
    {
      return LoadGradient(in, sample);
    }
  }

private:
  static constexpr bool HasValues = std::is_same_v<Value, std::uint8_t>;

  /// Apart from the kernel, where its eight words would take registers from everything else.
  static TETRALUX_NOINLINE LaneVector LoadGradient(
    const ImageKernelInput& in, const ImageSample& sample)
  {
    GradientCell cell;
    cell.Load(in, sample);
    return cell.GetGradient(in, sample.Place);
  }

  GradientCell Cell; ///< where it has values
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
