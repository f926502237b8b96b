// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/IntegratorChoice.h"

#include "Scene/VolumeScene.h"

namespace tetralux
{

Integrator ChooseIntegrator(const VolumeScene& scene, Lighting lighting)
{
  switch (scene.Optics.GetModel())
  {
    case OpticalModel::EmissionOnly:
      return Integrator::Emission;
    case OpticalModel::AbsorptionOnly:
      return Integrator::OpticalDepth;
    case OpticalModel::MaximumIntensity:
      return Integrator::Maximum;
    case OpticalModel::Isosurfaces:
      return Integrator::Isosurfaces;
    case OpticalModel::EmissionAbsorption:
      break;
  }
  const bool ofCells = scene.Mesh.HasCellScalars();
  if (scene.HasComponents())
  {
    return ofCells ? Integrator::ClosedForm : Integrator::Components;
  }
  const bool lit = lighting != Lighting::None && !ofCells; // constant cells have no gradient
  if (scene.GetPlan().ConstantColor && !lit)
  {
    return Integrator::OpticalDepth;
  }
  if (lit && lighting == Lighting::Varying)
  {
    return Integrator::VaryingLight;
  }
  if (scene.Optics.GetTable() && !ofCells)
  {
    return lit ? Integrator::LitTable : Integrator::Table;
  }
  return lit ? Integrator::LitClosedForm : Integrator::ClosedForm;
}

} // namespace tetralux
