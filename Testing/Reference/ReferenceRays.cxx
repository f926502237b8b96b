// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRays.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{

using namespace reference;

namespace
{

Vector Step(const Vector& begin, Real i, const Vector& stepX, Real j, const Vector& stepY)
{
  Vector result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = begin[axis] + i * stepX[axis] + j * stepY[axis];
  }
  return result;
}

/// The region along one axis, 0..2, as in vtkFixedPointVolumeRayCastMapper.
int CroppingRegion(Real x, const double planes[2])
{
  return x < planes[0] ? 0 : x > planes[1] ? 2 : 1;
}

} // namespace

ReferenceRay MakeReferenceRay(const RayGrid& grid, int i, int j)
{
  ReferenceRay ray;
  ray.WorldOrigin =
    Step(ToVector(grid.Origin), i, ToVector(grid.OriginStepX), j, ToVector(grid.OriginStepY));
  ray.WorldDirection = Step(
    ToVector(grid.Direction), i, ToVector(grid.DirectionStepX), j, ToVector(grid.DirectionStepY));
  const Real length = std::sqrt(Dot(ray.WorldDirection, ray.WorldDirection));
  for (Real& component : ray.WorldDirection)
  {
    component /= length;
  }
  ray.Origin = TransformPoint(grid.MeshFromWorld, ray.WorldOrigin);
  ray.Direction = TransformDirection(grid.MeshFromWorld, ray.WorldDirection);
  return ray;
}

ReferenceIntervals ApplyReferenceLimits(
  const RayLimits& limits, const ReferenceRay& ray, std::size_t pixel, Real begin, Real end)
{
  for (const auto& plane : limits.Planes)
  {
    const Vector normal{ plane[0], plane[1], plane[2] };
    const Real distance = Dot(normal, ray.WorldOrigin) + plane[3];
    const Real slope = Dot(normal, ray.WorldDirection);
    if (slope > 0)
    {
      begin = std::max(begin, -distance / slope);
    }
    else if (slope < 0)
    {
      end = std::min(end, -distance / slope);
    }
    else if (!(distance >= 0))
    {
      return {};
    }
  }
  if (limits.MaximumDistances)
  {
    end = std::min<Real>(end, limits.MaximumDistances[pixel]);
  }
  if (!(begin < end))
  {
    return {};
  }
  if (!limits.Cropping)
  {
    return { { begin, end } };
  }

  std::vector<Real> borders{ begin, end };
  for (int plane = 0; plane < 6; ++plane)
  {
    const int axis = plane / 2;
    const Real t = (limits.CroppingPlanes[plane] - ray.Origin[axis]) / ray.Direction[axis];
    if (t > begin && t < end)
    {
      borders.push_back(t);
    }
  }
  std::sort(borders.begin(), borders.end());
  ReferenceIntervals kept;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i)
  {
    const Real middle = borders[i] / 2 + borders[i + 1] / 2;
    int region = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      region = 3 * region +
        CroppingRegion(
          ray.Origin[axis] + middle * ray.Direction[axis], limits.CroppingPlanes + 2 * axis);
    }
    if (!(limits.CroppingFlags >> region & 1))
    {
      continue;
    }
    // A plane between two regions that are kept cuts nothing.
    if (!kept.empty() && kept.back()[1] == borders[i])
    {
      kept.back()[1] = borders[i + 1];
    }
    else
    {
      kept.push_back({ borders[i], borders[i + 1] });
    }
  }
  return kept;
}

} // namespace tetralux
