// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageBlends_h
#define tetralux_ImageBlends_h

#include "TriangleCaster/ImageOptics.h"

#include <array>

class vtkVolumeProperty;

namespace tetralux
{

/// The blend mode of a number of vtkVolumeMapper's BlendMode.
ImageBlend GetImageBlend(int blendMode);

/// The plane of a property's SliceFunction, in world coordinates, as ImageOptics has it. Throws
/// std::invalid_argument, with one line, if there is none.
std::array<double, 4> GetSlicePlane(vtkVolumeProperty* property);

} // namespace tetralux

#endif
