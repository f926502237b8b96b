// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceProjection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace reference
{
namespace
{

/// Pixels; the projection is accurate to 1e-6 of a pixel in any sane image.
constexpr double Margin = 0.01;
/// Relative rounding error of a coordinate of an ImagePoint, and some more.
constexpr double Rounding = 1e-12;
/// Share of the product of the lengths; below it the steps of the grid do not span an image.
constexpr Real SmallestDeterminant = 1e-9L;

/// The pixels of 0..size - 1 between the smallest and the largest value / w; all of them where
/// values lie on both sides of the camera or too close to it to tell.
Range Cover(const double* values, const double* w, int count, int size)
{
  const Range all{ 0, size - 1 };
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -minimum;
  for (int i = 0; i < count; ++i)
  {
    const double position = values[i] / w[i];
    if ((w[i] < 0) != (w[0] < 0) || !(std::abs(position) < Margin / Rounding))
    {
      return all;
    }
    minimum = std::min(minimum, position);
    maximum = std::max(maximum, position);
  }
  // Clamped before the conversion to int; a range beside the image becomes empty.
  const auto clamp = [size](double value) { return std::clamp<double>(value, -1, size); };
  return { static_cast<int>(std::max(0.0, clamp(std::ceil(minimum - Margin)))),
    static_cast<int>(std::min(size - 1.0, clamp(std::floor(maximum + Margin)))) };
}

} // namespace

ImageProjection::ImageProjection(const RayGrid& grid)
  : Width(grid.Width)
  , Height(grid.Height)
{
  const auto direction = [&grid](const double v[3])
  { return TransformDirection(grid.MeshFromWorld, ToVector(v)); };
  const auto isZero = [](const double v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
  this->Perspective = isZero(grid.OriginStepX) && isZero(grid.OriginStepY);
  const bool parallel = isZero(grid.DirectionStepX) && isZero(grid.DirectionStepY);
  this->Origin = TransformPoint(grid.MeshFromWorld, ToVector(grid.Origin));

  // A point P is seen at pixel (i, j) where P - Origin = i x + j y + w Direction in a parallel
  // image, w (i x + j y + Direction) in a perspective one.
  const Vector x = direction(this->Perspective ? grid.DirectionStepX : grid.OriginStepX);
  const Vector y = direction(this->Perspective ? grid.DirectionStepY : grid.OriginStepY);
  const Vector w = direction(grid.Direction);
  const Real determinant = Dot(Cross(x, y), w);
  const Real scale = std::sqrt(Dot(x, x) * Dot(y, y) * Dot(w, w));
  this->Usable =
    this->Perspective != parallel && std::abs(determinant) > SmallestDeterminant * scale;
  this->Inverse = { Cross(y, w), Cross(w, x), Cross(x, y) };
  for (Vector& row : this->Inverse)
  {
    for (Real& component : row)
    {
      component /= determinant;
    }
  }
}

ImagePoint ImageProjection::Project(const double* point) const
{
  const Vector offset{ point[0] - this->Origin[0], point[1] - this->Origin[1],
    point[2] - this->Origin[2] };
  const auto coordinate = [&](int row)
  { return static_cast<double>(Dot(this->Inverse[row], offset)); };
  return { coordinate(0), coordinate(1), this->Perspective ? coordinate(2) : 1 };
}

Range ImageProjection::FindRows(const ImagePoint* const corners[4]) const
{
  if (!this->Usable)
  {
    return { 0, this->Height - 1 };
  }
  double y[4];
  double w[4];
  for (int i = 0; i < 4; ++i)
  {
    y[i] = corners[i]->Y;
    w[i] = corners[i]->W;
  }
  return Cover(y, w, 4, this->Height);
}

Range ImageProjection::FindPixels(const ImagePoint* const corners[4], int row) const
{
  if (!this->Usable)
  {
    return { 0, this->Width - 1 };
  }
  // Corners of the polygon in which the plane of the row cuts the cell. Those within the margin
  // of the plane count as well, so that rounding can not lose the polygon.
  double x[10];
  double w[10];
  int count = 0;
  double distance[4];
  for (int i = 0; i < 4; ++i)
  {
    const ImagePoint& corner = *corners[i];
    distance[i] = corner.Y - row * corner.W;
    if (!(std::abs(distance[i]) > Margin * std::abs(corner.W) + Rounding * std::abs(corner.Y)))
    {
      x[count] = corner.X;
      w[count] = corner.W;
      ++count;
    }
  }
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      if ((distance[i] < 0) != (distance[j] < 0))
      {
        const double share = distance[i] / (distance[i] - distance[j]);
        x[count] = (1 - share) * corners[i]->X + share * corners[j]->X;
        w[count] = (1 - share) * corners[i]->W + share * corners[j]->W;
        ++count;
      }
    }
  }
  return count == 0 ? Range() : Cover(x, w, count, this->Width);
}

} // namespace reference
} // namespace tetralux
