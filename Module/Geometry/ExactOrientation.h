// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ExactOrientation_h
#define tetralux_ExactOrientation_h

#include <cmath>
#include <cstdint>

namespace tetralux
{

/// The signs of the three determinants, exact for any finite coordinates: by CGAL, where rounding
/// leaves them open.
int GetExactOrientation(const double* a, const double* b, const double* c, const double* d);
int GetExactOrientation(double ax, double ay, double bx, double by, double cx, double cy);
int GetExactDirectionTurn(
  const double* a, const double* b, const double* c, const double* direction);

/// Above these nothing that matters was lost to underflow.
constexpr double SmallestSafeVolume = 1e-270;
constexpr double SmallestSafeArea = 1e-290;

/// 1 where a, b, c, d have positive volume in VTK's order of a tetrahedron's points, -1 where
/// negative, 0 where they are coplanar.
inline int GetOrientation(const double* a, const double* b, const double* c, const double* d)
{
  // Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
  // 1997: rounding errors of the determinant in units of its permanent.
  constexpr double epsilon = 1.1102230246251565e-16;
  constexpr double errorBound = (7 + 56 * epsilon) * epsilon;
  const double adx = a[0] - d[0], ady = a[1] - d[1], adz = a[2] - d[2];
  const double bdx = b[0] - d[0], bdy = b[1] - d[1], bdz = b[2] - d[2];
  const double cdx = c[0] - d[0], cdy = c[1] - d[1], cdz = c[2] - d[2];
  const double bdxcdy = bdx * cdy, cdxbdy = cdx * bdy;
  const double cdxady = cdx * ady, adxcdy = adx * cdy;
  const double adxbdy = adx * bdy, bdxady = bdx * ady;
  // Negative where a, b, c, d are positive.
  const double determinant =
    adz * (bdxcdy - cdxbdy) + bdz * (cdxady - adxcdy) + cdz * (adxbdy - bdxady);
  const double permanent = (std::abs(bdxcdy) + std::abs(cdxbdy)) * std::abs(adz) +
    (std::abs(cdxady) + std::abs(adxcdy)) * std::abs(bdz) +
    (std::abs(adxbdy) + std::abs(bdxady)) * std::abs(cdz);
  const double bound = errorBound * permanent + SmallestSafeVolume;
  if (determinant < -bound && permanent <= 1e300)
  {
    return 1;
  }
  if (determinant > bound && permanent <= 1e300)
  {
    return -1;
  }
  return GetExactOrientation(a, b, c, d);
}

/// 1 where a, b, c run counter-clockwise as seen along the direction by a viewer that is far away,
/// -1 where clockwise, 0 where their plane is parallel to it.
inline int GetDirectionTurn(
  const double* a, const double* b, const double* c, const double* direction)
{
  // As above, of the rows b - a, c - a and the direction; that one is not rounded, which leaves
  // less of an error than the bound says.
  constexpr double epsilon = 1.1102230246251565e-16;
  constexpr double errorBound = (7 + 56 * epsilon) * epsilon;
  const double bax = b[0] - a[0], bay = b[1] - a[1], baz = b[2] - a[2];
  const double cax = c[0] - a[0], cay = c[1] - a[1], caz = c[2] - a[2];
  const double baycaz = bay * caz, bazcay = baz * cay;
  const double bazcax = baz * cax, baxcaz = bax * caz;
  const double baxcay = bax * cay, baycax = bay * cax;
  const double determinant = direction[0] * (baycaz - bazcay) + direction[1] * (bazcax - baxcaz) +
    direction[2] * (baxcay - baycax);
  const double permanent = (std::abs(baycaz) + std::abs(bazcay)) * std::abs(direction[0]) +
    (std::abs(bazcax) + std::abs(baxcaz)) * std::abs(direction[1]) +
    (std::abs(baxcay) + std::abs(baycax)) * std::abs(direction[2]);
  const double bound = errorBound * permanent + SmallestSafeVolume;
  if (permanent <= 1e300 && std::abs(determinant) > bound)
  {
    return determinant < 0 ? 1 : -1;
  }
  return GetExactDirectionTurn(a, b, c, direction);
}

/// The points of a triangulation, by their ids.
class ExactPoints
{
public:
  explicit ExactPoints(const double* coordinates)
    : Coordinates(coordinates)
  {
  }

  const double* operator[](std::int32_t id) const
  {
    return this->Coordinates + 3 * static_cast<std::ptrdiff_t>(id);
  }

  /// As GetOrientation; a repeated id costs nothing.
  int Orient(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const
  {
    if (a == b || a == c || a == d || b == c || b == d || c == d)
    {
      return 0;
    }
    return GetOrientation((*this)[a], (*this)[b], (*this)[c], (*this)[d]);
  }

  /// 1 where a, b, c run counterclockwise as seen against the axis that is dropped (0, 1, 2).
  int OrientProjected(std::int32_t a, std::int32_t b, std::int32_t c, int axis) const
  {
    if (a == b || a == c || b == c)
    {
      return 0;
    }
    constexpr double epsilon = 1.1102230246251565e-16;
    constexpr double errorBound = (3 + 16 * epsilon) * epsilon; // Shewchuk 1997
    const int x = axis == 0 ? 1 : 0;
    const int y = axis == 2 ? 1 : 2;
    const double* pa = (*this)[a];
    const double* pb = (*this)[b];
    const double* pc = (*this)[c];
    const double left = (pa[x] - pc[x]) * (pb[y] - pc[y]);
    const double right = (pa[y] - pc[y]) * (pb[x] - pc[x]);
    const double determinant = left - right;
    const double permanent = std::abs(left) + std::abs(right);
    const double bound = errorBound * permanent + SmallestSafeArea;
    if (permanent <= 1e300 && std::abs(determinant) > bound)
    {
      return determinant > 0 ? 1 : -1;
    }
    return GetExactOrientation(pa[x], pa[y], pb[x], pb[y], pc[x], pc[y]);
  }

  /// An axis along which the projection of a, b, c has an area; -1 where they are collinear.
  int FindProjection(std::int32_t a, std::int32_t b, std::int32_t c) const
  {
    const double* pa = (*this)[a];
    const double* pb = (*this)[b];
    const double* pc = (*this)[c];
    double normal[3];
    int best = 0;
    for (int i = 0; i < 3; ++i)
    {
      const int x = (i + 1) % 3;
      const int y = (i + 2) % 3;
      normal[i] = std::abs((pb[x] - pa[x]) * (pc[y] - pa[y]) - (pb[y] - pa[y]) * (pc[x] - pa[x]));
      best = normal[i] > normal[best] ? i : best;
    }
    for (int i = 0; i < 3; ++i)
    {
      const int axis = (best + i) % 3;
      if (this->OrientProjected(a, b, c, axis) != 0)
      {
        return axis;
      }
    }
    return -1;
  }

private:
  const double* Coordinates;
};

} // namespace tetralux

#endif
