// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntegratorName_h
#define tetralux_IntegratorName_h

#include "Integral/Integrator.h"

namespace tetralux
{

/// How segments were integrated, in statistics.
inline const char* GetName(Integrator integrator)
{
  switch (integrator)
  {
    case Integrator::Table:
    case Integrator::LitTable:
      return "table";
    case Integrator::OpticalDepth:
      return "optical depth";
    case Integrator::Emission:
      return "emission";
    case Integrator::Maximum:
      return "largest scalar";
    case Integrator::Components:
      return "several components";
    case Integrator::Isosurfaces:
      return "isosurfaces";
    default:
      return "closed form";
  }
}

} // namespace tetralux

#endif
