// SPDX-License-Identifier: BSD-3-Clause
#include "PlainRays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{

PlainVector Normalize(const PlainVector& v)
{
  const double length = std::sqrt(Dot(v, v));
  return length > 0 ? PlainVector{ v[0] / length, v[1] / length, v[2] / length } : v;
}

PlainRay MakePlainRay(const RayGrid& grid, const SlicePlanes& slices, int i, int j)
{
  PlainRay ray;
  for (int a = 0; a < 3; ++a)
  {
    ray.Start[a] = grid.Origin[a] + i * grid.OriginStepX[a] + j * grid.OriginStepY[a];
    ray.Direction[a] = grid.Direction[a] + i * grid.DirectionStepX[a] + j * grid.DirectionStepY[a];
  }
  ray.Direction = Normalize(ray.Direction);
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const PlainVector linear = { row[0], row[1], row[2] };
    ray.IndexStart[a] = Dot(linear, ray.Start) + row[3];
    ray.IndexDirection[a] = Dot(linear, ray.Direction);
  }
  ray.DepthOfDirection = slices.Shape == SliceShape::Planes
    ? Dot(ray.Direction, { slices.Normal[0], slices.Normal[1], slices.Normal[2] })
    : 1;
  return ray;
}

std::vector<PlainSlab> FindPlainSlabs(
  const std::array<int, 3>& dimensions, const SlicePlanes& slices, const PlainRay& ray)
{
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a)
  {
    const double low = -ray.IndexStart[a] / ray.IndexDirection[a];
    const double high = (dimensions[a] - 1 - ray.IndexStart[a]) / ray.IndexDirection[a];
    enter = std::max(enter, std::min(low, high));
    leave = std::min(leave, std::max(low, high));
  }
  std::vector<PlainSlab> slabs;
  for (int n = 0; n < slices.Count; ++n)
  {
    const double depth = slices.Origin + n * slices.Distance;
    const PlainSlab slab = { std::max(enter, depth / ray.DepthOfDirection),
      std::min(leave, (depth + slices.Distance) / ray.DepthOfDirection) };
    if (slab.Begin < slab.End)
    {
      slabs.push_back(slab);
    }
  }
  return slabs;
}

PlainPlace::PlainPlace(const std::array<int, 3>& dimensions, const PlainVector& index)
{
  for (int a = 0; a < 3; ++a)
  {
    this->Cell[a] = static_cast<int>(std::clamp(std::floor(index[a]), 0., dimensions[a] - 2.));
    this->Share[a] = index[a] - this->Cell[a];
  }
}

PlainVector ToWorld(const RayGrid& grid, const PlainVector& gradient)
{
  PlainVector world = { 0, 0, 0 };
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      world[a] += grid.MeshFromWorld[b][a] * gradient[b];
    }
  }
  return world;
}

PlainVector Shine(const std::vector<Light>& lights, const Material& surface,
  const PlainVector& color, const PlainVector& normal, const PlainVector& point,
  const PlainVector& view)
{
  PlainVector side = Normalize(normal);
  const bool exists = Dot(side, side) > 0;
  const double sign = Dot(side, view) > 0 ? -1 : 1;
  for (int a = 0; a < 3; ++a)
  {
    side[a] = exists ? sign * side[a] : -view[a];
  }
  PlainVector lit = { 0, 0, 0 };
  for (const Light& light : lights)
  {
    PlainVector toLight = { light.Position[0], light.Position[1], light.Position[2] };
    double share = 1;
    if (light.Positional)
    {
      for (int a = 0; a < 3; ++a)
      {
        toLight[a] -= point[a];
      }
      const double distance = std::sqrt(Dot(toLight, toLight));
      toLight = Normalize(toLight);
      share = 1 /
        (light.Attenuation[0] +
          distance * (light.Attenuation[1] + distance * light.Attenuation[2]));
      if (light.ConeCosine > -1)
      {
        const double cosine = -Dot(toLight, { light.Axis[0], light.Axis[1], light.Axis[2] });
        share *= cosine >= light.ConeCosine ? std::pow(std::max(cosine, 0.), light.Exponent) : 0;
      }
    }
    const double cosine = std::max(0., Dot(side, toLight));
    const PlainVector halfway =
      Normalize({ toLight[0] - view[0], toLight[1] - view[1], toLight[2] - view[2] });
    const double highlight =
      cosine > 0 ? std::pow(std::max(0., Dot(side, halfway)), surface.SpecularPower) : 0;
    for (int c = 0; c < 3; ++c)
    {
      lit[c] += color[c] *
          (surface.Ambient * light.Ambient[c] +
            share * cosine * surface.Diffuse * light.Diffuse[c]) +
        share * highlight * surface.Specular * light.Specular[c];
    }
  }
  return lit;
}

} // namespace tetralux
