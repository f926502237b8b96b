// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/ActiveTree.h"

#include "Isosurface/CellFieldValues.h"
#include "Isosurface/IsopolygonExtraction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Polygons of a leaf at most: as many as are placed together.
constexpr std::int32_t LeafSize = 8;

/// Nodes of the whole tree below which a subtree is one task.
constexpr std::int32_t TaskSize = 1024;

/// Leaves whose memory is asked for before it is needed: what is read lies where the cells are in
/// memory, and takes longer to come than to compute with.
constexpr std::size_t LeavesAhead = 4;

/// An active node of the whole tree, in depth-first order.
struct Visit
{
  std::int32_t Node;
  std::int32_t Parent;       ///< the visit above, or -1
  std::int32_t Polygons = 0; ///< of it and all below
  std::int32_t End = 0;      ///< the visit behind those below it
};

/// A subtree that is made by one thread.
struct Task
{
  std::int32_t Node; ///< of the whole tree
  std::vector<Visit> Visits;
  std::vector<std::int32_t> Cells; ///< that have polygons, in the order of the leaves
  std::int32_t FirstPolygon = 0;
  std::vector<MinMaxTree::Node> Nodes; ///< children count from the first one
};

class ActiveTreeBuilder
{
public:
  ActiveTreeBuilder(const MinMaxTree& tree, const MinMaxRanges& ranges,
    const IsopolygonSource& source, RawVector<Isopolygon> memory)
    : Tree(tree)
    , Ranges(ranges)
    , Source(source)
  {
    this->Result.Polygons = std::move(memory);
    for (int i = 0; i < source.NumberOfValues; ++i)
    {
      this->Steps.push_back(ranges.GetStep(source.Values[i]));
    }
  }

  ActiveTree Build(int threads)
  {
    if (!this->Tree.Nodes.empty())
    {
      this->FindTasks(0, static_cast<std::int32_t>(this->Tree.Nodes.size()));
    }
    const int count = static_cast<int>(this->Tasks.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (int i = 0; i < count; ++i)
    {
      this->Count(this->Tasks[i]);
    }
    std::int32_t polygons = 0;
    for (Task& task : this->Tasks)
    {
      task.FirstPolygon = polygons;
      polygons += task.Visits.empty() ? 0 : task.Visits.front().Polygons;
    }
    this->Result.Polygons.resize(polygons);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (int i = 0; i < count; ++i)
    {
      this->Make(this->Tasks[i]);
    }
    this->Tasks.erase(std::remove_if(this->Tasks.begin(), this->Tasks.end(),
                        [](const Task& task) { return task.Nodes.empty(); }),
      this->Tasks.end());
    if (!this->Tasks.empty())
    {
      this->Join(0, this->Tasks.size());
    }
    return std::move(this->Result);
  }

private:
  bool IsActive(std::int32_t node) const
  {
    const MinMaxTree::Range range = this->Ranges.Nodes[node];
    const auto step = std::lower_bound(this->Steps.begin(), this->Steps.end(), range.Least);
    return step != this->Steps.end() && MinMaxRanges::Holds(range, *step);
  }

  /// Nodes [begin, end) are a node and all below it.
  void FindTasks(std::int32_t begin, std::int32_t end)
  {
    if (end - begin <= TaskSize)
    {
      this->Tasks.emplace_back();
      this->Tasks.back().Node = begin;
      return;
    }
    if (this->IsActive(begin))
    {
      const std::int32_t second = this->Tree.Nodes[begin].First;
      this->FindTasks(begin + 1, second);
      this->FindTasks(second, end);
    }
  }

  void Count(Task& task) const
  {
    this->FindVisits(task, task.Node, -1);
    std::vector<std::int32_t> leaves;
    for (std::size_t v = 0; v < task.Visits.size(); ++v)
    {
      if (this->Tree.Nodes[task.Visits[v].Node].Count > 0)
      {
        leaves.push_back(static_cast<std::int32_t>(v));
      }
    }
    for (std::size_t l = 0; l < leaves.size(); ++l)
    {
      // Points of a leaf farther ahead, scalars of one nearer.
      if (l + 2 * LeavesAhead < leaves.size())
      {
        this->ForEachCell(task, leaves[l + 2 * LeavesAhead],
          [this](std::int32_t cell) { __builtin_prefetch(this->GetPoints(cell)); });
      }
      if (l + LeavesAhead < leaves.size())
      {
        this->ForEachCell(task, leaves[l + LeavesAhead],
          [this](std::int32_t cell)
          {
            for (int i = 0; i < 4; ++i)
            {
              __builtin_prefetch(this->Source.Scalars + this->GetPoints(cell)[i]);
            }
          });
      }
      this->ForEachCell(task, leaves[l],
        [&](std::int32_t cell)
        {
          const std::int32_t polygons = this->CountPolygons(cell);
          task.Visits[leaves[l]].Polygons += polygons;
          if (polygons > 0)
          {
            task.Cells.push_back(cell);
          }
        });
    }
    for (std::size_t v = task.Visits.size(); v-- > 1;)
    {
      task.Visits[task.Visits[v].Parent].Polygons += task.Visits[v].Polygons;
    }
  }

  void FindVisits(Task& task, std::int32_t id, std::int32_t parent) const
  {
    if (!this->IsActive(id))
    {
      return;
    }
    const MinMaxTree::Node& node = this->Tree.Nodes[id];
    const auto visit = static_cast<std::int32_t>(task.Visits.size());
    task.Visits.push_back({ id, parent });
    if (node.Count == 0)
    {
      this->FindVisits(task, id + 1, visit);
      this->FindVisits(task, node.First, visit);
    }
    task.Visits[visit].End = static_cast<std::int32_t>(task.Visits.size());
  }

  template <class Call>
  void ForEachCell(const Task& task, std::int32_t visit, const Call& call) const
  {
    const MinMaxTree::Node& node = this->Tree.Nodes[task.Visits[visit].Node];
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      call(this->Tree.Cells[i]);
    }
  }

  const std::int32_t* GetPoints(std::int32_t cell) const
  {
    return this->Source.Cells + 4 * static_cast<std::int64_t>(cell);
  }

  std::int32_t CountPolygons(std::int32_t cell) const
  {
    const std::int32_t* points = this->GetPoints(cell);
    double least = std::numeric_limits<double>::infinity();
    double largest = -least;
    for (int i = 0; i < 4; ++i)
    {
      const double scalar = this->Source.Scalars[points[i]];
      if (!std::isfinite(scalar))
      {
        return 0;
      }
      least = std::min(least, scalar);
      largest = std::max(largest, scalar);
    }
    const double* end = this->Source.Values + this->Source.NumberOfValues;
    return static_cast<std::int32_t>(std::upper_bound(this->Source.Values, end, largest) -
      std::upper_bound(this->Source.Values, end, least));
  }

  void Make(Task& task)
  {
    if (task.Visits.empty() || task.Visits.front().Polygons == 0)
    {
      return;
    }
    constexpr std::size_t CellsAhead = 16;
    std::int32_t next = task.FirstPolygon;
    for (std::size_t c = 0; c < task.Cells.size(); ++c)
    {
      if (c + CellsAhead < task.Cells.size())
      {
        for (int i = 0; i < 4; ++i)
        {
          const std::int32_t point = this->GetPoints(task.Cells[c + CellsAhead])[i];
          __builtin_prefetch(this->Source.Points + 3 * static_cast<std::int64_t>(point));
          __builtin_prefetch(this->Source.Scalars + point);
        }
      }
      TETRALUX_ISA::ForEachIsopolygon(this->Source, task.Cells[c],
        [&](const Isopolygon& polygon) { this->Result.Polygons[next++] = polygon; });
    }
    next = task.FirstPolygon;
    this->MakeNodes(task, 0, next);
  }

  /// Makes the nodes of a visit that has polygons; next: the first of them, then the one behind.
  void MakeNodes(Task& task, std::int32_t visit, std::int32_t& next) const
  {
    for (;;)
    {
      const Visit& here = task.Visits[visit];
      const bool isLeaf = visit + 1 == here.End;
      if (isLeaf || here.Polygons <= LeafSize)
      {
        task.Nodes.push_back(this->MakeLeaf(next, here.Polygons));
        next += here.Polygons;
        return;
      }
      const std::int32_t first = visit + 1;
      const std::int32_t second = task.Visits[first].End;
      const bool hasSecond = second < here.End && task.Visits[second].Polygons > 0;
      if (hasSecond && task.Visits[first].Polygons > 0)
      {
        const std::size_t id = task.Nodes.size();
        task.Nodes.emplace_back();
        this->MakeNodes(task, first, next);
        const auto secondId = static_cast<std::int32_t>(task.Nodes.size());
        this->MakeNodes(task, second, next);
        task.Nodes[id] = Unite(task.Nodes[id + 1], task.Nodes[secondId], secondId);
        return;
      }
      visit = hasSecond ? second : first;
    }
  }

  MinMaxTree::Node MakeLeaf(std::int32_t first, std::int32_t count) const
  {
    double lower[3], upper[3];
    std::fill_n(lower, 3, std::numeric_limits<double>::infinity());
    std::fill_n(upper, 3, -std::numeric_limits<double>::infinity());
    for (std::int32_t i = first; i < first + count; ++i)
    {
      const Isopolygon& polygon = this->Result.Polygons[i];
      const double* corners[3] = { polygon.X, polygon.Y, polygon.Z };
      for (int a = 0; a < 3; ++a)
      {
        lower[a] = std::min(lower[a], *std::min_element(corners[a], corners[a] + 4));
        upper[a] = std::max(upper[a], *std::max_element(corners[a], corners[a] + 4));
      }
    }
    MinMaxTree::Node node;
    for (int a = 0; a < 3; ++a)
    {
      constexpr float Infinity = std::numeric_limits<float>::infinity();
      node.Lower[a] = std::nextafter(static_cast<float>(lower[a]), -Infinity);
      node.Upper[a] = std::nextafter(static_cast<float>(upper[a]), Infinity);
    }
    node.First = first;
    node.Count = count;
    return node;
  }

  static MinMaxTree::Node Unite(
    const MinMaxTree::Node& first, const MinMaxTree::Node& second, std::int32_t secondId)
  {
    MinMaxTree::Node node;
    for (int a = 0; a < 3; ++a)
    {
      node.Lower[a] = std::min(first.Lower[a], second.Lower[a]);
      node.Upper[a] = std::max(first.Upper[a], second.Upper[a]);
    }
    node.First = secondId;
    node.Count = 0;
    return node;
  }

  /// Appends the nodes of tasks [begin, end), halved by number: where the whole tree has its nodes
  /// matters little above so large subtrees, and none of them is empty.
  void Join(std::size_t begin, std::size_t end)
  {
    std::vector<MinMaxTree::Node>& nodes = this->Result.Nodes;
    if (end - begin == 1)
    {
      const auto offset = static_cast<std::int32_t>(nodes.size());
      for (MinMaxTree::Node node : this->Tasks[begin].Nodes)
      {
        node.First += node.Count == 0 ? offset : 0;
        nodes.push_back(node);
      }
      return;
    }
    const std::size_t id = nodes.size();
    nodes.emplace_back();
    const std::size_t middle = begin + (end - begin) / 2;
    this->Join(begin, middle);
    const auto second = static_cast<std::int32_t>(nodes.size());
    this->Join(middle, end);
    nodes[id] = Unite(nodes[id + 1], nodes[second], second);
  }

  const MinMaxTree& Tree;
  const MinMaxRanges& Ranges;
  const IsopolygonSource& Source;
  std::vector<std::int32_t> Steps; ///< of the values, ascending
  std::vector<Task> Tasks;
  ActiveTree Result;
};

} // namespace

ActiveTree MakeActiveTree(const MinMaxTree& tree, const MinMaxRanges& ranges,
  const IsopolygonSource& source, int threads, RawVector<Isopolygon> memory)
{
  return ActiveTreeBuilder(tree, ranges, source, std::move(memory)).Build(threads);
}

RawVector<CellField<1>> MakeScalarFields(
  const ActiveTree& tree, const IsopolygonSource& source, const double* scalars, int threads)
{
  const auto count = static_cast<std::int64_t>(tree.Polygons.size());
  RawVector<CellField<1>> fields(count);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i)
  {
    TETRALUX_ISA::MakeScalarField(source, scalars, tree.Polygons[i].Cell, fields[i]);
  }
  return fields;
}

RawVector<CellField<3>> MakeGradientFields(
  const ActiveTree& tree, const IsopolygonSource& source, const GradientRow* gradients, int threads)
{
  const auto count = static_cast<std::int64_t>(tree.Polygons.size());
  RawVector<CellField<3>> fields(count);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i)
  {
    TETRALUX_ISA::MakeGradientField(source, gradients, tree.Polygons[i].Cell, fields[i]);
  }
  return fields;
}

RawVector<GradientRow> MakePolygonGradients(const ActiveTree& tree, const TetrahedralMesh& mesh,
  Span<const double> scalars, double length, double scalar, int threads,
  RawVector<GradientRow> memory)
{
  const auto count = static_cast<std::int64_t>(tree.Polygons.size());
  RawVector<GradientRow> gradients = std::move(memory);
  gradients.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i)
  {
    gradients[i] = MakeCellGradient(mesh, scalars, tree.Polygons[i].Cell, length, scalar);
  }
  return gradients;
}

} // namespace tetralux
