// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PolygonLimits_h
#define tetralux_PolygonLimits_h

// Clipping planes and cropping regions (Wald et al. 2007, section 7). Nodes and polygons that are
// wholly cut away are culled, those that are wholly kept cost nothing more, and the others are
// tested at each hit.

#include "Isosurface/FramePolygon.h"
#include "Isosurface/TraceInput.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

enum class LimitedPart
{
  None,
  Some,
  All
};

/// The regions that a box touches: a bit of a vtkVolumeMapper's CroppingRegionFlags for each.
template <class Real>
TETRALUX_INLINE std::uint32_t FindRegions(
  const TraceLimits& limits, const Real (&lower)[3], const Real (&upper)[3])
{
  std::uint32_t touched[3];
  for (int a = 0; a < 3; ++a)
  {
    const double first = limits.CroppingPlanes[2 * a];
    const double second = limits.CroppingPlanes[2 * a + 1];
    touched[a] = (lower[a] < first ? 1u : 0u) |
      (upper[a] >= first && lower[a] <= second ? 2u : 0u) | (upper[a] > second ? 4u : 0u);
  }
  std::uint32_t regions = 0;
  for (int z = 0; z < 3; ++z)
  {
    for (int y = 0; y < 3; ++y)
    {
      const bool any = (touched[2] >> z & 1) != 0 && (touched[1] >> y & 1) != 0;
      regions |= any ? touched[0] << (3 * y + 9 * z) : 0u;
    }
  }
  return regions;
}

TETRALUX_INLINE bool IsCroppedAway(
  const TraceLimits& limits, const float (&lower)[3], const float (&upper)[3])
{
  return (FindRegions(limits, lower, upper) & limits.CroppingFlags) == 0;
}

TETRALUX_INLINE double Evaluate(const double (&plane)[4], double x, double y, double z)
{
  return plane[0] * x + plane[1] * y + plane[2] * z + plane[3];
}

/// FindLimitedPart where there are limits.
TETRALUX_NOINLINE LimitedPart TestLimits(const TraceLimits& limits, const Isopolygon& polygon)
{
  bool all = true;
  for (int p = 0; p < limits.NumberOfPlanes; ++p)
  {
    int inside = 0;
    for (int i = 0; i < 4; ++i)
    {
      inside += Evaluate(limits.Planes[p], polygon.X[i], polygon.Y[i], polygon.Z[i]) >= 0;
    }
    if (inside == 0)
    {
      return LimitedPart::None;
    }
    all &= inside == 4;
  }
  if (limits.Cropping)
  {
    double lower[3] = { polygon.X[0], polygon.Y[0], polygon.Z[0] };
    double upper[3] = { polygon.X[0], polygon.Y[0], polygon.Z[0] };
    for (int i = 1; i < 4; ++i)
    {
      const double corner[3] = { polygon.X[i], polygon.Y[i], polygon.Z[i] };
      for (int a = 0; a < 3; ++a)
      {
        lower[a] = corner[a] < lower[a] ? corner[a] : lower[a];
        upper[a] = corner[a] > upper[a] ? corner[a] : upper[a];
      }
    }
    const std::uint32_t regions = FindRegions(limits, lower, upper);
    if ((regions & limits.CroppingFlags) == 0)
    {
      return LimitedPart::None;
    }
    all &= (regions & ~limits.CroppingFlags) == 0;
  }
  return all ? LimitedPart::All : LimitedPart::Some;
}

/// Which part of a polygon is kept.
TETRALUX_INLINE LimitedPart FindLimitedPart(const TraceLimits& limits, const Isopolygon& polygon)
{
  const bool limited = limits.NumberOfPlanes > 0 || limits.Cropping;
  return limited ? TestLimits(limits, polygon) : LimitedPart::All;
}

TETRALUX_INLINE bool IsKept(const TraceLimits& limits, const double (&point)[3])
{
  for (int p = 0; p < limits.NumberOfPlanes; ++p)
  {
    if (Evaluate(limits.Planes[p], point[0], point[1], point[2]) < 0)
    {
      return false;
    }
  }
  // On a plane between two regions both count.
  return !limits.Cropping || (FindRegions(limits, point, point) & limits.CroppingFlags) != 0;
}

/// HitChunk of a polygon that is partly cut away.
template <bool AnyHit>
TETRALUX_NOINLINE void HitChunkWithin(const TraceLimits& limits, const RayFrame& frame,
  const FramePolygon& polygon, std::int64_t id, RayPacket& packet, int chunk)
{
  double far[LaneCount];
  std::int64_t hit[LaneCount];
  const int first = chunk * LaneCount;
  for (int i = 0; i < LaneCount; ++i)
  {
    far[i] = packet.Far[first + i];
    hit[i] = packet.Hit[first + i];
  }
  HitChunk<false, false>(polygon, id, packet, chunk);
  for (int i = 0; i < LaneCount; ++i)
  {
    const int ray = first + i;
    if (packet.Far[ray] == far[i])
    {
      continue;
    }
    double point[3];
    GetPoint(frame, packet.U[ray], packet.V[ray], packet.Far[ray], point);
    if (!IsKept(limits, point))
    {
      packet.Far[ray] = far[i];
      packet.Hit[ray] = hit[i];
    }
    else if (AnyHit)
    {
      packet.Far[ray] = InfiniteKey;
    }
  }
  UpdateChunkFar(packet, chunk);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
