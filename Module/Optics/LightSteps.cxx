// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/LightSteps.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// Largest third derivative of cos(x)^power by x.
double BoundThirdDerivative(double power)
{
  // The power is nearly exp(-power x^2 / 2). Below 1 it has no bound where the cosine is 0.
  constexpr double OfGaussian = 1.4;
  constexpr double OfRoots = 8;
  return power > 1 ? OfGaussian * power * std::sqrt(power) : power < 1 ? OfRoots : 1;
}

} // namespace

LightSteps FindLightSteps(const std::vector<Light>& lights, const Material& surface, double error)
{
  // Largest third derivatives by angle, and by the logarithm of a distance.
  double byAngle = 0;
  double byDistance = 0;
  for (int c = 0; c < 3; ++c)
  {
    double turning = 0;
    double approaching = 0;
    for (const Light& light : lights)
    {
      const bool fades =
        light.Positional && (light.Attenuation[1] != 0 || light.Attenuation[2] != 0);
      // Parts are shorter where a light that fades is nearer than where all of it is left.
      const double share = light.Positional && !fades ? 1 / std::abs(light.Attenuation[0]) : 1;
      const double diffuse =
        share * std::abs(static_cast<double>(surface.Diffuse) * light.Diffuse[c]);
      const double specular =
        share * std::abs(static_cast<double>(surface.Specular) * light.Specular[c]);
      // A product of powers of cosines is at most as curved as one of the sum.
      const double ofSpot = light.Positional && light.ConeCosine > -1 ? light.Exponent : 0;
      turning += diffuse * BoundThirdDerivative(1 + ofSpot) +
        specular * BoundThirdDerivative(surface.SpecularPower + ofSpot);
      if (fades)
      {
        constexpr double OfInverseSquare = 24;
        approaching += OfInverseSquare * (diffuse + specular);
      }
    }
    byAngle = std::max(byAngle, turning);
    byDistance = std::max(byDistance, approaching);
  }
  // A parabola at the Chebyshev points is off by a third derivative over 192, up and down: most of
  // that cancels in the integral. What is left was measured over the scenes of TestLitVolumes: with
  // these steps pictures are off by less than the error.
  constexpr double OfChebyshevPoints = 192;
  constexpr double Cancelled = 24;
  constexpr double LeastStep = 1. / 256;
  LightSteps steps;
  steps.Error = std::max(error, SmallestLightError);
  const auto find = [&steps](double derivative)
  {
    constexpr double Scale = Cancelled * OfChebyshevPoints;
    const double step = derivative > 0 ? std::cbrt(Scale * steps.Error / derivative) : 1;
    if (step < LeastStep)
    {
      steps.Error = derivative * LeastStep * LeastStep * LeastStep / Scale;
    }
    return step < LeastStep ? LeastStep : std::min(step, 1.);
  };
  steps.Turn = find(byAngle);
  steps.Approach = find(byDistance);
  return steps;
}

Lighting FindLighting(bool shaded, bool smoothShading, const std::vector<Light>& lights)
{
  if (!shaded)
  {
    return Lighting::None;
  }
  const bool positional =
    std::any_of(lights.begin(), lights.end(), [](const Light& light) { return light.Positional; });
  return smoothShading || positional ? Lighting::Varying : Lighting::Even;
}

} // namespace tetralux
