// SPDX-License-Identifier: BSD-3-Clause
#include "ExactOrientation.h"

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

} // namespace tetralux
