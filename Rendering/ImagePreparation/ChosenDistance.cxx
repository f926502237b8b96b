// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ChosenDistance.h"

#include "Base/Digest.h"
#include "TriangleCaster/ImageError.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetralux
{
namespace
{

template <class Number, std::size_t Count>
void AddNumbers(const Number (&numbers)[Count], CacheKey& key)
{
  for (const Number number : numbers)
  {
    key.Add(number);
  }
}

void AddRays(const RayGrid& grid, CacheKey& key)
{
  key.Add(grid.Width);
  key.Add(grid.Height);
  for (const double(*vector)[3] : { &grid.Origin, &grid.OriginStepX, &grid.OriginStepY,
         &grid.Direction, &grid.DirectionStepX, &grid.DirectionStepY })
  {
    AddNumbers(*vector, key);
  }
  for (const double(&row)[4] : grid.MeshFromWorld)
  {
    AddNumbers(row, key);
  }
}

void AddLimits(const RayGrid& grid, const RayLimits& limits, CacheKey& key)
{
  key.Add(limits.Planes.size());
  for (const std::array<double, 4>& plane : limits.Planes)
  {
    for (const double coefficient : plane)
    {
      key.Add(coefficient);
    }
  }
  key.Add(limits.Cropping);
  AddNumbers(limits.CroppingPlanes, key);
  key.Add(limits.CroppingFlags);
  Digester distances;
  if (limits.MaximumDistances)
  {
    const std::size_t rays = static_cast<std::size_t>(grid.Width) * grid.Height;
    distances.Add(limits.MaximumDistances, rays * sizeof(float));
  }
  for (const std::uint64_t word : distances.Get())
  {
    key.Add(word);
  }
}

void AddLights(const ImageCasterOptions& options, CacheKey& key)
{
  key.Add(options.Shaded);
  key.Add(options.SumOfLights);
  key.Add(options.Surface.Ambient);
  key.Add(options.Surface.Diffuse);
  key.Add(options.Surface.Specular);
  key.Add(options.Surface.SpecularPower);
  key.Add(options.Lights.size());
  for (const Light& light : options.Lights)
  {
    key.Add(light.Positional);
    key.Add(light.ConeCosine);
    key.Add(light.Exponent);
    AddNumbers(light.Position, key);
    AddNumbers(light.Axis, key);
    AddNumbers(light.Ambient, key);
    AddNumbers(light.Diffuse, key);
    AddNumbers(light.Specular, key);
    AddNumbers(light.Attenuation, key);
  }
}

/// All that the pictures depend on, but tiles and threads.
CacheKey MakeKey(const RayGrid& grid, const RayLimits& limits, const ImageCasterOptions& options,
  double maximumError)
{
  CacheKey key = CacheKey::Of(maximumError, options.SampleDistance, options.Shape,
    options.CorrectOpacity, options.PreIntegrated, options.Gradients, options.Threshold,
    options.EndTriangles, options.SkipPixels);
  AddNumbers(options.NearColor, key);
  AddNumbers(options.FarColor, key);
  AddRays(grid, key);
  AddLimits(grid, limits, key);
  AddLights(options, key);
  return key;
}

} // namespace

bool ChosenDistance::Update(ImageCaster& caster, const RayGrid& grid, const RayLimits& limits,
  const ImageCasterOptions& options, double maximumError)
{
  return this->Distance.Update(MakeKey(grid, limits, options, maximumError),
    [&] { return ChooseSampleDistance(caster, grid, limits, options, maximumError); });
}

} // namespace tetralux
