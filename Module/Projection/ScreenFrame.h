// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScreenFrame_h
#define tetralux_ScreenFrame_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "View/RayGrid.h"

#include <array>
#include <cstdint>
#include <vector>

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

/// A plane as a fragment sees it: at dx, dy pixels from ScreenFrame::GetMiddle, a ray is on the
/// positive side where Constant + X dx + Y dy + Z z >= 0, with z = 1 / depth, or -depth in a
/// parallel projection.
struct ScreenPlane
{
  float X, Y, Constant, Z;
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

  /// In a perspective, points in front of it count as if they were behind the eye: closer to it
  /// than any near plane that makes sense.
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

  /// The middle of the picture, pixels.
  const double* GetMiddle() const { return this->Middle; }

  /// A world half-space, (a, b, c, d) as in RayLimits.
  ScreenPlane ProjectPlane(const std::array<double, 4>& plane) const;

  /// Depth of a point in homogeneous world coordinates relative to a position: the first over the
  /// second of the result, which are linear in the point.
  std::array<double, 2> ProjectDepth(const double position[3], const double point[4]) const;

  /// Which of some planes cut the mesh, so that rays have to be limited by them.
  struct Limits
  {
    std::vector<ScreenPlane> Planes;

    /// For each cell 1 where some of it may be kept by all planes, else 0; empty where all may be.
    std::vector<std::uint8_t> Cells;
  };

  /// planes: as in RayLimits. points: those of the mesh, projected. cells: four point ids each.
  /// candidates: one flag a cell; empty: all cells. Limits::Cells has only candidates. Parallel.
  Limits FindLimits(Span<const std::array<double, 4>> planes, Span<const ScreenPoint> points,
    Span<const std::int32_t> cells, Span<const std::uint8_t> candidates) const;

private:
  /// A plane in the coordinates of Rows: normal . (x t, y t, t) + offset.
  struct FramePlane
  {
    double Normal[3];
    double Offset;
  };
  FramePlane ToFrame(const std::array<double, 4>& plane) const;
  bool IsOutside(const FramePlane& plane, const ScreenPoint& point) const;

  bool Perspective = true;
  double Middle[2];
  double Steps[2][3];  ///< in the world: for a pixel along x and y,
  double Direction[3]; ///< along a ray,
  double Origin[3];    ///< from here, at pixel 0, 0
  double Center[3];
  double WorldDepth[4]; ///< t / DepthUnit of world coordinates
  double Rows[3][4];    ///< of x t, y t and t / DepthUnit, for points relative to Center
  double DepthUnit = 1;
};

} // namespace tetralux

#endif
