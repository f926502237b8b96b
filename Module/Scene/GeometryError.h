// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GeometryError_h
#define tetralux_GeometryError_h

// What rounding coordinates and scalars does to a picture.
//
// Rounding moves where a ray meets a face, and the scalar there. A channel changes by what the
// attenuation and the colour change along these ways:
// * In a cell the scalar changes by the rounding of scalars, and by its gradient times the rounding
//   across the ray. Over a segment of length l whose scalar runs over w, a change e moves the optical
//   depth by l V e / (w + 2 e), V the variation of the function over the w + 2 e.
// * Where the function of the scalar jumps in space, at the boundary of the mesh and between cells of
//   constant scalar, the face moves along the ray by the rounding across it times the face's slope.
// What a ray is wrong by is at most the sum of all its segments' errors, each weakened by the opacity
// in front of it: over a sample of the mesh's rays (MeshRays.h) that is measured.
//
// The worst pixel of a picture is one whose ray touches a surface, that of a step or a peak of the
// function, or the boundary. Its segment runs along the surface for long, or the face is seen from its
// edge. Lines that come within a distance d of touching are as frequent as d, and their error grows as
// the root of 1 / d: errors larger than e are as frequent as 1 / e^2. So the largest one of n rays is
// the root of n, over that of m, larger than the largest of m: with that the sample's errors are
// extrapolated to a picture's rays. It ends where a segment is wrong all along: LargestOfSegment.

#include "Integral/RaySegments.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// How single precision rounds what rays are integrated between.
struct GeometryRounding
{
  double Across; ///< of a point across a ray, radii of the mesh
  double Scalar; ///< of a scalar on a ray, of the larger of half of the function's range and the largest
                 ///< absolute distance of a scalar from the middle of that range
};

/// Rays of a picture of 512 x 512 pixels, to which errors of a sample's rays are extrapolated.
constexpr double RaysOfPicture = 1 << 18;

/// Estimated largest error of a channel of a picture by rounding; see above.
/// rays: DrawMeshRays. lengthScale: what their lengths are multiplied by to be those of the world.
/// radius: of the mesh, world units. scalarUnit: of rounding.Scalar, in units of the scalars.
TETRALUXCORE_EXPORT double EstimateRoundingError(const RaySample& rays, double lengthScale,
  double radius, double scalarUnit, const TransferFunction& function, bool absorbs,
  const GeometryRounding& rounding);

} // namespace tetralux

#endif
