// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EmbreeSurface_h
#define tetralux_EmbreeSurface_h

#include "View/RayGrid.h"

#include <array>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

class vtkPolyData;

namespace tetralux
{

/// What a picture of triangles shows.
struct EmbreeView
{
  RayGrid Rays;
  std::array<double, 3> Light; ///< position in the world
  bool Shadows = false;        ///< a ray from each hit to the light
  bool TwoLayers = false;      ///< the second hit, too; both with LayerOpacity
};

/// Triangles in a hierarchy of Embree.
class EmbreeSurface
{
public:
  EmbreeSurface(RTCBuildQuality quality, int threads);
  ~EmbreeSurface();
  EmbreeSurface(const EmbreeSurface&) = delete;
  EmbreeSurface& operator=(const EmbreeSurface&) = delete;

  /// Copies the triangles and builds the hierarchy anew. Points in single precision.
  void Build(vtkPolyData* triangles);

  /// Traces a ray through each pixel, in coherent packets of 4 x 4 pixels. rgba: premultiplied,
  /// four numbers a pixel, lit by normals of triangles.
  void Trace(const EmbreeView& view, std::vector<float>& rgba) const;

private:
  RTCBuildQuality Quality;
  int Threads;
  RTCDevice Device;
  RTCScene Scene = nullptr;
};

} // namespace tetralux

#endif
