// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RendererLights_h
#define tetralux_RendererLights_h

#include "Optics/OpticalModel.h"
#include "TetraluxRenderingModule.h"

#include <vector>

class vtkRenderer;
class vtkVolumeProperty;

namespace tetralux
{

/// The lights of a renderer that are switched on, as VTK's mappers of volumes take them: diffuse
/// and specular light have the diffuse colour. The ambient light of the renderer comes with the
/// first.
TETRALUXRENDERING_EXPORT std::vector<Light> GetRendererLights(vtkRenderer* renderer);

/// How a component of a property answers to lights.
TETRALUXRENDERING_EXPORT Material GetMaterial(vtkVolumeProperty* property, int component = 0);

} // namespace tetralux

#endif
