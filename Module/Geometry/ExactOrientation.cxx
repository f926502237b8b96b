// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/ExactOrientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace tetralux
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

//----------------------------------------------------------------------------
int GetExactOrientation(const double* a, const double* b, const double* c, const double* d)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a[axis] == d[axis] && b[axis] == d[axis] && c[axis] == d[axis])
    {
      return 0; // so are most planes of boxes
    }
  }
  return CGAL::orientation(Kernel::Point_3(a[0], a[1], a[2]), Kernel::Point_3(b[0], b[1], b[2]),
    Kernel::Point_3(c[0], c[1], c[2]), Kernel::Point_3(d[0], d[1], d[2]));
}

//----------------------------------------------------------------------------
int GetExactOrientation(double ax, double ay, double bx, double by, double cx, double cy)
{
  return CGAL::orientation(
    Kernel::Point_2(ax, ay), Kernel::Point_2(bx, by), Kernel::Point_2(cx, cy));
}

//----------------------------------------------------------------------------
int GetExactDirectionTurn(
  const double* a, const double* b, const double* c, const double* direction)
{
  // In views along an axis most faces that are seen edge-on share a coordinate.
  for (int axis = 0; axis < 3; ++axis)
  {
    if (direction[axis] == 0 && a[axis] == b[axis] && a[axis] == c[axis])
    {
      return 0;
    }
  }
  using Number = Kernel::Exact_kernel_rt::FT;
  Number rows[2][3];
  for (int axis = 0; axis < 3; ++axis)
  {
    rows[0][axis] = Number(b[axis]) - Number(a[axis]);
    rows[1][axis] = Number(c[axis]) - Number(a[axis]);
  }
  return -static_cast<int>(CGAL::sign_of_determinant(rows[0][0], rows[0][1], rows[0][2], rows[1][0],
    rows[1][1], rows[1][2], Number(direction[0]), Number(direction[1]), Number(direction[2])));
}

} // namespace tetralux
