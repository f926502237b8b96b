// SPDX-License-Identifier: BSD-3-Clause
#include "GradientReference.h"

#include "PlainRays.h"
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

using Vector = PlainVector;

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
    const PlainRay ray = MakePlainRay(grid, slices, i, j);
    double translucency = 1;
    double* color = &picture[4 * static_cast<std::size_t>(pixel)];
    for (const PlainSlab& slab : FindPlainSlabs(scene.Dimensions, slices, ray))
    {
      const double middle = slab.GetMiddle();
      const PlainPlace place(scene.Dimensions, ray.GetIndex(middle));
      const auto ofPoint = [&](const std::array<int, 3>& point)
      { return GetScalar(scene, point[0], point[1], point[2]); };
      const Vector gradient = ToWorld(grid, place.FindGradient(scene.Dimensions, ofPoint));
      const std::array<double, 4> optics =
        Classify(scene.Optics, place.Interpolate(ofPoint), gradient);
      Vector lit = { optics[0], optics[1], optics[2] };
      if (options.Shaded)
      {
        lit = Shine(
          options.Lights, options.Surface, lit, gradient, ray.GetPoint(middle), ray.Direction);
      }
      const double cue =
        (middle * ray.DepthOfDirection - slices.Origin) / (slices.Back - slices.Origin);
      const double length = slab.GetLength() / scene.Optics.UnitDistance;
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
