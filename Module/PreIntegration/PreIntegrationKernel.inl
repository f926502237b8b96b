// SPDX-License-Identifier: BSD-3-Clause

#include "Base/Check.h"
#include "Integral/SegmentIntegral.h"
#include "PreIntegration/PreIntegrationKernel.h"
#include "PreIntegration/TexelFormats.h"

#include <cstring>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

void IntegrateLengths(const SegmentPiece* pieces, int numberOfPieces, const float* lengths,
  int count, float* values, int stride)
{
  TETRALUX_CHECK(count % LaneCount == 0);
  for (int k = 0; k < count; k += LaneCount)
  {
    const Float8 length = LoadFloat8(lengths + k);
    Float8 transmittance = 1.f;
    Float8 channels[4] = { 0.f, 0.f, 0.f, 0.f };
    for (int p = 0; p < numberOfPieces; ++p)
    {
      const SegmentPiece& piece = pieces[p];
      TETRALUX_CHECK(piece.Depth[0] >= 0 && piece.Depth[1] >= 0);
      const SegmentWeights w =
        IntegrateSegment(Float8(piece.Depth[0]) * length, Float8(piece.Depth[1]) * length);
      const Float8 front = transmittance * w.Front;
      const Float8 back = transmittance * w.Back;
      for (int c = 0; c < 3; ++c)
      {
        channels[c] =
          Fma(front, Float8(piece.Color[0][c]), Fma(back, Float8(piece.Color[1][c]), channels[c]));
      }
      channels[3] = channels[3] + (front + back);
      transmittance = transmittance * w.Transmittance;
    }
    channels[3] = Min(channels[3], Float8(1.f));
    alignas(32) float lanes[4][LaneCount];
    for (int c = 0; c < 4; ++c)
    {
      Store(lanes[c], channels[c]);
    }
    for (int i = 0; i < LaneCount; ++i)
    {
      float* value = values + static_cast<long long>(k + i) * stride;
      for (int c = 0; c < 4; ++c)
      {
        value[c] = lanes[c][i];
      }
    }
  }
}

/// Rows, and registers of each, that are summed together: so many that no sum waits for its last
/// term, and that each number loaded serves several sums.
constexpr int RowsAtOnce = 4;
constexpr int RegistersAtOnce = 2;

/// Beyond every channel.
constexpr float Unbounded = 3e38f;

/// The bound of a channel: an opacity, the last one, is 1 or less.
constexpr float GetLargestChannel(int channel) { return channel == 3 ? 1.f : Unbounded; }

template <int Rows, int Registers>
TETRALUX_INLINE void CombineRegisters(const float* values, int stride, int numberOfValues,
  const float* weights, Float8 least, Float8 most, float* result, long long resultStride)
{
  Float8 sums[Rows][Registers];
  for (int r = 0; r < Rows; ++r)
  {
    for (int j = 0; j < Registers; ++j)
    {
      sums[r][j] = 0.f;
    }
  }
  for (int k = 0; k < numberOfValues; ++k)
  {
    const float* row = values + static_cast<long long>(k) * stride;
    Float8 value[Registers];
    for (int j = 0; j < Registers; ++j)
    {
      value[j] = LoadFloat8(row + j * LaneCount);
    }
    for (int r = 0; r < Rows; ++r)
    {
      const Float8 weight = weights[r * numberOfValues + k];
      for (int j = 0; j < Registers; ++j)
      {
        sums[r][j] = Fma(weight, value[j], sums[r][j]);
      }
    }
  }
  for (int r = 0; r < Rows; ++r)
  {
    for (int j = 0; j < Registers; ++j)
    {
      Store(result + r * resultStride + j * LaneCount, Min(Max(sums[r][j], least), most));
    }
  }
}

template <int Rows>
TETRALUX_INLINE void Combine(const float* values, int stride, int numberOfValues,
  const float* weights, Float8 least, float* result, long long resultStride, int size)
{
  float largest[LaneCount];
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    largest[lane] = GetLargestChannel(lane % 4);
  }
  const Float8 most = LoadFloat8(largest);
  int i = 0;
  for (; i + RegistersAtOnce * LaneCount <= size; i += RegistersAtOnce * LaneCount)
  {
    CombineRegisters<Rows, RegistersAtOnce>(
      values + i, stride, numberOfValues, weights, least, most, result + i, resultStride);
  }
  for (; i + LaneCount <= size; i += LaneCount)
  {
    CombineRegisters<Rows, 1>(
      values + i, stride, numberOfValues, weights, least, most, result + i, resultStride);
  }
  // Half a register is left where the number of texels is odd.
  for (; i < size; ++i)
  {
    for (int r = 0; r < Rows; ++r)
    {
      Float8 sum = 0.f;
      for (int k = 0; k < numberOfValues; ++k)
      {
        sum = Fma(Float8(weights[r * numberOfValues + k]),
          Float8(values[static_cast<long long>(k) * stride + i]), sum);
      }
      result[r * resultStride + i] =
        Lane(Min(Max(sum, least), Float8(GetLargestChannel(i % 4))), 0);
    }
  }
}

void CombineRows(const float* values, int stride, int numberOfValues, const float* weights,
  int numberOfRows, bool keepNegative, float* result, long long resultStride, int size)
{
  TETRALUX_CHECK(size % 4 == 0);
  const Float8 least = keepNegative ? -Unbounded : 0.f;
  int row = 0;
  for (; row + RowsAtOnce <= numberOfRows; row += RowsAtOnce)
  {
    Combine<RowsAtOnce>(values, stride, numberOfValues, weights + row * numberOfValues, least,
      result + row * resultStride, resultStride, size);
  }
  for (; row < numberOfRows; ++row)
  {
    Combine<1>(values, stride, numberOfValues, weights + row * numberOfValues, least,
      result + row * resultStride, resultStride, size);
  }
}

template <class Channel>
void Encode(const float* values, std::size_t count, std::uint8_t* texels)
{
  auto* channels = reinterpret_cast<typename Channel::Type*>(texels);
  for (std::size_t i = 0; i < count; ++i)
  {
    channels[i] = Channel::Encode(values[i]);
  }
}

void EncodeChannels(
  TexelFormat format, const float* values, std::size_t count, std::uint8_t* texels)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return Encode<UNorm8Channel>(values, count, texels);
    case TexelFormat::UNorm16:
      return Encode<UNorm16Channel>(values, count, texels);
    case TexelFormat::Half:
      return Encode<HalfChannel>(values, count, texels);
    case TexelFormat::Float:
      std::memcpy(texels, values, count * sizeof(float));
  }
}

PreIntegrationKernels MakePreIntegrationKernels()
{
  return { IntegrateLengths, CombineRows, EncodeChannels };
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
