// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/PictureKey.h"

#include "Base/Digest.h"

#include <array>

namespace tetralux
{

CacheKey MakePictureKey(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const IsosurfaceOptions& options)
{
  CacheKey key = CacheKey::Of(scene.Mesh.GetCellsVersion(), scene.Mesh.GetPointsVersion(),
    scene.Mesh.GetScalarsVersion(), scene.Mesh.GetColorScalarsVersion(),
    scene.Optics.GetFunctionVersion(), scene.Optics.GetSurfacesVersion(), grid.Width, grid.Height,
    limits.Cropping, limits.CroppingFlags, options.MaximumError, options.SmoothShading,
    options.Shadows, options.ShadowSoftness, options.AmbientOcclusion, options.OcclusionRadius,
    options.SamplesPerFrame, options.MaximumSamples, options.MaximumLayers, options.Polygons);
  const auto add = [&key](const auto& numbers)
  {
    for (const auto number : numbers)
    {
      key.Add(number);
    }
  };
  add(grid.Origin);
  add(grid.OriginStepX);
  add(grid.OriginStepY);
  add(grid.Direction);
  add(grid.DirectionStepX);
  add(grid.DirectionStepY);
  for (const auto& row : grid.MeshFromWorld)
  {
    add(row);
  }
  for (const auto& plane : limits.Planes)
  {
    add(plane);
  }
  add(limits.CroppingPlanes);
  if (limits.MaximumDistances)
  {
    Digester distances;
    distances.Add(limits.MaximumDistances, sizeof(float) * grid.Width * grid.Height);
    add(distances.Get());
  }
  const Material& surface = options.Surface;
  add(std::array<float, 4>{
    surface.Ambient, surface.Diffuse, surface.Specular, surface.SpecularPower });
  for (const Light& light : options.Lights)
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
  return key;
}

} // namespace tetralux
