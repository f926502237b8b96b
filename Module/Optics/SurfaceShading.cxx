// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/SurfaceShading.h"

#include "Mesh/CellGradient.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

double Dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// False where the length is zero or no number. Scaled by the largest component first: squares of
/// coordinates may be beyond any range.
bool Normalize(double a[3])
{
  const double largest = std::max({ std::abs(a[0]), std::abs(a[1]), std::abs(a[2]) });
  if (!(largest > 0) || !std::isfinite(largest))
  {
    return false;
  }
  for (int k = 0; k < 3; ++k)
  {
    a[k] /= largest;
  }
  const double length = std::sqrt(Dot(a, a));
  for (int k = 0; k < 3; ++k)
  {
    a[k] /= length;
  }
  return true;
}

/// Direction of the scalar's gradient in a cell, in the coordinates of the mesh; not of length 1.
void FindCellGradient(const SurfaceShading& shading, std::int32_t cell, double gradient[3])
{
  const std::int32_t* ids = &shading.Mesh->Cells[4 * static_cast<std::size_t>(cell)];
  const double* origin = &shading.Mesh->Points[3 * static_cast<std::size_t>(ids[0])];
  double edges[3][3], rises[3];
  double longest = 0;
  double largestRise = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double* point = &shading.Mesh->Points[3 * static_cast<std::size_t>(ids[i + 1])];
    for (int a = 0; a < 3; ++a)
    {
      edges[i][a] = point[a] - origin[a];
      longest = std::max(longest, std::abs(edges[i][a]));
    }
    rises[i] = shading.Scalars[ids[i + 1]] - shading.Scalars[ids[0]];
    largestRise = std::max(largestRise, std::abs(rises[i]));
  }
  // Only the direction matters: with edges and rises of about 1 nothing overflows.
  for (int i = 0; i < 3; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      edges[i][a] /= longest;
    }
    rises[i] /= largestRise;
  }
  std::copy_n(CellGradient(edges, rises).Weighted, 3, gradient);
}

/// The gradients of a cell's points, interpolated at a position in the mesh.
void InterpolateGradient(
  const SurfaceShading& shading, std::int32_t cell, const double position[3], double gradient[3])
{
  const std::int32_t* ids = &shading.Mesh->Cells[4 * static_cast<std::size_t>(cell)];
  double corners[4][3]; // from the position
  for (int i = 0; i < 4; ++i)
  {
    const double* point = &shading.Mesh->Points[3 * static_cast<std::size_t>(ids[i])];
    for (int a = 0; a < 3; ++a)
    {
      corners[i][a] = point[a] - position[a];
    }
  }
  // Volumes across the corners; outside of the cell, where rounding may have led, none is negative.
  double weights[4];
  double sum = 0;
  for (int i = 0; i < 4; ++i)
  {
    const double* p = corners[(i + 1) % 4];
    const double* q = corners[(i + 2) % 4];
    const double* r = corners[(i + 3) % 4];
    const double volume = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
      p[2] * (q[0] * r[1] - q[1] * r[0]);
    weights[i] = i % 2 == 0 ? volume : -volume;
    sum += weights[i];
  }
  const double sign = sum < 0 ? -1 : 1;
  sum = 0;
  for (double& weight : weights)
  {
    weight = std::max(0., sign * weight);
    sum += weight;
  }
  std::fill_n(gradient, 3, 0.);
  for (int i = 0; i < 4; ++i)
  {
    const double share = sum > 0 ? weights[i] / sum : 0.25;
    const PointGradient& g = shading.Gradients[ids[i]];
    gradient[0] += share * g.X;
    gradient[1] += share * g.Y;
    gradient[2] += share * g.Z;
  }
}

/// The normal in the world, turned to the viewer.
void FindNormal(const double gradient[3], const double direction[3], double normal[3])
{
  std::copy_n(gradient, 3, normal);
  const bool known = Normalize(normal);
  const double sign = !known || Dot(normal, direction) > 0 ? -1 : 1;
  for (int a = 0; a < 3; ++a)
  {
    normal[a] = sign * (known ? normal[a] : direction[a]);
  }
}

/// Direction from a position to a light, and the share of the light that comes there.
double FindShare(const Light& light, const double position[3], double toLight[3])
{
  std::copy_n(light.Position, 3, toLight);
  if (!light.Positional)
  {
    return 1;
  }
  double squared = 0;
  for (int a = 0; a < 3; ++a)
  {
    toLight[a] -= position[a];
    squared += toLight[a] * toLight[a];
  }
  if (!Normalize(toLight))
  {
    return 0;
  }
  const double* k = light.Attenuation;
  double share = 1 / (k[0] + k[1] * std::sqrt(squared) + k[2] * squared);
  if (light.ConeCosine > -1)
  {
    const double cosine = -Dot(toLight, light.Axis);
    share *= cosine >= light.ConeCosine ? std::pow(cosine, light.Exponent) : 0;
  }
  return share;
}

} // namespace

void FindGradient(
  const SurfaceShading& shading, std::int32_t cell, const double position[3], double gradient[3])
{
  double inMesh[3];
  if (shading.Gradients)
  {
    double place[3];
    for (int row = 0; row < 3; ++row)
    {
      const double* m = shading.MeshFromWorld[row];
      place[row] = Dot(m, position) + m[3];
    }
    InterpolateGradient(shading, cell, place, inMesh);
  }
  else
  {
    FindCellGradient(shading, cell, inMesh);
  }
  // Gradients are transformed by the transpose of what takes positions into the mesh.
  for (int a = 0; a < 3; ++a)
  {
    gradient[a] = 0;
    for (int row = 0; row < 3; ++row)
    {
      gradient[a] += shading.MeshFromWorld[row][a] * inMesh[row];
    }
  }
}

LightFactors Illuminate(const SurfaceShading& shading, const double gradient[3],
  const double position[3], const double direction[3])
{
  const Material& surface = shading.Surface;
  double normal[3];
  FindNormal(gradient, direction, normal);
  double scale[3] = { 0, 0, 0 };
  double add[3] = { 0, 0, 0 };
  for (const Light& light : shading.Lights)
  {
    double toLight[3];
    const double share = FindShare(light, position, toLight);
    const double cosine = Dot(normal, toLight);
    double diffuse = 0;
    double specular = 0;
    if (cosine > 0)
    {
      diffuse = share * surface.Diffuse * cosine;
      // Blinn's halfway vector between the light and the viewer.
      double halfway[3];
      for (int a = 0; a < 3; ++a)
      {
        halfway[a] = toLight[a] - direction[a];
      }
      specular = Normalize(halfway) ? share * surface.Specular *
          std::pow(std::max(0., Dot(normal, halfway)), surface.SpecularPower)
                                    : 0;
    }
    for (int c = 0; c < 3; ++c)
    {
      scale[c] += surface.Ambient * light.Ambient[c] + diffuse * light.Diffuse[c];
      add[c] += specular * light.Specular[c];
    }
  }
  LightFactors factors;
  for (int c = 0; c < 3; ++c)
  {
    factors.Scale[c] = static_cast<float>(scale[c]);
    factors.Add[c] = static_cast<float>(add[c]);
  }
  return factors;
}

LightFactors FindLight(const SurfaceShading& shading, std::int32_t cell, const double position[3],
  const double direction[3])
{
  double gradient[3];
  FindGradient(shading, cell, position, gradient);
  return Illuminate(shading, gradient, position, direction);
}

} // namespace tetralux
