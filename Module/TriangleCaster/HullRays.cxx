// SPDX-License-Identifier: BSD-3-Clause
// The depths of hulls on the rays of a picture.

#include "TriangleCaster/HullFrame.h"

namespace tetralux
{
namespace
{

/// Rays meet faces that they miss by this, cells: none slips through between two faces.
constexpr double EdgeSlack = 1. / (1 << 30);

/// Depths of the face on the rays of pixels.
void AddRays(const HullFrame& frame, const VisibleHull& hull, const HullFace& face,
  const PlacedFace& placed, HullDepths& depths)
{
  const int normal = face.Low[0] == face.High[0] ? 0 : face.Low[1] == face.High[1] ? 1 : 2;
  const int others[2] = { (normal + 1) % 3, (normal + 2) % 3 };
  const auto [x0, x1] =
    ClampPixels(std::ceil(placed.Box.X0), std::floor(placed.Box.X1), frame.Grid.Width);
  const auto [y0, y1] =
    ClampPixels(std::ceil(placed.Box.Y0), std::floor(placed.Box.Y1), frame.Grid.Height);
  const int size = depths.Tiles.Size;
  for (int y = y0; y < y1; ++y)
  {
    for (int x = x0; x < x1; ++x)
    {
      double origin[3], direction[3];
      frame.GetRay(x, y, origin, direction);
      const double t = (face.Low[normal] - origin[normal]) / direction[normal];
      // A ray within the face's plane has no t that is finite; its hull's other faces bound it.
      bool met = t >= 0 && std::isfinite(t);
      for (const int a : others)
      {
        const double place = origin[a] + t * direction[a];
        met = met && place >= face.Low[a] - EdgeSlack && place <= face.High[a] + EdgeSlack;
      }
      if (met)
      {
        const double depth =
          t * frame.Planes.GetDepthOfDirection(frame.GetWorldDirection(x, y).data());
        const bool inside = Overlaps(origin, origin, hull);
        const int tile = y / size * depths.Tiles.GetColumns() + x / size;
        depths.Triangles[2 * tile + GetTriangleOfPixel(x % size, y % size)].Add(
          inside ? 0 : depth, depth);
      }
    }
  }
}

} // namespace

HullDepths FindDepthsOfRays(Span<const VisibleHull> hulls, const RayGrid& grid,
  const SlicePlanes& planes, int tileSize, int threads)
{
  const HullFrame frame(grid, planes);
  HullDepths depths = MakeEmpty(grid, tileSize);
  for (const VisibleHull& hull : hulls)
  {
    AddFaces(frame, hull, threads, depths,
      [&](const HullFace& face, const PlacedFace& placed, HullDepths& own)
      { AddRays(frame, hull, face, placed, own); });
  }
  return depths;
}

} // namespace tetralux
