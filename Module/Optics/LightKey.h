// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LightKey_h
#define tetralux_LightKey_h

// What lit pictures follow from, for the keys of what is kept. KeyT: CacheKey.

#include "Optics/OpticalModel.h"

#include <vector>

namespace tetralux
{

template <class KeyT>
void AddMaterialTo(KeyT& key, const Material& material)
{
  for (const float number :
    { material.Ambient, material.Diffuse, material.Specular, material.SpecularPower })
  {
    key.Add(number);
  }
}

template <class KeyT>
void AddLightsTo(KeyT& key, const std::vector<Light>& lights)
{
  const auto add = [&key](const auto& numbers)
  {
    for (const auto number : numbers)
    {
      key.Add(number);
    }
  };
  key.Add(lights.size());
  for (const Light& light : lights)
  {
    key.Add(light.Positional);
    add(light.Position);
    add(light.Ambient);
    add(light.Diffuse);
    add(light.Specular);
    add(light.Attenuation);
    add(light.Axis);
    key.Add(light.ConeCosine);
    key.Add(light.Exponent);
  }
}

} // namespace tetralux

#endif
