// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/BoundaryTriangulation.h"

#include "Convexify/HullTriangles.h"
#include "Convexify/PocketWrap.h"
#include "Pockets.h"
#include "Rationals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace
{

using tetralux::BoundarySurface;
using tetralux::BoundaryTriangulation;
using tetralux::Triangle;

std::vector<double> DrawPoints(int count, bool isOnLattice)
{
  std::mt19937_64 random(1);
  std::set<std::array<double, 3>> points;
  while (points.size() < static_cast<std::size_t>(count))
  {
    std::array<double, 3> point;
    for (double& value : point)
    {
      value = isOnLattice ? static_cast<double>(random() % 4)
                          : std::ldexp(static_cast<double>(random() >> 11), -53);
    }
    points.insert(point);
  }
  std::vector<double> coordinates;
  for (const auto& point : points)
  {
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  return coordinates;
}

/// Neighbours that know of each other by the same face, infinite cells, positive volumes.
void CheckTables(const BoundaryTriangulation& triangulation, const std::vector<double>& coordinates)
{
  const tetralux::ExactPoints points(coordinates.data());
  for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
    EXPECT_LE(std::count(ids, ids + 4, BoundaryTriangulation::Infinite), 1);
    EXPECT_EQ(triangulation.IsInfinite(cell),
      std::count(ids, ids + 4, BoundaryTriangulation::Infinite) == 1);
    EXPECT_TRUE(
      triangulation.IsInfinite(cell) || points.Orient(ids[0], ids[1], ids[2], ids[3]) > 0);
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t neighbor = triangulation.Neighbors[4 * std::size_t(cell) + i];
      EXPECT_EQ(triangulation.FindFace(cell, neighbor), i);
      const int back = triangulation.FindFace(neighbor, cell);
      EXPECT_EQ(triangulation.Neighbors[4 * std::size_t(neighbor) + back], cell);
      std::set<std::int32_t> mine(ids, ids + 4);
      mine.erase(ids[i]);
      const std::int32_t* others = &triangulation.Cells[4 * std::size_t(neighbor)];
      std::set<std::int32_t> theirs(others, others + 4);
      theirs.erase(others[back]);
      EXPECT_EQ(mine, theirs);
    }
  }
  for (std::size_t point = 0; point < triangulation.PointCells.size(); ++point)
  {
    const std::int32_t cell = triangulation.PointCells[point];
    EXPECT_FALSE(triangulation.IsInfinite(cell));
    const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
    EXPECT_EQ(std::count(ids, ids + 4, static_cast<std::int32_t>(point)), 1);
  }
}

double MeasureFiniteCells(
  const BoundaryTriangulation& triangulation, const std::vector<double>& coordinates)
{
  double volume = 0;
  for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
    if (!triangulation.IsInfinite(cell))
    {
      volume += pockets::MeasureCell(coordinates, { ids[0], ids[1], ids[2], ids[3] });
    }
  }
  return volume;
}

/// A cube of eight points whose top has the given diagonal; the others are those of a lattice.
BoundarySurface MakeCube(bool otherDiagonal)
{
  BoundarySurface surface;
  for (int i = 0; i < 8; ++i)
  {
    const double point[3] = { double(i & 1), double(i >> 1 & 1), double(i >> 2) };
    surface.Coordinates.insert(surface.Coordinates.end(), point, point + 3);
    surface.PointIds.push_back(i);
  }
  // Quads counter-clockwise as seen from outside, cut from their first corner.
  std::array<std::int32_t, 4> quads[6] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
    { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  if (otherDiagonal)
  {
    std::rotate(quads[1].begin(), quads[1].begin() + 1, quads[1].end());
  }
  for (const auto& quad : quads)
  {
    surface.Triangles.push_back({ quad[0], quad[2], quad[1] });
    surface.Triangles.push_back({ quad[0], quad[3], quad[2] });
  }
  surface.Triangles = pockets::Reverse(surface.Triangles);
  surface.Faces.resize(surface.Triangles.size());
  return surface;
}

std::set<std::set<std::int32_t>> GetSets(const std::vector<Triangle>& triangles)
{
  std::set<std::set<std::int32_t>> sets;
  for (const Triangle& triangle : triangles)
  {
    sets.insert({ triangle[0], triangle[1], triangle[2] });
  }
  return sets;
}

/// What must hold of the triangles of a hull: closed, and all points on their positive side.
void CheckHull(const tetralux::HullTriangles& hull, const BoundarySurface& surface)
{
  ASSERT_FALSE(hull.Triangles.empty());
  EXPECT_EQ(hull.Cells.size(), hull.Triangles.size());
  EXPECT_EQ(hull.IsDelaunay.size(), hull.Triangles.size());
  EXPECT_TRUE(pockets::IsClosed(hull.Triangles));
  const tetralux::ExactPoints points(surface.Coordinates.data());
  for (const auto& [a, b, c] : hull.Triangles)
  {
    for (std::int32_t point = 0; point < surface.GetNumberOfPoints(); ++point)
    {
      EXPECT_GE(points.Orient(a, b, c, point), 0);
    }
  }
}

} // namespace

TEST(BoundaryTriangulation, OneTetrahedron)
{
  const std::vector<double> coordinates = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  const BoundaryTriangulation triangulation = tetralux::TriangulateDelaunay(coordinates);
  EXPECT_EQ(triangulation.GetNumberOfCells(), 1 + 4);
  CheckTables(triangulation, coordinates);
  EXPECT_DOUBLE_EQ(MeasureFiniteCells(triangulation, coordinates), 1. / 6);
}

TEST(BoundaryTriangulation, PointsOfOnePlaneHaveNoCells)
{
  EXPECT_EQ(tetralux::TriangulateDelaunay({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 }).Cells.size(), 0u);
  EXPECT_EQ(tetralux::TriangulateDelaunay({}).Cells.size(), 0u);
}

TEST(BoundaryTriangulation, SpheresAroundCellsAreEmpty)
{
  for (const bool isOnLattice : { false, true })
  {
    const std::vector<double> coordinates = DrawPoints(40, isOnLattice);
    const BoundaryTriangulation triangulation = tetralux::TriangulateDelaunay(coordinates);
    CheckTables(triangulation, coordinates);
    for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
    {
      if (triangulation.IsInfinite(cell))
      {
        continue;
      }
      const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
      const auto at = [&coordinates](std::size_t id) { return &coordinates[3 * id]; };
      for (std::size_t point = 0; point < coordinates.size() / 3; ++point)
      {
        EXPECT_LE(
          rationals::GetSphereSide(at(ids[0]), at(ids[1]), at(ids[2]), at(ids[3]), at(point)), 0);
      }
    }
  }
}

TEST(BoundaryTriangulation, OfGeneratedMeshes)
{
  for (const auto& [name, mesh] : pockets::GenerateMeshes())
  {
    SCOPED_TRACE(name);
    const BoundarySurface surface = pockets::MakeSurface(mesh);
    const BoundaryTriangulation triangulation = tetralux::TriangulateDelaunay(surface.Coordinates);
    CheckTables(triangulation, surface.Coordinates);
    const tetralux::HullTriangles hull = tetralux::TriangulateHull(surface, triangulation);
    CheckHull(hull, surface);
    const double volume = MeasureFiniteCells(triangulation, surface.Coordinates);
    EXPECT_NEAR(-tetralux::MeasureEnclosedVolume(surface.Coordinates, hull.Triangles), volume,
      pockets::VolumeRounding * volume);
  }
}

TEST(BoundaryTriangulation, PlaneHasTheEdgesThatItMust)
{
  // A square: each of its diagonals can be asked for, both can't.
  const std::vector<double> coordinates = { 0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5 };
  const tetralux::ExactPoints points(coordinates.data());
  for (const std::array<std::int32_t, 2>& diagonal : { std::array{ 0, 2 }, std::array{ 1, 3 } })
  {
    std::vector<Triangle> triangles;
    ASSERT_TRUE(tetralux::TriangulatePlane(points, { 0, 1, 2, 3 }, { diagonal }, 2, triangles));
    ASSERT_EQ(triangles.size(), 2u);
    for (const Triangle& triangle : triangles)
    {
      EXPECT_EQ(points.OrientProjected(triangle[0], triangle[1], triangle[2], 2), 1);
      for (const std::int32_t end : diagonal)
      {
        EXPECT_EQ(std::count(triangle.begin(), triangle.end(), end), 1);
      }
    }
  }
  std::vector<Triangle> triangles;
  EXPECT_FALSE(
    tetralux::TriangulatePlane(points, { 0, 1, 2, 3 }, { { 0, 2 }, { 1, 3 } }, 2, triangles));
}

TEST(HullTriangles, HaveTheDiagonalsOfTheBoundary)
{
  int lost = 0;
  for (const bool otherDiagonal : { false, true })
  {
    const BoundarySurface surface = MakeCube(otherDiagonal);
    const tetralux::ExactPoints points(surface.Coordinates.data());
    ASSERT_TRUE(tetralux::IsConvexSurface(points, surface.Triangles));
    const tetralux::HullTriangles hull =
      tetralux::TriangulateHull(surface, tetralux::TriangulateDelaunay(surface.Coordinates));
    CheckHull(hull, surface);
    EXPECT_EQ(GetSets(hull.Triangles), GetSets(surface.Triangles));
    lost += !hull.LostCells.empty();
    EXPECT_EQ(
      hull.LostCells.empty(), std::count(hull.IsDelaunay.begin(), hull.IsDelaunay.end(), 0) == 0);
  }
  // The triangulation has one of the two diagonals.
  EXPECT_GT(lost, 0);
}

TEST(HullTriangles, EdgesThatCrossHaveNone)
{
  BoundarySurface surface = MakeCube(false);
  const BoundarySurface other = MakeCube(true);
  surface.Triangles.insert(surface.Triangles.end(), other.Triangles.begin(), other.Triangles.end());
  EXPECT_TRUE(tetralux::TriangulateHull(surface, tetralux::TriangulateDelaunay(surface.Coordinates))
                .Triangles.empty());
}

TEST(PointNeighbors, AreTheEdgesOfTheTriangulation)
{
  const std::vector<double> coordinates = DrawPoints(60, false);
  const BoundaryTriangulation triangulation = tetralux::TriangulateDelaunay(coordinates);
  std::vector<std::set<std::int32_t>> expected(coordinates.size() / 3);
  for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
    for (int i = 0; i < 16 && !triangulation.IsInfinite(cell); ++i)
    {
      if (i / 4 != i % 4)
      {
        expected[ids[i / 4]].insert(ids[i % 4]);
      }
    }
  }
  const tetralux::PointNeighbors neighbors(triangulation);
  for (std::size_t point = 0; point < expected.size(); ++point)
  {
    std::multiset<std::int32_t> found;
    neighbors.ForEach(
      static_cast<std::int32_t>(point), [&found](std::int32_t id) { found.insert(id); });
    EXPECT_EQ(found, std::multiset<std::int32_t>(expected[point].begin(), expected[point].end()));
  }
  // A point that came later has none.
  neighbors.ForEach(static_cast<std::int32_t>(expected.size()), [](std::int32_t) { FAIL(); });
}
