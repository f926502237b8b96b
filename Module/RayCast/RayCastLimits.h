// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastLimits_h
#define tetralux_RayCastLimits_h

// Which part of each ray of a packet counts: planes, opaque geometry, cropping.

#include "RayCast/RayCastFrame.h"
#include "View/CroppedRay.h"

#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The part of each ray that counts, or the parts if it is cropped. Distances are from the ray's
/// point nearest to the centre of the mesh.
struct Intervals
{
  int Count;
  Double8 Begin[MostCroppedParts], End[MostCroppedParts];
};

/// start: distance of z = 0 along the rays.
TETRALUX_INLINE Intervals LimitRays(
  const KernelInput& in, int px, int py, const WorldRays& rays, Double8 start)
{
  const Double8(&origin)[3] = rays.Origin;
  const Double8(&direction)[3] = rays.Direction;
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  Intervals result;
  Double8 begin = -Infinity;
  Double8 end = Infinity;
  const Double8 zero = 0.;
  for (int p = 0; p < in.NumberOfPlanes; ++p)
  {
    const double* plane = in.Planes[p].data();
    const Double8 n[3] = { plane[0], plane[1], plane[2] };
    const Double8 height = Dot(n, origin[0], origin[1], origin[2]) + Double8(plane[3]);
    const Double8 slope = Dot(n, direction[0], direction[1], direction[2]);
    const Double8 t = (zero - height) / slope;
    begin = Select(zero < slope, Max(begin, t), begin);
    end = Select(slope < zero, Min(end, t), end);
    // Parallel to the plane: all or nothing.
    end = Select((slope == zero) & (height < zero), Double8(-Infinity), end);
  }
  if (in.MaximumDistances)
  {
    double farthest[LaneCount];
    for (int i = 0; i < LaneCount; ++i)
    {
      const int x = px + GetLaneColumn(i);
      const int y = py + GetLaneRow(i);
      farthest[i] = x < in.Grid->Width && y < in.Grid->Height
        ? static_cast<double>(
            in.MaximumDistances[static_cast<std::int64_t>(y) * in.Grid->Width + x])
        : -Infinity;
    }
    end = Min(end, LoadDouble8(farthest));
  }
  result.Count = 1;
  if (in.CroppingPlanes)
  {
    double o[3][LaneCount], d[3][LaneCount], b[LaneCount], e[LaneCount];
    for (int a = 0; a < 3; ++a)
    {
      const double* row = in.Grid->MeshFromWorld[a];
      const Double8 m[3] = { row[0], row[1], row[2] };
      Store(o[a], Dot(m, origin[0], origin[1], origin[2]) + Double8(row[3]));
      Store(d[a], Dot(m, direction[0], direction[1], direction[2]));
    }
    Store(b, begin);
    Store(e, end);
    double begins[MostCroppedParts][LaneCount], ends[MostCroppedParts][LaneCount];
    result.Count = 0;
    for (int i = 0; i < LaneCount; ++i)
    {
      const double origin1[3] = { o[0][i], o[1][i], o[2][i] };
      const double direction1[3] = { d[0][i], d[1][i], d[2][i] };
      const CroppedRay cropped =
        CropRay(*in.CroppingPlanes, in.CroppingFlags, origin1, direction1, b[i], e[i]);
      const int count = cropped.Count;
      for (int k = 0; k < MostCroppedParts; ++k)
      {
        begins[k][i] = k < count ? cropped.Begin[k] : Infinity;
        ends[k][i] = k < count ? cropped.End[k] : -Infinity;
      }
      result.Count = count > result.Count ? count : result.Count;
    }
    for (int k = 0; k < result.Count; ++k)
    {
      result.Begin[k] = LoadDouble8(begins[k]) - start;
      result.End[k] = LoadDouble8(ends[k]) - start;
    }
    return result;
  }
  result.Begin[0] = begin - start;
  result.End[0] = end - start;
  return result;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
