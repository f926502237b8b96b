// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/HullDepths.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// Places of projected points are widened by this, pixels: far more than they are rounded by, and
/// far less than a pixel.
constexpr double PixelSlack = 1. / (1 << 20);

/// Depths are widened by this part of the farthest: more than they are rounded by, less than slabs
/// in single precision can tell apart.
constexpr double DepthSlack = 1. / (1 << 28);

/// Rays meet faces that they miss by this, cells: none slips through between two faces.
constexpr double EdgeSlack = 1. / (1 << 30);

/// In a perspective, points in front of this depth, of the farthest corner of the hulls' box, have
/// no place in the picture.
constexpr double SmallestDepth = 1. / (1 << 20);

/// Faces that fit in a square of this many pixels are not cut at the edges of S-triangles.
constexpr double SmallFace = 1;

double Dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void Cross(const double a[3], const double b[3], double result[3])
{
  result[0] = a[1] * b[2] - a[2] * b[1];
  result[1] = a[2] * b[0] - a[0] * b[2];
  result[2] = a[0] * b[1] - a[1] * b[0];
}

/// A point of the volume is Origin + X Axes[0] + Y Axes[1] + T Axes[2]. In a parallel projection it
/// is seen at pixel (X, Y), else at (X / T, Y / T), where T is above 0.
struct FramePoint
{
  double X, Y, T;
};

/// X x + Y y + T t + Constant >= 0 is kept.
struct HalfSpace
{
  double X, Y, T, Constant;

  double Evaluate(const FramePoint& p) const
  {
    return this->X * p.X + this->Y * p.Y + this->T * p.T + this->Constant;
  }
};

struct PixelBox
{
  double X0 = std::numeric_limits<double>::infinity();
  double Y0 = std::numeric_limits<double>::infinity();
  double X1 = -std::numeric_limits<double>::infinity();
  double Y1 = -std::numeric_limits<double>::infinity();

  void Add(double x, double y)
  {
    this->X0 = std::min(this->X0, x);
    this->Y0 = std::min(this->Y0, y);
    this->X1 = std::max(this->X1, x);
    this->Y1 = std::max(this->Y1, y);
  }
};

/// Where a picture's rays see the points of a volume, and how deep.
class Frame
{
public:
  Frame(const RayGrid& grid, const SlicePlanes& planes)
    : Grid(grid)
    , Planes(planes)
  {
    const auto isZero = [](const double(&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
    this->Parallel = isZero(grid.DirectionStepX) && isZero(grid.DirectionStepY);
    if (!this->Parallel && !(isZero(grid.OriginStepX) && isZero(grid.OriginStepY)))
    {
      throw std::invalid_argument("the rays share neither origin nor direction");
    }
    const double* steps[3] = { this->Parallel ? grid.OriginStepX : grid.DirectionStepX,
      this->Parallel ? grid.OriginStepY : grid.DirectionStepY, grid.Direction };
    for (int s = 0; s < 3; ++s)
    {
      for (int a = 0; a < 3; ++a)
      {
        this->WorldAxes[s][a] = steps[s][a];
        this->Axes[s][a] = Dot(grid.MeshFromWorld[a], steps[s]);
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      this->Origin[a] = Dot(grid.MeshFromWorld[a], grid.Origin) + grid.MeshFromWorld[a][3];
    }
    double normal[3];
    Cross(this->Axes[1], this->Axes[2], normal);
    const double determinant = Dot(this->Axes[0], normal);
    if (determinant == 0 || !std::isfinite(determinant))
    {
      throw std::invalid_argument("the rays lie in a plane");
    }
    for (int row = 0; row < 3; ++row)
    {
      Cross(this->Axes[(row + 1) % 3], this->Axes[(row + 2) % 3], this->Rows[row]);
      for (double& element : this->Rows[row])
      {
        element /= determinant;
      }
    }
    this->DepthOfT = planes.GetDepthOfDirection(grid.Direction);
  }

  FramePoint Place(const double point[3]) const
  {
    const double d[3] = { point[0] - this->Origin[0], point[1] - this->Origin[1],
      point[2] - this->Origin[2] };
    return { Dot(this->Rows[0], d), Dot(this->Rows[1], d), Dot(this->Rows[2], d) };
  }

  /// The start and the direction, in the volume, of the ray of a pixel.
  void GetRay(double x, double y, double origin[3], double direction[3]) const
  {
    for (int a = 0; a < 3; ++a)
    {
      const double step = x * this->Axes[0][a] + y * this->Axes[1][a];
      origin[a] = this->Origin[a] + (this->Parallel ? step : 0);
      direction[a] = this->Axes[2][a] + (this->Parallel ? 0 : step);
    }
  }

  /// The world direction of the ray of a pixel.
  std::array<double, 3> GetWorldDirection(double x, double y) const
  {
    std::array<double, 3> direction{};
    for (int a = 0; a < 3; ++a)
    {
      direction[a] = this->WorldAxes[2][a] +
        (this->Parallel ? 0 : x * this->WorldAxes[0][a] + y * this->WorldAxes[1][a]);
    }
    return direction;
  }

  double GetDepth(const FramePoint& p) const
  {
    if (this->Planes.Shape == SliceShape::Planes)
    {
      return p.T * this->DepthOfT;
    }
    const std::array<double, 3> v = this->GetWorldVector(p);
    return std::hypot(v[0], v[1], v[2]);
  }

  /// A bound of the depths of a convex shape is the smallest of its corners. Shells are bounded by
  /// the plane that touches them where the direction, of length 1, meets them.
  double GetDepthBound(const FramePoint& p, const std::array<double, 3>& direction) const
  {
    return this->Planes.Shape == SliceShape::Planes
      ? p.T * this->DepthOfT
      : Dot(this->GetWorldVector(p).data(), direction.data());
  }

  /// Towards the middle of a tile, of length 1. Planes have no use for it.
  std::array<double, 3> GetBoundDirection(const Tile& tile) const
  {
    if (this->Planes.Shape == SliceShape::Planes)
    {
      return {};
    }
    std::array<double, 3> direction =
      this->GetWorldDirection(0.5 * (tile.X0 + tile.X1 - 1), 0.5 * (tile.Y0 + tile.Y1 - 1));
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (double& d : direction)
    {
      d /= length;
    }
    return direction;
  }

  /// The half-space that is seen where x px + y py + c >= 0 for the pixel (px, py).
  HalfSpace MakeHalfSpace(double x, double y, double c) const
  {
    return this->Parallel ? HalfSpace{ x, y, 0, c } : HalfSpace{ x, y, c, 0 };
  }

  const RayGrid& Grid;
  const SlicePlanes& Planes;
  bool Parallel = false;

private:
  std::array<double, 3> GetWorldVector(const FramePoint& p) const
  {
    std::array<double, 3> v{};
    for (int a = 0; a < 3; ++a)
    {
      v[a] =
        p.X * this->WorldAxes[0][a] + p.Y * this->WorldAxes[1][a] + p.T * this->WorldAxes[2][a];
    }
    return v;
  }

  double Axes[3][3];
  double WorldAxes[3][3];
  double Origin[3];
  double Rows[3][3]; ///< of X, Y and T
  double DepthOfT;
};

/// A face's corners, in turn.
std::array<std::array<double, 3>, 4> GetCorners(const HullFace& face)
{
  const int normal = face.Low[0] == face.High[0] ? 0 : face.Low[1] == face.High[1] ? 1 : 2;
  const int u = (normal + 1) % 3;
  const int v = (normal + 2) % 3;
  std::array<std::array<double, 3>, 4> corners;
  for (int c = 0; c < 4; ++c)
  {
    corners[c][normal] = face.Low[normal];
    corners[c][u] = c == 1 || c == 2 ? face.High[u] : face.Low[u];
    corners[c][v] = c >= 2 ? face.High[v] : face.Low[v];
  }
  return corners;
}

/// The depth in front of which points of a perspective have no place.
double FindSmallestT(const Frame& frame, const VisibleHull& hull)
{
  double farthest = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[3];
    for (int a = 0; a < 3; ++a)
    {
      point[a] = (corner >> a & 1) != 0 ? hull.High[a] : hull.Low[a];
    }
    farthest = std::max(farthest, frame.Place(point).T);
  }
  return frame.Parallel ? -std::numeric_limits<double>::infinity() : SmallestDepth * farthest;
}

/// A face as the picture shows it.
struct PlacedFace
{
  std::array<FramePoint, 4> Corners;
  PixelBox Box;        ///< where it is, or all of the picture
  bool InFront = true; ///< as a whole
};

PlacedFace PlaceFace(const Frame& frame, const HullFace& face, double smallestT)
{
  PlacedFace placed;
  const std::array<std::array<double, 3>, 4> corners = GetCorners(face);
  for (int c = 0; c < 4; ++c)
  {
    const FramePoint p = frame.Place(corners[c].data());
    placed.Corners[c] = p;
    placed.InFront = placed.InFront && p.T > std::max(smallestT, 0.);
    if (placed.InFront)
    {
      const double factor = frame.Parallel ? 1 : 1 / p.T;
      placed.Box.Add(p.X * factor, p.Y * factor);
    }
  }
  if (!placed.InFront)
  {
    placed.Box = { 0, 0, static_cast<double>(frame.Grid.Width),
      static_cast<double>(frame.Grid.Height) };
    if (frame.Parallel)
    {
      placed.Box = {};
      for (const FramePoint& p : placed.Corners)
      {
        placed.Box.Add(p.X, p.Y);
      }
    }
  }
  placed.Box.X0 -= PixelSlack;
  placed.Box.Y0 -= PixelSlack;
  placed.Box.X1 += PixelSlack;
  placed.Box.Y1 += PixelSlack;
  return placed;
}

bool IsBehind(const PlacedFace& face)
{
  return std::all_of(
    face.Corners.begin(), face.Corners.end(), [](const FramePoint& p) { return p.T < 0; });
}

/// Pixels with a coordinate from low to high, 0 to count - 1: the first one and the one behind the
/// last.
std::array<int, 2> ClampPixels(double low, double high, int count)
{
  const double first = std::clamp(low, 0., static_cast<double>(count));
  const double last = std::clamp(high + 1, first, static_cast<double>(count));
  return { static_cast<int>(first), static_cast<int>(last) };
}

/// Whether boxes overlap; low and high include the edge.
bool Overlaps(const double (&low)[3], const double (&high)[3], const VisibleHull& hull)
{
  for (int a = 0; a < 3; ++a)
  {
    if (high[a] < hull.Low[a] || low[a] > hull.High[a])
    {
      return false;
    }
  }
  return true;
}

/// Whether rays of some pixels start within the box around a hull.
bool StartsInside(
  const Frame& frame, const VisibleHull& hull, double x0, double y0, double x1, double y1)
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

/// Depths of the face on the rays of pixels.
void AddRays(const Frame& frame, const VisibleHull& hull, const HullFace& face,
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

Polygon CutToTriangle(const Frame& frame, const PlacedFace& placed, const TriangleEdges& edges)
{
  Polygon polygon;
  std::copy(placed.Corners.begin(), placed.Corners.end(), polygon.Corners.begin());
  polygon.Count = static_cast<int>(placed.Corners.size());
  const HalfSpace kept[6] = { { 0, 0, 1, 0 }, frame.MakeHalfSpace(1, 0, -edges.Box.X0),
    frame.MakeHalfSpace(-1, 0, edges.Box.X1), frame.MakeHalfSpace(0, 1, -edges.Box.Y0),
    frame.MakeHalfSpace(0, -1, edges.Box.Y1),
    frame.MakeHalfSpace(edges.Side, -edges.Side, edges.Offset) };
  for (const HalfSpace& halfSpace : kept)
  {
    polygon = Cut(polygon, halfSpace);
  }
  return polygon;
}

/// Adds bounds of the depths of a convex polygon. direction: as of GetDepthBound.
void AddDepths(const Frame& frame, const FramePoint* points, int count,
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
void AddPixels(const Frame& frame, const PlacedFace& placed, HullDepths& depths)
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

HullDepths MakeEmpty(const RayGrid& grid, int tileSize)
{
  HullDepths depths;
  depths.Tiles = { grid.Width, grid.Height, tileSize };
  depths.Triangles.resize(2 * static_cast<std::size_t>(depths.Tiles.GetCount()));
  return depths;
}

/// Calls add(face, placed, depths) for each face that is not behind the camera. Threads share the
/// faces; the smallest and largest depths are the same in any order.
template <class AddT>
void AddFaces(
  const Frame& frame, const VisibleHull& hull, int threads, HullDepths& depths, const AddT& add)
{
  const double smallestT = FindSmallestT(frame, hull);
  const auto count = static_cast<std::int64_t>(hull.Faces.size());
#pragma omp parallel num_threads(threads)
  {
    HullDepths own = MakeEmpty(frame.Grid, depths.Tiles.Size);
#pragma omp for schedule(static) nowait
    for (std::int64_t f = 0; f < count; ++f)
    {
      const PlacedFace placed = PlaceFace(frame, hull.Faces[f], smallestT);
      if (!IsBehind(placed))
      {
        add(hull.Faces[f], placed, own);
      }
    }
#pragma omp critical(tetralux_hull_depths)
    for (std::size_t i = 0; i < own.Triangles.size(); ++i)
    {
      depths.Triangles[i].Add(own.Triangles[i].Front, own.Triangles[i].Back);
    }
  }
}

} // namespace

HullDepths FindDepthsOfRays(Span<const VisibleHull> hulls, const RayGrid& grid,
  const SlicePlanes& planes, int tileSize, int threads)
{
  const Frame frame(grid, planes);
  HullDepths depths = MakeEmpty(grid, tileSize);
  for (const VisibleHull& hull : hulls)
  {
    AddFaces(frame, hull, threads, depths,
      [&](const HullFace& face, const PlacedFace& placed, HullDepths& own)
      { AddRays(frame, hull, face, placed, own); });
  }
  return depths;
}

HullDepths FindDepthsOfPixels(Span<const VisibleHull> hulls, const RayGrid& grid,
  const SlicePlanes& planes, int tileSize, int threads)
{
  const Frame frame(grid, planes);
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
