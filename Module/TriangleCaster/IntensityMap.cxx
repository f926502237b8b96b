// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/IntensityMap.h"

#include "Lighting/LaneLights.h"

#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

using namespace TETRALUX_ISA;

/// The direction of the ray through the picture's centre.
void FindView(const RayGrid& grid, double (&view)[3])
{
  for (int a = 0; a < 3; ++a)
  {
    view[a] = grid.Direction[a] + 0.5 * (grid.Width - 1) * grid.DirectionStepX[a] +
      0.5 * (grid.Height - 1) * grid.DirectionStepY[a];
  }
  const double length = std::hypot(view[0], view[1], view[2]);
  for (double& v : view)
  {
    v /= length;
  }
}

CacheKey MakeKey(const KernelLighting& lighting, const double (&view)[3])
{
  CacheKey key = CacheKey::Of(lighting.NumberOfLights, lighting.Shines, lighting.SpecularPower);
  for (int a = 0; a < 3; ++a)
  {
    key.Add(view[a]);
    for (const float n : lighting.NormalFromMesh[a])
    {
      key.Add(n);
    }
    for (int i = 0; i < lighting.NumberOfLights; ++i)
    {
      const KernelLight& light = lighting.Lights[i];
      key.Add(light.Position[a]);
      key.Add(light.Ambient[a]);
      key.Add(light.Diffuse[a]);
      key.Add(light.Specular[a]);
    }
  }
  return key;
}

/// Stores the entries of some gradients of the mesh, one after the other.
void Fill(const KernelLighting& lighting, const LaneLights& lights, const LaneVector& gradients,
  int count, IntensityMap::Entry* entries)
{
  const LaneFactors factors =
    lights.Find(lighting, LaneLights::ToWorld(lighting, gradients), Double8(0.));
  for (int c = 0; c < 3; ++c)
  {
    float scale[LaneCount], add[LaneCount];
    Store(scale, factors.Scale.C[c]);
    Store(add, factors.Add.C[c]);
    for (int l = 0; l < count; ++l)
    {
      entries[l].Scale[c] = scale[l];
      entries[l].Add[c] = add[l];
    }
  }
}

std::vector<IntensityMap::Entry> MakeEntries(
  const KernelLighting& lighting, const double (&view)[3], int threads)
{
  constexpr int Size = IntensityMap::Size;
  static_assert(Size % LaneCount == 0);
  WorldRays rays;
  for (int a = 0; a < 3; ++a)
  {
    rays.Origin[a] = Double8(0.);
    rays.Direction[a] = Double8(view[a]);
  }
  const LaneLights lights(rays, Double8(0.));
  std::vector<IntensityMap::Entry> entries(IntensityMap::NoGradient + Size + 2);
  const auto place = [](int k) { return static_cast<float>(2. * k / (Size - 1) - 1); };
#pragma omp parallel for num_threads(threads) schedule(static)
  for (int row = 0; row < 3 * Size; ++row)
  {
    const int axis = row / Size;
    for (int first = 0; first < Size; first += LaneCount)
    {
      float u[LaneCount];
      for (int l = 0; l < LaneCount; ++l)
      {
        u[l] = place(first + l);
      }
      LaneVector gradients;
      gradients.C[axis] = 1.f;
      gradients.C[(axis + 1) % 3] = LoadFloat8(u);
      gradients.C[(axis + 2) % 3] = place(row % Size);
      Fill(lighting, lights, gradients, LaneCount, &entries[row * Size + first]);
    }
  }
  IntensityMap::Entry& none = entries[IntensityMap::NoGradient];
  Fill(lighting, lights, { { 0.f, 0.f, 0.f } }, 1, &none);
  std::fill(entries.begin() + IntensityMap::NoGradient, entries.end(), IntensityMap::Entry(none));
  return entries;
}

} // namespace

void IntensityMap::Update(const KernelLighting& lighting, const RayGrid& grid, int threads)
{
  for (int i = 0; i < lighting.NumberOfLights; ++i)
  {
    if (lighting.Lights[i].Positional)
    {
      throw std::invalid_argument("the intensity map takes distant lights only");
    }
  }
  double view[3];
  FindView(grid, view);
  this->Entries.Update(
    MakeKey(lighting, view), [&] { return MakeEntries(lighting, view, threads); });
}

} // namespace tetralux
