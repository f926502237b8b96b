// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceTracer_h
#define tetralux_IsosurfaceTracer_h

#include "Base/Span.h"
#include "Isosurface/IsosurfaceOptions.h"
#include "Scene/VolumeScene.h"
#include "TetraluxCoreModule.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <memory>

namespace tetralux
{

/// Traces rays to the isosurfaces of tetrahedra, by an implicit hierarchy over all values (Wald,
/// Friedrich, Knoll and Hansen, Interactive Isosurface Ray Tracing of Time-Varying Tetrahedral
/// Volumes, 2007). Surfaces are planar in each cell, and no ray passes between two cells.
///
/// What was built is kept: the tree for the cells, its boxes for the points, its ranges for the
/// scalars, and isopolygons for the values; see IsosurfaceSteps.h for time steps.
class TETRALUXCORE_EXPORT IsosurfaceTracer
{
public:
  IsosurfaceTracer();
  ~IsosurfaceTracer();
  IsosurfaceTracer(const IsosurfaceTracer&) = delete;
  IsosurfaceTracer& operator=(const IsosurfaceTracer&) = delete;

  /// Draws a picture of a scene whose model is OpticalModel::Isosurfaces: four floats a pixel,
  /// premultiplied, and distances along rays to the first surface, -1 where there is none. The same
  /// picture for any number of threads; of two polygons that a ray meets at the same bits of a
  /// distance, on their common edge, the one that counts depends on the other options. Throws
  /// std::invalid_argument, with one line, if scalars are not at points, or if the arrays do not
  /// have the size of the grid.
  IsosurfaceStatistics Trace(VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
    const IsosurfaceOptions& options, Span<float> colors, Span<float> depths);

private:
  class Internals;
  std::unique_ptr<Internals> Private;
};

} // namespace tetralux

#endif
