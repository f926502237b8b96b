// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceImage_h
#define tetralux_ReferenceImage_h

#include "TriangleCaster/ImageOptics.h"
#include "TriangleCaster/ImageVolume.h"
#include "TriangleCaster/SliceShape.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <vector>

namespace tetralux
{

/// The oracle of image data: one ray at a time, in extended precision. Nothing is tabulated, no
/// space is left out, no ray ends early.
///
/// A ray counts from its start on, in the volume's box (its faces included), and where the limits
/// keep it. Cropping may cut it into parts; a plane between two regions that are kept cuts nothing.
/// The scalar is trilinear in each cell, and a cell is empty if a value at one of its corners is
/// not finite. At a step of the function the value from larger scalars counts.
///
/// Functions throw std::invalid_argument for a volume of fewer than 2 points along an axis, a
/// function without nodes, and a distance that is not above 0.

/// What samples may be off by in a program of less precision.
struct ReferenceRounding
{
  double Position = 0; ///< along each axis, cells
  double Scalar = 0;   ///< in units of the scalar
  double Length = 0;   ///< where a sample's part of the ray begins and ends, distances of slices
};

/// How rays are sampled: by slabs as SlicePlanes describes them, one sample in each slab and part.
/// Slab 0 is the first; there are as many behind it as the volume needs.
struct ReferenceSlices
{
  SliceShape Shape = SliceShape::Planes;
  double Distance = 1; ///< world units

  /// As in ImageCasterOptions: else lengths are those along the normal of the planes.
  bool CorrectOpacity = true;

  ReferenceRounding Rounding;
};

struct ReferencePixel
{
  double Rgba[4] = { 0, 0, 0, 0 }; ///< premultiplied

  /// World distance along the ray to where something contributes first: the near end of the first
  /// sample's part, or the first point at which the opacity begins to be more than 0. -1: nowhere.
  double Depth = -1;

  double Length = 0; ///< world length of what counts of the ray

  /// The most that a channel may change where each sample is off by Rounding. Large where a sample
  /// is at a step of the function or at an empty cell, or opaque however short it is.
  double Doubt = 0;
};

/// Composites samples front to back (Knittel 1999, equation 5).
ReferencePixel SampleReferenceRay(const ImageVolume& volume, const ImageOptics& optics,
  const RayGrid& grid, const RayLimits& limits, const ReferenceSlices& slices, int i, int j);

/// The integral along the ray, what samples come to as the distance of slices goes to 0: the
/// attenuation is a / UnitDistance, or for StepOpacity::Power -ln(1 - a) / UnitDistance. A stretch
/// of any length where a is 1 is opaque then, in the colour of its begin.
///
/// The ray is split at the planes of the grid, and where the cubic polynomial of the scalar in a
/// cell turns or meets a node of the function. Pieces are halved until Gauss-Legendre agrees to
/// 1e-13; channels are off by less than 1e-10.
ReferencePixel IntegrateReferenceRay(const ImageVolume& volume, const ImageOptics& optics,
  const RayGrid& grid, const RayLimits& limits, int i, int j);

/// All pixels of a picture, the lowest row first.
///@{
std::vector<ReferencePixel> SampleReferenceImage(const ImageVolume& volume,
  const ImageOptics& optics, const RayGrid& grid, const RayLimits& limits,
  const ReferenceSlices& slices);
std::vector<ReferencePixel> IntegrateReferenceImage(const ImageVolume& volume,
  const ImageOptics& optics, const RayGrid& grid, const RayLimits& limits);
///@}

} // namespace tetralux

#endif
