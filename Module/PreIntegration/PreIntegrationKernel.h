// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PreIntegrationKernel_h
#define tetralux_PreIntegrationKernel_h

// The inner loops that fill a pre-integration table, compiled once for each instruction set.

#include "PreIntegration/PreIntegrationTable.h"
#include "Simd/LaneCount.h"

#include <cstddef>
#include <cstdint>

namespace tetralux
{

/// A part of a segment on which attenuation and colour are linear.
struct SegmentPiece
{
  float Depth[2]; ///< attenuation at its ends, times its length in the longest segment
  float Color[2][3];
};

struct PreIntegrationKernels
{
  /// Integrates one segment at several lengths in closed form. pieces: of the longest segment,
  /// front to back. lengths: fractions of the longest. count: a multiple of LaneCount. Channel c of
  /// length k goes to values[k stride + c].
  void (*IntegrateLengths)(const SegmentPiece* pieces, int numberOfPieces, const float* lengths,
    int count, float* values, int stride);

  /// Sums of products: row i of result, of size floats, is the sum over k of weights[i K + k] times
  /// row k of values, row K = numberOfValues. Channels are kept at 0 or more (unless keepNegative)
  /// and opacities at 1 or less. Rows of values begin stride floats apart, rows of result
  /// resultStride; size: a multiple of 4.
  void (*CombineRows)(const float* values, int stride, int numberOfValues, const float* weights,
    int numberOfRows, bool keepNegative, float* result, long long resultStride, int size);

  /// Channels as the texels of a format hold them.
  void (*EncodeChannels)(
    TexelFormat format, const float* values, std::size_t count, std::uint8_t* texels);
};

PreIntegrationKernels GetPreIntegrationKernelsGeneric();
#ifdef TETRALUX_HAVE_AVX2_KERNEL
PreIntegrationKernels GetPreIntegrationKernelsAvx2();
#endif

} // namespace tetralux

#endif
