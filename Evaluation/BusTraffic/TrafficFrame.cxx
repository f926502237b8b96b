// SPDX-License-Identifier: BSD-3-Clause
#include "BusTraffic/TrafficFrame.h"

#include "TriangleCaster/HullDepths.h"
#include "TriangleCaster/VisibleHull.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <omp.h>

namespace tetralux
{
namespace
{

/// Cells with a value of at least threshold at a corner.
std::vector<std::uint8_t> FindVisibleCells(const ImageVolume& volume, int threshold)
{
  const int* points = volume.Dimensions;
  const auto* values = static_cast<const std::uint8_t*>(volume.Values);
  const std::size_t row = points[0];
  const std::size_t slice = row * points[1];
  const std::size_t corners[8] = { 0, 1, row, row + 1, slice, slice + 1, slice + row,
    slice + row + 1 };
  std::vector<std::uint8_t> visible;
  visible.reserve(GetNumberOfValues(volume));
  for (int z = 0; z + 1 < points[2]; ++z)
  {
    for (int y = 0; y + 1 < points[1]; ++y)
    {
      const std::uint8_t* first = values + z * slice + y * row;
      for (int x = 0; x + 1 < points[0]; ++x)
      {
        const bool found = std::any_of(
          corners, corners + 8, [&](std::size_t corner) { return first[x + corner] >= threshold; });
        visible.push_back(found ? 1 : 0);
      }
    }
  }
  return visible;
}

/// The world is the volume.
RayGrid MakeGrid(const ImageVolume& volume, const TrafficView& view, int size)
{
  const double ca = std::cos(view.Azimuth), sa = std::sin(view.Azimuth);
  const double ce = std::cos(view.Elevation), se = std::sin(view.Elevation);
  const double cr = std::cos(view.Roll), sr = std::sin(view.Roll);
  const double ahead[3] = { ce * ca, ce * sa, se };
  const double side[3] = { -sa, ca, 0 };
  const double upwards[3] = { -se * ca, -se * sa, ce };
  const bool parallel = view.ViewAngle == 0;
  double diagonal = 0;
  for (const int points : volume.Dimensions)
  {
    diagonal = std::hypot(diagonal, points - 1);
  }
  // A parallel camera may be anywhere in front of the volume.
  const double distance = parallel ? diagonal : 0.5 * view.Extent / std::tan(0.5 * view.ViewAngle);
  const double pixel = view.Extent / size;
  const double first = 0.5 * (1 - size) * pixel;
  RayGrid grid;
  grid.Width = grid.Height = size;
  for (int a = 0; a < 3; ++a)
  {
    const double right = cr * side[a] + sr * upwards[a];
    const double up = cr * upwards[a] - sr * side[a];
    const double corner = first * (right + up);
    grid.Origin[a] = 0.5 * (volume.Dimensions[a] - 1) - distance * ahead[a];
    grid.Direction[a] = ahead[a];
    if (parallel)
    {
      grid.Origin[a] += corner;
      grid.OriginStepX[a] = pixel * right;
      grid.OriginStepY[a] = pixel * up;
    }
    else
    {
      grid.Direction[a] += corner / distance;
      grid.DirectionStepX[a] = pixel / distance * right;
      grid.DirectionStepY[a] = pixel / distance * up;
    }
  }
  return grid;
}

} // namespace

std::int64_t TrafficFrame::GetNumberOfPTriangles() const
{
  std::int64_t count = 0;
  for (const TrafficTriangle& triangle : this->Triangles)
  {
    count += triangle.Back - triangle.Front + 1;
  }
  return count;
}

std::int64_t TrafficFrame::GetDepthsOfPixels() const
{
  return std::int64_t{ 2 } * this->Grid.Width * this->Grid.Height;
}

std::int64_t TrafficFrame::GetDepthsOfTriangles() const
{
  return std::int64_t{ 2 } * 2 * this->GetColumns() * this->GetColumns();
}

TrafficFrame MakeTrafficFrame(
  const ImageVolume& volume, const TrafficView& view, int threshold, double planeDistance, int size)
{
  if (volume.Type != ImageScalar::UInt8)
  {
    throw std::invalid_argument("the values are not unsigned numbers of 8 bits");
  }
  TrafficFrame frame;
  frame.Volume = volume;
  frame.Grid = MakeGrid(volume, view, size);
  frame.Planes = MakeSlicePlanes(volume, frame.Grid, SliceShape::Planes, planeDistance);
  const int cells[3] = { volume.Dimensions[0] - 1, volume.Dimensions[1] - 1,
    volume.Dimensions[2] - 1 };
  const VisibleHull hull = MakeVisibleHull(cells, FindVisibleCells(volume, threshold), 1);
  const HullDepths depths = FindDepthsOfRays(
    { &hull, 1 }, frame.Grid, frame.Planes, TrafficFrame::TileSize, omp_get_max_threads());
  // The plane next to a depth is that of its slab.
  const auto findPlane = [&frame](double depth)
  {
    const double slab = std::floor((depth - frame.Planes.Origin) / frame.Planes.Distance);
    return std::clamp(static_cast<int>(slab), 0, frame.Planes.Count - 1);
  };
  for (std::size_t i = 0; i < depths.Triangles.size(); ++i)
  {
    const DepthRange& range = depths.Triangles[i];
    if (!range.IsEmpty())
    {
      const TrafficTriangle triangle = { static_cast<int>(i / 2), static_cast<int>(i % 2),
        findPlane(range.Front), findPlane(range.Back) };
      const bool first = frame.Triangles.empty();
      frame.FirstPlane = first ? triangle.Front : std::min(frame.FirstPlane, triangle.Front);
      frame.LastPlane = std::max(frame.LastPlane, triangle.Back);
      frame.Triangles.push_back(triangle);
    }
  }
  return frame;
}

} // namespace tetralux
