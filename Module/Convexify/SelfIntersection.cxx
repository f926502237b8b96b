// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/BoundarySurface.h"

#include "Geometry/SimplexIntersection.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <tuple>

namespace tetralux
{

//----------------------------------------------------------------------------
Obstacle FindSelfIntersection(const BoundarySurface& surface)
{
  using Box = CGAL::Box_intersection_d::Box_d<double, 3>;
  const ExactPoints points(surface.Coordinates.data());
  std::vector<Box> boxes;
  boxes.reserve(surface.Triangles.size());
  for (const Triangle& triangle : surface.Triangles)
  {
    double low[3], high[3];
    for (int a = 0; a < 3; ++a)
    {
      std::tie(low[a], high[a]) =
        std::minmax({ points[triangle[0]][a], points[triangle[1]][a], points[triangle[2]][a] });
    }
    boxes.emplace_back(low, high);
  }
  const std::size_t firstId = boxes.empty() ? 0 : boxes[0].id();

  Obstacle obstacle;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
    [&](const Box& box0, const Box& box1)
    {
      const std::size_t t0 = box0.id() - firstId;
      const std::size_t t1 = box1.id() - firstId;
      const Triangle& triangle0 = surface.Triangles[t0];
      const Triangle& triangle1 = surface.Triangles[t1];
      if (!obstacle.Reason.empty() ||
        (!std::is_permutation(triangle0.begin(), triangle0.end(), triangle1.begin()) &&
          TrianglesMeetProperly(points, triangle0.data(), triangle1.data())))
      {
        return;
      }
      obstacle.Reason = "the boundary intersects itself";
      obstacle.Cells = { surface.Faces[t0] / 4, surface.Faces[t1] / 4 };
      // Between the middles of the two boxes' common part: near to where they meet.
      for (int a = 0; a < 3; ++a)
      {
        const double low = std::max(box0.min_coord(a), box1.min_coord(a));
        const double high = std::min(box0.max_coord(a), box1.max_coord(a));
        obstacle.Point[a] = low + 0.5 * (high - low);
      }
    });
  return obstacle;
}

} // namespace tetralux
