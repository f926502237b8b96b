// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceShading.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// v / |v|, or zero where v is zero.
Vector Normalize(Vector v)
{
  // Scaled first, since the square of a gradient may be beyond the range of numbers.
  const double largest = std::max({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) });
  if (largest == 0)
  {
    return v;
  }
  for (double& component : v)
  {
    component /= largest;
  }
  const double length = std::sqrt(Dot(v, v));
  for (double& component : v)
  {
    component /= length;
  }
  return v;
}

/// The direction from a point towards a light, and the share of the light that arrives.
Vector FindLight(const Light& light, const Vector& point, double& share)
{
  const double* p = light.Position;
  share = 1;
  if (!light.Positional)
  {
    return { p[0], p[1], p[2] };
  }
  const Vector offset{ p[0] - point[0], p[1] - point[1], p[2] - point[2] };
  const double distance = std::sqrt(Dot(offset, offset));
  const Vector direction = Normalize(offset);
  const double* a = light.Attenuation;
  share = 1 / (a[0] + distance * (a[1] + distance * a[2]));
  if (light.ConeCosine > -1)
  {
    const double cosine = -Dot(direction, { light.Axis[0], light.Axis[1], light.Axis[2] });
    share *= cosine >= light.ConeCosine ? std::pow(std::max(0.0, cosine), light.Exponent) : 0.0;
  }
  return direction;
}

} // namespace

ReferenceLight FindReferenceLight(const Material& material, const std::vector<Light>& lights,
  const Vector& point, const Vector& normal, const Vector& view)
{
  Vector n = Normalize(normal);
  if (Dot(n, view) < 0)
  {
    n = { -n[0], -n[1], -n[2] };
  }
  else if (Dot(n, n) == 0)
  {
    n = view;
  }
  ReferenceLight result;
  for (const Light& light : lights)
  {
    double share;
    const Vector l = FindLight(light, point, share);
    const double facing = Dot(n, l);
    const double diffuse = facing > 0 ? share * material.Diffuse * facing : 0;
    const Vector h = Normalize({ l[0] + view[0], l[1] + view[1], l[2] + view[2] });
    const double mirrored = Dot(n, h);
    const double specular = facing > 0 && mirrored > 0
      ? share * material.Specular * std::pow(mirrored, static_cast<double>(material.SpecularPower))
      : 0;
    for (int channel = 0; channel < 3; ++channel)
    {
      result.Scale[channel] +=
        material.Ambient * light.Ambient[channel] + diffuse * light.Diffuse[channel];
      result.Add[channel] += specular * light.Specular[channel];
    }
  }
  return result;
}

Vector ShadeReference(const float color[3], const Material& material,
  const std::vector<Light>& lights, const Vector& point, const Vector& normal, const Vector& view)
{
  const ReferenceLight light = FindReferenceLight(material, lights, point, normal, view);
  Vector result;
  for (int channel = 0; channel < 3; ++channel)
  {
    result[channel] =
      std::min(1.0, std::max(0.0, color[channel] * light.Scale[channel] + light.Add[channel]));
  }
  return result;
}

} // namespace tetralux
