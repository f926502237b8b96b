// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LightSamples_h
#define tetralux_LightSamples_h

// Where shadow rays come from: lights, points of lights that are seen under an angle, and
// directions of ambient light. The same samples for every pixel, and other ones for each frame.

#include "Isosurface/IsosurfaceKernel.h"
#include "Optics/OpticalModel.h"

#include <vector>

namespace tetralux
{

/// Samples first ... first + count of an endless series.
struct SampleRange
{
  int First = 0;
  int Count = 1;
};

/// The sources of each light's shadows. angle: under which lights are seen from the mesh's centre,
/// radians; 0: one source a light.
std::vector<ShadowSource> MakeShadowSources(const std::vector<Light>& lights, const RayGrid& grid,
  const MeshFrame& mesh, double angle, const SampleRange& samples);

/// Directions all around.
std::vector<OcclusionSample> MakeOcclusionSamples(
  const RayGrid& grid, const MeshFrame& mesh, const SampleRange& samples);

} // namespace tetralux

#endif
