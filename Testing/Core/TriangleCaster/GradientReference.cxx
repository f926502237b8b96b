// SPDX-License-Identifier: BSD-3-Clause
#include "GradientReference.h"

#include "ReferenceIntegral.h"
#include "TriangleCaster/TransferTableEvaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Normalize(Vector v)
{
  const double length = std::sqrt(Dot(v, v));
  for (double& component : v)
  {
    component = length > 0 ? component / length : 0;
  }
  return v;
}

template <class Value>
double Read(const ImageScene& scene, std::size_t index)
{
  Value value;
  std::memcpy(&value, &scene.Values[index * sizeof(Value)], sizeof(Value));
  return value;
}

double GetScalar(const ImageScene& scene, int i, int j, int k)
{
  const std::size_t index = i +
    static_cast<std::size_t>(scene.Dimensions[0]) *
      (j + static_cast<std::size_t>(scene.Dimensions[1]) * k);
  const double value = scene.Type == ImageScalar::Int8 ? Read<std::int8_t>(scene, index)
    : scene.Type == ImageScalar::UInt8                 ? Read<std::uint8_t>(scene, index)
    : scene.Type == ImageScalar::Int16                 ? Read<std::int16_t>(scene, index)
    : scene.Type == ImageScalar::UInt16                ? Read<std::uint16_t>(scene, index)
                                                       : Read<float>(scene, index);
  return scene.Offset + scene.Scale * value;
}

/// Scalars for a step to the next point.
Vector GetGradient(const ImageScene& scene, const std::array<int, 3>& point)
{
  Vector gradient;
  for (int a = 0; a < 3; ++a)
  {
    std::array<int, 3> before = point, behind = point;
    before[a] = std::max(point[a] - 1, 0);
    behind[a] = std::min(point[a] + 1, scene.Dimensions[a] - 1);
    gradient[a] = (GetScalar(scene, behind[0], behind[1], behind[2]) -
                    GetScalar(scene, before[0], before[1], before[2])) /
      (behind[a] - before[a]);
  }
  return gradient;
}

/// What a ray meets at a point of the volume.
struct Place
{
  double Scalar = 0;
  Vector Gradient = { 0, 0, 0 };

  Place(const ImageScene& scene, const Vector& at)
  {
    std::array<int, 3> cell;
    for (int a = 0; a < 3; ++a)
    {
      cell[a] = std::clamp(static_cast<int>(std::floor(at[a])), 0, scene.Dimensions[a] - 2);
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      std::array<int, 3> point = cell;
      double weight = 1;
      for (int a = 0; a < 3; ++a)
      {
        const bool second = (corner >> a & 1) != 0;
        point[a] += second ? 1 : 0;
        weight *= second ? at[a] - cell[a] : 1 - (at[a] - cell[a]);
      }
      this->Scalar += weight * GetScalar(scene, point[0], point[1], point[2]);
      const Vector gradient = GetGradient(scene, point);
      for (int a = 0; a < 3; ++a)
      {
        this->Gradient[a] += weight * gradient[a];
      }
    }
  }
};

/// The light on a colour, by the normal towards the viewer. view: from the viewer.
Vector Shine(const ImageCasterOptions& options, const Vector& color, Vector normal,
  const Vector& point, const Vector& view)
{
  normal = Normalize(normal);
  const bool exists = Dot(normal, normal) > 0;
  const double side = Dot(normal, view) > 0 ? -1 : 1;
  for (int a = 0; a < 3; ++a)
  {
    normal[a] = exists ? side * normal[a] : -view[a];
  }
  Vector lit = { 0, 0, 0 };
  for (const Light& light : options.Lights)
  {
    Vector toLight = { light.Position[0], light.Position[1], light.Position[2] };
    double share = 1;
    if (light.Positional)
    {
      for (int a = 0; a < 3; ++a)
      {
        toLight[a] -= point[a];
      }
      const double distance = std::sqrt(Dot(toLight, toLight));
      toLight = Normalize(toLight);
      share = 1 /
        (light.Attenuation[0] +
          distance * (light.Attenuation[1] + distance * light.Attenuation[2]));
      if (light.ConeCosine > -1)
      {
        const double cosine = -Dot(toLight, { light.Axis[0], light.Axis[1], light.Axis[2] });
        share *= cosine >= light.ConeCosine ? std::pow(std::max(cosine, 0.), light.Exponent) : 0;
      }
    }
    const double cosine = std::max(0., Dot(normal, toLight));
    Vector halfway;
    for (int a = 0; a < 3; ++a)
    {
      halfway[a] = toLight[a] - view[a];
    }
    const double highlight = cosine > 0
      ? std::pow(std::max(0., Dot(normal, Normalize(halfway))), options.Surface.SpecularPower)
      : 0;
    for (int c = 0; c < 3; ++c)
    {
      lit[c] += color[c] *
          (options.Surface.Ambient * light.Ambient[c] +
            share * cosine * options.Surface.Diffuse * light.Diffuse[c]) +
        share * highlight * options.Surface.Specular * light.Specular[c];
    }
  }
  return lit;
}

Vector ToWorld(const RayGrid& grid, const Vector& gradient)
{
  Vector world = { 0, 0, 0 };
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      world[a] += grid.MeshFromWorld[b][a] * gradient[b];
    }
  }
  return world;
}

/// Colour and scalar opacity.
std::array<double, 4> Classify(const ImageOptics& optics, double scalar, const Vector& gradient)
{
  const double sizes[3] = { std::abs(gradient[0]), std::abs(gradient[1]), std::abs(gradient[2]) };
  const double length = optics.GradientLength *
    (optics.Norm == GradientNorm::Euclidean ? std::sqrt(Dot(gradient, gradient))
                                            : sizes[0] + sizes[1] + sizes[2]);
  if (!optics.Table.Entries.empty())
  {
    const TransferTable::Entry entry = Evaluate(optics.Table, scalar, length);
    return { entry.Color[0], entry.Color[1], entry.Color[2], entry.Opacity };
  }
  const TransferFunction::Value value = EvaluateReference(optics.Function, scalar);
  const double factor = optics.GradientOpacity.Nodes.empty()
    ? 1
    : EvaluateReference(optics.GradientOpacity, length).Attenuation;
  return { value.Color[0], value.Color[1], value.Color[2], factor * value.Attenuation };
}

} // namespace

std::vector<double> RenderWithGradients(const ImageScene& scene)
{
  const RayGrid& grid = scene.Grid;
  const ImageCasterOptions& options = scene.Options;
  const SlicePlanes slices =
    MakeSlicePlanes(scene.GetVolume(), grid, options.Shape, options.SampleDistance);
  std::vector<double> picture(4 * static_cast<std::size_t>(scene.GetNumberOfPixels()), 0.);
  for (int pixel = 0; pixel < scene.GetNumberOfPixels(); ++pixel)
  {
    const int i = pixel % grid.Width;
    const int j = pixel / grid.Width;
    Vector start, direction;
    for (int a = 0; a < 3; ++a)
    {
      start[a] = grid.Origin[a] + i * grid.OriginStepX[a] + j * grid.OriginStepY[a];
      direction[a] = grid.Direction[a] + i * grid.DirectionStepX[a] + j * grid.DirectionStepY[a];
    }
    direction = Normalize(direction);
    // In coordinates of the volume, and where the ray is inside.
    Vector base, step;
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a)
    {
      const double* row = grid.MeshFromWorld[a];
      const Vector axis = { row[0], row[1], row[2] };
      base[a] = Dot(axis, start) + row[3];
      step[a] = Dot(axis, direction);
      const double low = -base[a] / step[a];
      const double high = (scene.Dimensions[a] - 1 - base[a]) / step[a];
      enter = std::max(enter, std::min(low, high));
      leave = std::min(leave, std::max(low, high));
    }
    const double slope = slices.Shape == SliceShape::Shells
      ? 1
      : Dot(direction, { slices.Normal[0], slices.Normal[1], slices.Normal[2] });
    double translucency = 1;
    double* color = &picture[4 * static_cast<std::size_t>(pixel)];
    for (int slab = 0; slab < slices.Count; ++slab)
    {
      const double depth = slices.Origin + slab * slices.Distance;
      const double from = std::max(enter, depth / slope);
      const double to = std::min(leave, (depth + slices.Distance) / slope);
      if (!(from < to))
      {
        continue;
      }
      const double middle = 0.5 * (from + to);
      Vector at, point;
      for (int a = 0; a < 3; ++a)
      {
        at[a] = base[a] + middle * step[a];
        point[a] = start[a] + middle * direction[a];
      }
      const Place place(scene, at);
      const Vector gradient = ToWorld(grid, place.Gradient);
      const std::array<double, 4> optics = Classify(scene.Optics, place.Scalar, gradient);
      Vector lit = { optics[0], optics[1], optics[2] };
      if (options.Shaded)
      {
        lit = Shine(options, lit, gradient, point, direction);
      }
      const double cue = (middle * slope - slices.Origin) / (slices.Back - slices.Origin);
      const double length = (to - from) / scene.Optics.UnitDistance;
      const double alpha = scene.Optics.Opacity == StepOpacity::Power
        ? 1 - std::pow(1 - optics[3], length)
        : 1 - std::exp(-optics[3] * length);
      for (int c = 0; c < 3; ++c)
      {
        const double factor =
          options.NearColor[c] + cue * (options.FarColor[c] - options.NearColor[c]);
        color[c] += translucency * alpha * factor * lit[c];
      }
      translucency *= 1 - alpha;
    }
    color[3] = 1 - translucency;
  }
  return picture;
}

} // namespace tetralux
