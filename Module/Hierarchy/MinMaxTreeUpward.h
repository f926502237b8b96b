// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MinMaxTreeUpward_h
#define tetralux_MinMaxTreeUpward_h

#include "Hierarchy/MinMaxTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <omp.h>

namespace tetralux
{

/// numberOfThreads: 0 is as many as OpenMP offers.
inline int CountThreads(int numberOfThreads)
{
  return numberOfThreads > 0 ? numberOfThreads : omp_get_max_threads();
}

/// Nodes of a tree from Begin to End: a node and all below it.
struct NodeSpan
{
  std::int32_t Begin;
  std::int32_t End;
};

/// Asks memory for the cells of a leaf that is visited some leaves after this one. Cells of leaves
/// are scattered over the mesh, so the processor does not foresee where it will read.
inline void PrefetchCells(
  const MinMaxTree& tree, const TetrahedralMesh& mesh, const MinMaxTree::Node& leaf)
{
  // Cells: about as long as memory takes to answer. Twice and half as many are as fast.
  constexpr std::int32_t Distance = 64;
  for (std::int32_t i = std::max(0, leaf.First - Distance); i < leaf.First - Distance + leaf.Count;
       ++i)
  {
    __builtin_prefetch(&mesh.Cells[std::size_t{ 4 } * tree.Cells[i]]);
  }
}

/// Calls visit(node id) once for each node of a tree, children before their parents. Subtrees are
/// visited in parallel, the few nodes above them by one thread (section 6.2 of the paper).
template <class Visit>
void VisitUpward(const MinMaxTree& tree, int numberOfThreads, const Visit& visit)
{
  // Nodes of a subtree at most: some tens of microseconds of work.
  constexpr std::int32_t SubtreeSize = 2048;
  std::vector<NodeSpan> subtrees;
  std::vector<std::int32_t> above;
  std::vector<NodeSpan> stack;
  if (!tree.Nodes.empty())
  {
    stack.push_back({ 0, static_cast<std::int32_t>(tree.Nodes.size()) });
  }
  while (!stack.empty())
  {
    const NodeSpan span = stack.back();
    stack.pop_back();
    if (span.End - span.Begin <= SubtreeSize)
    {
      subtrees.push_back(span);
      continue;
    }
    // The nodes below a node follow it, those of the second child last.
    const std::int32_t second = tree.Nodes[span.Begin].First;
    above.push_back(span.Begin);
    stack.push_back({ second, span.End });
    stack.push_back({ span.Begin + 1, second });
  }

  const auto numberOfSubtrees = static_cast<std::int64_t>(subtrees.size());
#pragma omp parallel for schedule(dynamic) num_threads(numberOfThreads)
  for (std::int64_t i = 0; i < numberOfSubtrees; ++i)
  {
    for (std::int32_t node = subtrees[i].End; node-- > subtrees[i].Begin;)
    {
      visit(node);
    }
  }
  for (auto node = above.rbegin(); node != above.rend(); ++node)
  {
    visit(*node);
  }
}

} // namespace tetralux

#endif
