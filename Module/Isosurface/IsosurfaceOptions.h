// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceOptions_h
#define tetralux_IsosurfaceOptions_h

#include "Base/Span.h"
#include "Base/Tile.h"
#include "Hierarchy/MinMaxTree.h"
#include "Isosurface/TraceInput.h"
#include "Optics/OpticalModel.h"
#include "Simd/InstructionSet.h"
#include "View/DepthMap.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tetralux
{

/// When isopolygons are made (Wald et al. 2007, section 4.4).
enum class Isopolygons
{
  Precomputed, ///< all of them, when values, scalars or points change
  OnTheFly     ///< for each packet that meets their cells
};

struct IsosurfaceOptions
{
  /// Largest error of a colour channel to aim at, 0..1: a ray ends where what is behind cannot
  /// change a channel by half of it.
  double MaximumError = 1e-4;

  bool Shaded = false;       ///< whether lights shine; their light is clamped to 0..1
  bool SmoothShading = true; ///< by gradients interpolated between points; else those of cells
  bool Shadows = false;      ///< whether surfaces block positional and distant lights
  std::vector<Light> Lights;
  Material Surface;

  double ShadowSoftness = 0;     ///< angle that lights are seen under, radians; 0: hard shadows
  bool AmbientOcclusion = false; ///< whether surfaces block light from all around, where lit
  double OcclusionRadius = 0;    ///< from how far they do, world units; 0: a fifth of the radius

  /// Light sources a frame of soft shadows, and directions of ambient light. Frames of which
  /// nothing else differs take further ones, up to MaximumSamples, and the picture is their mean.
  ///@{
  int SamplesPerFrame = 4;
  int MaximumSamples = 256;
  ///@}

  /// What the window's depth buffer holds of points, for WindowDepths.
  DepthMap Depth{};
  /// To be filled, one a ray, unless empty: what the depth buffer is to hold of the nearest opaque
  /// surface, 1 where there is none.
  Span<float> WindowDepths;
  /// To be filled, four a ray, unless empty: colours and opacities as the frame buffer of a window
  /// holds them, 0..255, in place of those in single precision and of distances. With WindowDepths.
  Span<std::uint8_t> WindowColors;

  int MaximumLayers = 0; ///< surfaces that a ray meets at most; 0: as many as MaximumError asks for

  TreeBuild Build = TreeBuild::SpatialMedian;
  Isopolygons Polygons = Isopolygons::Precomputed;

  /// Whether precomputed isopolygons are prepared once for all rays to a light, or of a direction
  /// of ambient light. Without a value: if there are few for the size of the picture.
  std::optional<bool> PlaceOnce;

  /// Bytes of time steps that are kept beside the present one. 0: none is kept, and boxes are
  /// refitted in place.
  std::size_t StepCacheBytes = std::size_t{ 256 } << 20;

  int NumberOfThreads = 0; ///< 0: as many as OpenMP offers

  /// Kernels to use instead of the best ones, for tests. The processor must have them.
  std::optional<InstructionSet> Kernels;

  /// As RayCastOptions::Progress.
  std::function<bool(double)> Progress;
};

struct IsosurfaceStatistics
{
  std::vector<std::string> Rebuilt; ///< of tree, boxes, ranges, isopolygons and gradients
  double TreeSeconds = 0;
  double RangesSeconds = 0;
  double PolygonsSeconds = 0;
  double TraceSeconds = 0;
  std::int64_t Nodes = 0;        ///< of the whole tree
  std::int64_t ActiveNodes = 0;  ///< of precomputed isopolygons
  std::int64_t Polygons = 0;     ///< the same
  int Steps = 0;                 ///< time steps that are kept, with the present one
  double TreeBytes = 0;          ///< for each tetrahedron
  double StepBytes = 0;          ///< for each tetrahedron, of one time step: ranges and scalars
  std::size_t AllTreesBytes = 0; ///< of all time steps that are kept
  std::size_t AllStepsBytes = 0; ///< the same, without trees: ranges, isopolygons, gradients
  TraceCounts Primary;
  TraceCounts Shadow;
  std::int64_t Hits = 0;
  Tile Covered{ 0, 0, 0, 0 }; ///< packets that hit anything, pixels; nothing else is in the picture
  int Samples = 0; ///< of soft shadows and ambient light, of all frames that the picture is of
  std::int64_t LostRays = 0; ///< ended at MaximumLayers
  int NumberOfThreads = 0;
  std::string InstructionSet;
  bool Aborted = false;
  double TerminationError = 0; ///< what may be lost behind a ray's early end
};

} // namespace tetralux

#endif
