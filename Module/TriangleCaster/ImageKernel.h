// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageKernel_h
#define tetralux_ImageKernel_h

// What the kernels of the triangle caster read and write: plain pointers, filled by ImageCaster.
// The kernels themselves (ImageKernel.inl, ImageComponentKernel.inl) are compiled once for each
// instruction set.

#include "Base/Tile.h"
#include "Lighting/KernelLighting.h"
#include "Optics/IntervalTable.h"
#include "TriangleCaster/EmptySpace.h"
#include "TriangleCaster/HullDepths.h"
#include "TriangleCaster/ImageOptics.h"
#include "TriangleCaster/ImageVolume.h"
#include "TriangleCaster/IntensityMap.h"
#include "TriangleCaster/SlicePlanes.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// What is linear over the pixels (i, j) of a picture.
struct PixelLinear
{
  double Value = 0;
  double StepX = 0;
  double StepY = 0;
  double At(double i, double j) const { return this->Value + i * this->StepX + j * this->StepY; }
};

/// A world half-space as a ray meets it: its height above the plane at the ray's start, and what it
/// gains along Direction.
struct PlaneAlongRays
{
  PixelLinear Height;
  PixelLinear Slope;
};

/// The transfer function as a kernel looks it up: which interval a scalar lies in is found by
/// comparisons where there are few, and by a grid of buckets where there are many.
struct TransferLookup
{
  /// The most intervals that are compared with.
  static constexpr int MostFew = 16;

  int Count = 0; ///< intervals
  /// Fields of the first MostFew intervals, in arrays. Lower ends; the first one's is left out.
  float Lower[MostFew], Reference[MostFew], Opacity[MostFew], OpacitySlope[MostFew];
  float Color[3][MostFew], ColorSlope[3][MostFew];

  const IntervalTable::Interval* Intervals = nullptr; ///< all
  /// Of many: for each bucket of equal width over [-1, 1] an interval that is not above that of any
  /// scalar in it, and the most intervals that a scalar may be above it.
  ///@{
  const std::int32_t* Buckets = nullptr;
  float NumberOfBuckets = 0;
  int MostSteps = 0;
  ///@}
};

/// A SlabTable as a kernel reads it.
struct SlabLookup
{
  const float* Texels = nullptr; ///< nullptr: samples are looked up one by one
  int Size = 0;                  ///< texels along each scalar
  /// The texel coordinate of a value v is CoordinateOffset + CoordinateScale v.
  ///@{
  float CoordinateScale = 1;
  float CoordinateOffset = 0;
  ///@}
  float PerLength = 1; ///< 1 over the length of the table's slabs, in unit distances
};

/// One of several components, as a kernel reads it.
struct ComponentLookup
{
  TransferLookup Transfer;
  /// Where a value lies in the intervals of Transfer: x = ValueOffset + ValueScale v.
  ///@{
  float ValueScale;
  float ValueOffset;
  ///@}
  float LengthScale; ///< the first component's unit distance over this one's
  float Weight;
  TransferLookup GradientTransfer; ///< of no intervals: opacity does not depend on gradients
  float GradientScale;             ///< as those of ImageKernelInput
  float GradientOffset;
  const KernelLighting* Lighting; ///< nullptr: no lights
};

/// The functions of all labels, one behind the other in what both lookups point to. They lie over
/// the same range of scalars.
struct LabelsLookup
{
  const unsigned char* Labels; ///< of points
  std::int32_t Rows[256];      ///< which function each label has
  TransferLookup Transfer;
  float ValueScale; ///< as those of ComponentLookup
  float ValueOffset;
  TransferLookup GradientTransfer;
  float GradientScale;
  float GradientOffset;
  float Share; ///< ImageOptics::LabelShare
};

/// Surfaces of constant scalar, as a kernel reads them.
struct SurfaceLookup
{
  int Count = 0;
  float Sign = 1; ///< of the scalar that a value is worth
  /// Sign times the surfaces' values, ascending with their scalars, between two infinite ones.
  const float* Bounds = nullptr;
  const float* Optics = nullptr; ///< red, green, blue and opacity of each, aligned to 16 bytes
};

/// A table over scalars and gradients as a kernel looks it up.
struct TransferTableLookup
{
  const TransferTable::Entry* Entries = nullptr; ///< nullptr: there is none
  std::int32_t Columns = 0;
  float LastColumn = 0;
  float LastRow = 0;
  /// The column of a scalar at x among the intervals of the transfer function is ColumnOffset +
  /// ColumnScale x, and the row of a gradient length is RowOffset + RowScale length.
  ///@{
  float ColumnScale = 0;
  float ColumnOffset = 0;
  float RowScale = 0;
  float RowOffset = 0;
  ///@}
};

struct ImageKernelInput
{
  // The volume.
  ImageScalar Type;
  const void* Values;
  std::int32_t Row;   ///< points from one row to the next
  std::int32_t Slice; ///< points from one slice of the grid to the next
  std::int32_t LastCell[3];
  /// Where a value lies in the transfer function's intervals: x = ValueOffset + ValueScale v.
  ///@{
  float ValueScale;
  float ValueOffset;
  ///@}

  bool Masked; ///< some points or cells are hidden, by one of these
  const unsigned char* Mask;
  const unsigned char* HiddenCells; ///< not 0: hidden; of the first point of each cell

  // Optics.
  ImageBlend Blend;
  float AverageLow, AverageHigh; ///< values that ImageBlend::AverageIntensity counts
  float GreyScale, GreyOffset;   ///< the grey of a value v is GreyOffset + GreyScale v, within 0..1
  SurfaceLookup Surfaces;
  PlaneAlongRays SlicePlane;
  TransferLookup Transfer;
  SlabLookup Slab;
  bool Power; ///< StepOpacity::Power
  double UnitDistance;
  bool CorrectOpacity;
  float Threshold;

  // Gradients.
  const KernelLighting* Lighting;  ///< nullptr: no lights
  TransferLookup GradientTransfer; ///< of no intervals: opacity does not depend on gradients
  GradientNorm Norm;
  /// Takes a gradient in values a point to scalars a GradientLength of the world, and the length of
  /// that to where it lies in the intervals of GradientTransfer.
  ///@{
  float WorldGradient[3][3];
  float GradientScale;
  float GradientOffset;
  ///@}
  /// Colours and opacities in place of those of Transfer, which then tells where there are any.
  TransferTableLookup Table;
  const float* GradientWords; ///< of GradientVoxels; nullptr: gradients are found on the fly
  float GradientWordScale;
  const IntensityMap::Entry* Intensities; ///< nullptr: lights are summed up directly
  bool InterpolateIntensities;

  /// Factors of colours that are linear in the slab position: those at 0, and what they grow by in
  /// a slab.
  ///@{
  bool Cued;
  float Cue[3];
  float CueStep[3];
  ///@}

  // Several components, and labels.
  int Components;
  bool Dependent;
  const ComponentLookup* Parts; ///< of independent components
  float ColorScale[3];          ///< from values to colours, of four dependent components
  float ColorOffset[3];
  const LabelsLookup* Labels; ///< nullptr: there are none

  // Rays: their starts and directions in coordinates of the volume, and directions in the world.
  PixelLinear Start[3];
  PixelLinear Direction[3];
  PixelLinear WorldDirection[3];
  SlicePlanes Slices;
  IndexBox Sliced; ///< the box that rays go through: the volume, or one that it is a part of
  /// The sides of the volume inside of that box, and those of the box moved to infinity. A slab
  /// that a side cuts belongs to the part of the box that has the slab's sample.
  ///@{
  bool Partial; ///< there are any
  IndexBox Own;
  ///@}
  std::vector<PlaneAlongRays> Planes;
  const RayGrid* Grid;
  const RayLimits* Limits;
  int Width; ///< of the picture

  // The order of work.
  bool EndTriangles;
  bool SkipPixels;
  const EmptySpace* Space;   ///< nullptr: nothing is skipped
  const HullDepths* Hulls;   ///< the same
  const BlockRanges* Ranges; ///< of the one component; nullptr with Space
  int SpaceReach;            ///< slabs in front of a sample and behind it that it depends on
  int TileSize;
  bool Triangles;

  float* Colors;
  float* Depths;
};

struct ImageKernelCounts
{
  std::int64_t Triangles = 0;
  std::int64_t Samples = 0;
  std::int64_t Rays = 0; ///< through the volume, and tiles that are not empty
};

/// Casts the pixels of a tile, whose edges are multiples of TileSize or those of the picture.
using ImageKernel = void (*)(const ImageKernelInput&, const Tile&, ImageKernelCounts&);

/// The kernel that does what an input of one component, without labels, asks for.
///@{
ImageKernel GetImageKernelGeneric(const ImageKernelInput& in);
#ifdef TETRALUX_HAVE_AVX2_KERNEL
ImageKernel GetImageKernelAvx2(const ImageKernelInput& in);
#endif
///@}

#ifdef TETRALUX_HAVE_AVX2_KERNEL
/// The same, with 16 lanes for AVX-512, where samples are composited by a function of their scalar
/// alone; else nullptr. The pictures are the same bits as by AVX2.
ImageKernel GetImageKernelAvx512(const ImageKernelInput& in);
#endif

/// The same as GetImageKernelGeneric for several components, or labels.
///@{
ImageKernel GetImageComponentKernelGeneric(const ImageKernelInput& in);
#ifdef TETRALUX_HAVE_AVX2_KERNEL
ImageKernel GetImageComponentKernelAvx2(const ImageKernelInput& in);
#endif
///@}

} // namespace tetralux

#endif
