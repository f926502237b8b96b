// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FrameSettings_h
#define tetralux_FrameSettings_h

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// What a mapper's properties say of where rays begin and end, and of light. Of no mapper class, so
/// that mappers of image data and tests fill it, too.
struct FrameSettings
{
  bool IntermixIntersectingGeometry = true; ///< rays end at opaque geometry
  bool SmoothShading = true; ///< gradients are interpolated between points; else of each cell

  /// World coordinates; normal and offset: what is positive is kept.
  std::vector<std::array<double, 4>> ClippingPlanes;

  // As in vtkVolumeMapper, coordinates of the data.
  bool Cropping = false;
  double CroppingRegionPlanes[6] = { 0, 1, 0, 1, 0, 1 };
  std::uint32_t CroppingRegionFlags = 0x2000;
};

} // namespace tetralux

#endif
