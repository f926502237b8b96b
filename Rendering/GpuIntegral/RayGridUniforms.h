// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayGridUniforms_h
#define tetralux_RayGridUniforms_h

#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <string>
#include <vector>

class vtkShaderProgram;

namespace tetralux
{

/// The rays of a grid and the planes that limit them as RayGridDec.glsl reads them.
class RayGridUniforms
{
public:
  /// center and radius: of the mesh, see WalkMesh.
  RayGridUniforms(
    const RayGrid& grid, const RayLimits& limits, const double center[3], double radius);

  /// What the GLSL is specialised by.
  std::string GetDefines() const;

  void Set(vtkShaderProgram* program) const;

private:
  float Middle[2];
  float Points[3][3];
  float Directions[3][3];
  float WorldDirections[3][3];
  float Time;
  std::vector<float> PlaneHeights, PlaneSlopes; ///< three each
};

} // namespace tetralux

#endif
