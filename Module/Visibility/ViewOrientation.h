// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ViewOrientation_h
#define tetralux_ViewOrientation_h

#include "Geometry/ExactOrientation.h"
#include "Visibility/VisibilityView.h"

#include <algorithm>
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

  /// 1 where a, b, c run counter-clockwise as the viewer sees them, -1 where clockwise, 0 where
  /// they are seen edge-on or are collinear.
  int GetTurn(const double* a, const double* b, const double* c) const
  {
    return this->Parallel ? GetDirectionTurn(a, b, c, this->Vector)
                          : GetOrientation(a, b, c, this->Vector);
  }

  /// Of a parallel view, its largest component of 0.5 to 1.
  const double* GetDirection() const { return this->Vector; }

private:
  bool Parallel;
  double Vector[3]; ///< the eye, or the direction of the view with a largest component of 0.5 to 1
};

} // namespace tetralux

#endif
