// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MinMaxTreeBuilder_h
#define tetralux_MinMaxTreeBuilder_h

#include "Base/CountingSort.h"
#include "Hierarchy/MinMaxTree.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tetralux
{

/// The box around the middles of cells.
struct MiddleBox
{
  std::array<float, 3> Lower;
  std::array<float, 3> Upper;

  /// items: at least one.
  template <class Item>
  MiddleBox(const Item* begin, const Item* end)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Lower[a] = this->Upper[a] = begin->GetMiddle(a);
    }
    for (const Item* item = begin + 1; item < end; ++item)
    {
      for (int a = 0; a < 3; ++a)
      {
        const float x = item->GetMiddle(a);
        this->Lower[a] = std::min(this->Lower[a], x);
        this->Upper[a] = std::max(this->Upper[a], x);
      }
    }
  }

  int GetLongestAxis() const
  {
    int longest = 0;
    for (int a = 1; a < 3; ++a)
    {
      // Halves: the edge of a box from end to end of single precision would overflow.
      if (0.5f * this->Upper[a] - 0.5f * this->Lower[a] >
        0.5f * this->Upper[longest] - 0.5f * this->Lower[longest])
      {
        longest = a;
      }
    }
    return longest;
  }
};

/// Orders items so that those which isFirst(item) holds for come first; returns where the others
/// begin. Without a branch that the processor would have to guess.
template <class Item, class IsFirst>
Item* PartitionItems(Item* begin, Item* end, const IsFirst& isFirst)
{
  Item* middle = begin;
  for (Item* item = begin; item < end; ++item)
  {
    const Item moved = *item;
    *item = *middle;
    *middle = moved;
    middle += isFirst(moved) ? 1 : 0;
  }
  return middle;
}

/// The first half of the items is the lower one along the longest edge of the box.
template <class Item>
Item* HalveByNumber(Item* begin, Item* end, const MiddleBox& box)
{
  const int axis = box.GetLongestAxis();
  Item* half = begin + (end - begin) / 2;
  std::nth_element(begin, half, end,
    [axis](const Item& s, const Item& t)
    {
      const float a = s.GetMiddle(axis);
      const float b = t.GetMiddle(axis);
      return a != b ? a < b : s.Cell < t.Cell;
    });
  return half;
}

/// Which cells the nodes of a tree have; boxes are not set. Item stands for a cell: Item::Cell is
/// its id, Item::GetMiddle(axis) the middle of its box. split(begin, end, box of the middles)
/// orders items and returns where the second child begins; begin or end where it finds no way.
///
/// The upper levels are divided by tasks, the subtrees below them are built by one task each. What
/// is a subtree does not depend on threads, so the tree does not.
template <class Item, class Split>
class MinMaxTreeBuilder
{
public:
  /// items: one for each cell.
  MinMaxTreeBuilder(
    std::unique_ptr<Item[]> items, std::int64_t size, const Split& split, int leafSize)
    : Items(std::move(items))
    , Size(size)
    , DivideItems(split)
    , LeafSize(leafSize)
  {
  }

  MinMaxTree Build(int numberOfThreads)
  {
    MinMaxTree tree;
    if (this->Size == 0)
    {
      return tree;
    }
    Part root;
    root.End = this->Size;
#pragma omp parallel num_threads(numberOfThreads)
#pragma omp single
    this->BuildPart(root);

    std::vector<const Part*> parts;
    tree.Nodes.resize(Place(root, 0, parts));
    const auto numberOfParts = static_cast<std::int64_t>(parts.size());
#pragma omp parallel for schedule(dynamic) num_threads(numberOfThreads)
    for (std::int64_t i = 0; i < numberOfParts; ++i)
    {
      MinMaxTree::Node* node = &tree.Nodes[parts[i]->FirstNode];
      for (const MinMaxTree::Node& local : parts[i]->Nodes)
      {
        *node = local;
        node->First += local.Count == 0 ? parts[i]->FirstNode : 0;
        ++node;
      }
    }
    tree.Cells.resize(this->Size);
#pragma omp parallel for schedule(static) num_threads(numberOfThreads)
    for (std::int64_t i = 0; i < this->Size; ++i)
    {
      tree.Cells[i] = this->Items[i].Cell;
    }
    return tree;
  }

private:
  /// Cells that one task builds a subtree of: about a millisecond of work.
  static constexpr std::int64_t PartSize = 8192;

  /// A subtree, or a node of the levels above the subtrees.
  struct Part
  {
    std::int64_t Begin = 0; ///< items
    std::int64_t End = 0;
    int Depth = 0;
    std::unique_ptr<Part> Children[2];   ///< none: this is a subtree
    std::vector<MinMaxTree::Node> Nodes; ///< First of inner ones as if the first node were node 0
    std::int32_t FirstNode = 0;
  };

  void BuildPart(Part& part)
  {
    if (part.End - part.Begin <= PartSize)
    {
      this->BuildSubtree(part.Nodes, part.Begin, part.End, part.Depth);
      return;
    }
    part.Nodes.resize(1);
    const std::int64_t middle = this->Divide(part.Begin, part.End, part.Depth);
    for (int c = 0; c < 2; ++c)
    {
      part.Children[c] = std::make_unique<Part>();
      Part* child = part.Children[c].get();
      child->Begin = c == 0 ? part.Begin : middle;
      child->End = c == 0 ? middle : part.End;
      child->Depth = part.Depth + 1;
#pragma omp task firstprivate(child)
      this->BuildPart(*child);
    }
  }

  void BuildSubtree(
    std::vector<MinMaxTree::Node>& nodes, std::int64_t begin, std::int64_t end, int depth)
  {
    const std::size_t nodeId = nodes.size();
    nodes.emplace_back();
    if (end - begin <= this->LeafSize)
    {
      nodes[nodeId].First = static_cast<std::int32_t>(begin);
      nodes[nodeId].Count = static_cast<std::int32_t>(end - begin);
      return;
    }
    const std::int64_t middle = this->Divide(begin, end, depth);
    this->BuildSubtree(nodes, begin, middle, depth + 1);
    nodes[nodeId].First = static_cast<std::int32_t>(nodes.size());
    this->BuildSubtree(nodes, middle, end, depth + 1);
  }

  /// Orders the items from begin to end and returns where the second child begins.
  std::int64_t Divide(std::int64_t begin, std::int64_t end, int depth)
  {
    Item* items = this->Items.get();
    const MiddleBox box(items + begin, items + end);
    // Levels that halving takes down to one cell: they must be left for the larger child.
    int levels = 0;
    while (end - begin > std::int64_t{ 1 } << levels)
    {
      ++levels;
    }
    Item* middle = items + begin;
    if (depth + 1 + levels <= MinMaxTree::MaximumDepth)
    {
      middle = this->DivideItems(items + begin, items + end, box);
    }
    if (middle == items + begin || middle == items + end)
    {
      middle = HalveByNumber(items + begin, items + end, box);
    }
    return middle - items;
  }

  /// Sets where the nodes of parts stand in the tree, depth first; lists the parts. Returns where
  /// the next part's nodes begin.
  static std::int32_t Place(Part& part, std::int32_t firstNode, std::vector<const Part*>& parts)
  {
    parts.push_back(&part);
    part.FirstNode = firstNode;
    const std::int32_t next = firstNode + static_cast<std::int32_t>(part.Nodes.size());
    if (!part.Children[0])
    {
      return next;
    }
    const std::int32_t second = Place(*part.Children[0], next, parts);
    part.Nodes[0].First = second - firstNode;
    return Place(*part.Children[1], second, parts);
  }

  std::unique_ptr<Item[]> Items;
  std::int64_t Size;
  Split DivideItems;
  int LeafSize;
};

} // namespace tetralux

#endif
