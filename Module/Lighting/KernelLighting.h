// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_KernelLighting_h
#define tetralux_KernelLighting_h

// Lights as the kernels read them.

#include "Mesh/Gradients.h"
#include "Optics/OpticalModel.h"
#include "View/RayGrid.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A light, with the material's coefficients multiplied in.
struct KernelLight
{
  bool Positional;
  bool IsSpot;
  bool Fades;         ///< with distance
  double Position[3]; ///< in the world; of a distant light the direction to it
  double Axis[3];
  bool IsWide;    ///< a spot whose cone is more than a half-space
  float ConeSine; ///< of half the cone
  float Exponent;
  float Falloff[3]; ///< coefficients of the distance, in KernelLighting::Unit
  float Ambient[3];
  float Diffuse[3];
  float Specular[3];
};

/// What lights what rays gather.
struct KernelLighting
{
  /// Of points, to be interpolated, or of cells; in coordinates of the mesh.
  const GradientRow* Gradients;
  std::int32_t NumberOfGradients;
  bool OfPoints;
  float NormalFromMesh[3][3]; ///< takes gradients to the world, times any factor
  const KernelLight* Lights;
  int NumberOfLights;
  bool Shines; ///< any highlights
  float SpecularPower;
  double Unit;    ///< world length of about the mesh's radius
  float Turn;     ///< LightSteps
  float Approach; ///< LightSteps
};

/// Fills all of lighting but its gradients, Turn and Approach. unit: KernelLighting::Unit. memory:
/// holds the lights, and must outlive lighting.
void FillKernelLighting(const std::vector<Light>& lights, const Material& surface,
  const RayGrid& grid, double unit, KernelLighting& lighting, std::vector<KernelLight>& memory);

} // namespace tetralux

#endif
