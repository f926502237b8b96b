// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/LightAlongRay.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// Shortest part, as a share of the way. What a nearer cut would change is less than single
/// precision keeps of the cell's light.
constexpr double ShortestPart = 1. / (1 << 20);

double Dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The shares where a quadratic function c + b t + a t^2 changes its sign, from the nearest one on;
/// cut keeps those that it wants.
template <class Cut>
void FindRoots(double c, double b, double a, const Cut& cut)
{
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0))
  {
    return;
  }
  // Of both roots the one without cancellation; the other one by their product.
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  cut(c / q);
  cut(q / a);
}

/// How far a vector that is linear in the share may go on until its direction has turned by an
/// angle, whose tangent is given; infinity: it never does.
double FindTurn(const double vector[3], const double change[3], double tangent)
{
  const double length = std::sqrt(Dot(vector, vector));
  const double along = Dot(vector, change) / length;
  double across = 0;
  for (int a = 0; a < 3; ++a)
  {
    const double d = change[a] - along * vector[a] / length;
    across += d * d;
  }
  const double rate = std::sqrt(across) - tangent * along;
  return rate > 0 ? tangent * length / rate : HUGE_VAL;
}

} // namespace

LightAlongRay::LightAlongRay(const SurfaceShading& shading, std::int32_t cell,
  const double front[3], const double back[3], const double direction[3])
  : Shading(&shading)
{
  FindGradient(shading, cell, front, this->Gradient);
  std::fill_n(this->Change, 3, 0.);
  if (shading.Gradients)
  {
    FindGradient(shading, cell, back, this->Change);
    for (int a = 0; a < 3; ++a)
    {
      this->Change[a] -= this->Gradient[a];
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    this->Front[a] = front[a];
    this->Way[a] = back[a] - front[a];
    this->Direction[a] = direction[a];
  }
}

LightFactors LightAlongRay::At(double share) const
{
  double gradient[3], position[3];
  for (int a = 0; a < 3; ++a)
  {
    gradient[a] = this->Gradient[a] + share * this->Change[a];
    position[a] = this->Front[a] + share * this->Way[a];
  }
  return Illuminate(*this->Shading, gradient, position, this->Direction);
}

double LightAlongRay::FindEnd(double begin) const
{
  double end = 1;
  // A cut that is nearer was there before.
  const auto cut = [&end, begin](double share)
  { end = share > begin + ShortestPart && share < end ? share : end; };
  const auto limit = [&end, begin](double step)
  {
    const double share = begin + std::max(step, ShortestPart);
    end = share < end ? share : end;
  };
  const double* g = this->Gradient;
  const double* dg = this->Change;
  double gradient[3];
  for (int a = 0; a < 3; ++a)
  {
    gradient[a] = g[a] + begin * dg[a];
  }
  const double tangent = std::tan(this->Shading->Steps.Turn);
  cut(-Dot(g, this->Direction) / Dot(dg, this->Direction));
  limit(FindTurn(gradient, dg, tangent));
  for (const Light& light : this->Shading->Lights)
  {
    if (!light.Positional)
    {
      cut(-Dot(g, light.Position) / Dot(dg, light.Position));
      continue;
    }
    double toLight[3], change[3], fromBegin[3];
    for (int a = 0; a < 3; ++a)
    {
      toLight[a] = light.Position[a] - this->Front[a];
      change[a] = -this->Way[a];
      fromBegin[a] = toLight[a] + begin * change[a];
    }
    const double approach = Dot(toLight, change);
    const double way2 = Dot(change, change);
    FindRoots(Dot(g, toLight), Dot(g, change) + Dot(dg, toLight), Dot(dg, change), cut);
    cut(-approach / way2);
    limit(FindTurn(fromBegin, change, tangent));
    if (light.Attenuation[1] != 0 || light.Attenuation[2] != 0)
    {
      limit(this->Shading->Steps.Approach * std::sqrt(Dot(fromBegin, fromBegin) / way2));
    }
    if (light.ConeCosine > -1)
    {
      // Where the cosine to the axis is that of the cone, or opposite to it.
      const double squared = light.ConeCosine * light.ConeCosine;
      const double axial = Dot(toLight, light.Axis);
      const double axialChange = Dot(change, light.Axis);
      FindRoots(axial * axial - squared * Dot(toLight, toLight),
        2 * (axial * axialChange - squared * approach), axialChange * axialChange - squared * way2,
        cut);
    }
  }
  return end < 1 - ShortestPart ? end : 1;
}

} // namespace tetralux
