// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageBlends.h"

#include "Intake/ScalarExtraction.h"

#include "vtkDataArray.h"
#include "vtkPlane.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

/// The plane of a slice, in world coordinates, as VTK's mappers take it.
std::array<double, 4> GetSlicePlane(vtkVolumeProperty* property)
{
  vtkImplicitFunction* function = property->GetSliceFunction();
  auto* plane = vtkPlane::SafeDownCast(function);
  if (!plane)
  {
    throw std::invalid_argument(
      "the slice BlendMode shows the property's SliceFunction, which is " +
      (function ? std::string("a ") + function->GetClassName() + " and no vtkPlane"
                : std::string("not set")));
  }
  if (plane->GetTransform())
  {
    throw std::invalid_argument("the property's SliceFunction has a Transform, which VTK's mappers "
                                "do not use: it may be a vtkPlane without one");
  }
  const double* n = plane->GetNormal();
  const double* p = plane->GetOrigin();
  return { n[0], n[1], n[2], -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) };
}

} // namespace

ImageBlend GetImageBlend(int blendMode)
{
  switch (blendMode)
  {
    case vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND:
      return ImageBlend::MaximumIntensity;
    case vtkVolumeMapper::MINIMUM_INTENSITY_BLEND:
      return ImageBlend::MinimumIntensity;
    case vtkVolumeMapper::AVERAGE_INTENSITY_BLEND:
      return ImageBlend::AverageIntensity;
    case vtkVolumeMapper::ADDITIVE_BLEND:
      return ImageBlend::Additive;
    case vtkVolumeMapper::ISOSURFACE_BLEND:
      return ImageBlend::Isosurfaces;
    case vtkVolumeMapper::SLICE_BLEND:
      return ImageBlend::Slice;
    default: // SetBlendMode refuses all others
      return ImageBlend::Composite;
  }
}

void SetBlend(
  ImageBlend blend, vtkVolumeProperty* property, const SelectedArray& scalars, ImageOptics& optics)
{
  optics.Blend = blend;
  if (blend == ImageBlend::Slice)
  {
    optics.SlicePlane = GetSlicePlane(property);
  }
  if (blend == ImageBlend::AverageIntensity || blend == ImageBlend::Additive)
  {
    double range[2];
    scalars.Array->GetFiniteRange(range, scalars.Magnitude ? -1 : scalars.Component);
    optics.GreyRange[0] = range[0] <= range[1] ? range[0] : 0;
    optics.GreyRange[1] = range[0] < range[1] ? range[1] : optics.GreyRange[0] + 1;
  }
}

} // namespace tetralux
