// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceShading_h
#define tetralux_ReferenceShading_h

#include "Optics/OpticalModel.h"

#include <array>
#include <vector>

namespace tetralux
{

/// The lit colour of a point of a surface, each channel 0..1, not multiplied by any opacity:
/// Blinn and Phong's model as VTK's volume mappers evaluate it for the light at the camera, for any
/// light.
///
/// point: world coordinates. normal: along the gradient, world coordinates, of any length; turned
/// towards the viewer here. A surface without one, of length 0, faces the viewer. view: from the
/// point to the viewer, world coordinates, of length 1.
///
/// With l from the point to the light and h halfway between l and view, the colour c is
///   ambient c sum(light ambient)
///   + sum over the lights before the surface of
///     share (diffuse c (light diffuse) n.l + specular (light specular) (n.h)^power),
/// where share is what distance and cone leave of the light.
std::array<double, 3> ShadeReference(const float color[3], const Material& material,
  const std::vector<Light>& lights, const std::array<double, 3>& point,
  const std::array<double, 3>& normal, const std::array<double, 3>& view);

/// The same before it is clamped, for any colour c: c Scale + Add.
struct ReferenceLight
{
  std::array<double, 3> Scale{};
  std::array<double, 3> Add{};
};

ReferenceLight FindReferenceLight(const Material& material, const std::vector<Light>& lights,
  const std::array<double, 3>& point, const std::array<double, 3>& normal,
  const std::array<double, 3>& view);

} // namespace tetralux

#endif
