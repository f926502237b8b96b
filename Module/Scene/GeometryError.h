// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GeometryError_h
#define tetralux_GeometryError_h

// What rounding coordinates and scalars does to a picture, as a sample of the mesh's rays tells.
//
// Rounding moves the place where a ray meets a face, and the scalar there:
// * In a cell the scalar changes by its own rounding, and by its gradient across the ray times the
//   rounding across. A change e moves the optical depth of a segment of length l, whose scalar runs
//   over w, by l V e / (w + 2 e), with V the variation of the attenuation over w + 2 e. Colours
//   likewise.
// * A face moves along the ray by the rounding across times its slope. That matters where the
//   attenuation jumps there: at the boundary, and between cells of constant scalar.
// Each is weakened by the opacity in front of it. Roundings are independent of each other, so their
// squares add up along a ray.
//
// The error of a picture is estimated as WorstOfPicture times what one ray in a thousand exceeds.
//
// No estimate covers rays that graze a face where the attenuation jumps. Rays within a distance d
// of touching a surface are as frequent as d, and are wrong by the inverse root of d: errors above
// e are as frequent as 1 / e^2, and the largest one grows with the number of pixels without a
// bound. Such pixels are found by the exact picture: it changes there by more than the estimate
// where the ray moves across by GrazingRounding. The ray caster for the processor measures its rays
// where they cross the boundary, and casts those that graze it in double precision.

#include "Integral/RaySegments.h"
#include "Optics/TransferFunction.h"
#include "Scene/WorstOfPicture.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// How far arithmetic moves what rays are integrated between.
struct GeometryRounding
{
  double Across; ///< a point across a ray, radii of the mesh
  double Scalar; ///< a scalar on a ray, shares of the largest absolute mapped scalar
};

/// Coordinates and scalars in the tables of WalkMesh are rounded to 2^-24 of the largest.
constexpr GeometryRounding SingleRounding = { 1. / (1 << 24), 1. / (1 << 24) };

/// No mapper rounds coordinates across a ray by more: radii of the mesh.
constexpr double GrazingRounding = 1. / (1 << 22);

/// What the lengths and scalars of a sample's rays are in a picture.
struct RayUnits
{
  double Length; ///< world length of a unit of RaySegment::Length
  double Radius; ///< of the mesh, world length
  double Scalar; ///< largest absolute mapped scalar, in units of the scalars
};

/// Estimated largest error of a channel of a picture by rounding. rays: DrawMeshRays. absorbs:
/// false for OpticalModel::EmissionOnly. Cost: some 10 ms of one thread for 100,000 segments;
/// parallel.
TETRALUXCORE_EXPORT double EstimateRoundingError(const RaySample& rays, const RayUnits& units,
  const TransferFunction& function, bool absorbs, const GeometryRounding& rounding);

} // namespace tetralux

#endif
