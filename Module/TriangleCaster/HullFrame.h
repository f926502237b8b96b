// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HullFrame_h
#define tetralux_HullFrame_h

// Where a picture shows the faces of hulls: what both ways to find their depths share.

#include "TriangleCaster/HullDepths.h"
#include "TriangleCaster/SlicePlanes.h"
#include "TriangleCaster/VisibleHull.h"
#include "View/RayGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetralux
{

/// Places of projected points are widened by this, pixels: far more than they are rounded by, and
/// far less than a pixel.
constexpr double PixelSlack = 1. / (1 << 20);

inline double DotProduct(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A point of the volume is Origin + X Axes[0] + Y Axes[1] + T Axes[2]. In a parallel projection it
/// is seen at pixel (X, Y), else at (X / T, Y / T), where T is above 0.
struct FramePoint
{
  double X, Y, T;
};

struct PixelBox
{
  double X0 = std::numeric_limits<double>::infinity();
  double Y0 = std::numeric_limits<double>::infinity();
  double X1 = -std::numeric_limits<double>::infinity();
  double Y1 = -std::numeric_limits<double>::infinity();

  void Add(double x, double y)
  {
    this->X0 = std::min(this->X0, x);
    this->Y0 = std::min(this->Y0, y);
    this->X1 = std::max(this->X1, x);
    this->Y1 = std::max(this->Y1, y);
  }
};

/// Where a picture's rays see the points of a volume, and how deep.
class HullFrame
{
public:
  /// Throws std::invalid_argument, with one line, if the rays share neither origin nor direction,
  /// or lie in a plane.
  HullFrame(const RayGrid& grid, const SlicePlanes& planes);

  FramePoint Place(const double point[3]) const
  {
    const double d[3] = { point[0] - this->Origin[0], point[1] - this->Origin[1],
      point[2] - this->Origin[2] };
    return { DotProduct(this->Rows[0], d), DotProduct(this->Rows[1], d),
      DotProduct(this->Rows[2], d) };
  }

  /// The start and the direction, in the volume, of the ray of a pixel.
  void GetRay(double x, double y, double origin[3], double direction[3]) const
  {
    for (int a = 0; a < 3; ++a)
    {
      const double step = x * this->Axes[0][a] + y * this->Axes[1][a];
      origin[a] = this->Origin[a] + (this->Parallel ? step : 0);
      direction[a] = this->Axes[2][a] + (this->Parallel ? 0 : step);
    }
  }

  /// The world direction of the ray of a pixel.
  std::array<double, 3> GetWorldDirection(double x, double y) const
  {
    std::array<double, 3> direction{};
    for (int a = 0; a < 3; ++a)
    {
      direction[a] = this->WorldAxes[2][a] +
        (this->Parallel ? 0 : x * this->WorldAxes[0][a] + y * this->WorldAxes[1][a]);
    }
    return direction;
  }

  double GetDepth(const FramePoint& p) const
  {
    if (this->Planes.Shape == SliceShape::Planes)
    {
      return p.T * this->DepthOfT;
    }
    const std::array<double, 3> v = this->GetWorldVector(p);
    return std::hypot(v[0], v[1], v[2]);
  }

  /// A bound of the depths of a convex shape is the smallest of its corners. Shells are bounded by
  /// the plane that touches them where the direction, of length 1, meets them.
  double GetDepthBound(const FramePoint& p, const std::array<double, 3>& direction) const
  {
    return this->Planes.Shape == SliceShape::Planes
      ? p.T * this->DepthOfT
      : DotProduct(this->GetWorldVector(p).data(), direction.data());
  }

  /// Towards the middle of a tile, of length 1. Planes have no use for it.
  std::array<double, 3> GetBoundDirection(const Tile& tile) const
  {
    if (this->Planes.Shape == SliceShape::Planes)
    {
      return {};
    }
    std::array<double, 3> direction =
      this->GetWorldDirection(0.5 * (tile.X0 + tile.X1 - 1), 0.5 * (tile.Y0 + tile.Y1 - 1));
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (double& d : direction)
    {
      d /= length;
    }
    return direction;
  }

  const RayGrid& Grid;
  const SlicePlanes& Planes;
  bool Parallel = false;

private:
  std::array<double, 3> GetWorldVector(const FramePoint& p) const
  {
    std::array<double, 3> v{};
    for (int a = 0; a < 3; ++a)
    {
      v[a] =
        p.X * this->WorldAxes[0][a] + p.Y * this->WorldAxes[1][a] + p.T * this->WorldAxes[2][a];
    }
    return v;
  }

  double Axes[3][3];
  double WorldAxes[3][3];
  double Origin[3];
  double Rows[3][3]; ///< of X, Y and T
  double DepthOfT;
};

/// A face as the picture shows it.
struct PlacedFace
{
  std::array<FramePoint, 4> Corners;
  PixelBox Box;        ///< where it is, or all of the picture
  bool InFront = true; ///< as a whole
};

/// Places a face. Points of a perspective in front of smallestT have no place.
PlacedFace PlaceFace(const HullFrame& frame, const HullFace& face, double smallestT);

/// Whether all of a face is behind the camera.
bool IsBehind(const PlacedFace& face);

/// The depth in front of which points of a perspective have no place.
double FindSmallestT(const HullFrame& frame, const VisibleHull& hull);

/// Pixels with a coordinate from low to high, 0 to count - 1: the first one and the one behind the
/// last.
std::array<int, 2> ClampPixels(double low, double high, int count);

/// Whether boxes overlap; low and high include the edge.
bool Overlaps(const double (&low)[3], const double (&high)[3], const VisibleHull& hull);

/// Depths of nothing, in tiles of a picture.
HullDepths MakeEmpty(const RayGrid& grid, int tileSize);

/// Calls add(face, placed, depths) for each face that is not behind the camera. Threads share the
/// faces; the smallest and largest depths are the same in any order.
template <class AddT>
void AddFaces(
  const HullFrame& frame, const VisibleHull& hull, int threads, HullDepths& depths, const AddT& add)
{
  const double smallestT = FindSmallestT(frame, hull);
  const auto count = static_cast<std::int64_t>(hull.Faces.size());
#pragma omp parallel num_threads(threads)
  {
    HullDepths own = MakeEmpty(frame.Grid, depths.Tiles.Size);
#pragma omp for schedule(static) nowait
    for (std::int64_t f = 0; f < count; ++f)
    {
      const PlacedFace placed = PlaceFace(frame, hull.Faces[f], smallestT);
      if (!IsBehind(placed))
      {
        add(hull.Faces[f], placed, own);
      }
    }
#pragma omp critical(tetralux_hull_depths)
    for (std::size_t i = 0; i < own.Triangles.size(); ++i)
    {
      depths.Triangles[i].Add(own.Triangles[i].Front, own.Triangles[i].Back);
    }
  }
}

} // namespace tetralux

#endif
