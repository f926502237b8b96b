// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshCleaning.h"

#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace
{

using tetralux::RemovedCells;
using tetralux::RemoveUnusableCells;
using tetralux::TetrahedralMesh;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

TetrahedralMesh MakePoints(int numberOfPoints)
{
  TetrahedralMesh mesh;
  for (int i = 0; i < 3 * numberOfPoints; ++i)
  {
    mesh.Points.push_back(std::sin(i));
  }
  return mesh;
}

RemovedCells RemoveSlowly(TetrahedralMesh& mesh)
{
  const auto numberOfPoints = static_cast<std::int32_t>(mesh.GetNumberOfPoints());
  RemovedCells removed;
  TetrahedralMesh kept;
  std::set<std::set<std::int32_t>> seen;
  for (std::size_t cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* points = &mesh.Cells[4 * cell];
    const std::set<std::int32_t> different(points, points + 4);
    bool isFinite = true;
    if (*different.begin() < 0 || *different.rbegin() >= numberOfPoints)
    {
      ++removed.InvalidPointIds;
      continue;
    }
    for (int i = 0; i < 12; ++i)
    {
      isFinite = isFinite && std::isfinite(mesh.Points[3 * points[i / 3] + i % 3]);
    }
    if (!isFinite)
    {
      ++removed.NonFiniteCoordinates;
    }
    else if (different.size() < 4)
    {
      ++removed.RepeatedPoints;
    }
    else if (!seen.insert(different).second)
    {
      ++removed.Duplicates;
    }
    else
    {
      kept.Cells.insert(kept.Cells.end(), points, points + 4);
      kept.OriginalCells.push_back(
        mesh.OriginalCells.empty() ? static_cast<std::int32_t>(cell) : mesh.OriginalCells[cell]);
    }
  }
  mesh.Cells = kept.Cells;
  mesh.OriginalCells = kept.OriginalCells;
  return removed;
}

void ExpectSame(const RemovedCells& actual, const RemovedCells& expected)
{
  EXPECT_EQ(actual.InvalidPointIds, expected.InvalidPointIds);
  EXPECT_EQ(actual.NonFiniteCoordinates, expected.NonFiniteCoordinates);
  EXPECT_EQ(actual.RepeatedPoints, expected.RepeatedPoints);
  EXPECT_EQ(actual.Duplicates, expected.Duplicates);
}

} // namespace

TEST(MeshCleaning, NothingToRemove)
{
  TetrahedralMesh empty;
  EXPECT_EQ(RemoveUnusableCells(empty).Total(), 0);

  TetrahedralMesh mesh = MakePoints(6);
  mesh.Points[15] = NotANumber; // of a point that no cell uses
  mesh.Cells = { 0, 1, 2, 3, 1, 2, 3, 4 };
  const auto cells = mesh.Cells;
  EXPECT_EQ(RemoveUnusableCells(mesh).Total(), 0);
  EXPECT_EQ(mesh.Cells, cells);
  EXPECT_EQ(mesh.GetNumberOfPoints(), 6u);
  EXPECT_TRUE(mesh.OriginalCells.empty());
}

TEST(MeshCleaning, EveryReasonOnce)
{
  TetrahedralMesh mesh = MakePoints(8);
  mesh.Points[3 * 5 + 1] = NotANumber;
  mesh.Points[3 * 6 + 2] = -Infinity;
  mesh.Cells = {
    0, 1, 2, 3,                                        //
    0, 1, 2, 8,                                        // no such point
    0, -1, 2, 3,                                       // no such point
    0, 1, 2, std::numeric_limits<std::int32_t>::min(), // no such point
    5, 1, 2, 3,                                        // not a number
    6, 6, 2, 3,                                        // infinite, and repeated
    0, 1, 0, 3,                                        // repeated
    3, 1, 0, 2,                                        // duplicate of the first
    1, 2, 3, 4,                                        //
    0, 1, 2, 3,                                        // duplicate of the first
  };
  const auto points = mesh.Points;
  ExpectSame(RemoveUnusableCells(mesh), { 3, 2, 1, 2 });
  EXPECT_EQ(mesh.Cells, (std::vector<std::int32_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(mesh.OriginalCells, (std::vector<std::int32_t>{ 0, 8 }));
  EXPECT_EQ(mesh.Points.size(), points.size());
}

TEST(MeshCleaning, FlatAndInvertedCellsStay)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1 };
  mesh.Cells = { 0, 1, 2, 3, 0, 2, 1, 4 };
  EXPECT_EQ(RemoveUnusableCells(mesh).Total(), 0);
  EXPECT_EQ(mesh.GetNumberOfCells(), 2u);
}

TEST(MeshCleaning, NoPoints)
{
  TetrahedralMesh mesh;
  mesh.Cells = { 0, 1, 2, 3 };
  ExpectSame(RemoveUnusableCells(mesh), { 1, 0, 0, 0 });
  EXPECT_TRUE(mesh.Cells.empty());
}

TEST(MeshCleaning, RandomDefects)
{
  for (const int numberOfPoints : { 6, 30, 300 })
  {
    std::mt19937_64 random(numberOfPoints);
    std::uniform_int_distribution<std::int32_t> draw(0, numberOfPoints - 1);
    TetrahedralMesh mesh = MakePoints(numberOfPoints);
    for (int i = 0; i < 4 * 2000; ++i)
    {
      mesh.Cells.push_back(draw(random));
    }
    for (int i = 0; i < 100; ++i)
    {
      mesh.Cells[random() % mesh.Cells.size()] += i % 2 == 0 ? numberOfPoints : -numberOfPoints;
      std::copy_n(&mesh.Cells[random() % 2000 * 4], 4, &mesh.Cells[random() % 2000 * 4]);
    }
    mesh.Points[0] = NotANumber;
    mesh.Points[3 * (numberOfPoints - 1) + 2] = Infinity;
    for (const bool hasOriginals : { false, true })
    {
      if (hasOriginals)
      {
        for (int i = 0; i < 2000; ++i)
        {
          mesh.OriginalCells.push_back(i / 5 + 1000);
        }
      }
      TetrahedralMesh expected = mesh;
      const RemovedCells expectedRemoved = RemoveSlowly(expected);
      ASSERT_GT(expectedRemoved.Duplicates, 10);
      ForEachThreadCount(
        [&]
        {
          TetrahedralMesh actual = mesh;
          ExpectSame(RemoveUnusableCells(actual), expectedRemoved);
          EXPECT_EQ(actual.Cells, expected.Cells);
          EXPECT_EQ(actual.OriginalCells, expected.OriginalCells);
        });
    }
  }
}
