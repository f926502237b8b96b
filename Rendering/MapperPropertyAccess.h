// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MapperPropertyAccess_h
#define tetralux_MapperPropertyAccess_h

#include "Properties/PropertyTable.h"
#include "TetraluxRenderingModule.h" // For export macro

#include <vector>

class vtkTetrahedraVolumeMapper;

namespace tetralux
{

/// What kind of mapper it is.
TETRALUXRENDERING_EXPORT unsigned GetKind(vtkTetrahedraVolumeMapper* mapper);

/// The numbers of a property, by its getter. The mapper must have the property.
TETRALUXRENDERING_EXPORT std::vector<double> GetPropertyValues(
  vtkTetrahedraVolumeMapper* mapper, const MapperProperty& property);

/// Sets a property by its setter, from as many numbers as the property has.
TETRALUXRENDERING_EXPORT void SetPropertyValues(vtkTetrahedraVolumeMapper* mapper,
  const MapperProperty& property, const std::vector<double>& values);

} // namespace tetralux

#endif
