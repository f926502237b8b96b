// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/IsosurfacesFromProperty.h"

#include "Optics/IntervalTable.h"

#include "vtkContourValues.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <stdexcept>

namespace tetralux
{

std::vector<Isosurface> IsosurfacesFromProperty(
  vtkVolumeProperty* property, const TransferFunction& opacities)
{
  vtkContourValues* values = property->GetIsoSurfaceValues();
  if (values->GetNumberOfContours() == 0)
  {
    throw std::invalid_argument(
      "the volume property has no IsoSurfaceValues, which the isosurface BlendMode shows");
  }
  std::vector<Isosurface> surfaces;
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    const TransferFunction::Value value = Evaluate(opacities, values->GetValue(i));
    Isosurface surface;
    surface.Value = values->GetValue(i);
    surface.Opacity = static_cast<float>(std::min(value.Attenuation, 1.));
    for (int c = 0; c < 3; ++c)
    {
      surface.Color[c] = static_cast<float>(value.Color[c]);
    }
    surfaces.push_back(surface);
  }
  return surfaces;
}

} // namespace tetralux
