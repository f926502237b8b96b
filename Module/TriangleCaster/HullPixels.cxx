// SPDX-License-Identifier: BSD-3-Clause
// Bounds of the depths of hulls in the squares of a picture's pixels.

#include "TriangleCaster/HullFrame.h"

namespace tetralux
{
namespace
{

/// Depths are widened by this part of the farthest: more than they are rounded by, less than slabs
/// in single precision can tell apart.
constexpr double DepthSlack = 1. / (1 << 28);

/// Faces that fit in a square of this many pixels are not cut at the edges of S-triangles.
constexpr double SmallFace = 1;

/// X x + Y y + T t + Constant >= 0 is kept.
struct HalfSpace
{
  double X, Y, T, Constant;

  double Evaluate(const FramePoint& p) const
  {
    return this->X * p.X + this->Y * p.Y + this->T * p.T + this->Constant;
  }
};

/// The half-space that is seen where x px + y py + c >= 0 for the pixel (px, py).
HalfSpace MakeHalfSpace(const HullFrame& frame, double x, double y, double c)
{
  return frame.Parallel ? HalfSpace{ x, y, 0, c } : HalfSpace{ x, y, c, 0 };
}

/// Whether rays of some pixels start within the box around a hull.
bool StartsInside(
  const HullFrame& frame, const VisibleHull& hull, double x0, double y0, double x1, double y1)
{
  double low[3], high[3];
  for (int corner = 0; corner < 4; ++corner)
  {
    double origin[3], direction[3];
    frame.GetRay((corner & 1) != 0 ? x1 : x0, (corner & 2) != 0 ? y1 : y0, origin, direction);
    for (int a = 0; a < 3; ++a)
    {
      low[a] = corner == 0 ? origin[a] : std::min(low[a], origin[a]);
      high[a] = corner == 0 ? origin[a] : std::max(high[a], origin[a]);
    }
  }
  return Overlaps(low, high, hull);
}

/// A convex polygon. Each of six half-spaces adds one corner to the four of a face; where rounding
/// makes edges of almost no length concave, half as many as there are.
struct Polygon
{
  std::array<FramePoint, 48> Corners;
  int Count = 0;
};

Polygon Cut(const Polygon& polygon, const HalfSpace& kept)
{
  Polygon result;
  for (int c = 0; c < polygon.Count; ++c)
  {
    const FramePoint& p = polygon.Corners[c];
    const FramePoint& q = polygon.Corners[(c + 1) % polygon.Count];
    const double atP = kept.Evaluate(p);
    const double atQ = kept.Evaluate(q);
    if (atP >= 0)
    {
      result.Corners[result.Count++] = p;
    }
    if ((atP < 0) != (atQ < 0))
    {
      const double u = atP / (atP - atQ);
      result.Corners[result.Count++] = { p.X + u * (q.X - p.X), p.Y + u * (q.Y - p.Y),
        p.T + u * (q.T - p.T) };
    }
  }
  return result;
}

/// The edges of the squares of an S-triangle's pixels, each moved outwards by the slack.
struct TriangleEdges
{
  PixelBox Box;
  double Side;   ///< 1: below the diagonal, -1: above it
  double Offset; ///< Side (x - y) + Offset >= 0 is kept

  TriangleEdges(const Tile& tile, int half)
    : Side(half == 0 ? 1 : -1)
  {
    const double x = tile.X0 - 0.5 - PixelSlack;
    const double y = tile.Y0 - 0.5 - PixelSlack;
    this->Box = { x, y, tile.X1 - 0.5 + PixelSlack, tile.Y1 - 0.5 + PixelSlack };
    // Squares on the diagonal reach 1 beyond it.
    this->Offset = this->Side * (tile.Y0 - tile.X0) + (half == 0 ? 1 : 0) + 2 * PixelSlack;
  }

  bool Contains(const PixelBox& box) const
  {
    return box.X0 >= this->Box.X0 && box.X1 <= this->Box.X1 && box.Y0 >= this->Box.Y0 &&
      box.Y1 <= this->Box.Y1 &&
      (this->Side > 0 ? box.X0 - box.Y1 : box.Y0 - box.X1) + this->Offset >= 0;
  }

  bool Overlaps(const PixelBox& box) const
  {
    return box.X1 >= this->Box.X0 && box.X0 <= this->Box.X1 && box.Y1 >= this->Box.Y0 &&
      box.Y0 <= this->Box.Y1 &&
      (this->Side > 0 ? box.X1 - box.Y0 : box.Y1 - box.X0) + this->Offset >= 0;
  }
};

Polygon CutToTriangle(const HullFrame& frame, const PlacedFace& placed, const TriangleEdges& edges)
{
  Polygon polygon;
  std::copy(placed.Corners.begin(), placed.Corners.end(), polygon.Corners.begin());
  polygon.Count = static_cast<int>(placed.Corners.size());
  const HalfSpace kept[6] = { { 0, 0, 1, 0 }, MakeHalfSpace(frame, 1, 0, -edges.Box.X0),
    MakeHalfSpace(frame, -1, 0, edges.Box.X1), MakeHalfSpace(frame, 0, 1, -edges.Box.Y0),
    MakeHalfSpace(frame, 0, -1, edges.Box.Y1),
    MakeHalfSpace(frame, edges.Side, -edges.Side, edges.Offset) };
  for (const HalfSpace& halfSpace : kept)
  {
    polygon = Cut(polygon, halfSpace);
  }
  return polygon;
}

/// Adds bounds of the depths of a convex polygon. direction: as of GetDepthBound.
void AddDepths(const HullFrame& frame, const FramePoint* points, int count,
  const std::array<double, 3>& direction, DepthRange& range)
{
  for (int p = 0; p < count; ++p)
  {
    const double depth = frame.GetDepth(points[p]);
    const double slack = DepthSlack * depth;
    range.Add(std::max(frame.GetDepthBound(points[p], direction) - slack, 0.), depth + slack);
  }
}

/// Bounds of the depths of the face in the squares of pixels.
void AddPixels(const HullFrame& frame, const PlacedFace& placed, HullDepths& depths)
{
  const TileGrid& tiles = depths.Tiles;
  const PixelBox& box = placed.Box;
  const bool small = placed.InFront && box.X1 - box.X0 <= SmallFace && box.Y1 - box.Y0 <= SmallFace;
  const auto [x0, x1] =
    ClampPixels(std::floor(box.X0 + 0.5), std::floor(box.X1 + 0.5), frame.Grid.Width);
  const auto [y0, y1] =
    ClampPixels(std::floor(box.Y0 + 0.5), std::floor(box.Y1 + 0.5), frame.Grid.Height);
  if (x0 >= x1 || y0 >= y1)
  {
    return;
  }
  for (int row = y0 / tiles.Size; row <= (y1 - 1) / tiles.Size; ++row)
  {
    for (int column = x0 / tiles.Size; column <= (x1 - 1) / tiles.Size; ++column)
    {
      const int index = row * tiles.GetColumns() + column;
      const Tile tile = tiles.GetTile(index);
      const std::array<double, 3> direction = frame.GetBoundDirection(tile);
      for (int half = 0; half < 2; ++half)
      {
        const TriangleEdges edges(tile, half);
        DepthRange& range = depths.Triangles[2 * index + half];
        if (placed.InFront && !edges.Overlaps(box))
        {
          continue;
        }
        if (placed.InFront && (small || edges.Contains(box)))
        {
          AddDepths(frame, placed.Corners.data(), static_cast<int>(placed.Corners.size()),
            direction, range);
        }
        else
        {
          const Polygon cut = CutToTriangle(frame, placed, edges);
          AddDepths(frame, cut.Corners.data(), cut.Count, direction, range);
        }
      }
    }
  }
}

} // namespace

HullDepths FindDepthsOfPixels(Span<const VisibleHull> hulls, const RayGrid& grid,
  const SlicePlanes& planes, int tileSize, int threads)
{
  const HullFrame frame(grid, planes);
  HullDepths depths = MakeEmpty(grid, tileSize);
  for (const VisibleHull& hull : hulls)
  {
    AddFaces(frame, hull, threads, depths,
      [&](const HullFace&, const PlacedFace& placed, HullDepths& own)
      { AddPixels(frame, placed, own); });
    for (std::size_t i = 0; i < depths.Triangles.size(); ++i)
    {
      const Tile tile = depths.Tiles.GetTile(static_cast<int>(i / 2));
      DepthRange& range = depths.Triangles[i];
      if (!range.IsEmpty() &&
        StartsInside(frame, hull, tile.X0 - 0.5, tile.Y0 - 0.5, tile.X1 - 0.5, tile.Y1 - 0.5))
      {
        range.Front = 0;
      }
    }
  }
  return depths;
}

} // namespace tetralux
