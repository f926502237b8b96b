// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/MinMaxTree.h"

#include "Generate/GeneratedMeshes.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

constexpr TreeBuild Builds[] = { TreeBuild::SpatialMedian, TreeBuild::SurfaceArea };

/// Boxes are of (x - Center) / Radius.
struct Frame
{
  double Center[3] = { 0, 0, 0 };
  double Radius = 1;
};

MinMaxTree Build(const TetrahedralMesh& mesh, const Frame& frame, TreeBuild build, int leafSize = 8)
{
  MinMaxTreeOptions options;
  options.Build = build;
  options.LeafSize = leafSize;
  return BuildMinMaxTree(mesh, frame.Center, frame.Radius, options);
}

/// A tetrahedron that shares no point with others.
void AddTetrahedron(TetrahedralMesh& mesh, const double (&middle)[3], double size)
{
  constexpr double Corners[4][3] = { { -1, -1, -1 }, { 1, 1, -1 }, { 1, -1, 1 }, { -1, 1, 1 } };
  for (const auto& corner : Corners)
  {
    mesh.Cells.push_back(static_cast<std::int32_t>(mesh.GetNumberOfPoints()));
    for (int a = 0; a < 3; ++a)
    {
      mesh.Points.push_back(middle[a] + size * corner[a]);
    }
  }
}

/// For each node the end of the nodes below it; -1 where no node of the tree leads to it. Checks
/// the depth, and that nodes stand depth first.
class TreeWalk
{
public:
  explicit TreeWalk(const MinMaxTree& tree)
    : Tree(tree)
    , Ends(tree.Nodes.size(), -1)
  {
    if (!tree.Nodes.empty())
    {
      EXPECT_EQ(this->Walk(0, 0), static_cast<std::int32_t>(tree.Nodes.size()));
    }
  }

  int Depth = 0;

  /// Cells of a node, in the order of the leaves.
  std::vector<std::int32_t> GetCells(std::int32_t node) const
  {
    std::vector<std::int32_t> cells;
    for (std::int32_t n = node; n < this->Ends[node]; ++n)
    {
      const std::int32_t* first = this->Tree.Cells.data() + this->Tree.Nodes[n].First;
      cells.insert(cells.end(), first, first + this->Tree.Nodes[n].Count);
    }
    return cells;
  }

private:
  std::int32_t Walk(std::int32_t nodeId, int depth)
  {
    this->Depth = std::max(this->Depth, depth);
    const MinMaxTree::Node& node = this->Tree.Nodes.at(nodeId);
    std::int32_t end = nodeId + 1;
    if (node.Count == 0)
    {
      end = this->Walk(nodeId + 1, depth + 1);
      EXPECT_EQ(node.First, end);
      end = this->Walk(node.First, depth + 1);
    }
    return this->Ends[nodeId] = end;
  }

  const MinMaxTree& Tree;
  std::vector<std::int32_t> Ends;
};

/// Checks all that a traversal relies on; returns the depth of the tree.
int CheckTree(const TetrahedralMesh& mesh, const Frame& frame, const MinMaxTree& tree, int leafSize)
{
  std::vector<std::int32_t> sorted = tree.Cells;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> expected(mesh.GetNumberOfCells());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(sorted, expected);

  const TreeWalk walk(tree);
  EXPECT_LE(walk.Depth, MinMaxTree::MaximumDepth);
  std::int32_t firstCell = 0;
  std::int64_t pointsOutside = 0;
  for (std::size_t n = 0; n < tree.Nodes.size(); ++n)
  {
    const MinMaxTree::Node& node = tree.Nodes[n];
    if (node.Count > 0)
    {
      EXPECT_EQ(node.First, firstCell);
      EXPECT_LE(node.Count, leafSize);
      firstCell += node.Count;
    }
    for (const std::int32_t cell : walk.GetCells(static_cast<std::int32_t>(n)))
    {
      for (int corner = 0; corner < 4; ++corner)
      {
        for (int a = 0; a < 3; ++a)
        {
          const double x =
            (mesh.Points[3 * mesh.Cells[4 * cell + corner] + a] - frame.Center[a]) / frame.Radius;
          pointsOutside += node.Lower[a] <= x && x <= node.Upper[a] ? 0 : 1;
        }
      }
    }
  }
  EXPECT_EQ(pointsOutside, 0);
  EXPECT_EQ(firstCell, static_cast<std::int32_t>(tree.Cells.size()));
  return walk.Depth;
}

/// Leaves that a random line through the root's box meets on average: sum of the leaves' areas over
/// the area of the root.
double CountLeavesOnLine(const MinMaxTree& tree)
{
  const auto getArea = [](const MinMaxTree::Node& node)
  {
    const double x = node.Upper[0] - node.Lower[0];
    const double y = node.Upper[1] - node.Lower[1];
    const double z = node.Upper[2] - node.Lower[2];
    return x * y + y * z + z * x;
  };
  double sum = 0;
  for (const MinMaxTree::Node& node : tree.Nodes)
  {
    sum += node.Count > 0 ? getArea(node) : 0;
  }
  return sum / getArea(tree.Nodes[0]);
}

/// Whether a surface of a value crosses a cell.
bool Crosses(const TetrahedralMesh& mesh, Span<const double> scalars, std::int32_t cell, double v)
{
  int below = 0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double s = scalars[mesh.Cells[4 * cell + corner]];
    if (!std::isfinite(s))
    {
      return false;
    }
    below += s < v ? 1 : 0;
  }
  return below > 0 && below < 4;
}

/// Checks that each node holds the values whose surfaces cross its cells, and that its range is
/// that of the scalars of its cells.
void CheckRanges(const TetrahedralMesh& mesh, Span<const double> scalars, const MinMaxTree& tree,
  const std::vector<double>& values)
{
  const MinMaxRanges ranges = MakeMinMaxRanges(tree, mesh, scalars, 0);
  ASSERT_EQ(ranges.Nodes.size(), tree.Nodes.size());
  ASSERT_TRUE(std::isfinite(ranges.Offset));
  ASSERT_TRUE(std::isfinite(ranges.Scale));
  const TreeWalk walk(tree);
  std::int64_t missed = 0;
  std::int64_t loose = 0;
  for (std::size_t n = 0; n < tree.Nodes.size(); ++n)
  {
    const MinMaxTree::Range range = ranges.Nodes[n];
    double least = Infinity;
    double largest = -Infinity;
    std::vector<bool> isCrossed(values.size(), false);
    for (const std::int32_t cell : walk.GetCells(static_cast<std::int32_t>(n)))
    {
      double sum = 0;
      for (int corner = 0; corner < 4; ++corner)
      {
        sum += scalars[mesh.Cells[4 * cell + corner]] * 0;
      }
      if (sum != 0)
      {
        continue; // a scalar is not finite
      }
      for (int corner = 0; corner < 4; ++corner)
      {
        least = std::min(least, scalars[mesh.Cells[4 * cell + corner]]);
        largest = std::max(largest, scalars[mesh.Cells[4 * cell + corner]]);
      }
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        isCrossed[k] = isCrossed[k] || Crosses(mesh, scalars, cell, values[k]);
      }
    }
    if (least > largest)
    {
      EXPECT_GT(range.Least, range.Largest);
      continue;
    }
    loose += range.Least == ranges.GetStep(least) ? 0 : 1;
    loose += range.Largest == ranges.GetStep(largest) ? 0 : 1;
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      const bool holds = MinMaxRanges::Holds(range, ranges.GetStep(values[k]));
      missed += isCrossed[k] && !holds ? 1 : 0;
    }
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(loose, 0);
}

/// Some scalars of points, numbers between them, and numbers outside of all.
std::vector<double> MakeValues(Span<const double> scalars)
{
  std::vector<double> finite;
  std::copy_if(scalars.begin(), scalars.end(), std::back_inserter(finite),
    [](double s) { return std::isfinite(s); });
  std::sort(finite.begin(), finite.end());
  const double least = finite.front();
  const double largest = finite.back();
  std::vector<double> values = { least, largest, std::nextafter(least, -Infinity),
    std::nextafter(least, Infinity), std::nextafter(largest, -Infinity),
    std::nextafter(largest, Infinity) };
  constexpr int NumberOfValues = 20;
  for (int k = 0; k < NumberOfValues; ++k)
  {
    values.push_back(finite[finite.size() * k / NumberOfValues]);
    const double share = (k + 0.5) / NumberOfValues;
    values.push_back((1 - share) * least + share * largest);
  }
  return values;
}

template <class T>
bool IsSame(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(MinMaxTree, HasNothingWithoutCells)
{
  for (const TreeBuild build : Builds)
  {
    MinMaxTree tree = Build({}, {}, build);
    EXPECT_TRUE(tree.Nodes.empty());
    EXPECT_TRUE(tree.Cells.empty());
    RefitMinMaxTree(tree, {}, Frame().Center, 1, 0);
    EXPECT_TRUE(tree.Nodes.empty());
    EXPECT_TRUE(MakeMinMaxRanges(tree, {}, {}, 0).Nodes.empty());
  }
}

TEST(MinMaxTree, HoldsEachCellOnce)
{
  const Frame frame = { { 0.5, 0.4, 0.3 }, 1.7 };
  const std::pair<const char*, std::map<std::string, double>> meshes[] = {
    { "random", { { "cells", 14 } } },
    { "boundary-layer", { { "cells", 8 }, { "layers", 40 } } },
    { "cubes", { { "cells", 4 } } },
  };
  for (const auto& [name, parameters] : meshes)
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, name);
    const TetrahedralMesh mesh = GenerateMesh(name, parameters).Mesh;
    for (const TreeBuild build : Builds)
    {
      for (const int leafSize : { 1, 8, 13 })
      {
        CheckTree(mesh, frame, Build(mesh, frame, build, leafSize), leafSize);
      }
    }
  }
}

TEST(MinMaxTree, HoldsFewCells)
{
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  TetrahedralMesh mesh;
  for (int count = 1; count < 40; ++count)
  {
    AddTetrahedron(mesh, { unit(generator), unit(generator), unit(generator) }, 0.1);
    for (const TreeBuild build : Builds)
    {
      CheckTree(mesh, {}, Build(mesh, {}, build, 4), 4);
    }
  }
}

TEST(MinMaxTree, ALineMeetsFewLeaves)
{
  // About the cube root of the number of leaves, which is 28 for 4 cells a leaf.
  const TetrahedralMesh mesh = GenerateMesh("ball", { { "cells", 32. } }).Mesh;
  for (const TreeBuild build : Builds)
  {
    EXPECT_LT(CountLeavesOnLine(Build(mesh, {}, build)), 60);
  }
}

TEST(MinMaxTree, DoesNotDependOnThreads)
{
  const GeneratedMesh ball = GenerateMesh("ball", { { "cells", 32. } });
  for (const TreeBuild build : Builds)
  {
    const MinMaxTree expected = Build(ball.Mesh, {}, build);
    const MinMaxRanges expectedRanges = MakeMinMaxRanges(expected, ball.Mesh, ball.Scalars, 0);
    ForEachThreadCount(
      [&]()
      {
        const MinMaxTree tree = Build(ball.Mesh, {}, build);
        EXPECT_TRUE(IsSame(tree.Nodes, expected.Nodes));
        EXPECT_TRUE(IsSame(tree.Cells, expected.Cells));
        const MinMaxRanges ranges = MakeMinMaxRanges(tree, ball.Mesh, ball.Scalars, 0);
        EXPECT_TRUE(IsSame(ranges.Nodes, expectedRanges.Nodes));
        EXPECT_EQ(ranges.Offset, expectedRanges.Offset);
        EXPECT_EQ(ranges.Scale, expectedRanges.Scale);
      });
  }
}

TEST(MinMaxTree, HalvesCellsAtTheSamePlaceByNumber)
{
  TetrahedralMesh same;
  TetrahedralMesh nested;
  for (int cell = 0; cell < 20000; ++cell)
  {
    AddTetrahedron(same, { 0.3, -0.2, 0.1 }, 0.25);
    AddTetrahedron(nested, { 0, 0, 0 }, std::pow(10, -36. * cell / 20000));
  }
  for (const TreeBuild build : Builds)
  {
    EXPECT_LE(CheckTree(same, {}, Build(same, {}, build), 8), 12);
    EXPECT_LE(CheckTree(nested, {}, Build(nested, {}, build), 8), 12);
  }
}

TEST(MinMaxTree, BoundsItsDepthForSizesInGeometricProgression)
{
  // The middle of an edge splits off few cells at one end.
  for (const double ratio : { 0.5, 0.9, 0.99, 0.998 })
  {
    TetrahedralMesh mesh;
    double x = 1;
    for (int cell = 0; cell < 20000 && x > 1e-36; ++cell)
    {
      AddTetrahedron(mesh, { x, 0, 0 }, 0.1 * x);
      x *= ratio;
    }
    for (const TreeBuild build : Builds)
    {
      const int depth = CheckTree(mesh, {}, Build(mesh, {}, build, 1), 1);
      // Else the bound does nothing here.
      EXPECT_TRUE(build != TreeBuild::SpatialMedian || depth > MinMaxTree::MaximumDepth / 2);
    }
  }
}

TEST(MinMaxTree, HoldsSmallAndLargeAndDistantMeshes)
{
  const TetrahedralMesh unit = GenerateMesh("random", { { "cells", 6. } }).Mesh;
  const struct
  {
    double Factor;
    double Offset;
  } changes[] = { { 1e-30, 0 }, { 1e30, 0 }, { 1, 1e7 }, { 1e-42, 0 } };
  for (const auto& change : changes)
  {
    TetrahedralMesh mesh = unit;
    for (double& x : mesh.Points)
    {
      x = x * change.Factor + change.Offset;
    }
    const double middle = 0.5 * change.Factor + change.Offset;
    const Frame own = { { middle, middle, middle }, change.Factor };
    for (const TreeBuild build : Builds)
    {
      CheckTree(mesh, own, Build(mesh, own, build), 8);
      CheckTree(mesh, {}, Build(mesh, {}, build), 8);
    }
  }
}

TEST(MinMaxTree, HoldsPointsBeyondSinglePrecision)
{
  TetrahedralMesh mesh = GenerateMesh("random", { { "cells", 4. } }).Mesh;
  for (double& x : mesh.Points)
  {
    x *= 1e30;
  }
  const Frame frame = { { 0, 0, 0 }, 1e-30 };
  for (const TreeBuild build : Builds)
  {
    CheckTree(mesh, frame, Build(mesh, frame, build), 8);
  }
}

TEST(MinMaxTree, FitsPointsThatMoved)
{
  const TetrahedralMesh first = GenerateMesh("swinging-ball", { { "cells", 20. } }).Mesh;
  const TetrahedralMesh second =
    GenerateMesh("swinging-ball", { { "cells", 20. }, { "time", 0.3 } }).Mesh;
  ASSERT_EQ(first.Cells, second.Cells);
  ASSERT_NE(first.Points, second.Points);
  TetrahedralMesh larger = first;
  for (double& x : larger.Points)
  {
    x *= 4;
  }
  for (const TreeBuild build : Builds)
  {
    const MinMaxTree before = Build(first, {}, build);
    ForEachThreadCount(
      [&]()
      {
        MinMaxTree tree = before;
        RefitMinMaxTree(tree, second, Frame().Center, 1, 0);
        CheckTree(second, {}, tree, 8);
        RefitMinMaxTree(tree, first, Frame().Center, 1, 0);
        EXPECT_TRUE(IsSame(tree.Nodes, before.Nodes));
        // A power of two changes no decision of the build.
        RefitMinMaxTree(tree, larger, Frame().Center, 1, 0);
        EXPECT_TRUE(IsSame(tree.Nodes, Build(larger, {}, build).Nodes));
      });
  }
}

TEST(MinMaxRanges, CountStepsFromTheLeastScalar)
{
  MinMaxRanges ranges;
  ranges.Offset = 10;
  ranges.Scale = 2;
  EXPECT_EQ(ranges.GetStep(-Infinity), -1);
  EXPECT_EQ(ranges.GetStep(-1e300), -1);
  EXPECT_EQ(ranges.GetStep(std::nextafter(10, 0)), -1);
  EXPECT_EQ(ranges.GetStep(10), 0);
  EXPECT_EQ(ranges.GetStep(std::nextafter(10.5, 0)), 0);
  EXPECT_EQ(ranges.GetStep(10.5), 1);
  EXPECT_EQ(ranges.GetStep(1e300), MinMaxRanges::LargestStep + 1);
  EXPECT_EQ(ranges.GetStep(Infinity), MinMaxRanges::LargestStep + 1);
  EXPECT_EQ(ranges.GetStep(NaN), -1);
}

TEST(MinMaxRanges, HoldWhatSurfacesCross)
{
  const std::pair<const char*, std::map<std::string, double>> meshes[] = {
    { "ring", { { "around", 40 }, { "across", 6 } } },
    { "random", { { "cells", 8 } } },
  };
  for (const auto& [name, parameters] : meshes)
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, name);
    const GeneratedMesh generated = GenerateMesh(name, parameters);
    for (const TreeBuild build : Builds)
    {
      const MinMaxTree tree = Build(generated.Mesh, {}, build);
      CheckRanges(generated.Mesh, generated.Scalars, tree, MakeValues(generated.Scalars));
    }
  }
}

TEST(MinMaxRanges, LeaveOutMostNodes)
{
  const GeneratedMesh ball = GenerateMesh("ball", { { "cells", 32. } });
  const MinMaxTree tree = Build(ball.Mesh, {}, TreeBuild::SpatialMedian);
  const MinMaxRanges ranges = MakeMinMaxRanges(tree, ball.Mesh, ball.Scalars, 0);
  const auto count = [&](double value)
  {
    const std::int32_t step = ranges.GetStep(value);
    return std::count_if(ranges.Nodes.begin(), ranges.Nodes.end(),
      [&](MinMaxTree::Range range) { return MinMaxRanges::Holds(range, step); });
  };
  const auto [least, largest] = std::minmax_element(ball.Scalars.begin(), ball.Scalars.end());
  const double nearLargest = 0.05 * *least + 0.95 * *largest;
  EXPECT_GT(count(nearLargest), 0);
  EXPECT_LT(count(nearLargest), static_cast<std::int64_t>(tree.Nodes.size()) / 4);
  EXPECT_EQ(count(*least - 0.01 * (*largest - *least)), 0);
  EXPECT_EQ(count(*largest + 0.01 * (*largest - *least)), 0);
  EXPECT_EQ(count(-Infinity), 0);
  EXPECT_EQ(count(Infinity), 0);
  EXPECT_EQ(count(NaN), 0);
}

TEST(MinMaxRanges, HoldSmallAndLargeAndDistantScalars)
{
  const GeneratedMesh generated = GenerateMesh("random", { { "cells", 6. } });
  const MinMaxTree tree = Build(generated.Mesh, {}, TreeBuild::SpatialMedian);
  const struct
  {
    double Factor;
    double Offset;
  } changes[] = { { 1e-30, 0 }, { 1e30, 0 }, { 1, 1e7 }, { 1e-30, 1e-23 }, { 1e30, -1e37 },
    { 1e-310, 0 }, { 1e-16, 1 }, { 1e308, 0 } };
  for (const auto& change : changes)
  {
    std::vector<double> scalars = generated.Scalars;
    const auto [least, largest] = std::minmax_element(scalars.begin(), scalars.end());
    const double lower = *least;
    const double width = *largest - lower;
    for (double& s : scalars)
    {
      // From -1 to 1: with the largest factor a difference overflows.
      s = (2 * (s - lower) / width - 1) * change.Factor + change.Offset;
    }
    CheckRanges(generated.Mesh, scalars, tree, MakeValues(scalars));
    const MinMaxRanges ranges = MakeMinMaxRanges(tree, generated.Mesh, scalars, 0);
    // All steps are in use, but where that takes a scale beyond double precision.
    EXPECT_EQ(ranges.Nodes[0].Least, 0);
    EXPECT_TRUE(ranges.Nodes[0].Largest >= MinMaxRanges::LargestStep - 1 || change.Factor < 1e-300);
  }
}

TEST(MinMaxRanges, HoldOneScalarAlone)
{
  const TetrahedralMesh mesh = GenerateMesh("random", { { "cells", 4. } }).Mesh;
  const MinMaxTree tree = Build(mesh, {}, TreeBuild::SpatialMedian);
  for (const double scalar : { 0., 1e-30, -1e30, 7. })
  {
    const std::vector<double> scalars(mesh.GetNumberOfPoints(), scalar);
    CheckRanges(mesh, scalars, tree, MakeValues(scalars));
    const MinMaxRanges ranges = MakeMinMaxRanges(tree, mesh, scalars, 0);
    EXPECT_FALSE(MinMaxRanges::Holds(ranges.Nodes[0], ranges.GetStep(scalar + 1e25)));
    EXPECT_FALSE(MinMaxRanges::Holds(ranges.Nodes[0], ranges.GetStep(scalar - 1e25)));
  }
}

TEST(MinMaxRanges, LeaveOutCellsWithScalarsThatAreNotFinite)
{
  const GeneratedMesh generated = GenerateMesh("random", { { "cells", 6. } });
  const MinMaxTree tree = Build(generated.Mesh, {}, TreeBuild::SpatialMedian, 2);
  std::mt19937_64 generator(11);
  for (const double share : { 0.1, 0.9 })
  {
    std::vector<double> scalars = generated.Scalars;
    constexpr double Bad[] = { NaN, Infinity, -Infinity };
    for (double& s : scalars)
    {
      s =
        std::uniform_real_distribution<double>(0, 1)(generator) < share ? Bad[generator() % 3] : s;
    }
    CheckRanges(generated.Mesh, scalars, tree, MakeValues(scalars));
  }
  const std::vector<double> none(generated.Scalars.size(), NaN);
  const MinMaxRanges ranges = MakeMinMaxRanges(tree, generated.Mesh, none, 0);
  EXPECT_TRUE(std::isfinite(ranges.Offset));
  EXPECT_TRUE(std::isfinite(ranges.Scale));
  for (const MinMaxTree::Range range : ranges.Nodes)
  {
    EXPECT_GT(range.Least, range.Largest);
    EXPECT_FALSE(MinMaxRanges::Holds(range, ranges.GetStep(0)));
  }
}

} // namespace
} // namespace tetralux
