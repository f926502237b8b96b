// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/CellProjection.h"

#include "Projection/CellProjector.h"

namespace tetralux
{

int ProjectCell(const ScreenFrame& frame, const ProjectionSettings& settings, const ScreenPoint& a,
  const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d, ProjectedCell& result)
{
  const ScreenPoint* const points[4] = { &a, &b, &c, &d };
  return CellProjector(frame, settings).Project(points, result);
}

int ProjectCell(const ScreenFrame& frame, const ProjectionSettings& settings, const ScreenPoint& a,
  const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d, ProjectedCell& result,
  const double gradients[4][3], ProjectedGradient& gradient)
{
  const ScreenPoint* const points[4] = { &a, &b, &c, &d };
  CellProjector projector(frame, settings);
  const int corners = projector.Project(points, result);
  if (corners > 0)
  {
    gradient = projector.Project(gradients);
  }
  return corners;
}

} // namespace tetralux
