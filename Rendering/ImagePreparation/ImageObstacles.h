// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageObstacles_h
#define tetralux_ImageObstacles_h

#include "Intake/ScalarExtraction.h"
#include "TetraluxRenderingModule.h"
#include "TriangleCaster/ImageOptics.h"

#include <string>

class vtkDataObject;
class vtkVolumeProperty;

namespace tetralux
{

/// Why the triangle caster can't render a data object, in one line; empty if it can.
TETRALUXRENDERING_EXPORT std::string FindObstacle(
  vtkDataObject* data, const ScalarSelection& selection);

/// Why it can't use a property; empty if it can.
TETRALUXRENDERING_EXPORT std::string FindObstacle(vtkVolumeProperty* property, ImageBlend blend);

/// Whether a property has a function of gradients that changes opacities: VTK's mappers make one
/// that does not.
bool HasGradientOpacity(vtkVolumeProperty* property);

/// What of a property it does not use, in one line; empty if nothing. numberOfComponents: of the
/// array.
TETRALUXRENDERING_EXPORT std::string DescribeUnused(
  vtkVolumeProperty* property, ImageBlend blend, int numberOfComponents, int vectorMode);

} // namespace tetralux

#endif
