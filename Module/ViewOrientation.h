// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ViewOrientation_h
#define tetralux_ViewOrientation_h

#include "ExactOrientation.h"
#include "VisibilityView.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetralux
{

/// How triangles are turned towards a viewer, with exact signs.
class ViewOrientation
{
public:
  explicit ViewOrientation(const VisibilityView& view)
    : Parallel(view.Parallel)
  {
    // No products of a long direction overflow; halving and doubling lose nothing.
    int exponent = 0;
    if (this->Parallel)
    {
      std::frexp(std::max({ std::abs(view.Direction[0]), std::abs(view.Direction[1]),
                   std::abs(view.Direction[2]) }),
        &exponent);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Vector[axis] =
        this->Parallel ? std::ldexp(view.Direction[axis], -exponent) : view.Eye[axis];
    }
  }

  /// 1 where a, b, c run counter-clockwise as the viewer sees them, -1 where clockwise, 0 where they
  /// are seen edge-on or are collinear.
  int GetTurn(const double* a, const double* b, const double* c) const
  {
    return this->Parallel ? GetDirectionTurn(a, b, c, this->Vector)
                          : GetOrientation(a, b, c, this->Vector);
  }

  /// The turns of a cell's faces; face i has the points other than i, in their order.
  void GetFaceTurns(const std::array<const double*, 4>& points, std::array<int, 4>& turns) const
  {
    if (!this->Parallel && this->GetClearFaceTurns(points, turns))
    {
      return;
    }
    for (int face = 0; face < 4; ++face)
    {
      turns[face] = this->GetTurn(
        points[face == 0 ? 1 : 0], points[face <= 1 ? 2 : 1], points[face == 3 ? 2 : 3]);
    }
  }

private:
  /// All four in a perspective view from two cross products, false where rounding leaves one open.
  bool GetClearFaceTurns(
    const std::array<const double*, 4>& points, std::array<int, 4>& turns) const
  {
    double relative[4][3];
    for (int point = 0; point < 4; ++point)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        relative[point][axis] = points[point][axis] - this->Vector[axis];
      }
    }
    double cross01[3], cross23[3], sum01[3], sum23[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int next = axis == 2 ? 0 : axis + 1;
      const int last = axis == 0 ? 2 : axis - 1;
      const double left01 = relative[0][next] * relative[1][last];
      const double right01 = relative[0][last] * relative[1][next];
      const double left23 = relative[2][next] * relative[3][last];
      const double right23 = relative[2][last] * relative[3][next];
      cross01[axis] = left01 - right01;
      sum01[axis] = std::abs(left01) + std::abs(right01);
      cross23[axis] = left23 - right23;
      sum23[axis] = std::abs(left23) + std::abs(right23);
    }
    // The opposite of the determinant has the sign of the turn, see GetOrientation; the bound is the
    // one there.
    constexpr double epsilon = 1.1102230246251565e-16;
    constexpr double errorBound = (7 + 56 * epsilon) * epsilon;
    bool clear = true;
    for (int face = 0; face < 4; ++face)
    {
      const double* cross = face < 2 ? cross23 : cross01;
      const double* sum = face < 2 ? sum23 : sum01;
      const double* third = relative[face ^ 1];
      const double determinant = cross[0] * third[0] + cross[1] * third[1] + cross[2] * third[2];
      const double permanent =
        sum[0] * std::abs(third[0]) + sum[1] * std::abs(third[1]) + sum[2] * std::abs(third[2]);
      clear = clear && std::abs(determinant) > errorBound * permanent + SmallestSafeVolume &&
        permanent <= 1e300;
      turns[face] = determinant < 0 ? 1 : -1;
    }
    return clear;
  }

  bool Parallel;
  double Vector[3]; ///< the eye, or the direction of the view with a largest component of 0.5 to 1
};

} // namespace tetralux

#endif
