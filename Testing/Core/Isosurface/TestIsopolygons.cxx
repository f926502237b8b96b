// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/Isopolygon.h"

#include "ActiveSurfaces.h"
#include "Generate/GeneratedMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

/// Twice the area of a triangle, as a vector.
std::array<double, 3> GetArea(const Isopolygon& polygon, int i, int j, int k)
{
  const double u[3] = { polygon.X[j] - polygon.X[i], polygon.Y[j] - polygon.Y[i],
    polygon.Z[j] - polygon.Z[i] };
  const double v[3] = { polygon.X[k] - polygon.X[i], polygon.Y[k] - polygon.Y[i],
    polygon.Z[k] - polygon.Z[i] };
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

/// A tetrahedron with corners at the origin and at the ends of the axes, and its polygon at 0.
ActiveTree MakeOne(const std::array<double, 4>& scalars)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  mesh.Cells = { 0, 1, 2, 3 };
  const ActiveSurfaces surfaces(mesh, { scalars.begin(), scalars.end() }, { 0. });
  return surfaces.Make();
}

TEST(Isopolygons, OfEachCase)
{
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> sizes(0.1, 1);
  for (int mask = 0; mask < 16; ++mask)
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, "case " + std::to_string(mask));
    for (int i = 0; i < 10; ++i)
    {
      std::array<double, 4> scalars;
      int above = 0;
      for (int corner = 0; corner < 4; ++corner)
      {
        const bool isAbove = (mask >> corner & 1) != 0;
        above += isAbove ? 1 : 0;
        scalars[corner] = (isAbove ? 1 : -1) * sizes(generator);
      }
      const ActiveTree tree = MakeOne(scalars);
      ASSERT_EQ(tree.Polygons.size(), above % 4 == 0 ? 0u : 1u);
      if (tree.Polygons.empty())
      {
        continue;
      }
      const Isopolygon& polygon = tree.Polygons[0];
      const bool triangle = polygon.X[2] == polygon.X[3] && polygon.Y[2] == polygon.Y[3] &&
        polygon.Z[2] == polygon.Z[3];
      EXPECT_EQ(triangle, above != 2);
      // Around a plane polygon all corners turn alike.
      const std::array<double, 3> first = GetArea(polygon, 0, 1, 2);
      for (int corner = 1; corner < (triangle ? 1 : 4); ++corner)
      {
        const std::array<double, 3> area =
          GetArea(polygon, corner, (corner + 1) % 4, (corner + 2) % 4);
        EXPECT_GT(area[0] * first[0] + area[1] * first[1] + area[2] * first[2], 0);
      }
    }
  }
}

TEST(Isopolygons, LieOnTheSurface)
{
  const GeneratedMesh generated = GenerateMesh("random", { { "cells", 8. } });
  const ActiveSurfaces surfaces(
    generated.Mesh, generated.Scalars, MakeValues(generated.Scalars, 5));
  const IsopolygonSource& source = surfaces.Source;
  // Coordinates and scalars are about 1; scalars of edges differ by a thousandth at least.
  constexpr double Rounding = 1e-12;
  for (const Isopolygon& polygon : surfaces.Make().Polygons)
  {
    const std::int32_t* ids = source.Cells + 4 * polygon.Cell;
    const double value = source.Values[polygon.Surface];
    int mask = 0;
    for (int i = 0; i < 4; ++i)
    {
      mask |= source.Scalars[ids[i]] >= value ? 1 << i : 0;
    }
    for (int corner = 0; corner < 4; ++corner)
    {
      const double x[3] = { polygon.X[corner], polygon.Y[corner], polygon.Z[corner] };
      int edges = 0; // whose ends the value is between, with the corner where it is met
      for (int i = 0; i < 4; ++i)
      {
        for (int j = i + 1; j < 4; ++j)
        {
          const double s = source.Scalars[ids[i]], t = source.Scalars[ids[j]];
          if ((mask >> i & 1) == (mask >> j & 1))
          {
            continue;
          }
          const double share = (value - s) / (t - s);
          double away = 0;
          for (int a = 0; a < 3; ++a)
          {
            const double p =
              (source.Points[3 * ids[i] + a] - source.Frame.Center[a]) / source.Frame.Radius;
            const double q =
              (source.Points[3 * ids[j] + a] - source.Frame.Center[a]) / source.Frame.Radius;
            away = std::max(away, std::abs(p + share * (q - p) - x[a]));
          }
          edges += away < Rounding;
        }
      }
      EXPECT_GE(edges, 1);
    }
  }
}

TEST(Isopolygons, OfNeighboursShareTheirCorners)
{
  // On each face of the mesh that two cells share, both polygons have the same two corners, to the
  // bit.
  const GeneratedMesh generated = GenerateMesh("ball", { { "cells", 12. } });
  const ActiveSurfaces surfaces(
    generated.Mesh, generated.Scalars, MakeValues(generated.Scalars, 4));
  using Point = std::array<double, 3>;
  const auto getPoint = [](const Isopolygon& polygon, int i) -> Point {
    return { polygon.X[i], polygon.Y[i], polygon.Z[i] };
  };
  // How many polygons have an edge, whichever way it runs.
  std::map<std::pair<Point, Point>, int> edges;
  for (const Isopolygon& polygon : surfaces.Make().Polygons)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Point p = getPoint(polygon, i);
      const Point q = getPoint(polygon, (i + 1) % 4);
      if (p != q)
      {
        ++edges[{ std::min(p, q), std::max(p, q) }];
      }
    }
  }
  // Edges of one polygon only are at the boundary of the ball.
  int inside = 0;
  for (const auto& [ends, count] : edges)
  {
    const auto getRadius = [&](const Point& point)
    {
      double squared = 0;
      for (int a = 0; a < 3; ++a)
      {
        const double x = point[a] * surfaces.Source.Frame.Radius + surfaces.Source.Frame.Center[a];
        squared += x * x;
      }
      return std::sqrt(squared);
    };
    const bool atBoundary = std::max(getRadius(ends.first), getRadius(ends.second)) > 0.9;
    EXPECT_TRUE(count % 2 == 0 || atBoundary);
    inside += atBoundary ? 0 : 1;
  }
  EXPECT_GT(inside, 1000);
}

TEST(Isopolygons, GoExactlyThroughPointsOfTheValue)
{
  const auto hasCorner = [](const Isopolygon& polygon, const TetrahedralMesh& mesh,
                           const IsopolygonSource& source, std::int32_t point)
  {
    for (int i = 0; i < 4; ++i)
    {
      const double x[3] = { polygon.X[i], polygon.Y[i], polygon.Z[i] };
      bool same = true;
      for (int a = 0; a < 3; ++a)
      {
        const double p =
          (mesh.Points[3 * static_cast<std::size_t>(point) + a] - source.Frame.Center[a]) /
          source.Frame.Radius;
        same = same && p == x[a];
      }
      if (same)
      {
        return true;
      }
    }
    return false;
  };
  const GeneratedMesh generated = GenerateMesh("random", { { "cells", 8. } });
  std::vector<double> values = generated.Scalars;
  std::sort(values.begin(), values.end());
  values = { values[values.size() / 4], values[values.size() / 3], values[values.size() / 2],
    values[values.size() * 2 / 3], values[values.size() * 3 / 4] };
  const ActiveSurfaces surfaces(generated.Mesh, generated.Scalars, values);
  int touched = 0;
  for (const Isopolygon& polygon : surfaces.Make().Polygons)
  {
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t point = surfaces.Mesh.Cells[4 * polygon.Cell + i];
      if (surfaces.Scalars[point] == values[polygon.Surface])
      {
        EXPECT_TRUE(hasCorner(polygon, surfaces.Mesh, surfaces.Source, point));
        ++touched;
      }
    }
  }
  EXPECT_GT(touched, 10);
}

TEST(Isopolygons, OfFacesBelongToTheCellBelow)
{
  // Three points of the value: a polygon if the fourth is below, none if it is above.
  EXPECT_EQ(MakeOne({ -1, 0, 0, 0 }).Polygons.size(), 1u);
  EXPECT_EQ(MakeOne({ 1, 0, 0, 0 }).Polygons.size(), 0u);
  EXPECT_EQ(MakeOne({ 0, 0, 0, 0 }).Polygons.size(), 0u);
  EXPECT_EQ(MakeOne({ -1, -1, 0, 0 }).Polygons.size(), 1u);
  EXPECT_EQ(MakeOne({ 1, 1, 0, 0 }).Polygons.size(), 0u);
}

TEST(Isopolygons, OfHugeAndTinyScalarsAreFinite)
{
  const double largest = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  for (const std::array<double, 4>& scalars :
    { std::array<double, 4>{ -largest, largest, largest, largest },
      { largest, -largest, -largest, 0.5 * largest }, { 1e-300, -1e-300, -2e-300, -1e-300 },
      { least, -least, -2 * least, 0 } })
  {
    const ActiveTree tree = MakeOne(scalars);
    ASSERT_EQ(tree.Polygons.size(), 1u);
    for (int i = 0; i < 4; ++i)
    {
      const Isopolygon& polygon = tree.Polygons[0];
      EXPECT_TRUE(std::isfinite(polygon.X[i] + polygon.Y[i] + polygon.Z[i]));
    }
  }
}

} // namespace
} // namespace tetralux
