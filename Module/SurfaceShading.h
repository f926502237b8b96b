// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SurfaceShading_h
#define tetralux_SurfaceShading_h

#include "OpticalModel.h"
#include "TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// What surfaces of constant scalar are shaded by.
struct SurfaceShading
{
  const TetrahedralMesh* Mesh;
  const double* Scalars;            ///< one a point
  const double (*MeshFromWorld)[4]; ///< three rows, as in RayGrid
  std::vector<Light> Lights;
  Material Surface;
};

/// Turns the colour of a surface into that which a viewer sees who looks along direction, of length
/// 1, at its position in the world, where it is in the cell. Its normal is the gradient of the
/// scalar in the cell, turned to the viewer; a cell without a gradient faces the viewer. Ambient and
/// diffuse light times the surface's colour, and Blinn's specular light, as in VTK's mappers of
/// volumes; the sum is clamped to 0..1.
TETRALUXCORE_EXPORT void ShadeSurface(const SurfaceShading& shading, std::int32_t cell,
  const double position[3], const double direction[3], float color[3]);

} // namespace tetralux

#endif
