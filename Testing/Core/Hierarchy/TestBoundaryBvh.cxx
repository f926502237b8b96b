// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/BoundaryBvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{

using tetralux::BoundaryBvh;
using tetralux::BuildBoundaryBvh;

/// Far smaller than any triangle that rays are sent through below.
constexpr float Margin = 1e-6f;

/// Triangles without common points.
struct Soup
{
  std::vector<float> Points;
  std::vector<std::int32_t> Triangles;

  int GetNumberOfTriangles() const { return static_cast<int>(this->Triangles.size() / 3); }

  const float* GetCorner(int triangle, int corner) const
  {
    return &this->Points[4 * this->Triangles[3 * triangle + corner]];
  }

  void Add(const std::array<std::array<double, 3>, 3>& corners)
  {
    for (const std::array<double, 3>& corner : corners)
    {
      this->Triangles.push_back(static_cast<std::int32_t>(this->Points.size() / 4));
      for (const double x : corner)
      {
        this->Points.push_back(static_cast<float>(x));
      }
      this->Points.push_back(std::numeric_limits<float>::quiet_NaN()); // not to be looked at
    }
  }
};

Soup MakeRandomSoup(int count, double size, std::uint64_t seed)
{
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Soup soup;
  for (int t = 0; t < count; ++t)
  {
    const std::array<double, 3> middle = { unit(generator), unit(generator), unit(generator) };
    std::array<std::array<double, 3>, 3> corners;
    for (auto& corner : corners)
    {
      for (int a = 0; a < 3; ++a)
      {
        corner[a] = middle[a] + size * unit(generator);
      }
    }
    soup.Add(corners);
  }
  return soup;
}

/// A triangle of the given size about a point.
std::array<std::array<double, 3>, 3> MakeTriangle(const std::array<double, 3>& middle, double size)
{
  const auto& m = middle;
  return { { { m[0] - size, m[1] - size, m[2] }, { m[0] + size, m[1] - size, m[2] + size },
    { m[0], m[1] + size, m[2] - size } } };
}

bool Contains(const BoundaryBvh::Node& node, const float* point)
{
  for (int a = 0; a < 3; ++a)
  {
    // Two floats, so that their difference is exact in double precision.
    const double distance = std::abs(static_cast<double>(point[a]) - node.Center[a]);
    if (!(distance <= node.Half[a]))
    {
      return false;
    }
  }
  return true;
}

/// Checks all that a traversal relies on; returns the depth of the tree.
int CheckTree(const Soup& soup, const BoundaryBvh& bvh)
{
  struct Item
  {
    std::int32_t Node;
    int Depth;
    std::vector<std::int32_t> Above; ///< ids of the nodes above
  };
  const std::int32_t numberOfNodes = static_cast<std::int32_t>(bvh.Nodes.size());
  std::vector<int> timesSeen(soup.GetNumberOfTriangles(), 0);
  std::vector<bool> isVisited(numberOfNodes, false);
  int depth = 0;
  std::vector<Item> stack;
  if (numberOfNodes > 0)
  {
    stack.push_back({ 0, 0, {} });
  }
  while (!stack.empty())
  {
    Item item = stack.back();
    stack.pop_back();
    if (item.Node < 0 || item.Node >= numberOfNodes || isVisited[item.Node])
    {
      ADD_FAILURE() << "node " << item.Node << " is no node, or has two parents";
      return depth;
    }
    isVisited[item.Node] = true;
    depth = std::max(depth, item.Depth);
    const BoundaryBvh::Node& node = bvh.Nodes[item.Node];
    item.Above.push_back(item.Node);
    if (node.Count == 0)
    {
      stack.push_back({ node.First, item.Depth + 1, item.Above });
      stack.push_back({ item.Node + 1, item.Depth + 1, std::move(item.Above) });
      continue;
    }
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      const std::int32_t triangle = bvh.Triangles.at(i);
      ++timesSeen.at(triangle);
      for (const std::int32_t above : item.Above)
      {
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_TRUE(Contains(bvh.Nodes[above], soup.GetCorner(triangle, c)))
            << "triangle " << triangle << " in node " << above;
        }
      }
    }
  }
  EXPECT_TRUE(std::all_of(timesSeen.begin(), timesSeen.end(), [](int n) { return n == 1; }));
  EXPECT_TRUE(std::all_of(isVisited.begin(), isVisited.end(), [](bool b) { return b; }));
  EXPECT_LE(depth, BoundaryBvh::MaximumDepth);
  return depth;
}

struct Ray
{
  double Origin[3];
  double Direction[3];
};

/// A line through the cube from -1 to 1.
Ray MakeRandomRay(std::mt19937_64& generator)
{
  std::uniform_real_distribution<double> unit(-1, 1);
  Ray ray;
  for (int a = 0; a < 3; ++a)
  {
    ray.Origin[a] = unit(generator);
    ray.Direction[a] = unit(generator);
  }
  return ray;
}

/// Whether the line of the ray goes through a triangle (Moeller and Trumbore 1997).
bool HitsTriangle(const Ray& ray, const Soup& soup, int triangle)
{
  double e1[3], e2[3], t[3];
  for (int a = 0; a < 3; ++a)
  {
    const double corner = soup.GetCorner(triangle, 0)[a];
    e1[a] = soup.GetCorner(triangle, 1)[a] - corner;
    e2[a] = soup.GetCorner(triangle, 2)[a] - corner;
    t[a] = ray.Origin[a] - corner;
  }
  const auto cross = [](const double* a, const double* b, double* c)
  {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
  };
  const auto dot = [](const double* a, const double* b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  double p[3], q[3];
  cross(ray.Direction, e2, p);
  cross(t, e1, q);
  const double determinant = dot(e1, p);
  const double u = dot(t, p) / determinant;
  const double v = dot(ray.Direction, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1;
}

bool HitsBox(const Ray& ray, const BoundaryBvh::Node& node)
{
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a)
  {
    const double lo = (node.Center[a] - node.Half[a] - ray.Origin[a]) / ray.Direction[a];
    const double hi = (node.Center[a] + node.Half[a] - ray.Origin[a]) / ray.Direction[a];
    begin = std::max(begin, std::min(lo, hi));
    end = std::min(end, std::max(lo, hi));
  }
  return begin <= end;
}

/// The triangles that a line hits, ascending; adds up how many were looked at.
std::vector<int> Traverse(
  const Ray& ray, const Soup& soup, const BoundaryBvh& bvh, std::int64_t& triangleTests)
{
  std::vector<int> hits;
  std::vector<std::int32_t> stack{ 0 };
  while (!stack.empty())
  {
    const std::int32_t nodeId = stack.back();
    stack.pop_back();
    const BoundaryBvh::Node& node = bvh.Nodes[nodeId];
    if (!HitsBox(ray, node))
    {
      continue;
    }
    if (node.Count == 0)
    {
      stack.push_back(node.First);
      stack.push_back(nodeId + 1);
      continue;
    }
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      ++triangleTests;
      if (HitsTriangle(ray, soup, bvh.Triangles[i]))
      {
        hits.push_back(bvh.Triangles[i]);
      }
    }
  }
  std::sort(hits.begin(), hits.end());
  return hits;
}

TEST(BoundaryBvh, NoTriangles)
{
  const BoundaryBvh bvh = BuildBoundaryBvh({}, {}, Margin);
  EXPECT_TRUE(bvh.Nodes.empty());
  EXPECT_TRUE(bvh.Triangles.empty());
}

TEST(BoundaryBvh, FewTriangles)
{
  for (int count = 1; count < 40; ++count)
  {
    const Soup soup = MakeRandomSoup(count, 0.1, count);
    CheckTree(soup, BuildBoundaryBvh(soup.Points, soup.Triangles, Margin));
  }
}

TEST(BoundaryBvh, FindsWhatBruteForceFinds)
{
  // Where all of them are looked at for all rays, what is the tree for? Small triangles are found
  // among few others.
  const struct
  {
    int Count;
    double Size;
    double LargestShareOfTests;
  } soups[] = { { 100, 1, 1 }, { 1000, 0.1, 0.1 }, { 5000, 0.02, 0.01 } };
  std::mt19937_64 generator(5);
  std::int64_t hits = 0;
  for (const auto& s : soups)
  {
    const Soup soup = MakeRandomSoup(s.Count, s.Size, s.Count);
    const BoundaryBvh bvh = BuildBoundaryBvh(soup.Points, soup.Triangles, Margin);
    CheckTree(soup, bvh);
    constexpr int NumberOfRays = 1000;
    std::int64_t triangleTests = 0;
    for (int r = 0; r < NumberOfRays; ++r)
    {
      const Ray ray = MakeRandomRay(generator);
      std::vector<int> expected;
      for (int t = 0; t < s.Count; ++t)
      {
        if (HitsTriangle(ray, soup, t))
        {
          expected.push_back(t);
        }
      }
      ASSERT_EQ(Traverse(ray, soup, bvh, triangleTests), expected);
      hits += static_cast<std::int64_t>(expected.size());
    }
    const double share = static_cast<double>(triangleTests) / NumberOfRays / s.Count;
    EXPECT_LE(share, s.LargestShareOfTests) << s.Count << " triangles";
  }
  EXPECT_GT(hits, 1000);
}

TEST(BoundaryBvh, TrianglesAtTheSamePlace)
{
  Soup soup;
  for (int t = 0; t < 20000; ++t)
  {
    soup.Add(MakeTriangle({ 0.3, -0.2, 0.1 }, 0.25));
  }
  const int depth = CheckTree(soup, BuildBoundaryBvh(soup.Points, soup.Triangles, Margin));
  EXPECT_LE(depth, 15); // halved by number
}

TEST(BoundaryBvh, TrianglesInsideEachOther)
{
  // Their middles coincide, their sizes go down to where single precision ends.
  Soup soup;
  for (int t = 0; t < 2000; ++t)
  {
    soup.Add(MakeTriangle({ 0, 0, 0 }, std::pow(10, -36. * t / 2000)));
  }
  CheckTree(soup, BuildBoundaryBvh(soup.Points, soup.Triangles, 0));
}

TEST(BoundaryBvh, SizesInGeometricProgression)
{
  // Each of 16 equal bins splits off few triangles at one end: the depth must be bounded by more
  // than luck.
  for (const double ratio : { 0.5, 0.9, 0.98, 0.995 })
  {
    Soup soup;
    double x = 1;
    for (int t = 0; t < 10000 && x > 1e-36; ++t)
    {
      soup.Add(MakeTriangle({ x, 0, 0 }, 0.1 * x));
      x *= ratio;
    }
    const BoundaryBvh bvh = BuildBoundaryBvh(soup.Points, soup.Triangles, 0);
    CheckTree(soup, bvh);
    std::int64_t triangleTests = 0;
    const Ray ray = { { 1, 0, -1 }, { 1e-9, 2e-9, 1 } };
    EXPECT_FALSE(Traverse(ray, soup, bvh, triangleTests).empty()) << "ratio " << ratio;
  }
}

TEST(BoundaryBvh, FlatAndThinSoups)
{
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int flatAxes = 1; flatAxes <= 3; ++flatAxes)
  {
    Soup soup;
    for (int t = 0; t < 3000; ++t)
    {
      std::array<std::array<double, 3>, 3> corners;
      for (auto& corner : corners)
      {
        for (int a = 0; a < 3; ++a)
        {
          corner[a] = a < flatAxes ? 0.7 : unit(generator);
        }
      }
      soup.Add(corners);
    }
    CheckTree(soup, BuildBoundaryBvh(soup.Points, soup.Triangles, Margin));
  }
}

} // namespace
