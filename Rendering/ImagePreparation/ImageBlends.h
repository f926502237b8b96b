// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageBlends_h
#define tetralux_ImageBlends_h

#include "TriangleCaster/ImageOptics.h"

class vtkVolumeProperty;

namespace tetralux
{

struct SelectedArray;

/// The blend mode of a number of vtkVolumeMapper's BlendMode.
ImageBlend GetImageBlend(int blendMode);

/// Fills what a blend mode takes from a property and from the scalars, but surfaces: the plane of
/// SliceFunction, and for grey the range of the finite scalars. Where all of them are the same, all
/// are black, as in vtkGPUVolumeRayCastMapper. Throws std::invalid_argument, with one line, if
/// there is no such plane.
void SetBlend(
  ImageBlend blend, vtkVolumeProperty* property, const SelectedArray& scalars, ImageOptics& optics);

} // namespace tetralux

#endif
