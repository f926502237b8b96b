// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WindowWays_h
#define tetralux_WindowWays_h

// Ways that draw into a window. Their time is that of a whole frame.

#include "Isosurfaces/IsosurfaceWay.h"

#include <memory>

struct SceneOptions;
class vtkUnstructuredGrid;

namespace tetralux
{

/// A frame with nothing to draw: the part of the window in the times of the others.
std::unique_ptr<IsosurfaceWay> MakeEmptyWay(vtkUnstructuredGrid* grid, const SceneOptions& options);

/// Triangles, drawn by OpenGL. Shadows are shadow maps, layers are peeled: the nearest and the
/// farthest one, with what is between them blended in any order.
std::unique_ptr<IsosurfaceWay> MakeRasteriserWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options);

/// The isosurfaces of vtkTetrahedraRayCastMapper. It has no shadows, and blends all layers.
std::unique_ptr<IsosurfaceWay> MakeRayCasterWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options);

/// vtkTetrahedraIsosurfaceMapper, in a window and as far as its picture.
///@{
std::unique_ptr<IsosurfaceWay> MakeTracerWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options);
std::unique_ptr<IsosurfaceWay> MakeTracerAloneWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options);
///@}

} // namespace tetralux

#endif
