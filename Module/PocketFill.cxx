// SPDX-License-Identifier: BSD-3-Clause
#include "PocketFill.h"

#include "CellComplex.h"
#include "SimplexIntersection.h"
#include "SteinerPoint.h"

#include <algorithm>
#include <atomic>

namespace tetralux
{
namespace
{

/// Triangles of a front up to which cells are searched for depth first.
constexpr std::size_t LargestSearch = 60;

/// Cells that a search tries before it gives up.
constexpr int MaximumSteps = 2000;

/// Fills a pocket with the points that it has. Returns the fronts of what could not be filled; none
/// of them where all was.
std::vector<Front> FillPocket(const ExactPoints& points, const PointNeighbors& neighbors,
  const Front& front, std::vector<Cell>& cells, bool canWrap = true)
{
  if (FillFromPoint(points, front, cells) ||
    (front.size() <= LargestSearch && SearchCells(points, front, MaximumSteps, cells)))
  {
    return {};
  }
  if (!canWrap)
  {
    return { front };
  }
  std::vector<Front> stuck;
  const Front rest = WrapFront(points, neighbors, front, cells);
  for (const Front& part : SplitFront(points, rest))
  {
    for (Front& left : FillPocket(points, neighbors, part, cells, false))
    {
      stuck.push_back(std::move(left));
    }
  }
  return stuck;
}

/// Rounds in which a stuck pocket takes in the imaginary cells next to it, and the size that it may
/// grow to.
constexpr int MaximumGrowth = 3;
constexpr std::size_t LargestGrown = 400;

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
    bool isFilled = true;
    for (const Front& part : SplitFront(points, grown))
    {
      isFilled = isFilled && FillPocket(points, neighbors, part, cells).empty();
    }
    if (isFilled)
    {
      complex.Remove(absorbed);
      complex.Add(cells);
      return true;
    }
  }
  return false;
}

/// Steiner points for each triangle of a pocket, after which it is given up.
constexpr std::size_t MaximumSteinerPoints = 4;

/// Fills a stuck pocket with points of its own.
bool FillWithSteinerPoints(const PointNeighbors& neighbors, const Front& front,
  std::vector<double>& coordinates, CellComplex& complex)
{
  std::vector<Front> stuck = { front };
  std::size_t pointsLeft = MaximumSteinerPoints * (front.size() + 1);
  while (!stuck.empty())
  {
    const Front pocket = std::move(stuck.back());
    stuck.pop_back();
    if (pointsLeft-- == 0)
    {
      return false;
    }
    SteinerPoint steiner;
    if (!FindSteinerPoint(ExactPoints(coordinates.data()), pocket, steiner))
    {
      return false;
    }
    const auto id = static_cast<std::int32_t>(coordinates.size() / 3);
    coordinates.insert(coordinates.end(), steiner.Position.begin(), steiner.Position.end());
    const ExactPoints points(coordinates.data());
    std::vector<Cell> cells;
    Front rest = pocket;
    for (const std::int32_t t : steiner.VisibleTriangles)
    {
      const auto [a, b, c] = pocket[t];
      cells.push_back({ a, b, c, id });
    }
    rest = CellComplex::Advance(std::move(rest), cells);
    for (const Front& part : SplitFront(points, rest))
    {
      for (Front& left : FillPocket(points, neighbors, part, cells))
      {
        stuck.push_back(std::move(left));
      }
    }
    complex.Add(cells);
  }
  return true;
}

} // namespace

//----------------------------------------------------------------------------
std::vector<Cell> FillPockets(EmptySpace space, const PointNeighbors& neighbors,
  std::vector<double>& coordinates, Obstacle& obstacle, const std::function<bool(double)>& progress)
{
  const ExactPoints points(coordinates.data());
  const auto numberOfPockets = static_cast<std::int64_t>(space.Pockets.size());
  std::vector<std::vector<Cell>> cells(numberOfPockets);
  std::vector<std::vector<Front>> stuck(numberOfPockets);
#pragma omp parallel for schedule(dynamic, 8)
  for (std::int64_t i = 0; i < numberOfPockets; ++i)
  {
    stuck[i] = FillPocket(points, neighbors, space.Pockets[i], cells[i]);
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
    if (!FillGrown(ExactPoints(coordinates.data()), neighbors, front, complex) &&
      !FillWithSteinerPoints(neighbors, front, coordinates, complex))
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
