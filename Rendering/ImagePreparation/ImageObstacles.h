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

/// What of a property it does not use, in one line; empty if nothing. arrayComponents: of the array
/// itself. hasLabels: whether there is a map of labels.
TETRALUXRENDERING_EXPORT std::string DescribeUnused(vtkVolumeProperty* property, ImageBlend blend,
  int arrayComponents, int vectorMode, bool hasLabels);

} // namespace tetralux

#endif
