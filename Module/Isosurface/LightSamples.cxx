// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/LightSamples.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Sample i of a series that fills the unit square evenly wherever it ends: multiples of powers of
/// the plastic number (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018).
void GetSample(int i, double& x, double& y)
{
  constexpr double Plastic = 1.32471795724474602596;
  const double a = 0.5 + i / Plastic;
  const double b = 0.5 + i / (Plastic * Plastic);
  x = a - std::floor(a);
  y = b - std::floor(b);
}

double Dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void Normalize(double (&v)[3])
{
  const double length = std::hypot(v[0], v[1], v[2]);
  for (double& x : v)
  {
    x /= length;
  }
}

/// Two directions across one of length 1.
void FindAcross(const double (&along)[3], double (&first)[3], double (&second)[3])
{
  int smallest = 0;
  for (int a = 1; a < 3; ++a)
  {
    smallest = std::abs(along[a]) < std::abs(along[smallest]) ? a : smallest;
  }
  for (int a = 0; a < 3; ++a)
  {
    first[a] = (a == smallest ? 1 : 0) - along[smallest] * along[a];
  }
  Normalize(first);
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    second[a] = along[b] * first[c] - along[c] * first[b];
  }
}

void ToMesh(const RayGrid& grid, const MeshFrame& mesh, const double (&world)[3], bool isPoint,
  double (&result)[3])
{
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const double offset = isPoint ? row[3] - mesh.Center[a] : 0;
    result[a] = (Dot(row, world) + offset) / mesh.Radius;
  }
}

/// place: in the mesh's frame, the point of the light or the direction to it.
void SetPlace(const double (&place)[3], ShadowSource& source)
{
  std::copy_n(place, 3, source.Place);
  if (source.Positional)
  {
    for (int side = 0; side < 6; ++side)
    {
      source.Frames[side] = MakeAxisFrame(place, side / 2, side % 2 == 1);
    }
    return;
  }
  // Depths as radii of the mesh.
  const double length = std::hypot(place[0], place[1], place[2]);
  const double direction[3] = { -place[0] / length, -place[1] / length, -place[2] / length };
  source.Frames[0] = MakeParallelFrame(direction);
}

} // namespace

std::vector<ShadowSource> MakeShadowSources(const std::vector<Light>& lights, const RayGrid& grid,
  const MeshFrame& mesh, double angle, const SampleRange& samples)
{
  std::vector<ShadowSource> sources;
  const int count = angle > 0 ? samples.Count : 1;
  for (std::size_t l = 0; l < lights.size(); ++l)
  {
    const Light& light = lights[l];
    for (int s = 0; s < count; ++s)
    {
      ShadowSource source{};
      source.Light = static_cast<int>(l);
      source.First = s == 0;
      source.Share = 1.f / static_cast<float>(count);
      source.Positional = light.Positional;
      double place[3];
      ToMesh(grid, mesh, light.Position, light.Positional, place);
      if (angle > 0)
      {
        // A disc towards the mesh's centre, in the mesh's frame.
        const double distance = std::hypot(place[0], place[1], place[2]);
        if (distance > 0)
        {
          double along[3] = { place[0] / distance, place[1] / distance, place[2] / distance };
          double first[3], second[3], x, y;
          FindAcross(along, first, second);
          GetSample(samples.First + s, x, y);
          const double radius = distance * std::tan(angle / 2) * std::sqrt(x);
          for (int a = 0; a < 3; ++a)
          {
            place[a] +=
              radius * (std::cos(2 * Pi * y) * first[a] + std::sin(2 * Pi * y) * second[a]);
          }
        }
      }
      SetPlace(place, source);
      sources.push_back(source);
    }
  }
  return sources;
}

std::vector<OcclusionSample> MakeOcclusionSamples(
  const RayGrid& grid, const MeshFrame& mesh, const SampleRange& samples)
{
  std::vector<OcclusionSample> result;
  for (int s = 0; s < samples.Count; ++s)
  {
    double x, y;
    GetSample(samples.First + s, x, y);
    const double height = 1 - 2 * x;
    const double around = std::sqrt(std::max(0., 1 - height * height));
    const double towards[3] = { around * std::cos(2 * Pi * y), around * std::sin(2 * Pi * y),
      height };
    const double world[3] = { -towards[0], -towards[1], -towards[2] };
    double direction[3];
    ToMesh(grid, mesh, world, false, direction);
    OcclusionSample sample{};
    sample.Frame = MakeParallelFrame(direction);
    for (int a = 0; a < 3; ++a)
    {
      sample.Direction[a] = static_cast<float>(towards[a]);
    }
    result.push_back(sample);
  }
  return result;
}

} // namespace tetralux
