// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SlicePlanes_h
#define tetralux_SlicePlanes_h

#include "TetraluxCoreModule.h"
#include "TriangleCaster/ImageVolume.h"
#include "TriangleCaster/SliceShape.h"
#include "View/RayGrid.h"

#include <cstdint>

namespace tetralux
{

/// The slabs of a picture of a box, a volume's or one around it: slab n is between depths Origin +
/// n Distance and Origin + (n + 1) Distance. A ray has one sample in each, at the middle of its way
/// through what of it is in the volume and in the ray's limits; that way is the sample's length.
///
/// The depth of a point is its distance from the plane of the camera that the rays start at, or for
/// shells from the eye.
struct SlicePlanes
{
  SliceShape Shape = SliceShape::Planes;
  double Distance = 1; ///< from one to the next, world units, above 0

  /// Where slab 0 begins: the smallest depth of the box, or for shells of the box along
  /// the world's axes around it, but not behind the camera.
  double Origin = 0;

  double Back = 0;        ///< depth of the back of the box
  std::int32_t Count = 0; ///< slabs up to there

  /// What the depth grows by along a ray's Direction of RayGrid, that is the depth of Direction.
  /// direction: of the ray.
  TETRALUXCORE_EXPORT double GetDepthOfDirection(const double direction[3]) const;

  double Normal[3] = { 0, 0, -1 }; ///< of the planes, away from the camera, of length 1
};

/// A box along the axes of a volume's coordinates, which are indices of points.
struct IndexBox
{
  double Low[3] = { 0, 0, 0 };
  double High[3] = { 0, 0, 0 };
};

/// That of a volume's outermost points.
TETRALUXCORE_EXPORT IndexBox GetIndexBox(const ImageVolume& volume);

/// The slabs of a picture of this box; grid.MeshFromWorld leads to its coordinates. Throws
/// std::invalid_argument, with one line, if distance is not above 0, or so short that there are
/// more than 2^24 slabs.
TETRALUXCORE_EXPORT SlicePlanes MakeSlicePlanes(
  const IndexBox& box, const RayGrid& grid, SliceShape shape, double distance);

/// Those of a picture of this volume.
inline SlicePlanes MakeSlicePlanes(
  const ImageVolume& volume, const RayGrid& grid, SliceShape shape, double distance)
{
  return MakeSlicePlanes(GetIndexBox(volume), grid, shape, distance);
}

} // namespace tetralux

#endif
