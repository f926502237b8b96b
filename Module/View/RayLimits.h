// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayLimits_h
#define tetralux_RayLimits_h

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// Which part of each ray counts.
struct RayLimits
{
  /// World half-spaces (a, b, c, d): what has a x + b y + c z + d >= 0 is kept. The near and far
  /// planes of the camera and every clipping plane go here.
  std::vector<std::array<double, 4>> Planes;

  /// The first ones that are the camera's own: they cut what it sees, not what blocks light.
  int NumberOfCameraPlanes = 0;

  /// Cropping as in vtkVolumeMapper: planes xmin, xmax, ymin, ymax, zmin, zmax in mesh coordinates
  /// cut space into 27 regions, and bit x + 3 y + 9 z of CroppingFlags keeps a region. Used where
  /// Cropping is true.
  bool Cropping = false;
  double CroppingPlanes[6] = { 0, 1, 0, 1, 0, 1 };
  std::uint32_t CroppingFlags = 0x2000;

  /// Width x Height distances along the rays, in world units from their starts, behind which
  /// nothing is seen (opaque geometry); nullptr: none.
  const float* MaximumDistances = nullptr;
};

} // namespace tetralux

#endif
