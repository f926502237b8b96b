// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/PocketSearch.h"

#include "Geometry/SimplexIntersection.h"
#include "Geometry/TetrahedronFaces.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace tetralux
{
namespace
{

bool Contains(const Triangle& triangle, std::int32_t point)
{
  return triangle[0] == point || triangle[1] == point || triangle[2] == point;
}

/// Whether two triangles have the same points.
bool AreSame(const Triangle& triangle0, const Triangle& triangle1)
{
  return Contains(triangle0, triangle1[0]) && Contains(triangle0, triangle1[1]) &&
    Contains(triangle0, triangle1[2]);
}

/// Whether the boxes around a cell and a triangle have no point in common.
bool AreApart(const ExactPoints& points, const Cell& cell, const Triangle& triangle)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [cellLow, cellHigh] = std::minmax({ points[cell[0]][axis], points[cell[1]][axis],
      points[cell[2]][axis], points[cell[3]][axis] });
    const auto [low, high] = std::minmax(
      { points[triangle[0]][axis], points[triangle[1]][axis], points[triangle[2]][axis] });
    if (low > cellHigh || high < cellLow)
    {
      return true;
    }
  }
  return false;
}

/// Depth-first search for the cells of a small pocket: always at the triangle with the fewest
/// choices.
class CellSearch
{
public:
  CellSearch(const ExactPoints& points, const Front& front, int maximumSteps)
    : Points(points)
    , Start(front)
    , Apexes(GetFrontPoints(front))
    , StepsLeft(maximumSteps)
  {
  }

  bool Search(std::vector<Cell>& cells)
  {
    if (!this->SearchFrom(this->Start))
    {
      return false;
    }
    cells.insert(cells.end(), this->Cells.begin(), this->Cells.end());
    return true;
  }

private:
  bool SearchFrom(const Front& front)
  {
    if (front.empty())
    {
      return true;
    }
    Triangle base{};
    std::vector<std::int32_t> choices;
    bool isFirst = true;
    for (auto triangle = front.rbegin(); triangle != front.rend(); ++triangle)
    {
      std::vector<std::int32_t> found;
      for (const std::int32_t apex : this->Apexes)
      {
        if (this->Fits(front, *triangle, apex))
        {
          found.push_back(apex);
          if (!isFirst && found.size() >= choices.size())
          {
            break;
          }
        }
      }
      if (found.empty())
      {
        return false;
      }
      if (isFirst || found.size() < choices.size())
      {
        isFirst = false;
        choices = std::move(found);
        base = *triangle;
      }
      if (choices.size() == 1)
      {
        break;
      }
    }

    if (choices.size() > 1)
    {
      const DelaunayOrder order(this->Points, base);
      std::vector<std::pair<double, std::int32_t>> sorted;
      sorted.reserve(choices.size());
      for (const std::int32_t apex : choices)
      {
        sorted.emplace_back(order(apex), apex);
      }
      std::sort(sorted.begin(), sorted.end());
      std::transform(sorted.begin(), sorted.end(), choices.begin(),
        [](const auto& entry) { return entry.second; });
    }
    for (const std::int32_t apex : choices)
    {
      if (--this->StepsLeft < 0)
      {
        return false;
      }
      const Cell cell = { base[0], base[1], base[2], apex };
      this->Cells.push_back(cell);
      if (this->SearchFrom(Advance(front, cell)))
      {
        return true;
      }
      this->Cells.pop_back();
    }
    return false;
  }

  /// The front without what the cell covers.
  static Front Advance(const Front& front, const Cell& cell)
  {
    Front next = front;
    for (const auto& face : OutwardFaces)
    {
      const Triangle triangle = { cell[face[0]], cell[face[1]], cell[face[2]] };
      const auto closed = std::find_if(next.begin(), next.end(),
        [&triangle](const Triangle& other) { return AreSame(triangle, other); });
      if (closed != next.end())
      {
        next.erase(closed);
      }
      else
      {
        next.push_back(triangle);
      }
    }
    return next;
  }

  bool Fits(const Front& front, const Triangle& base, std::int32_t apex)
  {
    if (Contains(base, apex) || this->Points.Orient(base[0], base[1], base[2], apex) <= 0)
    {
      return false;
    }
    const Cell cell = { base[0], base[1], base[2], apex };
    if (!this->FitsStart(cell))
    {
      return false;
    }
    // What came after the start is at the end.
    for (auto triangle = front.rbegin(); triangle != front.rend(); ++triangle)
    {
      if (!CellFitsTriangle(this->Points, cell, *triangle))
      {
        return false;
      }
    }
    return true;
  }

  /// Whether a cell fits into the pocket as it was at the start; asked again and again.
  bool FitsStart(const Cell& cell)
  {
    Cell sorted = cell;
    std::sort(sorted.begin(), sorted.end());
    std::uint64_t key = 0;
    for (const std::int32_t point : sorted)
    {
      key = key << 16 |
        static_cast<std::uint64_t>(
          std::lower_bound(this->Apexes.begin(), this->Apexes.end(), point) - this->Apexes.begin());
    }
    const auto [entry, isNew] = this->Known.try_emplace(key, false);
    if (isNew)
    {
      entry->second = std::all_of(this->Start.begin(), this->Start.end(),
        [&](const Triangle& triangle) { return CellFitsTriangle(this->Points, cell, triangle); });
    }
    return entry->second;
  }

  const ExactPoints& Points;
  const Front& Start;
  const std::vector<std::int32_t> Apexes;
  int StepsLeft;
  std::unordered_map<std::uint64_t, bool> Known;
  std::vector<Cell> Cells;
};

} // namespace

//----------------------------------------------------------------------------
DelaunayOrder::DelaunayOrder(const ExactPoints& points, const Triangle& triangle)
  : Points(points)
{
  const double* p = points[triangle[0]];
  double u[3], v[3];
  for (int a = 0; a < 3; ++a)
  {
    this->Origin[a] = p[a];
    u[a] = points[triangle[1]][a] - p[a];
    v[a] = points[triangle[2]][a] - p[a];
  }
  double uu = 0, vv = 0, nn = 0;
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    this->Normal[a] = u[b] * v[c] - u[c] * v[b];
    uu += u[a] * u[a];
    vv += v[a] * v[a];
    nn += this->Normal[a] * this->Normal[a];
  }
  this->SquaredRadius = 0;
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    // (uu v - vv u) x n / (2 nn), see any text on circumscribed circles.
    this->Center[a] =
      ((vv * u[b] - uu * v[b]) * -this->Normal[c] + (vv * u[c] - uu * v[c]) * this->Normal[b]) /
      (2 * nn);
    this->SquaredRadius += this->Center[a] * this->Center[a];
  }
}

//----------------------------------------------------------------------------
double DelaunayOrder::operator()(std::int32_t apex) const
{
  const double* p = this->Points[apex];
  double squaredDistance = 0;
  double height = 0;
  for (int a = 0; a < 3; ++a)
  {
    const double d = p[a] - this->Origin[a];
    height += d * this->Normal[a];
    squaredDistance += (d - this->Center[a]) * (d - this->Center[a]);
  }
  const double offset = (squaredDistance - this->SquaredRadius) / height;
  // What can't be computed comes last.
  return offset <= std::numeric_limits<double>::max() ? offset : std::numeric_limits<double>::max();
}

//----------------------------------------------------------------------------
std::vector<std::int32_t> GetFrontPoints(const Front& front)
{
  std::vector<std::int32_t> ids;
  ids.reserve(3 * front.size());
  for (const Triangle& triangle : front)
  {
    ids.insert(ids.end(), triangle.begin(), triangle.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

//----------------------------------------------------------------------------
bool CellFitsTriangle(const ExactPoints& points, const Cell& cell, const Triangle& triangle)
{
  int other = -1;
  int shared = 0;
  for (int i = 0; i < 4; ++i)
  {
    const bool isShared = Contains(triangle, cell[i]);
    shared += isShared;
    other = isShared ? other : i;
  }
  if (shared == 3)
  {
    return points.Orient(triangle[0], triangle[1], triangle[2], cell[other]) > 0;
  }
  return (shared == 0 && AreApart(points, cell, triangle)) ||
    CellMeetsTriangleProperly(points, cell.data(), triangle.data());
}

//----------------------------------------------------------------------------
bool FillFromPoint(const ExactPoints& points, const Front& front, std::vector<Cell>& cells)
{
  for (const std::int32_t apex : GetFrontPoints(front))
  {
    if (std::all_of(front.begin(), front.end(),
          [&](const Triangle& triangle)
          {
            return Contains(triangle, apex) ||
              points.Orient(triangle[0], triangle[1], triangle[2], apex) > 0;
          }))
    {
      for (const Triangle& triangle : front)
      {
        if (!Contains(triangle, apex))
        {
          cells.push_back({ triangle[0], triangle[1], triangle[2], apex });
        }
      }
      return true;
    }
  }
  return false;
}

//----------------------------------------------------------------------------
bool SearchCells(
  const ExactPoints& points, const Front& front, int maximumSteps, std::vector<Cell>& cells)
{
  return CellSearch(points, front, maximumSteps).Search(cells);
}

} // namespace tetralux
