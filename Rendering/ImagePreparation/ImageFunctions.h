// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageFunctions_h
#define tetralux_ImageFunctions_h

// The functions of a volume property for image data: of components and of labels.

#include "Base/Cached.h"
#include "TriangleCaster/ImageOptics.h"

#include <array>

class vtkVolumeProperty;

namespace tetralux
{

/// How functions are brought into a caster's form.
struct FunctionRules
{
  bool OpacitiesAreShares = true; ///< those above 1 count as 1
  double MaximumError = 1e-4;     ///< of functions that are not piecewise linear
  double LongestPath = 1;         ///< of a ray, world units
  double Error = 0;               ///< receives what approximating them adds
};

/// Whether a component of a property has a function of gradients that changes opacities: VTK's
/// mappers make one that does not.
bool HasGradientOpacity(vtkVolumeProperty* property, int component);

/// Colours and scalar opacities of a component. Throws as TransferFunctionFromProperty, as the
/// functions below do.
TransferFunction MakeFunction(vtkVolumeProperty* property, int component, FunctionRules& rules);

/// The gradient opacity of a component, in the place of attenuation; without nodes if it has none.
TransferFunction MakeGradientOpacity(
  vtkVolumeProperty* property, int component, FunctionRules& rules);

/// Fills what optics have of independent components behind the first one, and the weight of that.
void SetIndependentComponents(
  vtkVolumeProperty* property, int components, FunctionRules& rules, ImageOptics& optics);

/// Fills what they have of dependent ones. valueType: of VTK, of the array.
void SetDependentComponents(int valueType, ImageOptics& optics);

/// Fills Labels from the functions of labels 1 and so on. A label without a function of its own has
/// that of the property, as in vtkGPUVolumeRayCastMapper. Throws std::invalid_argument, with one
/// line, if a label is not within 0..255.
void SetLabels(vtkVolumeProperty* property, FunctionRules& rules, ImageOptics& optics);

/// Adds to a key what SetIndependentComponents and SetLabels read.
void AddComponentsAndLabels(vtkVolumeProperty* property, int components, CacheKey& key);

} // namespace tetralux

#endif
