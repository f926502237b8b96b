// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageBlends.h"

#include "vtkPlane.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <stdexcept>
#include <string>

namespace tetralux
{

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

} // namespace tetralux
