// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/KernelLighting.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

KernelLight MakeLight(const Light& light, const Material& surface, double unit)
{
  KernelLight result;
  result.Positional = light.Positional;
  result.IsSpot = light.Positional && light.ConeCosine > -1;
  result.Fades = light.Positional && (light.Attenuation[1] != 0 || light.Attenuation[2] != 0);
  double power = 1; // of the unit
  for (int a = 0; a < 3; ++a)
  {
    result.Position[a] = light.Position[a];
    result.Axis[a] = light.Axis[a];
    result.Falloff[a] = static_cast<float>(power * light.Attenuation[a]);
    result.Ambient[a] = surface.Ambient * light.Ambient[a];
    result.Diffuse[a] = surface.Diffuse * light.Diffuse[a];
    result.Specular[a] = surface.Specular * light.Specular[a];
    power *= unit;
  }
  result.IsWide = light.ConeCosine < 0;
  // Narrow cones have a sine with all of its digits.
  result.ConeSine =
    static_cast<float>(std::sqrt(std::max(0., 1 - light.ConeCosine * light.ConeCosine)));
  result.Exponent = static_cast<float>(light.Exponent);
  return result;
}

} // namespace

void FillKernelLighting(const std::vector<Light>& lights, const Material& surface,
  const RayGrid& grid, double unit, KernelLighting& lighting, std::vector<KernelLight>& memory)
{
  double largest = 0;
  for (const auto& row : grid.MeshFromWorld)
  {
    largest = std::max({ largest, std::abs(row[0]), std::abs(row[1]), std::abs(row[2]) });
  }
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      // Gradients are transformed by the transpose of what takes positions into the mesh.
      lighting.NormalFromMesh[column][row] =
        static_cast<float>(grid.MeshFromWorld[row][column] / largest);
    }
  }
  lighting.Unit = unit;
  lighting.SpecularPower = surface.SpecularPower;
  for (const Light& light : lights)
  {
    memory.push_back(MakeLight(light, surface, unit));
    for (const float specular : memory.back().Specular)
    {
      lighting.Shines = lighting.Shines || specular != 0;
    }
  }
  lighting.Lights = memory.data();
  lighting.NumberOfLights = static_cast<int>(memory.size());
}

} // namespace tetralux
