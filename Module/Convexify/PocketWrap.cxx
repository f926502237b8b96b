// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/PocketWrap.h"

#include "Convexify/FaceTable.h"
#include "Geometry/BoxTree.h"
#include "Geometry/TetrahedronFaces.h"

#include <algorithm>
#include <deque>
#include <tuple>
#include <unordered_map>

namespace tetralux
{
namespace
{

/// Points that are tried in front of a triangle, the best ones; and how often all triangles are
/// tried that had none which fits.
constexpr std::size_t MaximumCandidates = 24;
constexpr int MaximumPasses = 4;

/// A front that moves on, with all that finds its triangles.
class MovingFront
{
public:
  MovingFront(
    const ExactPoints& points, const PointNeighbors& neighbors, const Front& front, WrapOrder order)
    : Points(points)
    , Neighbors(neighbors)
    , Order(order)
    , Table(front.size())
  {
    for (const Triangle& triangle : front)
    {
      this->Add(triangle);
    }
  }

  void Advance(std::vector<Cell>& cells)
  {
    // A triangle that had no choice may have one when others have gone.
    std::deque<std::int32_t> stuck;
    std::size_t cellsBefore = 0;
    for (int pass = 0; pass < MaximumPasses && (pass == 0 || cells.size() != cellsBefore); ++pass)
    {
      cellsBefore = cells.size();
      while (!this->Waiting.empty())
      {
        const std::int32_t number = this->Waiting.front();
        this->Waiting.pop_front();
        if (this->Leaves[number] < 0)
        {
          continue;
        }
        const std::int32_t apex = this->FindApex(this->Triangles[number]);
        if (apex < 0)
        {
          stuck.push_back(number);
          continue;
        }
        const Triangle base = this->Triangles[number];
        this->Cover({ base[0], base[1], base[2], apex });
        cells.push_back({ base[0], base[1], base[2], apex });
      }
      std::swap(this->Waiting, stuck);
    }
  }

  Front GetRest() const
  {
    Front rest;
    for (std::size_t i = 0; i < this->Triangles.size(); ++i)
    {
      if (this->Leaves[i] >= 0)
      {
        rest.push_back(this->Triangles[i]);
      }
    }
    return rest;
  }

private:
  Box GetBox(const std::int32_t* ids, int count) const
  {
    Box box;
    std::copy_n(this->Points[ids[0]], 3, box.Low.begin());
    box.High = box.Low;
    for (int i = 1; i < count; ++i)
    {
      const double* point = this->Points[ids[i]];
      for (int a = 0; a < 3; ++a)
      {
        box.Low[a] = std::min(box.Low[a], point[a]);
        box.High[a] = std::max(box.High[a], point[a]);
      }
    }
    return box;
  }

  void Add(const Triangle& triangle)
  {
    const auto number = static_cast<std::int32_t>(this->Triangles.size());
    this->Triangles.push_back(triangle);
    this->Leaves.push_back(this->Tree.Insert(this->GetBox(triangle.data(), 3), number));
    this->Table.Set(triangle[0], triangle[1], triangle[2], number);
    for (const std::int32_t point : triangle)
    {
      this->TrianglesAt[point].push_back(number);
    }
    this->Waiting.push_back(number);
  }

  void Cover(const Cell& cell)
  {
    for (const auto& face : OutwardFaces)
    {
      const Triangle triangle = { cell[face[0]], cell[face[1]], cell[face[2]] };
      const std::int32_t number = this->Table.Find(triangle[0], triangle[1], triangle[2]);
      if (number == FaceTable::None)
      {
        this->Add(triangle);
        continue;
      }
      this->Table.Set(triangle[0], triangle[1], triangle[2], FaceTable::None);
      this->Tree.Remove(this->Leaves[number]);
      this->Leaves[number] = -1;
      for (const std::int32_t point : triangle)
      {
        std::vector<std::int32_t>& at = this->TrianglesAt[point];
        at.erase(std::find(at.begin(), at.end(), number));
      }
    }
  }

  bool Fits(const Cell& cell) const
  {
    return this->Tree.ForEach(this->GetBox(cell.data(), 4),
      [&](std::int32_t number)
      { return CellFitsTriangle(this->Points, cell, this->Triangles[number]); });
  }

  /// How many triangles of the front, beside its base, a cell would close; 0 where that
  /// is not asked.
  int CountClosed(const Triangle& base, std::int32_t apex) const
  {
    int count = 0;
    for (int i = 0; i < 3 && this->Order == WrapOrder::Closing; ++i)
    {
      count += this->Table.Find(base[i], base[(i + 1) % 3], apex) != FaceTable::None;
    }
    return count;
  }

  /// The first point in the order that makes a cell which fits; -1 where none does.
  std::int32_t FindApex(const Triangle& base)
  {
    const auto [a, b, c] = base;
    this->Candidates.clear();
    const DelaunayOrder order(this->Points, base);
    this->Ids.clear();
    for (const std::int32_t point : base)
    {
      const auto add = [this](std::int32_t id)
      {
        const auto at = this->TrianglesAt.find(id);
        if (at != this->TrianglesAt.end() && !at->second.empty())
        {
          this->Ids.push_back(id);
        }
      };
      this->Neighbors.ForEach(point, add);
      for (const std::int32_t number : this->TrianglesAt[point])
      {
        for (const std::int32_t id : this->Triangles[number])
        {
          this->Ids.push_back(id);
        }
      }
    }
    std::sort(this->Ids.begin(), this->Ids.end());
    this->Ids.erase(std::unique(this->Ids.begin(), this->Ids.end()), this->Ids.end());
    for (const std::int32_t id : this->Ids)
    {
      if (this->Points.Orient(a, b, c, id) > 0)
      {
        this->Candidates.emplace_back(-this->CountClosed(base, id), order(id), id);
      }
    }
    const std::size_t size = std::min(this->Candidates.size(), MaximumCandidates);
    std::partial_sort(this->Candidates.begin(),
      this->Candidates.begin() + static_cast<std::ptrdiff_t>(size), this->Candidates.end());
    this->Candidates.resize(size);
    const auto found = std::find_if(this->Candidates.begin(), this->Candidates.end(),
      [&, a = a, b = b, c = c](const auto& candidate) {
        return this->Fits({ a, b, c, std::get<2>(candidate) });
      });
    return found == this->Candidates.end() ? -1 : std::get<2>(*found);
  }

  const ExactPoints& Points;
  const PointNeighbors& Neighbors;
  WrapOrder Order;
  std::vector<Triangle> Triangles;
  std::vector<std::int32_t> Leaves; ///< of the tree, -1 for triangles that are no longer there
  std::deque<std::int32_t> Waiting;
  BoxTree Tree;
  FaceTable Table;
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> TrianglesAt;
  std::vector<std::int32_t> Ids;
  std::vector<std::tuple<int, double, std::int32_t>> Candidates;
};

} // namespace

//----------------------------------------------------------------------------
PointNeighbors::PointNeighbors(const BoundaryTriangulation& triangulation)
{
  const std::size_t numberOfPoints = triangulation.PointCells.size();
  std::vector<std::array<std::int32_t, 2>> edges;
  const auto numberOfCells = static_cast<std::int32_t>(triangulation.GetNumberOfCells());
  for (std::int32_t cell = 0; cell < numberOfCells; ++cell)
  {
    if (triangulation.IsInfinite(cell))
    {
      continue;
    }
    const std::int32_t* corners = &triangulation.Cells[4 * static_cast<std::size_t>(cell)];
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        if (i != j)
        {
          edges.push_back({ corners[i], corners[j] });
        }
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  this->Begin.assign(numberOfPoints + 1, 0);
  for (const auto& edge : edges)
  {
    ++this->Begin[edge[0] + 1];
    this->Points.push_back(edge[1]);
  }
  for (std::size_t i = 0; i < numberOfPoints; ++i)
  {
    this->Begin[i + 1] += this->Begin[i];
  }
}

//----------------------------------------------------------------------------
Front WrapFront(const ExactPoints& points, const PointNeighbors& neighbors, const Front& front,
  WrapOrder order, std::vector<Cell>& cells)
{
  MovingFront moving(points, neighbors, front, order);
  moving.Advance(cells);
  return moving.GetRest();
}

} // namespace tetralux
