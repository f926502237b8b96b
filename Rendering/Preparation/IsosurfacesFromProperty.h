// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfacesFromProperty_h
#define tetralux_IsosurfacesFromProperty_h

#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"

#include <vector>

class vtkVolumeProperty;

namespace tetralux
{

/// The surfaces of a property's IsoSurfaceValues, each with colour and opacity at its value.
/// opacities: the property's function, with scalar opacities in the place of attenuations. Throws
/// std::invalid_argument, with one line, if there are no values.
std::vector<Isosurface> IsosurfacesFromProperty(
  vtkVolumeProperty* property, const TransferFunction& opacities);

} // namespace tetralux

#endif
