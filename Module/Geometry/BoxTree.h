// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoxTree_h
#define tetralux_BoxTree_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// An axis-aligned box.
struct Box
{
  std::array<double, 3> Low, High;

  bool Meets(const Box& other) const
  {
    return this->Low[0] <= other.High[0] && other.Low[0] <= this->High[0] &&
      this->Low[1] <= other.High[1] && other.Low[1] <= this->High[1] &&
      this->Low[2] <= other.High[2] && other.Low[2] <= this->High[2];
  }
  Box Join(const Box& other) const
  {
    Box box;
    for (int a = 0; a < 3; ++a)
    {
      box.Low[a] = std::min(this->Low[a], other.Low[a]);
      box.High[a] = std::max(this->High[a], other.High[a]);
    }
    return box;
  }
  /// A measure of how often a box is met that, other than its surface, tells flat boxes apart.
  double GetSize() const
  {
    return (this->High[0] - this->Low[0]) + (this->High[1] - this->Low[1]) +
      (this->High[2] - this->Low[2]);
  }
};

/// A binary tree of boxes, each with a number, that come and go.
class BoxTree
{
public:
  /// Returns what Remove wants.
  std::int32_t Insert(const Box& box, std::int32_t number)
  {
    const std::int32_t leaf = this->NewNode();
    this->Nodes[leaf].Bounds = box;
    this->Nodes[leaf].Number = number;
    if (this->Root < 0)
    {
      this->Root = leaf;
      return leaf;
    }
    // Down to where the boxes grow the least.
    std::int32_t sibling = this->Root;
    while (this->Nodes[sibling].Children[0] >= 0)
    {
      const Node& node = this->Nodes[sibling];
      const double joined = node.Bounds.Join(box).GetSize();
      const double inherited = joined - node.Bounds.GetSize();
      double best = joined;
      std::int32_t next = -1;
      for (const std::int32_t child : node.Children)
      {
        const Node& other = this->Nodes[child];
        const double size = other.Bounds.Join(box).GetSize();
        const double cost =
          inherited + size - (other.Children[0] >= 0 ? other.Bounds.GetSize() : 0);
        if (cost < best)
        {
          best = cost;
          next = child;
        }
      }
      if (next < 0)
      {
        break;
      }
      sibling = next;
    }

    const std::int32_t parent = this->NewNode();
    const std::int32_t above = this->Nodes[sibling].Parent;
    this->Nodes[parent].Parent = above;
    this->Nodes[parent].Children = { sibling, leaf };
    this->Nodes[sibling].Parent = parent;
    this->Nodes[leaf].Parent = parent;
    this->Replace(above, sibling, parent);
    this->Refit(parent);
    return leaf;
  }

  void Remove(std::int32_t leaf)
  {
    const std::int32_t parent = this->Nodes[leaf].Parent;
    this->Free.push_back(leaf);
    if (parent < 0)
    {
      this->Root = -1;
      return;
    }
    const auto& children = this->Nodes[parent].Children;
    const std::int32_t sibling = children[0] == leaf ? children[1] : children[0];
    const std::int32_t above = this->Nodes[parent].Parent;
    this->Nodes[sibling].Parent = above;
    this->Replace(above, parent, sibling);
    this->Refit(above);
    this->Free.push_back(parent);
  }

  /// Calls accept(number) for each box that meets the given one until it returns false; returns
  /// whether it never did.
  template <class Accept>
  bool ForEach(const Box& box, const Accept& accept) const
  {
    this->Stack.clear();
    if (this->Root >= 0)
    {
      this->Stack.push_back(this->Root);
    }
    while (!this->Stack.empty())
    {
      const Node& node = this->Nodes[this->Stack.back()];
      this->Stack.pop_back();
      if (!node.Bounds.Meets(box))
      {
        continue;
      }
      if (node.Children[0] >= 0)
      {
        this->Stack.insert(this->Stack.end(), node.Children.begin(), node.Children.end());
      }
      else if (!accept(node.Number))
      {
        return false;
      }
    }
    return true;
  }

private:
  struct Node
  {
    Box Bounds;
    std::int32_t Parent = -1;
    std::array<std::int32_t, 2> Children = { -1, -1 };
    std::int32_t Number = -1;
  };

  std::int32_t NewNode()
  {
    if (this->Free.empty())
    {
      this->Nodes.emplace_back();
      return static_cast<std::int32_t>(this->Nodes.size()) - 1;
    }
    const std::int32_t node = this->Free.back();
    this->Free.pop_back();
    this->Nodes[node] = Node();
    return node;
  }

  void Replace(std::int32_t parent, std::int32_t child, std::int32_t replacement)
  {
    if (parent < 0)
    {
      this->Root = replacement;
      return;
    }
    auto& children = this->Nodes[parent].Children;
    children[children[0] == child ? 0 : 1] = replacement;
  }

  void Refit(std::int32_t node)
  {
    for (; node >= 0; node = this->Nodes[node].Parent)
    {
      const auto& children = this->Nodes[node].Children;
      this->Nodes[node].Bounds =
        this->Nodes[children[0]].Bounds.Join(this->Nodes[children[1]].Bounds);
    }
  }

  std::vector<Node> Nodes;
  std::vector<std::int32_t> Free;
  std::int32_t Root = -1;
  mutable std::vector<std::int32_t> Stack;
};

} // namespace tetralux

#endif
