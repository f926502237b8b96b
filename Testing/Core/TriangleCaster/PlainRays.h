// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PlainRays_h
#define tetralux_PlainRays_h

#include "TriangleCaster/ImageCasterOptions.h"
#include "TriangleCaster/SlicePlanes.h"
#include "View/RayGrid.h"

#include <array>
#include <vector>

namespace tetralux
{

// What the tests' plain loops share: rays, slabs, places in cells and light, in double precision.

using PlainVector = std::array<double, 3>;

inline double Dot(const PlainVector& a, const PlainVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Of length 1; 0 remains 0.
PlainVector Normalize(const PlainVector& v);

struct PlainRay
{
  PlainVector Start, Direction;           ///< in the world, of length 1
  PlainVector IndexStart, IndexDirection; ///< in the volume
  double DepthOfDirection;

  PlainVector GetPoint(double t) const { return Find(this->Start, this->Direction, t); }
  PlainVector GetIndex(double t) const { return Find(this->IndexStart, this->IndexDirection, t); }

private:
  static PlainVector Find(const PlainVector& start, const PlainVector& direction, double t)
  {
    return { start[0] + t * direction[0], start[1] + t * direction[1],
      start[2] + t * direction[2] };
  }
};

/// Where the ray of a pixel goes.
PlainRay MakePlainRay(const RayGrid& grid, const SlicePlanes& slices, int i, int j);

/// A stretch of a ray within one slab: world distances.
struct PlainSlab
{
  double Begin, End;
  double GetMiddle() const { return 0.5 * (this->Begin + this->End); }
  double GetLength() const { return this->End - this->Begin; }
};

/// The stretches of a ray in a volume.
std::vector<PlainSlab> FindPlainSlabs(
  const std::array<int, 3>& dimensions, const SlicePlanes& slices, const PlainRay& ray);

/// A place in a volume: a cell, and where in it.
struct PlainPlace
{
  std::array<int, 3> Cell;
  PlainVector Share;

  PlainPlace(const std::array<int, 3>& dimensions, const PlainVector& index);

  /// Interpolates what points have trilinearly.
  template <class OfPoint>
  double Interpolate(const OfPoint& ofPoint) const
  {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      std::array<int, 3> point = this->Cell;
      double weight = 1;
      for (int a = 0; a < 3; ++a)
      {
        const bool upper = (corner >> a & 1) != 0;
        point[a] += upper ? 1 : 0;
        weight *= upper ? this->Share[a] : 1 - this->Share[a];
      }
      sum += weight * ofPoint(point);
    }
    return sum;
  }

  /// The gradient of what points have, for a step to the next point: central differences,
  /// one-sided at the border, interpolated.
  template <class OfPoint>
  PlainVector FindGradient(const std::array<int, 3>& dimensions, const OfPoint& ofPoint) const
  {
    PlainVector gradient;
    for (int a = 0; a < 3; ++a)
    {
      gradient[a] = this->Interpolate(
        [&](std::array<int, 3> point)
        {
          std::array<int, 3> before = point;
          before[a] = before[a] > 0 ? before[a] - 1 : 0;
          point[a] = point[a] + 1 < dimensions[a] ? point[a] + 1 : point[a];
          return (ofPoint(point) - ofPoint(before)) / (point[a] - before[a]);
        });
    }
    return gradient;
  }
};

/// A gradient of the world, of one for steps to the next points.
PlainVector ToWorld(const RayGrid& grid, const PlainVector& gradient);

/// The light on a colour, by a normal of any length and side. point: in the world. view: from the
/// viewer, of length 1.
PlainVector Shine(const std::vector<Light>& lights, const Material& surface,
  const PlainVector& color, const PlainVector& normal, const PlainVector& point,
  const PlainVector& view);

} // namespace tetralux

#endif
