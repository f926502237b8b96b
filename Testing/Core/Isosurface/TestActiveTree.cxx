// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/ActiveTree.h"

#include "ActiveSurfaces.h"
#include "Generate/GeneratedMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

/// Walks the tree and checks its shape: each polygon in one leaf, in order, and inside of all boxes
/// above it. Returns the node behind.
class TreeCheck
{
public:
  explicit TreeCheck(const ActiveTree& tree)
    : Tree(tree)
  {
    if (!tree.Nodes.empty())
    {
      EXPECT_EQ(this->Walk(0, 0), static_cast<std::int32_t>(tree.Nodes.size()));
    }
    EXPECT_EQ(this->NextPolygon, static_cast<std::int32_t>(tree.Polygons.size()));
    EXPECT_EQ(this->Outside, 0);
    EXPECT_LE(this->Depth, MinMaxTree::MaximumDepth);
  }

private:
  std::int32_t Walk(std::int32_t id, int depth)
  {
    this->Depth = std::max(this->Depth, depth);
    const MinMaxTree::Node& node = this->Tree.Nodes.at(id);
    const std::int32_t first = this->NextPolygon;
    std::int32_t end = id + 1;
    if (node.Count > 0)
    {
      EXPECT_EQ(node.First, this->NextPolygon);
      this->NextPolygon += node.Count;
    }
    else
    {
      end = this->Walk(id + 1, depth + 1);
      EXPECT_EQ(node.First, end);
      end = this->Walk(node.First, depth + 1);
    }
    for (std::int32_t p = first; p < this->NextPolygon; ++p)
    {
      const Isopolygon& polygon = this->Tree.Polygons.at(p);
      const double* corners[3] = { polygon.X, polygon.Y, polygon.Z };
      for (int a = 0; a < 3; ++a)
      {
        for (int i = 0; i < 4; ++i)
        {
          this->Outside += node.Lower[a] <= corners[a][i] && corners[a][i] <= node.Upper[a] ? 0 : 1;
        }
      }
    }
    return end;
  }

  const ActiveTree& Tree;
  std::int32_t NextPolygon = 0;
  std::int64_t Outside = 0; ///< coordinates outside of boxes
  int Depth = 0;
};

void ExpectAllPolygons(const ActiveSurfaces& surfaces, const ActiveTree& tree)
{
  const TreeCheck check(tree);
  std::set<std::pair<std::int32_t, std::int32_t>> made;
  for (const Isopolygon& polygon : tree.Polygons)
  {
    EXPECT_TRUE(made.emplace(polygon.Cell, polygon.Surface).second);
  }
  EXPECT_EQ(made, surfaces.FindCrossed());
}

TEST(ActiveTree, HoldsThePolygonsOfAllCells)
{
  const std::pair<const char*, std::map<std::string, double>> meshes[] = {
    { "random", { { "cells", 12 } } },
    { "ring", { { "around", 60 }, { "across", 6 } } },
    { "boundary-layer", { { "cells", 8 }, { "layers", 30 } } },
    { "cubes", { { "cells", 4 } } },
  };
  for (const auto& [name, parameters] : meshes)
  {
    const GeneratedMesh generated = GenerateMesh(name, parameters);
    for (const int count : { 1, 3, 60 })
    {
      const testing::ScopedTrace trace(
        __FILE__, __LINE__, name + (", " + std::to_string(count)) + " values");
      const ActiveSurfaces surfaces(
        generated.Mesh, generated.Scalars, MakeValues(generated.Scalars, count));
      EXPECT_GT(surfaces.FindCrossed().size(), 50u);
      for (const TreeBuild build : { TreeBuild::SpatialMedian, TreeBuild::SurfaceArea })
      {
        ExpectAllPolygons(surfaces, surfaces.Make(2, build));
      }
    }
  }
}

TEST(ActiveTree, LeavesOutCellsWithScalarsThatAreNotFinite)
{
  GeneratedMesh generated = GenerateMesh("random", { { "cells", 12 } });
  const std::vector<double> values = MakeValues(generated.Scalars, 5);
  std::mt19937 random(4);
  const double bad[3] = { std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (double& scalar : generated.Scalars)
  {
    scalar = random() % 10 == 0 ? bad[random() % 3] : scalar;
  }
  const ActiveSurfaces surfaces(generated.Mesh, generated.Scalars, values);
  ExpectAllPolygons(surfaces, surfaces.Make());
}

TEST(ActiveTree, IsEmptyWithoutPolygons)
{
  const GeneratedMesh generated = GenerateMesh("random", { { "cells", 6. } });
  const double largest = *std::max_element(generated.Scalars.begin(), generated.Scalars.end());
  for (const std::vector<double>& values :
    { std::vector<double>(), std::vector<double>{ largest + 1 } })
  {
    const ActiveSurfaces surfaces(generated.Mesh, generated.Scalars, values);
    EXPECT_TRUE(surfaces.Make().Nodes.empty());
    EXPECT_TRUE(surfaces.Make().Polygons.empty());
  }
  const ActiveSurfaces none({}, {}, { 1. });
  EXPECT_TRUE(none.Make().Nodes.empty());
}

TEST(ActiveTree, DoesNotDependOnThreads)
{
  // More nodes than one task takes.
  const GeneratedMesh generated = GenerateMesh("ball", { { "cells", 24. } });
  const ActiveSurfaces surfaces(
    generated.Mesh, generated.Scalars, MakeValues(generated.Scalars, 7));
  const ActiveTree expected = surfaces.Make(1);
  ExpectAllPolygons(surfaces, expected);
  for (const int threads : { 2, 3, 7 })
  {
    const ActiveTree tree = surfaces.Make(threads);
    ASSERT_EQ(tree.Nodes.size(), expected.Nodes.size());
    ASSERT_EQ(tree.Polygons.size(), expected.Polygons.size());
    EXPECT_EQ(std::memcmp(tree.Nodes.data(), expected.Nodes.data(),
                tree.Nodes.size() * sizeof(MinMaxTree::Node)),
      0);
    // Behind the last member there is padding.
    constexpr std::size_t Bytes = offsetof(Isopolygon, Surface) + sizeof(Isopolygon::Surface);
    std::int64_t differing = 0;
    for (std::size_t i = 0; i < tree.Polygons.size(); ++i)
    {
      differing += std::memcmp(&tree.Polygons[i], &expected.Polygons[i], Bytes) != 0 ? 1 : 0;
    }
    EXPECT_EQ(differing, 0);
  }
}

TEST(ActiveTree, HasFewNodes)
{
  const GeneratedMesh generated = GenerateMesh("ball", { { "cells", 24. } });
  const ActiveSurfaces surfaces(
    generated.Mesh, generated.Scalars, MakeValues(generated.Scalars, 3));
  const ActiveTree tree = surfaces.Make();
  // A leaf and an inner node for each, at most.
  EXPECT_LT(tree.Nodes.size(), 2 * tree.Polygons.size());
  for (const MinMaxTree::Node& node : tree.Nodes)
  {
    EXPECT_TRUE(node.Count >= 0 && (node.Count > 0 || node.First > 0));
  }
}

TEST(ActiveTree, GradientsAreLinearInCells)
{
  // Gradients x, y and z at the points are so in between.
  const GeneratedMesh generated = GenerateMesh("random", { { "cells", 6. } });
  const ActiveSurfaces surfaces(
    generated.Mesh, generated.Scalars, MakeValues(generated.Scalars, 2));
  const IsopolygonSource& source = surfaces.Source;
  std::vector<GradientRow> rows;
  for (std::size_t p = 0; p < surfaces.Mesh.GetNumberOfPoints(); ++p)
  {
    float x[3];
    for (int a = 0; a < 3; ++a)
    {
      x[a] = static_cast<float>(
        (source.Points[3 * p + a] - source.Frame.Center[a]) / source.Frame.Radius);
    }
    rows.push_back({ x[0], x[1], x[2], 0 });
  }
  const ActiveTree tree = surfaces.Make();
  const RawVector<CellField<3>> fields = MakeGradientFields(tree, source, rows.data(), 2);
  ASSERT_EQ(fields.size(), tree.Polygons.size());
  // Rows are rounded to single precision, and cells are not thinner than a hundredth.
  constexpr double RowRounding = 100. / (1 << 23);
  double worst = 0;
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    const Isopolygon& polygon = tree.Polygons[i];
    for (int corner = 0; corner < 4; ++corner)
    {
      const double point[3] = { polygon.X[corner], polygon.Y[corner], polygon.Z[corner] };
      for (int k = 0; k < 3; ++k)
      {
        double value = fields[i].Base[k];
        for (int a = 0; a < 3; ++a)
        {
          value += fields[i].Slope[k][a] * (point[a] - fields[i].Origin[a]);
        }
        worst = std::max(worst, std::abs(value - point[k]));
      }
    }
  }
  EXPECT_LT(worst, RowRounding);
}

} // namespace
} // namespace tetralux
