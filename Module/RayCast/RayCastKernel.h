// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastKernel_h
#define tetralux_RayCastKernel_h

// What the kernels of the ray caster read and write: plain pointers, filled by CastRays. The
// kernels themselves (RayCastKernel.inl) are compiled once for each instruction set.

#include "Hierarchy/BoundaryBvh.h"
#include "Integral/Integrator.h"
#include "Lighting/KernelLighting.h"
#include "Optics/ComponentFunctions.h"
#include "Optics/IntervalTable.h"
#include "Optics/OpticalModel.h"
#include "PreIntegration/PreIntegrationTable.h"
#include "RayCast/BoundaryTiles.h"
#include "View/RayAcross.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"
#include "Walk/WalkMesh.h"

#include <array>
#include <cstdint>

namespace tetralux
{

/// A pre-integration table with texels in single precision.
struct KernelTable
{
  const float* Texels; ///< four each, in the order of PreIntegrationTable
  const ScalarAxisMap::Interval* Axis;
  int AxisSize; ///< number of intervals
  int ScalarSize;
  int LengthSize;
  bool Logarithmic;
  int StepsPerDoubling;
  float InverseDelta;
};

/// Intervals of a transfer function, column by column: lanes look them up in registers.
struct alignas(64) IntervalColumns
{
  static constexpr int Few = 16; ///< in one register or two
  static constexpr int Most = 64;
  using Column = float[Most];
  Column Lo, Hi, Reference, Attenuation, AttenuationSlope;
  Column Color[3], ColorSlope[3], ColorBend[3];
};

/// Several scalars at points.
struct KernelComponents
{
  int Count;          ///< 2 to MostComponents
  bool Dependent;     ///< as ComponentFunctions has it
  const double* Rows; ///< four for each point
  const IntervalTable::Interval* Intervals[MostComponents];
};

struct KernelInput
{
  // The mesh. Points: WalkPoint<Real> of the kernel's Real.
  const void* Points;
  const WalkFace* Faces;
  const WalkEntry* Entries;
  const BoundaryBvh::Node* Nodes; ///< nullptr: no boundary, an empty mesh
  const std::int32_t* Triangles;
  /// BoundaryTiles of Grid; nullptr: rays find the boundary by Nodes.
  ///@{
  const TileFace* TileFaces;
  const std::int32_t* TileBegins;
  int TileColumns;
  ///@}
  std::int32_t NumberOfCells; ///< of the mesh; those behind are imaginary
  /// For checks: what ids are below.
  ///@{
  std::int32_t NumberOfPoints;
  std::int32_t NumberOfWalkCells; ///< imaginary ones included
  std::int32_t NumberOfEntries;
  ///@}
  double Center[3];
  double Radius;

  // What is integrated. Intervals for scalars at points, CellValues for scalars at cells; of the
  // largest scalar these hold the scalar, as the intervals map it, for an attenuation.
  const IntervalTable::Interval* Intervals;
  int NumberOfIntervals;
  const IntervalColumns* Columns; ///< the same; nullptr where there are more than it holds
  bool Curved;                    ///< IntervalTable::Curved
  const CellValue* CellValues;
  float Color[3]; ///< OpticalDepth: where the colour is constant
  /// Values of surfaces i - 1 and i, for i from 0 up to their number.
  const std::array<float, 2>* SurfaceNeighbors;
  int NumberOfSurfaces;
  const float* SurfaceColors; ///< red, green, blue, opacity of each surface, ascending in value
  const KernelTable* Table;   ///< of Integrator::Table
  const KernelComponents* Components; ///< of Integrator::Components
  const KernelLighting* Lighting;     ///< of lit integrators; nullptr where isosurfaces are not lit
  double DistanceRounding;            ///< what distances along rays may be off by, in world units

  // Of single precision: what a ray's colour changes by where rounding moves the boundary along it.
  /// The change for a slope of 1 of a boundary face, world units along the ray for a unit of
  /// projections, where the attenuation is largest; 0: none is found.
  float ShiftFactor;
  float LargestAttenuation;
  float LargestShiftError;     ///< of a ray whose block is not marked
  std::uint8_t* InexactBlocks; ///< blocks row by row; those that are marked are not cast. nullptr:
                               ///< all are cast

  // The scene.
  const RayGrid* Grid;
  RayAxes Axes;
  const std::array<double, 4>* Planes;
  int NumberOfPlanes;
  const double (*CroppingPlanes)[6]; ///< nullptr: no cropping
  std::uint32_t CroppingFlags;
  const float* MaximumDistances; ///< nullptr: none

  /// A ray ends where it is this opaque, since too little of the light behind reaches the eye.
  float MaximumOpacity;
  float MaximumDepth; ///< the same as an optical depth

  float* Colors; ///< four a pixel, premultiplied
  float* Depths; ///< one a pixel
};

/// How far single precision moves a face of the boundary across a ray, radii of the mesh:
/// coordinates are rounded to 2^-25, and so is each of the four terms that project them.
constexpr double ShiftRounding = 1. / (1 << 23);

/// Projections are scaled by this, so that products of two of them stay normal numbers down to the
/// smallest that differ from zero (SmallestProjection squared, times 2^-24).
constexpr double ProjectionScale = 1099511627776.; // 2^40

/// Lanes of the largest packet that kernels cast.
constexpr int MostLanes = 16;

/// Where the rays of a packet cross a face of the boundary.
struct FaceCrossing
{
  union
  {
    float Single[MostLanes];
    double Double[MostLanes / 2];
  } Distances;         ///< of each lane, in the precision of the kernel
  std::int32_t Entry;  ///< index into KernelInput::Entries
  std::uint32_t Lanes; ///< rays that cross it, but for those that entered or left there before
                       ///< another crossing
};

/// Room for the crossings of a packet's rays, owned by one thread and grown on demand.
struct CrossingBuffer
{
  FaceCrossing* Crossings;
  int Capacity;
  void (*Grow)(CrossingBuffer&); ///< at least doubles Capacity; contents are lost
};

/// Packets that a thread casts by turns.
constexpr int PacketsInFlight = 2;
using CrossingBuffers = std::array<CrossingBuffer*, PacketsInFlight>;

struct KernelCounts
{
  std::int64_t Segments = 0; ///< cells walked through, over all rays
  std::int64_t Lanes = 0;    ///< lanes of packets, over all their steps
  std::int64_t Paths = 0;    ///< entries into the mesh
  double ShiftError = 0;     ///< largest of a ray, see KernelInput::ShiftFactor
};

/// Place of the block with a pixel in KernelInput::InexactBlocks.
constexpr std::int64_t GetBlockPlace(int width, int x, int y)
{
  return static_cast<std::int64_t>(y / BlockHeight) * ((width + BlockWidth - 1) / BlockWidth) +
    x / BlockWidth;
}

/// Casts the rays of the pixels from (x0, y0) up to but without (x1, y1): of one tile of
/// RayTileSize, or of a block of it.
using RayCastKernel = void (*)(
  const KernelInput&, int x0, int y0, int x1, int y1, const CrossingBuffers&, KernelCounts&);

/// The kernels of one instruction set.
struct RayCastKernels
{
  struct Pair
  {
    RayCastKernel Single = nullptr;
    RayCastKernel Double = nullptr;
  };
  Pair Points[static_cast<int>(Integrator::Count)];
  Pair Cells[static_cast<int>(Integrator::Count)];
};

RayCastKernels GetRayCastKernelsGeneric();
#ifdef TETRALUX_HAVE_AVX2_KERNEL
RayCastKernels GetRayCastKernelsAvx2();
RayCastKernels GetRayCastKernelsAvx512();
RayCastKernels GetRayCastKernelsAvx512Wide(); ///< of 16 lanes, of single precision alone
#endif

} // namespace tetralux

#endif
