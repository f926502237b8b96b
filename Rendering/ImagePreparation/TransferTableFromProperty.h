// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferTableFromProperty_h
#define tetralux_TransferTableFromProperty_h

#include "TriangleCaster/TransferTable.h"

#include <array>

class vtkVolumeProperty;

namespace tetralux
{

/// The TransferFunction2D of a property, if its TransferFunctionMode is TF_2D; else a table without
/// entries. Columns cover the range of the scalars and rows a quarter of it, over
/// ImageOptics::GradientLength, as in vtkGPUVolumeRayCastMapper. Throws std::invalid_argument, with
/// one line, if there is no image with float arrays of red, green, blue and opacity.
TransferTable TransferTableFromProperty(
  vtkVolumeProperty* property, const std::array<double, 2>& scalars);

} // namespace tetralux

#endif
