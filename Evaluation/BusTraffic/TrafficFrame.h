// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TrafficFrame_h
#define tetralux_TrafficFrame_h

#include "TriangleCaster/ImageVolume.h"
#include "TriangleCaster/SlicePlanes.h"
#include "View/RayGrid.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A camera that looks at the middle of a volume. Angles are in radians.
struct TrafficView
{
  double Azimuth = 0;   ///< of the direction of view, from x towards y
  double Elevation = 0; ///< of the direction of view, towards z
  double Roll = 0;      ///< of the picture; 0: z is upwards
  double ViewAngle = 0; ///< of the picture, or 0: a parallel projection

  /// Edge of the picture, in voxels, at the depth of the middle.
  double Extent = 256;
};

/// The P-triangles of an S-triangle, from the front triangle to the back triangle: planes of
/// TrafficFrame.
struct TrafficTriangle
{
  int Tile = 0;
  int Half = 0; ///< which of its two S-triangles, see GetTriangleOfPixel
  int Front = 0;
  int Back = 0;
};

/// A picture of a volume, cut into P-triangles.
struct TrafficFrame
{
  static constexpr int TileSize = 8;

  ImageVolume Volume;
  RayGrid Grid;
  SlicePlanes Planes;                     ///< plane n is in the middle of slab n
  std::vector<TrafficTriangle> Triangles; ///< all that show something, tile by tile
  int FirstPlane = 0;                     ///< the smallest of all Front
  int LastPlane = -1;                     ///< the largest of all Back

  int GetNumberOfPlanes() const { return this->LastPlane - this->FirstPlane + 1; }
  std::int64_t GetNumberOfPTriangles() const;

  /// Tiles along an edge. They are numbered row by row.
  int GetColumns() const { return this->Grid.Width / TileSize; }

  /// Values of the depth buffer that are read back after its two passes (section 2.1), if each
  /// pixel's is read, or one for each S-triangle.
  ///@{
  std::int64_t GetDepthsOfPixels() const;
  std::int64_t GetDepthsOfTriangles() const;
  ///@}
};

/// The P-triangles between front and back of what is visible: of cells with a value of at least
/// threshold at a corner. planeDistance: voxels. size: pixels along an edge of the picture, a
/// multiple of 8. Throws std::invalid_argument, with one line, if the volume's values are not
/// unsigned and of 8 bits.
TrafficFrame MakeTrafficFrame(const ImageVolume& volume, const TrafficView& view, int threshold,
  double planeDistance, int size);

} // namespace tetralux

#endif
