// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCaster_h
#define tetralux_RayCaster_h

#include "Base/Span.h"
#include "Integral/ErrorBudget.h"
#include "Integral/Integrator.h"
#include "RayCast/RayCastOptions.h"
#include "Scene/VolumeScene.h"
#include "TetraluxCoreModule.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <cstdint>
#include <string>

namespace tetralux
{

struct RayCastStatistics
{
  bool Aborted = false;
  bool DoublePrecision = false; ///< of all rays
  std::int64_t DoubleRays = 0;  ///< in double precision, also where others are not
  std::string InstructionSet;
  Integrator Integration = Integrator::ClosedForm;
  int NumberOfThreads = 0;
  std::int64_t Rays = 0;
  std::int64_t Segments = 0;         ///< cells walked through, over all rays
  std::int64_t Paths = 0;            ///< entries into the mesh, over all rays
  bool BoundaryTiles = false;        ///< whether the boundary was found by BoundarySearch::Tiles
  bool ImaginaryCells = false;       ///< whether rays went through imaginary cells
  std::int64_t TransparentCells = 0; ///< left out of the walk; 0 where that would not pay
  double LaneUse = 0;                ///< share of vector lanes that carried a ray, 0..1
  ErrorBudget Budget;                ///< how MaximumError was divided
  double ErrorEstimate = 0;          ///< sum of the five below
  double TerminationError = 0;       ///< at most, by ending rays early
  double Brightness = 1;             ///< FindLargestBrightness of what is lit
  double IntegralError = 0;          ///< at most, by the weights of segments
  double SummationError = 0;         ///< estimated, by adding pieces up; of a path of mean length
  double TableError = 0;             ///< estimated, by interpolation in a table
  double GeometryError = 0; ///< estimated, by rounding coordinates and scalars, also of rays that
                            ///< graze the boundary; not of those that graze cells in it whose
                            ///< scalars are constant, see GeometryError.h
};

/// Cell-to-cell ray casting on the CPU (Garrity 1990; Weiler et al. 2003): packets of rays,
/// tiles of the image over OpenMP threads. The picture does not depend on the number of threads.
///
/// Casts all rays of the grid. Throws std::invalid_argument if the scene is not complete
/// (VolumeScene::CheckComplete). Reads a pre-integration table in single precision, whatever its
/// format.
///
/// colors: four floats a pixel, premultiplied red, green, blue and opacity. depths: one float a
/// pixel, the distance along the ray to the first contribution, world units, or -1. Both have the
/// lowest row first, and are incomplete after an abort.
TETRALUXCORE_EXPORT RayCastStatistics CastRays(VolumeScene& scene, const RayGrid& grid,
  const RayLimits& limits, const RayCastOptions& options, Span<float> colors, Span<float> depths);

} // namespace tetralux

#endif
