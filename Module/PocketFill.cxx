// SPDX-License-Identifier: BSD-3-Clause
#include "PocketFill.h"

#include "CellComplex.h"
#include "SimplexIntersection.h"
#include "SteinerPoint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Fronts up to these many triangles are searched depth first, and how many cells are tried: at once
/// what is tiny, what gift wrapping leaves behind, and what it could not fill.
struct SearchLimit
{
  std::size_t Triangles;
  int Steps;
};
constexpr SearchLimit TinySearch = { 16, 200 };
constexpr SearchLimit RestSearch = { 40, 200 };
constexpr SearchLimit LastSearch = { 40, 500 };

bool FillBySearch(
  const ExactPoints& points, const Front& front, const SearchLimit& limit, std::vector<Cell>& cells)
{
  return FillFromPoint(points, front, cells) ||
    (front.size() <= limit.Triangles && SearchCells(points, front, limit.Steps, cells));
}

std::size_t CountTriangles(const std::vector<Front>& fronts)
{
  std::size_t count = 0;
  for (const Front& front : fronts)
  {
    count += front.size();
  }
  return count;
}

/// Fills a pocket with the points that it has. Returns the fronts of what could not be filled; none
/// of them where all was.
std::vector<Front> FillPocket(const ExactPoints& points, const PointNeighbors& neighbors,
  const Front& front, int attempts, std::vector<Cell>& cells)
{
  if (FillBySearch(points, front, TinySearch, cells))
  {
    return {};
  }
  std::vector<Front> best = { front };
  std::vector<Cell> bestCells;
  for (int attempt = 0; attempt < attempts && !best.empty(); ++attempt)
  {
    const WrapOrder order = { attempt % 4 != 0, attempt % 2 == 0 && attempt != 0,
      static_cast<std::uint64_t>(attempt / 2) };
    std::vector<Front> stuck;
    std::vector<Cell> wrapped;
    const Front rest = WrapFront(points, neighbors, front, order, wrapped);
    for (Front& part : SplitFront(points, rest))
    {
      if (!FillBySearch(points, part, RestSearch, wrapped))
      {
        stuck.push_back(std::move(part));
      }
    }
    if (CountTriangles(stuck) < CountTriangles(best))
    {
      best = std::move(stuck);
      bestCells = std::move(wrapped);
    }
  }
  if (!best.empty() && front.size() <= LastSearch.Triangles &&
    SearchCells(points, front, LastSearch.Steps, cells))
  {
    return {};
  }
  cells.insert(cells.end(), bestCells.begin(), bestCells.end());
  return best;
}

/// Ways to wrap a pocket that are tried.
constexpr int FirstAttempts = 2;

/// Rounds in which a stuck pocket takes in the imaginary cells next to it, the size that it may grow
/// to, and ways to wrap it that are tried each time: before it gets points of its own, and after
/// there was no room for these.
struct GrowthLimit
{
  int Rounds;
  std::size_t Triangles;
  int Attempts;
};
constexpr GrowthLimit QuickGrowth = { 2, 120, 2 };
constexpr GrowthLimit LastGrowth = { 6, 400, 12 };

/// How thin a pocket is that can't hold a point of its own: its points are in one plane but for so
/// many roundings of the largest coordinate.
constexpr double FlatRoundings = 16;

/// Whether the points of a front are in one plane, to rounding.
bool IsFlat(const ExactPoints& points, const Front& front)
{
  double largest = 0;
  double normal[3] = { 0, 0, 0 };
  const double* origin = points[front[0][0]];
  double largestArea = 0;
  for (const Triangle& triangle : front)
  {
    const double* p = points[triangle[0]];
    const double* q = points[triangle[1]];
    const double* r = points[triangle[2]];
    double cross[3];
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      cross[a] = (q[b] - p[b]) * (r[c] - p[c]) - (q[c] - p[c]) * (r[b] - p[b]);
      largest = std::max({ largest, std::abs(p[a]), std::abs(q[a]), std::abs(r[a]) });
    }
    const double area = std::hypot(cross[0], cross[1], cross[2]);
    if (area > largestArea)
    {
      largestArea = area;
      origin = p;
      std::copy_n(cross, 3, normal);
    }
  }
  const double limit = FlatRoundings * std::numeric_limits<double>::epsilon() * largest;
  for (const Triangle& triangle : front)
  {
    for (const std::int32_t id : triangle)
    {
      double height = 0;
      for (int a = 0; a < 3; ++a)
      {
        height += (points[id][a] - origin[a]) * (normal[a] / largestArea);
      }
      if (!(std::abs(height) <= limit))
      {
        return false;
      }
    }
  }
  return true;
}

bool FillParts(const ExactPoints& points, const PointNeighbors& neighbors, const Front& front,
  int attempts, std::vector<Cell>& cells)
{
  const std::vector<Front> parts = SplitFront(points, front);
  return !parts.empty() &&
    std::all_of(parts.begin(), parts.end(),
      [&](const Front& part)
      { return FillPocket(points, neighbors, part, attempts, cells).empty(); });
}

/// Fills a stuck pocket after taking back cells next to it.
bool FillGrown(const ExactPoints& points, const PointNeighbors& neighbors, const Front& front,
  const GrowthLimit& limit, CellComplex& complex)
{
  Front grown = front;
  std::vector<std::int32_t> absorbed;
  for (int round = 0; round < limit.Rounds; ++round)
  {
    const std::size_t before = absorbed.size();
    grown = complex.Grow(grown, absorbed);
    if (absorbed.size() == before || grown.size() > limit.Triangles)
    {
      return false;
    }
    std::vector<Cell> cells;
    if (FillParts(points, neighbors, grown, limit.Attempts, cells))
    {
      complex.Remove(absorbed);
      complex.Add(cells);
      return true;
    }
  }
  return false;
}

/// Leaves a stuck pocket empty, with all cells between it and the mesh or its hull, if these are flat
/// to rounding.
bool LeaveFlat(const ExactPoints& points, const Front& front, CellComplex& complex, Front& flat)
{
  Front grown = front;
  std::vector<std::int32_t> absorbed;
  std::size_t before = 0;
  do
  {
    if (!IsFlat(points, grown))
    {
      return false;
    }
    before = absorbed.size();
    grown = complex.Grow(grown, absorbed);
  } while (absorbed.size() != before);
  complex.Remove(absorbed);
  flat.insert(flat.end(), grown.begin(), grown.end());
  return true;
}

/// Steiner points for each triangle of a pocket, after which it is given up.
constexpr std::size_t MaximumSteinerPoints = 4;

/// Fills a stuck pocket with points of its own.
bool FillWithSteinerPoints(const PointNeighbors& neighbors, const Front& front,
  std::vector<double>& coordinates, CellComplex& complex)
{
  const std::size_t numberOfCoordinates = coordinates.size();
  std::vector<Cell> cells;
  std::vector<Front> stuck = { front };
  for (std::size_t left = MaximumSteinerPoints * front.size(); !stuck.empty(); --left)
  {
    const Front pocket = std::move(stuck.back());
    stuck.pop_back();
    SteinerPoint steiner;
    if (left == 0 || !FindSteinerPoint(ExactPoints(coordinates.data()), pocket, steiner))
    {
      coordinates.resize(numberOfCoordinates);
      return false;
    }
    const auto id = static_cast<std::int32_t>(coordinates.size() / 3);
    coordinates.insert(coordinates.end(), steiner.Position.begin(), steiner.Position.end());
    const ExactPoints points(coordinates.data());
    std::vector<Cell> cone;
    for (const std::int32_t t : steiner.VisibleTriangles)
    {
      const auto [a, b, c] = pocket[t];
      cone.push_back({ a, b, c, id });
    }
    const Front rest = CellComplex::Advance(pocket, cone);
    const std::vector<Front> parts = SplitFront(points, rest);
    if (parts.empty() && !rest.empty())
    {
      coordinates.resize(numberOfCoordinates);
      return false;
    }
    cells.insert(cells.end(), cone.begin(), cone.end());
    for (const Front& part : parts)
    {
      for (Front& next : FillPocket(points, neighbors, part, FirstAttempts, cells))
      {
        stuck.push_back(std::move(next));
      }
    }
  }
  complex.Add(cells);
  return true;
}

} // namespace

//----------------------------------------------------------------------------
std::vector<Cell> FillPockets(EmptySpace space, const PointNeighbors& neighbors,
  std::vector<double>& coordinates, Front& flat, Obstacle& obstacle,
  const std::function<bool(double)>& progress)
{
  const auto numberOfPockets = static_cast<std::int64_t>(space.Pockets.size());
  std::vector<std::vector<Cell>> cells(numberOfPockets);
  std::vector<std::vector<Front>> stuck(numberOfPockets);
#pragma omp parallel for schedule(dynamic, 8)
  for (std::int64_t i = 0; i < numberOfPockets; ++i)
  {
    stuck[i] = FillPocket(
      ExactPoints(coordinates.data()), neighbors, space.Pockets[i], FirstAttempts, cells[i]);
  }
  std::vector<Front> remaining;
  for (std::int64_t i = 0; i < numberOfPockets; ++i)
  {
    space.Cells.insert(space.Cells.end(), cells[i].begin(), cells[i].end());
    std::move(stuck[i].begin(), stuck[i].end(), std::back_inserter(remaining));
  }
  if (remaining.empty())
  {
    return std::move(space.Cells);
  }

  CellComplex complex(std::move(space.Cells));
  for (const Front& front : remaining)
  {
    const ExactPoints points(coordinates.data());
    if (!FillGrown(points, neighbors, front, QuickGrowth, complex) &&
      !LeaveFlat(points, front, complex, flat) &&
      !FillWithSteinerPoints(neighbors, front, coordinates, complex) &&
      !FillGrown(ExactPoints(coordinates.data()), neighbors, front, LastGrowth, complex))
    {
      obstacle.Reason = "a pocket of " + std::to_string(front.size()) +
        " triangles could not be filled within the limits of the search";
      std::copy_n(
        &coordinates[3 * static_cast<std::size_t>(front[0][0])], 3, obstacle.Point.begin());
      return {};
    }
  }
  (void)progress;
  return complex.GetCells();
}

} // namespace tetralux
