// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceGrazing.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
std::vector<double> MeasureGrazing(const ReferenceMesh& mesh, const ReferenceOptics& optics,
  const RayGrid& rays, const RayLimits& limits, const ReferenceImage& image,
  Span<const std::uint8_t> pixels, double displacement)
{
  const std::size_t numberOfPixels = static_cast<std::size_t>(rays.Width) * rays.Height;
  if (image.Rgba.size() != 4 * numberOfPixels)
  {
    throw std::invalid_argument("MeasureGrazing: the image is not that of the rays");
  }
  const auto renderDisplaced = [&](double i, double j)
  {
    RayGrid displaced = rays;
    for (int axis = 0; axis < 3; ++axis)
    {
      displaced.Origin[axis] += i * rays.OriginStepX[axis] + j * rays.OriginStepY[axis];
      displaced.Direction[axis] += i * rays.DirectionStepX[axis] + j * rays.DirectionStepY[axis];
    }
    return RenderReference(mesh, optics, displaced, limits, pixels);
  };
  std::vector<double> grazing(numberOfPixels, 0.0);
  for (int direction = 0; direction < 2; ++direction)
  {
    const double i = direction == 0 ? displacement : 0;
    const double j = direction == 1 ? displacement : 0;
    const ReferenceImage left = renderDisplaced(-i, -j);
    const ReferenceImage right = renderDisplaced(i, j);
    for (std::size_t pixel = 0; pixel < numberOfPixels; ++pixel)
    {
      if (!pixels.empty() && !pixels[pixel])
      {
        continue;
      }
      for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
      {
        const double bend = std::abs(left.Rgba[k] - 2 * image.Rgba[k] + right.Rgba[k]);
        const double steepness = std::abs(right.Rgba[k] - left.Rgba[k]) / 2 - displacement;
        grazing[pixel] = std::max({ grazing[pixel], bend, steepness });
      }
    }
  }
  return grazing;
}

} // namespace tetralux
