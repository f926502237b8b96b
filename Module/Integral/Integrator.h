// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Integrator_h
#define tetralux_Integrator_h

namespace tetralux
{

/// How what a ray meets in a cell is integrated, the same for every method; chosen by
/// ChooseIntegrator.
enum class Integrator
{
  ClosedForm,    ///< emission and absorption
  LitClosedForm, ///< emission and absorption, lit alike all through a cell; scalars at points only
  VaryingLight,  ///< emission and absorption, lit; scalars at points only
  Table,         ///< emission and absorption, by pre-integration; scalars at points only
  LitTable,      ///< as LitClosedForm, by pre-integration
  OpticalDepth,  ///< emission and absorption of a constant colour, or absorption alone
  Emission,      ///< emission alone
  Maximum,       ///< the largest scalar
  Isosurfaces,   ///< scalars at points only
  Components,    ///< emission and absorption of several scalars at points; by the ray caster only
  Count
};

inline bool IsTabulated(Integrator integrator)
{
  return integrator == Integrator::Table || integrator == Integrator::LitTable;
}

inline bool IsLit(Integrator integrator)
{
  return integrator == Integrator::LitClosedForm || integrator == Integrator::VaryingLight ||
    integrator == Integrator::LitTable;
}

/// Whether a ray may end before it leaves the mesh: what is in front hides what is behind.
inline bool EndsEarly(Integrator integrator)
{
  return integrator != Integrator::Emission && integrator != Integrator::Maximum;
}

/// Whether weights of segments are evaluated, with SegmentWeightError.
inline bool HasWeights(Integrator integrator)
{
  return integrator != Integrator::Maximum && integrator != Integrator::Isosurfaces;
}

} // namespace tetralux

#endif
