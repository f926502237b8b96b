// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCaster_h
#define tetralux_RayCaster_h

#include "Base/Span.h"
#include "Optics/OpticalModel.h"
#include "Scene/VolumeScene.h"
#include "TetraluxCoreModule.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tetralux
{

/// Arithmetic of the geometry along a ray. Integrals are always evaluated in single precision,
/// whose error there is SegmentWeightError.
enum class Precision
{
  Automatic, ///< single where EstimateGeometryError stays within the error that is asked for
  Single,    ///< single; double all the same where the mesh's world radius is beyond its range
  Double
};

/// How rays that left the mesh find where they enter it again.
enum class Reentry
{
  Automatic, ///< whichever is faster, see CastRays
  Boundary,  ///< by a hierarchy over the boundary's faces
  Imaginary  ///< through imaginary cells between the mesh and its hull (Weiler et al. 2003, section
             ///< 3.4); by the boundary where the mesh can't be made convex
};

struct RayCastOptions
{
  /// Largest error of a colour channel or of the opacity that is aimed at, 0..1. Rays end early
  /// where what is behind could not change a channel by half of it.
  double MaximumError = 1e-4;

  Precision Arithmetic = Precision::Automatic;

  /// Whether lights shine on OpticalModel::Isosurfaces, and on what emits and absorbs, where scalars
  /// are at points: FindLight in SurfaceShading.h. A segment is lit as its middle is; the light of
  /// surfaces is clamped to 0..1, that of volumes is not. Other models, and scalars at cells, shine by
  /// themselves.
  bool Shaded = false;
  bool SmoothShading = true; ///< by gradients interpolated between points; else those of cells
  std::vector<Light> Lights;
  Material Surface;

  Reentry ReentryBy = Reentry::Automatic;

  int NumberOfThreads = 0; ///< 0: as many as OpenMP offers

  /// Use the kernels that run on any processor even where there are faster ones; the pictures
  /// differ by rounding. For tests of those kernels.
  bool PortableKernels = false;

  /// Called every few milliseconds, by the calling thread only, with the share that is done, 0..1;
  /// returns false to abort. The last call is with 1, when nothing is left to abort. May be empty.
  std::function<bool(double)> Progress;
};

struct RayCastStatistics
{
  bool Aborted = false;
  bool DoublePrecision = false;
  std::string InstructionSet;
  /// How rays were integrated: "closed form", "table", "optical depth", "emission", "largest scalar"
  /// or "isosurfaces".
  std::string Integration;
  int NumberOfThreads = 0;
  std::int64_t Rays = 0;
  std::int64_t Segments = 0;         ///< cells walked through, over all rays
  std::int64_t Paths = 0;            ///< entries into the mesh, over all rays
  bool ImaginaryCells = false;       ///< whether rays went through imaginary cells
  std::int64_t TransparentCells = 0; ///< left out of the walk; 0 where that would not pay
  double LaneUse = 0;                ///< share of vector lanes that carried a ray, 0..1
  double ErrorEstimate = 0;          ///< sum of the five below
  double TerminationError = 0;       ///< at most, by ending rays early
  double IntegralError = 0;          ///< at most, by the weights of segments
  double SummationError = 0;         ///< estimated, by adding segments up; of a path of mean length
  double TableError = 0;             ///< estimated, by interpolation in a table
  double GeometryError = 0; ///< estimated, by rounding coordinates and scalars; not that of
                            ///< pixels that graze, see GeometryError.h
};

/// Cell-to-cell ray casting on the CPU (Garrity 1990; Weiler et al. 2003): packets of eight rays,
/// tiles of the image over OpenMP threads. The picture does not depend on the number of threads.
///
/// Casts all rays of the grid. Throws std::invalid_argument where the scene is not complete
/// (VolumeScene::CheckComplete). A pre-integration table is read in single precision, whatever it is
/// stored in. colors: four floats a pixel, premultiplied red, green, blue and opacity; depths: one
/// float a pixel, the distance along the ray to the first contribution in world units, -1 where there
/// is none; both lower row first. After an abort they are incomplete.
TETRALUXCORE_EXPORT RayCastStatistics CastRays(VolumeScene& scene, const RayGrid& grid,
  const RayLimits& limits, const RayCastOptions& options, Span<float> colors, Span<float> depths);

} // namespace tetralux

#endif
