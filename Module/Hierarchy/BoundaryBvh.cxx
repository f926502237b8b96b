// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/BoundaryBvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// A triangle on its way into the leaves.
struct BoxedTriangle
{
  Box Bounds;
  std::int32_t Id;
};

/// Of the triangles whose middles are in one bin.
struct Bin
{
  Box Bounds;
  std::int32_t Count = 0;
};

/// Subtrees of at least so many triangles are built by tasks of their own: some 0.1 ms.
constexpr std::int32_t TriangleTask = 512;

class Builder
{
public:
  Builder(Span<const float> points, Span<const std::int32_t> triangles, float margin)
    : Margin(margin)
    , Triangles(triangles.size() / 3)
  {
    const auto n = static_cast<std::int64_t>(this->Triangles.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t t = 0; t < n; ++t)
    {
      BoxedTriangle& triangle = this->Triangles[t];
      triangle.Id = static_cast<std::int32_t>(t);
      for (int c = 0; c < 3; ++c)
      {
        triangle.Bounds.Add(&points[4 * static_cast<std::size_t>(triangles[3 * t + c])]);
      }
    }
  }

  BoundaryBvh Build()
  {
    BoundaryBvh result;
    if (this->Triangles.empty())
    {
      return result;
    }
#pragma omp parallel
#pragma omp single
    this->BuildNode(0, static_cast<std::int32_t>(this->Triangles.size()), 0, result.Nodes);
    for (const BoxedTriangle& triangle : this->Triangles)
    {
      result.Triangles.push_back(triangle.Id);
    }
    return result;
  }

private:
  using Nodes = std::vector<BoundaryBvh::Node>;

  /// Appends the subtree of the triangles from begin to end.
  void BuildNode(std::int32_t begin, std::int32_t end, int depth, Nodes& nodes)
  {
    Box box;
    Box middles;
    for (std::int32_t i = begin; i < end; ++i)
    {
      const Box& b = this->Triangles[i].Bounds;
      box.Add(b);
      const float middle[3] = { b.Middle(0), b.Middle(1), b.Middle(2) };
      middles.Add(middle);
    }

    const std::size_t nodeId = nodes.size();
    BoundaryBvh::Node node{};
    SetBox(node, box, this->Margin);
    const bool leaf = end - begin <= LeafSize;
    node.First = leaf ? begin : 0;
    node.Count = leaf ? end - begin : 0;
    nodes.push_back(node);
    if (leaf)
    {
      return;
    }
    const std::int32_t split = this->Split(begin, end, middles, depth);
    if (end - begin < TriangleTask)
    {
      this->BuildNode(begin, split, depth + 1, nodes);
      nodes[nodeId].First = static_cast<std::int32_t>(nodes.size());
      this->BuildNode(split, end, depth + 1, nodes);
      return;
    }
    Nodes second;
#pragma omp task shared(second)
    this->BuildNode(split, end, depth + 1, second);
    this->BuildNode(begin, split, depth + 1, nodes);
#pragma omp taskwait
    const auto offset = static_cast<std::int32_t>(nodes.size());
    nodes[nodeId].First = offset;
    for (BoundaryBvh::Node& moved : second)
    {
      moved.First += moved.Count == 0 ? offset : 0;
    }
    nodes.insert(nodes.end(), second.begin(), second.end());
  }

  /// Orders the triangles from begin to end and returns where the second child begins.
  std::int32_t Split(std::int32_t begin, std::int32_t end, const Box& middles, int depth)
  {
    const auto first = this->Triangles.begin();
    std::array<std::array<Bin, NumberOfBins>, 3> bins;
    if (depth < BoundaryBvh::MaximumSahDepth)
    {
      for (std::int32_t i = begin; i < end; ++i)
      {
        const Box& b = this->Triangles[i].Bounds;
        for (int a = 0; a < 3; ++a)
        {
          Bin& bin = bins[a][FindBin(b, middles, a)];
          bin.Bounds.Add(b);
          ++bin.Count;
        }
      }
    }
    int axis = -1;
    int bin = 0;
    float bestCost = std::numeric_limits<float>::max();
    for (int a = 0; a < 3 && depth < BoundaryBvh::MaximumSahDepth; ++a)
    {
      if (!(middles.Lo[a] < middles.Hi[a]))
      {
        continue;
      }
      std::array<float, NumberOfBins> right{};
      Box sweep;
      std::int32_t count = 0;
      for (int k = NumberOfBins - 1; k > 0; --k)
      {
        sweep.Add(bins[a][k].Bounds);
        count += bins[a][k].Count;
        right[k] = count ? sweep.Area() * static_cast<float>(count) : -1.f;
      }
      sweep = Box();
      count = 0;
      for (int k = 1; k < NumberOfBins; ++k)
      {
        sweep.Add(bins[a][k - 1].Bounds);
        count += bins[a][k - 1].Count;
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
        [&](const BoxedTriangle& t) { return FindBin(t.Bounds, middles, axis) < bin; });
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
      [&](const BoxedTriangle& s, const BoxedTriangle& t)
      {
        const float a = s.Bounds.Middle(axis);
        const float b = t.Bounds.Middle(axis);
        return a != b ? a < b : s.Id < t.Id;
      });
    return half;
  }

  /// 0 where all middles are at one place along the axis.
  static int FindBin(const Box& b, const Box& middles, int a)
  {
    const float size = middles.Hi[a] - middles.Lo[a];
    const float x = size > 0 ? (b.Middle(a) - middles.Lo[a]) / size : 0.f;
    return std::min(NumberOfBins - 1, static_cast<int>(x * NumberOfBins));
  }

  float Margin;
  std::vector<BoxedTriangle> Triangles;
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
