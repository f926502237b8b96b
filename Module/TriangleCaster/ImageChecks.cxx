// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/ImageChecks.h"

#include "TriangleCaster/FunctionSet.h"
#include "TriangleCaster/ImageBlending.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

void CheckUnitDistance(double distance)
{
  if (!(distance > 0) || !std::isfinite(distance))
  {
    throw std::invalid_argument("the unit distance of opacity is not above 0");
  }
}

/// Whether several components, or labels, have what options ask for.
void CheckComponentOptions(const ImageCasterOptions& options)
{
  if (options.Gradients != GradientSource::OnTheFly || options.SumOfLights != LightSum::Direct)
  {
    throw std::invalid_argument(
      "stored gradients and maps of light need one component, without labels");
  }
}

void CheckSlabOptions(const ImageOptics& optics, const ImageCasterOptions& options, bool several)
{
  if (options.Shaded || !optics.GradientOpacity.Nodes.empty() || HasTable(optics))
  {
    throw std::invalid_argument(
      "pre-integrated slabs have no gradients: shading and gradient opacity need them off");
  }
  if (several)
  {
    throw std::invalid_argument(
      "pre-integrated slabs are of one function: they need one component, without labels");
  }
}

} // namespace

bool HasCue(const ImageCasterOptions& options)
{
  const auto isOne = [](float factor) { return factor == 1; };
  return !std::all_of(options.NearColor, options.NearColor + 3, isOne) ||
    !std::all_of(options.FarColor, options.FarColor + 3, isOne);
}

void CheckVolume(const ImageVolume& volume)
{
  const char* const axes[] = { "x", "y", "z" };
  double values = 1;
  for (int a = 0; a < 3; ++a)
  {
    if (volume.Dimensions[a] < 2)
    {
      throw std::invalid_argument("the image has " + std::to_string(volume.Dimensions[a]) +
        " points along " + axes[a] + "; a volume has at least 2");
    }
    values *= volume.Dimensions[a];
  }
  if (volume.Components < 1 || volume.Components > ImageVolume::MostComponents)
  {
    throw std::invalid_argument("the image has " + std::to_string(volume.Components) +
      " components; a volume has 1 to " + std::to_string(ImageVolume::MostComponents));
  }
  values *= volume.Components;
  if (values > std::numeric_limits<std::int32_t>::max())
  {
    throw std::invalid_argument(
      "the image has more than 2^31 - 1 values, the most that the triangle caster takes");
  }
  if (!volume.Values)
  {
    throw std::invalid_argument("the image has no values");
  }
  if (!std::isfinite(volume.Scale) || volume.Scale == 0 || !std::isfinite(volume.Offset))
  {
    throw std::invalid_argument("the scale of an image's values is 0, or not finite");
  }
}

void CheckOptics(const ImageOptics& optics)
{
  CheckUnitDistance(optics.UnitDistance);
  const auto checkWeight = [](double weight)
  {
    if (!(weight >= 0) || !std::isfinite(weight))
    {
      throw std::invalid_argument("the weight of a component is negative, or not finite");
    }
  };
  checkWeight(optics.Weight);
  for (const ComponentOptics& other : optics.OtherComponents)
  {
    CheckUnitDistance(other.UnitDistance);
    checkWeight(other.Weight);
  }
  for (int c = 0; c < 3; ++c)
  {
    if (!std::isfinite(optics.ColorScale[c]) || !std::isfinite(optics.ColorOffset[c]))
    {
      throw std::invalid_argument("the scale of the colours of components is not finite");
    }
  }
  if (!(optics.LabelShare >= 0 && optics.LabelShare <= 1))
  {
    throw std::invalid_argument("the share of labels is not within 0..1");
  }
  if (!(optics.GradientLength > 0) || !std::isfinite(optics.GradientLength))
  {
    throw std::invalid_argument("the length that gradients are measured over is not above 0");
  }
  CheckBlending(optics);
}

void CheckMatch(const ImageVolume& volume, const ImageOptics& optics)
{
  if (volume.Components > 1 && ShowsLabels(volume, optics))
  {
    throw std::invalid_argument(
      "labels are shown of one component; the image has " + std::to_string(volume.Components));
  }
  const bool several = volume.Components > 1 || ShowsLabels(volume, optics);
  if (several && optics.Blend != ImageBlend::Composite)
  {
    throw std::invalid_argument(
      "several components and labels are composited: other blend modes have one function");
  }
  if (several && HasTable(optics))
  {
    throw std::invalid_argument(
      "a table over scalars and gradients is of one component, without labels");
  }
  if (optics.Components == ImageComponents::Dependent && volume.Components != 2 &&
    volume.Components != 4)
  {
    throw std::invalid_argument(
      "dependent components are 2 or 4; the image has " + std::to_string(volume.Components));
  }
  if (optics.Components == ImageComponents::Independent &&
    optics.OtherComponents.size() + 1 != static_cast<std::size_t>(volume.Components))
  {
    throw std::invalid_argument("the image has " + std::to_string(volume.Components) +
      " independent components, and there are optics for " +
      std::to_string(optics.OtherComponents.size() + 1));
  }
}

void CheckOptions(
  const ImageVolume& volume, const ImageOptics& optics, const ImageCasterOptions& options)
{
  const bool several = volume.Components > 1 || ShowsLabels(volume, optics);
  if (several)
  {
    CheckComponentOptions(options);
  }
  if (options.PreIntegrated && optics.Blend == ImageBlend::Composite)
  {
    CheckSlabOptions(optics, options, several);
  }
}

} // namespace tetralux
