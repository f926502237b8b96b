// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScreenFrame_h
#define tetralux_ScreenFrame_h

#include "RayGrid.h"
#include "Span.h"
#include "TetraluxCoreModule.h"

#include <cstdint>

namespace tetralux
{

/// A point of a mesh as the camera sees it, and its scalar.
struct ScreenPoint
{
  /// In pixels, the centre of pixel (i, j) at (i, j). Behind ScreenFrame::SmallestDepth there is no
  /// such place: there these are the homogeneous coordinates, pixels times Depth.
  double X, Y;
  double Depth;  ///< along the ray, in units of ScreenFrame::DepthUnit
  double Scalar; ///< as mapped
};

/// Where the rays of a grid see the points of a mesh (Kraus et al. 2004, section 2.1). Any point is
/// Origin(x, y) + t Direction(x, y) for one t, its depth, and one place (x, y) of the picture; x t,
/// y t and t (in a parallel projection x, y and t) are affine functions of the point.
///
/// All is computed in double precision and relative to the centre of the mesh.
class TETRALUXCORE_EXPORT ScreenFrame
{
public:
  /// center, radius: a ball around the mesh, in its coordinates. Throws std::invalid_argument where
  /// the rays do not reach all of space.
  ScreenFrame(const RayGrid& grid, const double center[3], double radius);

  bool IsPerspective() const { return this->Perspective; }

  /// World lengths of depths: t is Depth times this, and a distance t times the length of the ray's
  /// Direction.
  double GetDepthUnit() const { return this->DepthUnit; }

  /// In a perspective, points in front of it count as if they were behind the eye: closer to it than
  /// any near plane that makes sense.
  static constexpr double SmallestDepth = 1. / (1 << 30);

  bool IsInFront(const ScreenPoint& point) const
  {
    return !this->Perspective || point.Depth > SmallestDepth;
  }

  /// scalar: as mapped.
  ScreenPoint Project(const double point[3], double scalar) const;

  /// points: three coordinates each. scalars: one for each point, x = (s - offset) / scale; empty:
  /// 0. Parallel.
  void Project(Span<const double> points, Span<const double> scalars, double offset, double scale,
    Span<ScreenPoint> result) const;

private:
  bool Perspective = true;
  double Center[3];
  double Rows[3][4]; ///< of x t, y t and t / DepthUnit, for points relative to Center
  double DepthUnit = 1;
};

} // namespace tetralux

#endif
