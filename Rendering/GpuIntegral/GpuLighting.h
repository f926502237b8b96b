// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GpuLighting_h
#define tetralux_GpuLighting_h

#include "Base/Span.h"
#include "Optics/LightSteps.h"
#include "Optics/OpticalModel.h"
#include "TetraluxRenderingModule.h"
#include "View/RayGrid.h"

#include <array>
#include <string>
#include <vector>

class vtkShaderProgram;

namespace tetralux
{

/// Lights in shaders, as RayCastLight.h has them on the CPU:
///
///   LightFactors FindLight(vec3 point, vec3 gradient, vec3 direction)
///
/// see LightingDec.glsl, and for light that varies in cells LightAlongRayDec.glsl. Single precision
/// throughout.
class TETRALUXRENDERING_EXPORT GpuLighting
{
public:
  /// As many as a shader takes: loops over more of them are cut short on some graphics cards.
  static constexpr int LargestNumberOfLights = 8;

  /// For one frame. Throws std::invalid_argument, with one line, if there are more lights than
  /// that. center and radius: see WalkMesh. steps: of light that varies in cells.
  void Update(const std::vector<Light>& lights, const Material& surface, const LightSteps& steps,
    const RayGrid& grid, const double center[3], double radius);

  /// To be put into a shader before the functions of GpuSegmentIntegral.
  std::string GetDeclarations() const;

  /// For a program that has the declarations and is in use.
  void Set(vtkShaderProgram* program) const;

private:
  using Vector3 = std::array<float, 3>;
  using Vector4 = std::array<float, 4>;

  float WorldFromRay[9]; ///< column by column
  float NormalFromMesh[9];
  float SpecularPower = 1;
  LightSteps Steps;
  bool Shines = false; ///< any highlights
  std::vector<Vector4> Positions, Cones, Falloffs;
  std::vector<Vector3> Ambient, Diffuse, Specular;
  std::vector<Vector3> AcrossAxes; ///< from the centre, see LightingDec.glsl
};

} // namespace tetralux

#endif
