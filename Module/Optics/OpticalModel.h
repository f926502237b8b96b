// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OpticalModel_h
#define tetralux_OpticalModel_h

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralux
{

/// What a ray gathers (Weiler et al. 2003, section 4), with tau the attenuation and c the colour of
/// the transfer function at the scalar.
enum class OpticalModel
{
  /// Density emitter: radiance is the integral of tau c exp(-optical depth), opacity
  /// 1 - exp(-optical depth).
  EmissionAbsorption,

  /// Light adds up and nothing is in front of anything: radiance is the integral of tau
  /// c, opacity 0.
  EmissionOnly,

  /// Dark smoke: radiance 0, opacity 1 - exp(-optical depth).
  AbsorptionOnly,

  /// Colour and opacity of the largest scalar along the ray. Opacity here is the scalar opacity
  /// itself, not per length: TransferFunction::Attenuation is taken for it, 0..1.
  MaximumIntensity,

  /// Surfaces of constant scalar, each with a colour and an opacity, composited front to back;
  /// flat, or shaded by the gradient of the cell.
  Isosurfaces
};

/// A surface of constant scalar.
struct Isosurface
{
  double Value;   ///< in the units of the scalars, finite
  float Color[3]; ///< red, green, blue, not multiplied by anything; usually 0..1
  float Opacity;  ///< 0..1
};

/// A light as surfaces see it.
struct Light
{
  /// World coordinates: the position of the light, or for a distant one the direction towards it,
  /// of length 1.
  double Position[3];
  bool Positional;
  float Ambient[3];  ///< times Material::Ambient times the surface's colour
  float Diffuse[3];  ///< times Material::Diffuse times the surface's colour
  float Specular[3]; ///< times Material::Specular
  /// Share of the light at distance d from a positional one: 1 / (a0 + a1 d + a2 d^2).
  double Attenuation[3] = { 1, 0, 0 };
  /// Of a positional light that is a spot: world direction of its axis, of length 1, cosine of half
  /// its cone and exponent; a cosine of -1 or less is no spot.
  double Axis[3] = { 0, 0, -1 };
  double ConeCosine = -1;
  double Exponent = 1;
};

/// How a shaded surface answers to lights: the coefficients of vtkVolumeProperty.
struct Material
{
  float Ambient = 0.1f;
  float Diffuse = 0.7f;
  float Specular = 0.2f;
  float SpecularPower = 10.f; ///< of 1 or more
};

/// How much brighter than what is lit, at 1 or less, lights may make it; at least 1. What is behind
/// a ray's end counts by that. center, radius: of the mesh, in its coordinates; scale: least world
/// length of a unit of them. A positional light counts as it shines at the mesh's nearest, but not
/// nearer than a twentieth of the radius.
inline double FindLargestBrightness(const std::vector<Light>& lights, const Material& surface,
  const double (*meshFromWorld)[4], const double center[3], double radius, double scale)
{
  constexpr double Nearest = 1. / 20;
  double largest = 1;
  for (int c = 0; c < 3; ++c)
  {
    double sum = 0;
    for (const Light& light : lights)
    {
      double share = 1;
      if (light.Positional)
      {
        double offset[3];
        for (int a = 0; a < 3; ++a)
        {
          const double* row = meshFromWorld[a];
          offset[a] = row[0] * light.Position[0] + row[1] * light.Position[1] +
            row[2] * light.Position[2] + row[3] - center[a];
        }
        const double toCenter = std::hypot(offset[0], offset[1], offset[2]);
        const double distance = scale * std::max(toCenter - radius, Nearest * radius);
        const double* k = light.Attenuation;
        share = 1 / (k[0] + distance * (k[1] + distance * k[2]));
      }
      sum += std::abs(surface.Ambient * light.Ambient[c]) +
        share *
          (std::abs(surface.Diffuse * light.Diffuse[c]) +
            std::abs(surface.Specular * light.Specular[c]));
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

} // namespace tetralux

#endif
