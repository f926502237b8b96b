// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SurfaceShading_h
#define tetralux_SurfaceShading_h

#include "Mesh/PointGradients.h"
#include "Mesh/TetrahedralMesh.h"
#include "Optics/LightSteps.h"
#include "Optics/OpticalModel.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// What is shaded, and by what.
struct SurfaceShading
{
  const TetrahedralMesh* Mesh;
  const double* Scalars;            ///< one a point
  const PointGradient* Gradients;   ///< one a point; nullptr: those of the cells
  const double (*MeshFromWorld)[4]; ///< three rows, as in RayGrid
  std::vector<Light> Lights;
  Material Surface;
  LightSteps Steps; ///< of LightAlongRay alone
};

/// What lights make of a colour: color Scale + Add.
struct LightFactors
{
  float Scale[3]; ///< ambient and diffuse light
  float Add[3];   ///< specular light

  float Apply(int channel, float color) const
  {
    return color * this->Scale[channel] + this->Add[channel];
  }
};

/// The gradient of the scalar at a position in the world, which is in the cell: of the cell, or
/// interpolated between those of its points. In the world, of any length; of the same cell all by
/// the same factor, so that it is linear in the position. Zero or no number where there is none.
TETRALUXCORE_EXPORT void FindGradient(
  const SurfaceShading& shading, std::int32_t cell, const double position[3], double gradient[3]);

/// Light at a position in the world for a viewer who looks along direction, of length 1. The normal
/// is the gradient turned to the viewer; what has no gradient faces the viewer. Ambient and diffuse
/// light times the colour, and Blinn's specular light, as in VTK's mappers of volumes.
TETRALUXCORE_EXPORT LightFactors Illuminate(const SurfaceShading& shading, const double gradient[3],
  const double position[3], const double direction[3]);

/// The light where the gradient is FindGradient's.
TETRALUXCORE_EXPORT LightFactors FindLight(const SurfaceShading& shading, std::int32_t cell,
  const double position[3], const double direction[3]);

} // namespace tetralux

#endif
