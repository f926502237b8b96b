// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/PocketFill.h"

#include "Convexify/CellComplex.h"
#include "Convexify/SteinerPoint.h"
#include "Geometry/TetrahedronFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Fronts up to these many triangles are searched depth first, and how many cells are tried: at
/// once what is tiny, what gift wrapping leaves behind, and what it could not fill.
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

/// How thin a pocket is that can't hold a point of its own: its volume is no more than its surface
/// times so many roundings of the largest coordinate.
constexpr double ThinRoundings = 16;

/// Whether what some triangles enclose is thin.
bool IsThin(const ExactPoints& points, const Front& front)
{
  double largest = 0;
  double volume = 0;
  double area = 0;
  const double* origin = points[front[0][0]];
  for (const Triangle& triangle : front)
  {
    const double* p = points[triangle[0]];
    const double* q = points[triangle[1]];
    const double* r = points[triangle[2]];
    double normal[3];
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      normal[a] = (q[b] - p[b]) * (r[c] - p[c]) - (q[c] - p[c]) * (r[b] - p[b]);
      volume += normal[a] * (p[a] - origin[a]) / 6;
      largest = std::max({ largest, std::abs(p[a]), std::abs(q[a]), std::abs(r[a]) });
    }
    area += std::hypot(normal[0], normal[1], normal[2]) / 2;
  }
  return std::abs(volume) <=
    ThinRoundings * std::numeric_limits<double>::epsilon() * largest * area;
}

/// Thin pockets of more triangles are not wrapped: walls of thousands of triangles that are plane
/// only to rounding would take minutes, and most can be left empty.
constexpr std::size_t LargestThinWrap = 1000;

/// Fills a pocket with the points that it has. Returns the fronts of what could not be filled; none
/// of them where all was.
std::vector<Front> FillPocket(const ExactPoints& points, const PointNeighbors& neighbors,
  const Front& front, std::vector<Cell>& cells)
{
  if (FillBySearch(points, front, TinySearch, cells))
  {
    return {};
  }
  std::vector<Front> best = { front };
  if (front.size() > LargestThinWrap && IsThin(points, front))
  {
    return best;
  }
  std::vector<Cell> bestCells;
  for (const WrapOrder order : { WrapOrder::Delaunay, WrapOrder::Closing })
  {
    if (best.empty())
    {
      break;
    }
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

/// Rounds in which a stuck pocket takes in the imaginary cells next to it, and the size that it may
/// grow to.
constexpr int MaximumGrowth = 2;
constexpr std::size_t LargestGrown = 120;

Front GetFaces(const Cell& cell)
{
  Front faces;
  for (const auto& face : OutwardFaces)
  {
    faces.push_back({ cell[face[0]], cell[face[1]], cell[face[2]] });
  }
  return faces;
}

bool FillParts(const ExactPoints& points, const PointNeighbors& neighbors, const Front& front,
  std::vector<Cell>& cells)
{
  const std::vector<Front> parts = SplitFront(points, front);
  return !parts.empty() &&
    std::all_of(parts.begin(), parts.end(),
      [&](const Front& part) { return FillPocket(points, neighbors, part, cells).empty(); });
}

/// Fills a stuck pocket after taking back cells next to it.
bool FillGrown(const ExactPoints& points, const PointNeighbors& neighbors, const Front& front,
  CellComplex& complex)
{
  Front grown = front;
  std::vector<std::int32_t> absorbed;
  for (int round = 0; round < MaximumGrowth; ++round)
  {
    const std::size_t before = absorbed.size();
    grown = complex.Grow(grown, absorbed);
    if (absorbed.size() == before || grown.size() > LargestGrown)
    {
      return false;
    }
    std::vector<Cell> cells;
    if (FillParts(points, neighbors, grown, cells))
    {
      complex.Remove(absorbed);
      complex.Add(cells);
      return true;
    }
  }
  return false;
}

/// Leaves a stuck pocket empty, with all cells between it and the mesh or its hull, if
/// these are thin.
bool LeaveThin(const ExactPoints& points, const Front& front, CellComplex& complex, Front& flat)
{
  if (!IsThin(points, front))
  {
    return false;
  }
  Front grown = front;
  std::vector<std::int32_t> absorbed;
  std::size_t before = 0;
  do
  {
    before = absorbed.size();
    grown = complex.Grow(grown, absorbed);
    if (std::any_of(absorbed.begin() + static_cast<std::ptrdiff_t>(before), absorbed.end(),
          [&](std::int32_t number) { return !IsThin(points, GetFaces(complex.GetCell(number))); }))
    {
      return false;
    }
  } while (absorbed.size() != before);
  complex.Remove(absorbed);
  flat.insert(flat.end(), grown.begin(), grown.end());
  return true;
}

/// Gives a stuck pocket a point of its own. What is still not filled then is added to
/// the stuck ones.
bool AddSteinerPoint(const PointNeighbors& neighbors, const Front& front,
  std::vector<double>& coordinates, CellComplex& complex, std::vector<Front>& stuck)
{
  SteinerPoint steiner;
  if (!FindSteinerPoint(ExactPoints(coordinates.data()), front, steiner))
  {
    return false;
  }
  const auto id = static_cast<std::int32_t>(coordinates.size() / 3);
  coordinates.insert(coordinates.end(), steiner.Position.begin(), steiner.Position.end());
  const ExactPoints points(coordinates.data());
  std::vector<Cell> cells;
  for (const std::int32_t t : steiner.VisibleTriangles)
  {
    const auto [a, b, c] = front[t];
    cells.push_back({ a, b, c, id });
  }
  const Front rest = CellComplex::Advance(front, cells);
  const std::vector<Front> parts = SplitFront(points, rest);
  for (const Front& part : parts)
  {
    for (Front& next : FillPocket(points, neighbors, part, cells))
    {
      stuck.push_back(std::move(next));
    }
  }
  complex.Add(cells);
  return !parts.empty() || rest.empty();
}

/// Steiner points in a row that leave no fewer stuck triangles than there were before, after which
/// the pockets are given up: each has covered a few triangles only, and left more behind.
constexpr int MaximumVainPoints = 32;

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
    stuck[i] = FillPocket(ExactPoints(coordinates.data()), neighbors, space.Pockets[i], cells[i]);
  }
  std::vector<Front> stuckFronts;
  for (std::int64_t i = 0; i < numberOfPockets; ++i)
  {
    space.Cells.insert(space.Cells.end(), cells[i].begin(), cells[i].end());
    std::move(stuck[i].begin(), stuck[i].end(), std::back_inserter(stuckFronts));
  }
  if (stuckFronts.empty())
  {
    return std::move(space.Cells);
  }

  CellComplex complex(std::move(space.Cells));
  const auto numberOfStuck = static_cast<double>(stuckFronts.size());
  double done = 0;
  std::size_t fewestTriangles = CountTriangles(stuckFronts);
  int vainPoints = 0;
  std::reverse(stuckFronts.begin(), stuckFronts.end());
  while (!stuckFronts.empty())
  {
    // It may get worse before it gets better.
    done = std::max(done, 1 - static_cast<double>(stuckFronts.size()) / numberOfStuck);
    if (progress && !progress(done))
    {
      return {};
    }
    const Front front = std::move(stuckFronts.back());
    stuckFronts.pop_back();
    const ExactPoints points(coordinates.data());
    if (FillGrown(points, neighbors, front, complex) || LeaveThin(points, front, complex, flat))
    {
      continue;
    }
    const bool isThin = IsThin(points, front);
    if (vainPoints < MaximumVainPoints && !isThin &&
      AddSteinerPoint(neighbors, front, coordinates, complex, stuckFronts))
    {
      const std::size_t triangles = CountTriangles(stuckFronts);
      vainPoints = triangles < fewestTriangles ? 0 : vainPoints + 1;
      fewestTriangles = std::min(fewestTriangles, triangles);
      continue;
    }
    obstacle.Reason = "a pocket of " + std::to_string(front.size()) +
      (isThin ? " triangles, too thin for a point of its own, could not be filled"
              : " triangles could not be filled within the limits of the search");
    std::copy_n(&coordinates[3 * static_cast<std::size_t>(front[0][0])], 3, obstacle.Point.begin());
    return {};
  }
  return complex.GetCells();
}

} // namespace tetralux
