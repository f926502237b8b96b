// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TracedScene_h
#define tetralux_TracedScene_h

// What the isosurface tracer takes from a scene.

#include "Isosurface/Isopolygon.h"
#include "Isosurface/IsosurfaceOptions.h"
#include "Scene/VolumeScene.h"

#include <algorithm>
#include <vector>

namespace tetralux
{

inline MeshFrame GetMeshFrame(const VolumeScene& scene)
{
  const WalkMesh& mesh = *scene.Mesh.GetMesh();
  MeshFrame frame;
  std::copy_n(mesh.GetCenter(), 3, frame.Center);
  frame.Radius = mesh.GetRadius();
  return frame;
}

inline IsopolygonSource MakeIsopolygonSource(
  const VolumeScene& scene, const std::vector<double>& values)
{
  const TetrahedralMesh& mesh = scene.Mesh.GetMesh()->GetMesh();
  return { GetMeshFrame(scene), mesh.Points.data(), mesh.Cells.data(),
    scene.Mesh.GetScalars().data(), values.data(), static_cast<int>(values.size()) };
}

/// The surfaces that a picture may show; the others block no light either.
inline std::vector<Isosurface> ListVisible(const VolumeScene& scene)
{
  std::vector<Isosurface> visible;
  for (const Isosurface& surface : scene.Optics.GetIsosurfaces())
  {
    if (surface.Opacity > 0 || !scene.Mesh.GetColorScalars().empty())
    {
      visible.push_back(surface);
    }
  }
  return visible;
}

inline bool IsLit(const VolumeScene& scene, const IsosurfaceOptions& options)
{
  return options.Shaded && !scene.Mesh.HasCellScalars();
}

} // namespace tetralux

#endif
