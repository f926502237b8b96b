// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntegratorChoice_h
#define tetralux_IntegratorChoice_h

#include "Integral/Integrator.h"
#include "Optics/LightSteps.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

class VolumeScene;

/// The cheapest way of integrating that is exact for a prepared scene, or the table if it has one;
/// for every method. Where light varies in cells the table is not used: it does not tell where
/// along a segment its colour comes from. lighting: of what can be lit, which is emission and
/// absorption of scalars at points, and isosurfaces.
TETRALUXCORE_EXPORT Integrator ChooseIntegrator(const VolumeScene& scene, Lighting lighting);

} // namespace tetralux

#endif
