// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayGridUniforms_h
#define tetralux_RayGridUniforms_h

#include "TetraluxRenderingModule.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <string>
#include <vector>

class vtkShaderProgram;

namespace tetralux
{

/// World length that lengths along rays are in units of, in shaders: the mesh's radius in the world
/// but for rounding to a power of two, so that no digit is lost by it. radius: of the mesh.
TETRALUXRENDERING_EXPORT double GetRayLengthUnit(const RayGrid& grid, double radius);

/// The rays of a grid and the planes that limit them as RayGridDec.glsl reads them.
class RayGridUniforms
{
public:
  /// center and radius: of the mesh, see WalkMesh. Throws std::invalid_argument, with one line, if
  /// the rays are beyond the range of single precision.
  RayGridUniforms(
    const RayGrid& grid, const RayLimits& limits, const double center[3], double radius);

  /// What the GLSL is specialised by.
  std::string GetDefines() const;

  void Set(vtkShaderProgram* program) const;

  bool AreParallel() const { return this->Parallel; }

private:
  void CheckRange() const;

  float Middle[2];
  float Points[3][3];
  float Directions[3][3];
  float WorldDirections[3][3];
  bool Parallel;
  float Axes[2][3];
  float Time;
  float LengthUnit;
  std::vector<float> PlaneHeights, PlaneSlopes; ///< three each
};

} // namespace tetralux

#endif
