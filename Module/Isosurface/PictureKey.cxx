// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/PictureKey.h"

#include "Base/Digest.h"
#include "Optics/LightKey.h"
#include "View/ViewKey.h"

namespace tetralux
{

CacheKey MakePictureKey(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const IsosurfaceOptions& options)
{
  CacheKey key = CacheKey::Of(scene.Mesh.GetCellsVersion(), scene.Mesh.GetPointsVersion(),
    scene.Mesh.GetScalarsVersion(), scene.Mesh.GetColorScalarsVersion(),
    scene.Optics.GetFunctionVersion(), scene.Optics.GetSurfacesVersion(), options.MaximumError,
    options.SmoothShading, options.Shadows, options.ShadowSoftness, options.AmbientOcclusion,
    options.OcclusionRadius, options.SamplesPerFrame, options.MaximumSamples, options.MaximumLayers,
    options.Polygons);
  AddRaysTo(key, grid);
  AddLimitsTo(key, limits);
  if (limits.MaximumDistances)
  {
    Digester distances;
    distances.Add(limits.MaximumDistances, sizeof(float) * grid.Width * grid.Height);
    AddNumbersTo(key, distances.Get());
  }
  AddMaterialTo(key, options.Surface);
  AddLightsTo(key, options.Lights);
  return key;
}

} // namespace tetralux
