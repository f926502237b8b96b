// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/ImageBlending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// The nearest finite number.
float ToFinite(double x)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -Largest, Largest));
}

SurfaceTable MakeSurfaceTable(std::vector<Isosurface> surfaces, double scale, double offset)
{
  std::stable_sort(surfaces.begin(), surfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Value < b.Value; });
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  SurfaceTable table;
  table.Bounds.push_back(-Infinity);
  for (const Isosurface& surface : surfaces)
  {
    table.Bounds.push_back(ToFinite((surface.Value - offset) / std::abs(scale)));
    table.Rows.push_back(
      { { surface.Color[0], surface.Color[1], surface.Color[2] }, surface.Opacity });
  }
  table.Bounds.push_back(Infinity);
  table.Rows.push_back({}); // for lanes that look up nothing
  return table;
}

} // namespace

void CheckBlending(const ImageOptics& optics)
{
  if (!(optics.AverageRange[0] <= optics.AverageRange[1]))
  {
    throw std::invalid_argument("the range of scalars to be averaged does not ascend");
  }
  const double* grey = optics.GreyRange;
  if (!std::isfinite(grey[0]) || !std::isfinite(grey[1]) || grey[0] == grey[1])
  {
    throw std::invalid_argument("the scalars of black and white are the same, or not finite");
  }
  for (const Isosurface& surface : optics.Surfaces)
  {
    const bool finite = std::isfinite(surface.Value) &&
      std::all_of(surface.Color, surface.Color + 3, [](float c) { return std::isfinite(c); });
    if (!finite || !(surface.Opacity >= 0 && surface.Opacity <= 1))
    {
      throw std::invalid_argument(
        "an isosurface has a value or colour that is not finite, or an opacity outside of 0..1");
    }
  }
  const std::array<double, 4>& plane = optics.SlicePlane;
  if (!std::all_of(plane.begin(), plane.end(), [](double x) { return std::isfinite(x); }) ||
    (plane[0] == 0 && plane[1] == 0 && plane[2] == 0))
  {
    throw std::invalid_argument("the plane of a slice has no normal, or is not finite");
  }
}

void FillBlending(const ImageVolume& volume, const ImageOptics& optics, SurfaceTable& surfaces,
  ImageKernelInput& in)
{
  in.Blend = optics.Blend;
  const double scale = volume.Scale;
  const auto toValue = [&](double scalar) { return ToFinite((scalar - volume.Offset) / scale); };
  const float a = toValue(optics.AverageRange[0]);
  const float b = toValue(optics.AverageRange[1]);
  in.AverageLow = std::min(a, b);
  in.AverageHigh = std::max(a, b);
  const double width = optics.GreyRange[1] - optics.GreyRange[0];
  in.GreyScale = static_cast<float>(scale / width);
  in.GreyOffset = static_cast<float>((volume.Offset - optics.GreyRange[0]) / width);
  surfaces = MakeSurfaceTable(optics.Surfaces, scale, volume.Offset);
  in.Surfaces.Count = static_cast<int>(optics.Surfaces.size());
  in.Surfaces.Sign = scale < 0 ? -1.f : 1.f;
  in.Surfaces.Bounds = surfaces.Bounds.data();
  in.Surfaces.Optics = surfaces.Rows.front().Color;
}

} // namespace tetralux
