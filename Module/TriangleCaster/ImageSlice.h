// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageSlice_h
#define tetralux_ImageSlice_h

// What a plane cuts out of a volume.

#include "TriangleCaster/ImageRays.h"
#include "TriangleCaster/ImageSample.h"
#include "TriangleCaster/MaskLanes.h"
#include "TriangleCaster/ValuePixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The sample that each ray has on in.SlicePlane, if that is within a part of it.
inline ImageSample FindSliceSample(const ImageKernelInput& in, const ImageRays& rays)
{
  const std::int32_t strides[3] = { 1, in.Row, in.Slice };
  std::int32_t index[LaneCount];
  float place[3][LaneCount], middle[LaneCount];
  unsigned active = 0;
  for (int l = 0; l < LaneCount; ++l)
  {
    index[l] = 0;
    place[0][l] = place[1][l] = place[2][l] = middle[l] = 0.f;
    const double i = rays.X[l], j = rays.Y[l];
    const double direction[3] = { in.WorldDirection[0].At(i, j), in.WorldDirection[1].At(i, j),
      in.WorldDirection[2].At(i, j) };
    // Not finite along the plane, and then in no part.
    const double way = -in.SlicePlane.Height.At(i, j) / in.SlicePlane.Slope.At(i, j);
    const double position =
      (way * in.Slices.GetDepthOfDirection(direction) - in.Slices.Origin) / in.Slices.Distance;
    bool within = false;
    for (int p = 0; p < rays.PartCount; ++p)
    {
      within = within ||
        (rays.First[p][l] <= rays.Last[p][l] &&
          rays.First[p][l] + static_cast<double>(rays.Begin[p][l]) <= position &&
          position <= rays.Last[p][l] + static_cast<double>(rays.End[p][l]));
    }
    if (!within)
    {
      continue;
    }
    active |= 1u << l;
    middle[l] = static_cast<float>(position);
    for (int a = 0; a < 3; ++a)
    {
      const double x = rays.Base[a][l] + position * rays.Step[a][l];
      const double cell = std::clamp(std::floor(x), 0., static_cast<double>(in.LastCell[a]));
      index[l] += static_cast<std::int32_t>(cell) * strides[a];
      place[a][l] = static_cast<float>(x - cell);
    }
  }
  ImageSample sample{};
  sample.Index = LoadInt8(index);
  for (int a = 0; a < 3; ++a)
  {
    sample.Place[a] = LoadFloat8(place[a]);
  }
  sample.Active = MaskFromBits(active);
  sample.Middle = LoadFloat8(middle);
  return sample;
}

/// Pixels of rays that were set up.
template <class Value>
PixelLanes GetSlicePixels(const ImageKernelInput& in, const ImageRays& rays, std::int64_t& samples)
{
  ImageSample sample = FindSliceSample(in, rays);
  if (in.Masked)
  {
    sample.Active = sample.Active & FindShown(in, sample);
  }
  samples += __builtin_popcount(Bits(sample.Active));
  const Float8 x = sample.GetScalar<Value>(in);
  return GetValuePixels(in, sample.Active & (Abs(x) <= Float8(LargestScalar)), x, sample.Middle);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
