// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Gradients.h"

#include "Generate/GeneratedMeshes.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

/// Single precision, in which gradients are held, and sums over the cells around a point.
constexpr double Rounding = 1e-6;

std::vector<double> MakeLinearField(const TetrahedralMesh& mesh, const double (&gradient)[3])
{
  std::vector<double> field;
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &mesh.Points[3 * p];
    field.push_back(7 + gradient[0] * x[0] + gradient[1] * x[1] + gradient[2] * x[2]);
  }
  return field;
}

TEST(PointGradients, AreExactWhereTheFieldIsLinear)
{
  const TetrahedralMesh mesh = GenerateMesh("random", { { "cells", 4. }, { "removed", 0.1 } }).Mesh;
  const double gradient[3] = { 2, -3, 0.5 };
  for (const GradientRow& g : MakePointGradients(mesh, MakeLinearField(mesh, gradient), 1, 1))
  {
    EXPECT_NEAR(g.X, gradient[0], Rounding * 3);
    EXPECT_NEAR(g.Y, gradient[1], Rounding * 3);
    EXPECT_NEAR(g.Z, gradient[2], Rounding * 3);
  }
}

TEST(PointGradients, AreInTheUnitsAskedFor)
{
  const TetrahedralMesh mesh = GenerateMesh("random", { { "cells", 2. } }).Mesh;
  const double gradient[3] = { 1, 0, 0 };
  for (const GradientRow& g : MakePointGradients(mesh, MakeLinearField(mesh, gradient), 8, 4))
  {
    EXPECT_NEAR(g.X, 2, 2 * Rounding);
  }
}

/// Two cells of volumes 1 : 2 on both sides of a face, with gradients 1 and 4 along x; the face has
/// points 1, 2, 3.
TetrahedralMesh MakeTwoCells()
{
  TetrahedralMesh mesh;
  mesh.Points = { -1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0 };
  mesh.Cells = { 0, 1, 2, 3, 4, 1, 2, 3 };
  return mesh;
}

TEST(PointGradients, AreMeansByVolume)
{
  const std::vector<double> scalars = { -1, 0, 0, 0, 8 };
  const std::vector<GradientRow> g = MakePointGradients(MakeTwoCells(), scalars, 1, 1);
  EXPECT_NEAR(g[0].X, 1, Rounding);
  EXPECT_NEAR(g[4].X, 4, 4 * Rounding);
  for (int p = 1; p < 4; ++p)
  {
    EXPECT_NEAR(g[p].X, 3, 3 * Rounding);
  }
}

TEST(PointGradients, CellsWithoutFiniteScalarsDoNotCount)
{
  for (const double missing :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    const std::vector<double> scalars = { -1, 0, 0, 0, missing };
    const std::vector<GradientRow> g = MakePointGradients(MakeTwoCells(), scalars, 1, 1);
    for (int p = 0; p < 4; ++p)
    {
      EXPECT_NEAR(g[p].X, 1, Rounding);
    }
    EXPECT_EQ(g[4].X, 0);
    EXPECT_EQ(g[4].Y, 0);
  }
}

TEST(PointGradients, StayFiniteAtTheEndsOfTheRange)
{
  for (const double scale : { 1e-30, 1e30, 1e300 })
  {
    const std::vector<double> scalars = { -scale, 0, 0, 0, 8 * scale };
    const std::vector<GradientRow> g = MakePointGradients(MakeTwoCells(), scalars, 1, scale);
    EXPECT_NEAR(g[1].X, 3, 3 * Rounding) << scale;
  }
  TetrahedralMesh flat = MakeTwoCells();
  flat.Points[0] = -1e-300;
  for (const GradientRow& g : MakePointGradients(flat, std::vector<double>{ -1, 0, 0, 0, 8 }, 1, 1))
  {
    EXPECT_TRUE(std::isfinite(g.X) && std::isfinite(g.Y) && std::isfinite(g.Z));
  }
}

TEST(PointGradients, DoNotDependOnThreads)
{
  const TetrahedralMesh mesh = GenerateMesh("random", { { "cells", 16. } }).Mesh;
  const double gradient[3] = { 2, -3, 0.5 };
  std::vector<double> field = MakeLinearField(mesh, gradient);
  for (double& x : field)
  {
    x = std::sin(x);
  }
  std::vector<GradientRow> first;
  ForEachThreadCount(
    [&]
    {
      const std::vector<GradientRow> g = MakePointGradients(mesh, field, 1, 1);
      first = first.empty() ? g : first;
      for (std::size_t p = 0; p < g.size(); ++p)
      {
        ASSERT_TRUE(g[p].X == first[p].X && g[p].Y == first[p].Y && g[p].Z == first[p].Z) << p;
      }
    });
}

TEST(CellGradients, AreThoseOfEachCell)
{
  const std::vector<double> scalars = { -1, 0, 0, 0, 8 };
  const std::vector<GradientRow> g = MakeCellGradients(MakeTwoCells(), scalars, 1, 1);
  ASSERT_EQ(g.size(), 2u);
  EXPECT_NEAR(g[0].X, 1, Rounding);
  EXPECT_NEAR(g[1].X, 4, 4 * Rounding);
  EXPECT_NEAR(g[1].Y, 0, Rounding);
  const std::vector<GradientRow> scaled = MakeCellGradients(MakeTwoCells(), scalars, 8, 4);
  EXPECT_NEAR(scaled[0].X, 2, 2 * Rounding);
}

TEST(CellGradients, FlatCellsKeepADirectionAndBlankOnesHaveNone)
{
  TetrahedralMesh flat = MakeTwoCells();
  flat.Points[0] = 0;
  const std::vector<GradientRow> g =
    MakeCellGradients(flat, std::vector<double>{ -1, 0, 0, 0, 8 }, 1, 1);
  EXPECT_GT(g[0].X, 0);
  EXPECT_EQ(g[0].Y, 0);
  const double missing = std::numeric_limits<double>::quiet_NaN();
  const std::vector<GradientRow> blank =
    MakeCellGradients(MakeTwoCells(), std::vector<double>{ missing, 0, 0, 0, 8 }, 1, 1);
  EXPECT_EQ(blank[0].X, 0);
  EXPECT_NEAR(blank[1].X, 4, 4 * Rounding);
}

} // namespace
} // namespace tetralux
