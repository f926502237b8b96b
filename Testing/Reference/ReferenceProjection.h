// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceProjection_h
#define tetralux_ReferenceProjection_h

#include "ReferenceVector.h"
#include "View/RayGrid.h"

#include <array>

namespace tetralux
{
namespace reference
{

/// Pixels or rows of pixels, both ends included; empty where First > Last.
struct Range
{
  int First = 0;
  int Last = -1;
};

/// Where points lie in the image: at pixel (X / W, Y / W), behind the camera if W is negative.
struct ImagePoint
{
  double X;
  double Y;
  double W;
};

/// Finds the pixels that may see a cell, a few too many rather than one too few. Knows parallel and
/// perspective cameras; of any other grid, every pixel has to try every cell.
class ImageProjection
{
public:
  explicit ImageProjection(const RayGrid& grid);

  ImagePoint Project(const double* point) const;

  /// Rows that may see a cell.
  Range FindRows(const ImagePoint* const corners[4]) const;

  /// Pixels of a row that may see a cell.
  Range FindPixels(const ImagePoint* const corners[4], int row) const;

private:
  int Width;
  int Height;
  bool Perspective;
  bool Usable;
  Vector Origin;
  std::array<Vector, 3> Inverse; ///< from mesh coordinates to those of an ImagePoint
};

} // namespace reference
} // namespace tetralux

#endif
