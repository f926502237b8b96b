// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceKernel_h
#define tetralux_IsosurfaceKernel_h

// What the kernels of the isosurface tracer read and write: plain pointers, filled by
// IsosurfaceTracer. The kernels themselves (IsosurfaceKernel.inl) are compiled once for each
// instruction set.

#include "Isosurface/CellField.h"
#include "Isosurface/PlacedTree.h"
#include "Isosurface/RayBlock.h"
#include "Isosurface/TraceInput.h"
#include "Lighting/KernelLighting.h"
#include "Optics/IntervalTable.h"
#include "View/RayGrid.h"

#include <cstdint>

namespace tetralux
{

/// A point of a light, or a direction to it, from which shadow rays start.
struct ShadowSource
{
  int Light;   ///< index
  bool First;  ///< of its light
  float Share; ///< of its light
  /// Of a distant light one frame, else one for each half of each axis of the mesh's frame.
  ///@{
  bool Positional;
  RayFrame Frames[6];
  const PlacedTree* Placed[6]; ///< of each frame; nullptr: there is none
  ///@}
  double Place[3]; ///< in the mesh's frame: position, or direction to the light
};

/// A direction from which ambient light comes.
struct OcclusionSample
{
  RayFrame Frame;           ///< of rays that come from there; depths are lengths in the world
  float Direction[3];       ///< to there, in the world, of length 1
  const PlacedTree* Placed; ///< of the frame; nullptr: there is none
};

struct IsosurfaceInput
{
  TraceTree Tree;

  // The rays of the picture.
  RayFrame Frame;
  const RayGrid* Grid;
  TraceLimits Limits;            ///< with the near and the far plane
  const float* MaximumDistances; ///< nullptr: none

  // What surfaces look like.
  const IntervalTable::Interval* Intervals; ///< of the function of ColorScalars
  int NumberOfIntervals;
  double FunctionOffset;            ///< IntervalTable::Offset
  double FunctionScale;             ///< IntervalTable::Scale
  const double* ColorScalars;       ///< of points; nullptr: SurfaceColors counts
  const CellField<1>* ColorFields;  ///< of each polygon; nullptr: made of ColorScalars
  const float* SurfaceColors;       ///< red, green, blue, opacity of each value
  const KernelLighting* Lighting;   ///< nullptr: no light
  const CellField<3>* Gradients;    ///< of each polygon, interpolated; nullptr: Lighting's
  const GradientRow* CellGradients; ///< of each polygon; nullptr: Lighting's
  const ShadowSource* Shadows;      ///< of the lights that are blocked
  int NumberOfShadows;
  const OcclusionSample* Occlusion; ///< nullptr: nothing blocks ambient light
  int NumberOfOcclusionSamples;
  double OcclusionRadius;   ///< what is farther blocks no ambient light; in the world
  double OcclusionOffset;   ///< what is nearer blocks none either; in the world
  TraceLimits ShadowLimits; ///< what is cut away blocks no light
  int MaximumLayers;        ///< surfaces that a ray meets at most
  float MaximumOpacity;     ///< a ray ends where it is this opaque

  float* Colors;              ///< four a pixel, premultiplied
  float* Depths;              ///< one a pixel
  float* WindowDepths;        ///< one a pixel; nullptr: not wanted
  std::uint8_t* WindowColors; ///< four a pixel, in place of Colors and Depths; nullptr: not wanted

  /// What a depth buffer holds of a point of a ray, and what that is divided by: factors of u, v,
  /// the key and 1.
  ///@{
  double DepthFactors[4];
  double DivisorFactors[4];
  ///@}
};

struct IsosurfaceCounts
{
  TraceCounts Primary;
  TraceCounts Shadow;
  std::int64_t Hits = 0;     ///< surfaces that rays met
  std::int64_t LostRays = 0; ///< ended at MaximumLayers, though not opaque
  double LostOpacity = 0;    ///< largest share of light that such a ray lets through
};

/// Memory of a thread.
struct IsosurfaceScratch
{
  RayBlock Block;
  RayPacket ShadowRays;

  /// The present packet of the block.
  ///@{
  RayPacket* Rays;
  PacketPixels* Pixels;
  ///@}

  // The hits of a layer of it.
  std::uint8_t HitRays[RayPacket::MaximumChunks]; ///< those of a chunk that hit, one bit each
  double Points[3][RayPacket::MaximumRays];       ///< in the mesh's frame
  float Gradients[3][RayPacket::MaximumRays];
  float HitColors[4][RayPacket::MaximumRays]; ///< and opacities, if ColorScalars counts
  std::int32_t Surfaces[RayPacket::MaximumRays];
  /// MaximumRays for each light, 1 of lights that are not blocked; nullptr: no light is.
  float* Visible;
  float Ambient[RayPacket::MaximumRays]; ///< share of ambient light, if anything blocks it
};

/// Draws the pixels from (x0, y0) up to but without (x1, y1): a block at most.
using DrawKernel = void (*)(
  const IsosurfaceInput&, int x0, int y0, int x1, int y1, IsosurfaceScratch&, IsosurfaceCounts&);

/// Fills the leaves of a PlacedTree among the nodes from first up to but without end. bounds: of
/// all rays of the frame, least u and v, then largest u and v.
using PlaceKernel = void (*)(const TraceTree&, const RayFrame&, const TraceLimits&,
  const double (&bounds)[4], std::int32_t first, std::int32_t end, const PlacedTree&);

struct IsosurfaceKernels
{
  DrawKernel Draw;
  PlaceKernel Place;
};

IsosurfaceKernels GetIsosurfaceKernelsGeneric();
#ifdef TETRALUX_HAVE_AVX2_KERNEL
IsosurfaceKernels GetIsosurfaceKernelsAvx2();
IsosurfaceKernels GetIsosurfaceKernelsAvx512();
#endif

} // namespace tetralux

#endif
