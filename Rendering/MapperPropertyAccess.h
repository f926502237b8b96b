// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MapperPropertyAccess_h
#define tetralux_MapperPropertyAccess_h

#include "Properties/PropertyTable.h"
#include "TetraluxRenderingModule.h" // For export macro

#include <vector>

class vtkAbstractVolumeMapper;

namespace tetralux
{

/// What kind of mapper it is, of those of this project.
TETRALUXRENDERING_EXPORT unsigned GetKind(vtkAbstractVolumeMapper* mapper);

/// The numbers of a property, by its getter. The mapper must have the property.
TETRALUXRENDERING_EXPORT std::vector<double> GetPropertyValues(
  vtkAbstractVolumeMapper* mapper, const MapperProperty& property);

/// Sets a property by its setter, from as many numbers as the property has.
TETRALUXRENDERING_EXPORT void SetPropertyValues(vtkAbstractVolumeMapper* mapper,
  const MapperProperty& property, const std::vector<double>& values);

} // namespace tetralux

#endif
