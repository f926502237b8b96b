// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/VisibilityCycles.h"

#include "Visibility/MeasureTriangle.h"
#include "Visibility/VisibilityArrows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <vector>

namespace tetralux
{
namespace
{

/// How many arrows of a cycle are followed, in all, to find ignored ones that close no cycle: a
/// tenth of a second, and all that there are in cycles of some thousand cells. More is only in
/// meshes whose cells overlap everywhere.
constexpr std::int64_t LargestNumberOfSteps = 1 << 22;

/// An arrow between two cells of a cycle, by their places in it.
struct CycleArrow
{
  std::int32_t From, To;
  double Size;
  bool Sliver;
  bool Removed; ///< ignored, or one of its cells is on no cycle any more
  bool Ignored;
};

/// Ignores arrows between the cells of a cycle until there is an order.
class CycleBreaker
{
public:
  /// cells: ascending.
  CycleBreaker(const VisibilityGeometry& geometry, const VisibilityView& view,
    Span<const std::uint8_t> arrows, const VisibilityGaps& gaps, Span<const std::int32_t> cells)
    : Cells(cells)
    , Into(cells.size())
    , From(cells.size())
    , Sizes(cells.size(), 0)
    , NumbersInto(cells.size(), 0)
    , NumbersFrom(cells.size(), 0)
    , Placed(cells.size(), 0)
  {
    for (std::int32_t place = 0; place < static_cast<std::int32_t>(cells.size()); ++place)
    {
      const std::int32_t cell = cells[place];
      for (int face = 0; face < 4; ++face)
      {
        if ((arrows[cell] >> face & 1) != 0)
        {
          const auto corners = geometry.GetCorners(cell);
          this->Add(place, geometry.Faces[4 * static_cast<std::int64_t>(cell) + face].Cell,
            MeasureTriangle({ corners[face == 0 ? 1 : 0], corners[face <= 1 ? 2 : 1],
                              corners[face == 3 ? 2 : 3] },
              view),
            false);
        }
      }
      if (!gaps.Cells.empty())
      {
        for (std::int32_t gap = gaps.Begins[cell]; gap < gaps.Begins[cell + 1]; ++gap)
        {
          this->Add(place, gaps.Cells[gap], gaps.Sizes[gap], gaps.Slivers[gap] != 0);
        }
      }
    }
  }

  /// Returns whether there is a cycle, of more than slivers.
  bool Break(VisibilityCycles& cycles)
  {
    for (std::int32_t arrow = 0; arrow < static_cast<std::int32_t>(this->All.size()); ++arrow)
    {
      if (this->All[arrow].Sliver)
      {
        this->Ignore(arrow);
      }
    }
    this->PlaceEnds();
    for (std::int32_t place = 0; place < static_cast<std::int32_t>(this->Cells.size()); ++place)
    {
      this->Cheapest.emplace(this->Sizes[place], place);
    }
    while (!this->Cheapest.empty())
    {
      const auto [size, place] = this->Cheapest.top();
      this->Cheapest.pop();
      if (this->Placed[place] || size != this->Sizes[place])
      {
        continue; // said anew since
      }
      for (const std::int32_t arrow : this->Into[place])
      {
        this->Ignore(arrow);
      }
      this->Ends.push_back(place);
      this->PlaceEnds();
    }
    this->TakeBack();
    bool cycle = false;
    for (const CycleArrow& arrow : this->All)
    {
      const bool counts = arrow.Ignored && !arrow.Sliver;
      cycle = cycle || counts;
      cycles.IgnoredFaces += counts ? 1 : 0;
      cycles.IgnoredArea += counts ? arrow.Size : 0;
    }
    return cycle;
  }

  /// Appends the cells, farthest first; after Break.
  void Place(std::vector<std::int32_t>& order) const
  {
    std::vector<std::int32_t> hidden(this->Cells.size(), 0);
    for (const CycleArrow& arrow : this->All)
    {
      hidden[arrow.From] += arrow.Ignored ? 0 : 1;
    }
    std::vector<std::int32_t> ready;
    for (std::int32_t place = 0; place < static_cast<std::int32_t>(this->Cells.size()); ++place)
    {
      if (hidden[place] == 0)
      {
        ready.push_back(place);
      }
    }
    while (!ready.empty())
    {
      const std::int32_t place = ready.back();
      ready.pop_back();
      order.push_back(this->Cells[place]);
      for (const std::int32_t arrow : this->Into[place])
      {
        if (!this->All[arrow].Ignored && --hidden[this->All[arrow].From] == 0)
        {
          ready.push_back(this->All[arrow].From);
        }
      }
    }
  }

private:
  /// Adds an arrow if its target is in the cycle, too.
  void Add(std::int32_t place, std::int32_t behind, double size, bool sliver)
  {
    const auto found = std::lower_bound(this->Cells.begin(), this->Cells.end(), behind);
    if (found != this->Cells.end() && *found == behind)
    {
      const std::int32_t to = static_cast<std::int32_t>(found - this->Cells.begin());
      this->Into[to].push_back(static_cast<std::int32_t>(this->All.size()));
      this->From[place].push_back(static_cast<std::int32_t>(this->All.size()));
      this->All.push_back({ place, to, size, sliver, false, false });
      this->Sizes[to] += size;
      ++this->NumbersInto[to];
      ++this->NumbersFrom[place];
    }
  }

  /// Cells that nothing hides any more, or that hide nothing more, are on no cycle.
  void PlaceEnds()
  {
    while (!this->Ends.empty())
    {
      const std::int32_t place = this->Ends.back();
      this->Ends.pop_back();
      if (this->Placed[place])
      {
        continue;
      }
      this->Placed[place] = 1;
      for (const auto* arrows : { &this->Into[place], &this->From[place] })
      {
        for (const std::int32_t arrow : *arrows)
        {
          if (!this->All[arrow].Removed)
          {
            this->Remove(arrow);
          }
        }
      }
    }
  }

  /// Ignores no arrow that closes no cycle with the others, the largest ones first.
  void TakeBack()
  {
    std::vector<std::int32_t> ignored;
    for (std::int32_t arrow = 0; arrow < static_cast<std::int32_t>(this->All.size()); ++arrow)
    {
      if (this->All[arrow].Ignored)
      {
        ignored.push_back(arrow);
      }
    }
    std::stable_sort(ignored.begin(), ignored.end(),
      [this](std::int32_t a, std::int32_t b) { return this->All[a].Size > this->All[b].Size; });
    std::int64_t budget = LargestNumberOfSteps;
    std::vector<std::int32_t> reached(this->Cells.size(), -1);
    std::vector<std::int32_t> path;
    for (const std::int32_t arrow : ignored)
    {
      // Whether its target leads to its source.
      const std::int32_t source = this->All[arrow].From;
      path.assign(1, this->All[arrow].To);
      reached[path.back()] = arrow;
      while (!path.empty() && reached[source] != arrow && budget > 0)
      {
        const std::int32_t place = path.back();
        path.pop_back();
        for (const std::int32_t next : this->From[place])
        {
          --budget;
          const std::int32_t to = this->All[next].To;
          if (!this->All[next].Ignored && reached[to] != arrow)
          {
            reached[to] = arrow;
            path.push_back(to);
          }
        }
      }
      this->All[arrow].Ignored = !path.empty() || reached[source] == arrow;
    }
  }

  void Ignore(std::int32_t arrow)
  {
    if (!this->All[arrow].Removed)
    {
      this->All[arrow].Ignored = true;
      this->Remove(arrow);
    }
  }

  void Remove(std::int32_t id)
  {
    CycleArrow& arrow = this->All[id];
    arrow.Removed = true;
    if (--this->NumbersFrom[arrow.From] == 0)
    {
      this->Ends.push_back(arrow.From);
    }
    if (--this->NumbersInto[arrow.To] == 0)
    {
      this->Ends.push_back(arrow.To);
    }
    // Summed anew: a difference would keep the rounding of what is no longer there.
    double sum = 0;
    for (const std::int32_t other : this->Into[arrow.To])
    {
      sum += this->All[other].Removed ? 0 : this->All[other].Size;
    }
    this->Sizes[arrow.To] = sum;
    this->Cheapest.emplace(sum, arrow.To);
  }

  using Candidate = std::pair<double, std::int32_t>;

  Span<const std::int32_t> Cells;
  std::vector<CycleArrow> All;
  std::vector<std::vector<std::int32_t>> Into, From; ///< ids of arrows, for each place
  std::vector<double> Sizes;                         ///< of the arrows into each place
  std::vector<std::int32_t> NumbersInto, NumbersFrom;
  std::vector<std::uint8_t> Placed;
  std::vector<std::int32_t> Ends;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> Cheapest;
};

} // namespace

//----------------------------------------------------------------------------
std::vector<std::int32_t> SortWithCycles(const VisibilityGeometry& geometry,
  const VisibilityView& view, Span<const std::uint8_t> arrows, const VisibilityGaps& gaps,
  Span<const KeyedItem> roots, VisibilityCycles& cycles)
{
  // Tarjan, Depth-First Search and Linear Graph Algorithms, 1972: the components that are strongly
  // connected, each once all that it hides was found.
  const std::int64_t numberOfCells = geometry.GetNumberOfCells();
  constexpr std::int32_t Done = -1;                      // the component is known
  std::vector<std::int32_t> visits(numberOfCells, 0);    // ascending from 1; 0 where not visited
  std::vector<std::int32_t> lowest(numberOfCells);       // visit that a path leads back to
  std::vector<std::int32_t> nextArrow(numberOfCells, 0); // faces, then gaps
  std::vector<std::int32_t> path;
  std::vector<std::int32_t> open; // visited, and their component is not known
  std::vector<std::int32_t> order;
  std::int32_t numberOfVisits = 0;
  order.reserve(numberOfCells);
  cycles.Begins.assign(1, 0);

  const auto visit = [&](std::int32_t cell)
  {
    visits[cell] = lowest[cell] = ++numberOfVisits;
    path.push_back(cell);
    open.push_back(cell);
  };
  // Takes the component of a cell off the open ones.
  const auto closeComponent = [&](std::int32_t cell)
  {
    auto begin = open.end();
    do
    {
      --begin;
      visits[*begin] = Done;
    } while (*begin != cell);
    if (open.end() - begin == 1)
    {
      order.push_back(cell);
    }
    else
    {
      std::sort(begin, open.end());
      const Span<const std::int32_t> cells(&*begin, static_cast<std::size_t>(open.end() - begin));
      CycleBreaker breaker(geometry, view, arrows, gaps, cells);
      if (breaker.Break(cycles))
      {
        cycles.Cells.insert(cycles.Cells.end(), begin, open.end());
        cycles.Begins.push_back(static_cast<std::int64_t>(cycles.Cells.size()));
      }
      breaker.Place(order);
    }
    open.erase(begin, open.end());
  };
  const auto visitAllBehind = [&](std::int32_t root)
  {
    if (visits[root] != 0)
    {
      return;
    }
    visit(root);
    while (!path.empty())
    {
      const std::int32_t cell = path.back();
      const std::int32_t numberOfGaps =
        gaps.Cells.empty() ? 0 : gaps.Begins[cell + 1] - gaps.Begins[cell];
      if (nextArrow[cell] < 4 + numberOfGaps)
      {
        const std::int32_t arrow = nextArrow[cell]++;
        std::int32_t behind = -1;
        if (arrow >= 4)
        {
          behind = gaps.Cells[gaps.Begins[cell] + arrow - 4];
        }
        else if ((arrows[cell] >> arrow & 1) != 0)
        {
          behind = geometry.Faces[4 * static_cast<std::int64_t>(cell) + arrow].Cell;
        }
        if (behind >= 0 && visits[behind] == 0)
        {
          visit(behind);
        }
        else if (behind >= 0 && visits[behind] != Done)
        {
          lowest[cell] = std::min(lowest[cell], visits[behind]);
        }
        continue;
      }
      path.pop_back();
      if (!path.empty())
      {
        lowest[path.back()] = std::min(lowest[path.back()], lowest[cell]);
      }
      if (lowest[cell] == visits[cell])
      {
        closeComponent(cell);
      }
    }
  };
  for (const KeyedItem& root : roots)
  {
    visitAllBehind(root.Item);
  }
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    visitAllBehind(static_cast<std::int32_t>(cell));
  }
  return order;
}

} // namespace tetralux
