// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/RendererLights.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkRenderer.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// From this cone angle on a positional light is no spot, in degrees, see vtkLight.
constexpr double SmallestOpenCone = 90;

Light MakeLight(vtkLight* source)
{
  Light light;
  double position[3], focalPoint[3];
  source->GetTransformedPosition(position);
  source->GetTransformedFocalPoint(focalPoint);
  double axis[3] = { focalPoint[0] - position[0], focalPoint[1] - position[1],
    focalPoint[2] - position[2] };
  vtkMath::Normalize(axis);
  light.Positional = source->GetPositional() != 0;
  for (int a = 0; a < 3; ++a)
  {
    light.Axis[a] = axis[a];
    light.Position[a] = light.Positional ? position[a] : -axis[a];
    const double intensity = source->GetIntensity();
    light.Ambient[a] = static_cast<float>(intensity * source->GetAmbientColor()[a]);
    light.Diffuse[a] = static_cast<float>(intensity * source->GetDiffuseColor()[a]);
    light.Specular[a] = light.Diffuse[a];
  }
  source->GetAttenuationValues(light.Attenuation);
  if (light.Attenuation[0] == 0 && light.Attenuation[1] == 0 && light.Attenuation[2] == 0)
  {
    light.Attenuation[0] = 1; // nothing to divide by: distance does not weaken it
  }
  light.ConeCosine = source->GetConeAngle() < SmallestOpenCone
    ? std::cos(vtkMath::RadiansFromDegrees(source->GetConeAngle()))
    : -1;
  light.Exponent = source->GetExponent();
  return light;
}

} // namespace

std::vector<Light> GetRendererLights(vtkRenderer* renderer)
{
  std::vector<Light> lights;
  vtkLightCollection* sources = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  sources->InitTraversal(iterator);
  while (vtkLight* source = sources->GetNextLight(iterator))
  {
    if (source->GetSwitch())
    {
      lights.push_back(MakeLight(source));
    }
  }
  for (int c = 0; c < 3 && !lights.empty(); ++c)
  {
    lights.front().Ambient[c] += static_cast<float>(renderer->GetAmbient()[c]);
  }
  return lights;
}

Material GetMaterial(vtkVolumeProperty* property, int component)
{
  Material material;
  material.Ambient = static_cast<float>(property->GetAmbient(component));
  material.Diffuse = static_cast<float>(property->GetDiffuse(component));
  material.Specular = static_cast<float>(property->GetSpecular(component));
  material.SpecularPower = static_cast<float>(std::max(property->GetSpecularPower(component), 0.));
  return material;
}

} // namespace tetralux
