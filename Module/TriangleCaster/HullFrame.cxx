// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/HullFrame.h"

#include <stdexcept>

namespace tetralux
{
namespace
{

/// In a perspective, points in front of this depth, of the farthest corner of the hulls' box, have
/// no place in the picture.
constexpr double SmallestDepth = 1. / (1 << 20);

void Cross(const double a[3], const double b[3], double result[3])
{
  result[0] = a[1] * b[2] - a[2] * b[1];
  result[1] = a[2] * b[0] - a[0] * b[2];
  result[2] = a[0] * b[1] - a[1] * b[0];
}

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

} // namespace

HullFrame::HullFrame(const RayGrid& grid, const SlicePlanes& planes)
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
      this->Axes[s][a] = DotProduct(grid.MeshFromWorld[a], steps[s]);
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    this->Origin[a] = DotProduct(grid.MeshFromWorld[a], grid.Origin) + grid.MeshFromWorld[a][3];
  }
  double normal[3];
  Cross(this->Axes[1], this->Axes[2], normal);
  const double determinant = DotProduct(this->Axes[0], normal);
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

double FindSmallestT(const HullFrame& frame, const VisibleHull& hull)
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

PlacedFace PlaceFace(const HullFrame& frame, const HullFace& face, double smallestT)
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

std::array<int, 2> ClampPixels(double low, double high, int count)
{
  const double first = std::clamp(low, 0., static_cast<double>(count));
  const double last = std::clamp(high + 1, first, static_cast<double>(count));
  return { static_cast<int>(first), static_cast<int>(last) };
}

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

HullDepths MakeEmpty(const RayGrid& grid, int tileSize)
{
  HullDepths depths;
  depths.Tiles = { grid.Width, grid.Height, tileSize };
  depths.Triangles.resize(2 * static_cast<std::size_t>(depths.Tiles.GetCount()));
  return depths;
}

} // namespace tetralux
