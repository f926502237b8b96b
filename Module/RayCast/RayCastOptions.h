// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastOptions_h
#define tetralux_RayCastOptions_h

#include "Optics/OpticalModel.h"
#include "Simd/InstructionSet.h"

#include <functional>
#include <optional>
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

/// How rays find the boundary of the mesh. Pictures have the same bits.
enum class BoundarySearch
{
  Automatic, ///< whichever is faster
  Hierarchy, ///< by a hierarchy over the boundary's faces
  Tiles      ///< by faces that are sorted into tiles of the picture first; by the hierarchy where
             ///< that is not possible, see MakeBoundaryTiles
};

struct RayCastOptions
{
  /// Largest error of a colour channel or of the opacity to aim at, 0..1. A ray ends early if what
  /// is behind cannot change a channel by half of it.
  double MaximumError = 1e-4;

  Precision Arithmetic = Precision::Automatic;

  /// Whether lights shine (RayCastLight.h) on OpticalModel::Isosurfaces, and on EmissionAbsorption
  /// if scalars are at points. The light of surfaces is clamped to 0..1, that of volumes is not.
  /// Lights do not change other models, nor volumes whose scalars are at cells.
  bool Shaded = false;
  bool SmoothShading = true; ///< by gradients interpolated between points; else those of cells
  std::vector<Light> Lights;
  Material Surface;

  Reentry ReentryBy = Reentry::Automatic;
  BoundarySearch Boundary = BoundarySearch::Automatic;

  int NumberOfThreads = 0; ///< 0: as many as OpenMP offers

  /// Which kernels cast: some that are compiled and that the processor has. Without a value: the
  /// widest. Pictures of those for any processor differ by rounding.
  std::optional<InstructionSet> Kernels;

  /// Cast packets of 16 rays where HasFastWideLanes() (InstructionSet.h), in single precision and
  /// without Kernels. The pictures are the same bits. For tests of the others.
  bool WideKernels = true;

  /// Called every few milliseconds, by the calling thread only, with the share that is done, 0..1.
  /// Returns false to abort. The last call is with 1, when nothing is left to abort. May be empty.
  std::function<bool(double)> Progress;
};

} // namespace tetralux

#endif
