// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/BoundaryBvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace tetralux
{
namespace
{

constexpr int NumberOfBins = 16;
constexpr int LeafSize = 4;

struct Box
{
  std::array<float, 3> Lo;
  std::array<float, 3> Hi;

  Box()
  {
    this->Lo.fill(std::numeric_limits<float>::max());
    this->Hi.fill(std::numeric_limits<float>::lowest());
  }
  void Add(const Box& b)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Lo[a] = std::min(this->Lo[a], b.Lo[a]);
      this->Hi[a] = std::max(this->Hi[a], b.Hi[a]);
    }
  }
  void Add(const float* p)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Lo[a] = std::min(this->Lo[a], p[a]);
      this->Hi[a] = std::max(this->Hi[a], p[a]);
    }
  }
  float Area() const
  {
    const float x = this->Hi[0] - this->Lo[0];
    const float y = this->Hi[1] - this->Lo[1];
    const float z = this->Hi[2] - this->Lo[2];
    return x * y + y * z + z * x;
  }
  float Middle(int a) const { return 0.5f * (this->Lo[a] + this->Hi[a]); }
};

/// What is stored of a box.
void SetBox(BoundaryBvh::Node& node, const Box& box, float margin)
{
  for (int a = 0; a < 3; ++a)
  {
    node.Center[a] = box.Middle(a);
    // The middle is rounded: measure the half edge from what it became, and round it up.
    const float half = std::max(box.Hi[a] - node.Center[a], node.Center[a] - box.Lo[a]);
    node.Half[a] = std::nextafter(half, std::numeric_limits<float>::max()) + margin;
  }
}

class Builder
{
public:
  Builder(Span<const float> points, Span<const std::int32_t> triangles, float margin)
    : Margin(margin)
  {
    const std::size_t n = triangles.size() / 3;
    this->Boxes.resize(n);
    for (std::size_t t = 0; t < n; ++t)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->Boxes[t].Add(&points[4 * static_cast<std::size_t>(triangles[3 * t + c])]);
      }
    }
    this->Result.Triangles.resize(n);
    std::iota(this->Result.Triangles.begin(), this->Result.Triangles.end(), 0);
    this->Result.Nodes.reserve(n);
  }

  BoundaryBvh Build()
  {
    if (!this->Boxes.empty())
    {
      this->BuildNode(0, static_cast<std::int32_t>(this->Boxes.size()), 0);
    }
    return std::move(this->Result);
  }

private:
  void BuildNode(std::int32_t begin, std::int32_t end, int depth)
  {
    Box box;
    Box middles;
    for (std::int32_t i = begin; i < end; ++i)
    {
      const Box& b = this->Boxes[this->Result.Triangles[i]];
      box.Add(b);
      const float middle[3] = { b.Middle(0), b.Middle(1), b.Middle(2) };
      middles.Add(middle);
    }

    const std::size_t nodeId = this->Result.Nodes.size();
    BoundaryBvh::Node node{};
    SetBox(node, box, this->Margin);
    const bool leaf = end - begin <= LeafSize;
    node.First = leaf ? begin : 0;
    node.Count = leaf ? end - begin : 0;
    this->Result.Nodes.push_back(node);
    if (leaf)
    {
      return;
    }
    const std::int32_t split = this->Split(begin, end, middles, depth);
    this->BuildNode(begin, split, depth + 1);
    this->Result.Nodes[nodeId].First = static_cast<std::int32_t>(this->Result.Nodes.size());
    this->BuildNode(split, end, depth + 1);
  }

  /// Orders the triangles from begin to end and returns where the second child begins.
  std::int32_t Split(std::int32_t begin, std::int32_t end, const Box& middles, int depth)
  {
    const auto first = this->Result.Triangles.begin();
    int axis = -1;
    int bin = 0;
    float bestCost = std::numeric_limits<float>::max();
    for (int a = 0; a < 3 && depth < BoundaryBvh::MaximumSahDepth; ++a)
    {
      if (!(middles.Lo[a] < middles.Hi[a]))
      {
        continue;
      }
      std::array<Box, NumberOfBins> boxes;
      std::array<std::int32_t, NumberOfBins> counts{};
      for (std::int32_t i = begin; i < end; ++i)
      {
        const Box& b = this->Boxes[first[i]];
        const int k = this->Bin(b, middles, a);
        boxes[k].Add(b);
        ++counts[k];
      }
      std::array<float, NumberOfBins> right{};
      Box sweep;
      std::int32_t count = 0;
      for (int k = NumberOfBins - 1; k > 0; --k)
      {
        sweep.Add(boxes[k]);
        count += counts[k];
        right[k] = count ? sweep.Area() * static_cast<float>(count) : -1.f;
      }
      sweep = Box();
      count = 0;
      for (int k = 1; k < NumberOfBins; ++k)
      {
        sweep.Add(boxes[k - 1]);
        count += counts[k - 1];
        if (count == 0 || right[k] < 0)
        {
          continue;
        }
        const float cost = sweep.Area() * static_cast<float>(count) + right[k];
        if (cost < bestCost)
        {
          bestCost = cost;
          axis = a;
          bin = k;
        }
      }
    }
    if (axis >= 0)
    {
      const auto middle = std::partition(first + begin, first + end,
        [&](std::int32_t t) { return this->Bin(this->Boxes[t], middles, axis) < bin; });
      return static_cast<std::int32_t>(middle - first);
    }
    // All middles coincide, or the tree is too deep: halve by number along the longest edge.
    axis = 0;
    for (int a = 1; a < 3; ++a)
    {
      if (middles.Hi[a] - middles.Lo[a] > middles.Hi[axis] - middles.Lo[axis])
      {
        axis = a;
      }
    }
    const std::int32_t half = begin + (end - begin) / 2;
    std::nth_element(first + begin, first + half, first + end,
      [&](std::int32_t s, std::int32_t t)
      {
        const float a = this->Boxes[s].Middle(axis);
        const float b = this->Boxes[t].Middle(axis);
        return a != b ? a < b : s < t;
      });
    return half;
  }

  int Bin(const Box& b, const Box& middles, int a) const
  {
    const float x = (b.Middle(a) - middles.Lo[a]) / (middles.Hi[a] - middles.Lo[a]);
    return std::min(NumberOfBins - 1, static_cast<int>(x * NumberOfBins));
  }

  float Margin;
  std::vector<Box> Boxes;
  BoundaryBvh Result;
};

} // namespace

BoundaryBvh BuildBoundaryBvh(
  Span<const float> points, Span<const std::int32_t> triangles, float margin)
{
  return Builder(points, triangles, margin).Build();
}

void RefitBoundaryBvh(
  BoundaryBvh& bvh, Span<const float> points, Span<const std::int32_t> triangles, float margin)
{
  // Children stand behind their parents.
  std::vector<Box> boxes(bvh.Nodes.size());
  for (std::size_t n = bvh.Nodes.size(); n-- > 0;)
  {
    BoundaryBvh::Node& node = bvh.Nodes[n];
    if (node.Count == 0)
    {
      boxes[n].Add(boxes[n + 1]);
      boxes[n].Add(boxes[node.First]);
    }
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      const std::int32_t* corners = &triangles[3 * static_cast<std::size_t>(bvh.Triangles[i])];
      for (int c = 0; c < 3; ++c)
      {
        boxes[n].Add(&points[4 * static_cast<std::size_t>(corners[c])]);
      }
    }
    SetBox(node, boxes[n], margin);
  }
}

} // namespace tetralux
