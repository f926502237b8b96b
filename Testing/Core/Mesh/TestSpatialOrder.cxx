// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SpatialOrder.h"

#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace
{

using tetralux::OrderSpatially;
using tetralux::TetrahedralMesh;

/// Random points, and cells of points that are next to each other in the list.
TetrahedralMesh MakeRandomMesh(int numberOfPoints, int numberOfCells, double size, double offset)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> draw(offset, offset + size);
  TetrahedralMesh mesh;
  for (int i = 0; i < 3 * numberOfPoints; ++i)
  {
    mesh.Points.push_back(draw(random));
  }
  std::uniform_int_distribution<std::int32_t> drawPoint(0, numberOfPoints - 1);
  while (mesh.GetNumberOfCells() < static_cast<std::size_t>(numberOfCells))
  {
    std::set<std::int32_t> cell;
    while (cell.size() < 4)
    {
      cell.insert(drawPoint(random));
    }
    std::vector<std::int32_t> points(cell.begin(), cell.end());
    std::shuffle(points.begin(), points.end(), random);
    mesh.Cells.insert(mesh.Cells.end(), points.begin(), points.end());
  }
  return mesh;
}

/// The ordered mesh must be the same mesh: for inputs that have no Original... arrays.
void CheckSameMesh(const TetrahedralMesh& ordered, const TetrahedralMesh& input)
{
  ASSERT_EQ(ordered.OriginalPoints.size(), ordered.GetNumberOfPoints());
  ASSERT_EQ(ordered.OriginalCells.size(), ordered.GetNumberOfCells());
  ASSERT_EQ(ordered.GetNumberOfCells(), input.GetNumberOfCells());

  const std::set<std::int64_t> points(ordered.OriginalPoints.begin(), ordered.OriginalPoints.end());
  const std::set<std::int64_t> usedPoints(input.Cells.begin(), input.Cells.end());
  EXPECT_EQ(points, usedPoints);
  EXPECT_EQ(points.size(), ordered.OriginalPoints.size());
  for (std::size_t point = 0; point < ordered.GetNumberOfPoints(); ++point)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ASSERT_EQ(ordered.Points[3 * point + i], input.Points[3 * ordered.OriginalPoints[point] + i]);
    }
  }

  const std::set<std::int64_t> cells(ordered.OriginalCells.begin(), ordered.OriginalCells.end());
  EXPECT_EQ(cells.size(), ordered.OriginalCells.size());
  for (std::size_t cell = 0; cell < ordered.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* orderedPoints = &ordered.Cells[4 * cell];
    ASSERT_TRUE(std::is_sorted(orderedPoints, orderedPoints + 4));
    std::set<std::int64_t> expected;
    std::set<std::int64_t> actual;
    for (int i = 0; i < 4; ++i)
    {
      expected.insert(input.Cells[4 * ordered.OriginalCells[cell] + i]);
      actual.insert(ordered.OriginalPoints[orderedPoints[i]]);
    }
    ASSERT_EQ(actual, expected);
  }
}

void ExpectSame(const TetrahedralMesh& actual, const TetrahedralMesh& expected)
{
  EXPECT_EQ(actual.Points, expected.Points);
  EXPECT_EQ(actual.Cells, expected.Cells);
  EXPECT_EQ(actual.OriginalPoints, expected.OriginalPoints);
  EXPECT_EQ(actual.OriginalCells, expected.OriginalCells);
}

} // namespace

TEST(SpatialOrder, EmptyMesh)
{
  TetrahedralMesh mesh;
  OrderSpatially(mesh);
  EXPECT_EQ(mesh.GetNumberOfPoints(), 0u);

  mesh.Points = { 1, 2, 3 };
  ForEachThreadCount([&] { OrderSpatially(mesh); });
  EXPECT_EQ(mesh.GetNumberOfPoints(), 0u);
  EXPECT_EQ(mesh.GetNumberOfCells(), 0u);
}

TEST(SpatialOrder, IsTheSameMesh)
{
  // Sizes and offsets where a key could overflow, underflow or lose all of its digits.
  const double largest = std::numeric_limits<double>::max();
  for (const auto& [size, offset] : { std::pair{ 1.0, 0.0 }, { 0.0, 3.0 }, { 1e-3, 1e7 },
         { 1e300, -5e299 }, { largest, -largest }, { 1e-310, 0.0 }, { 5e-324, 0.0 } })
  {
    const TetrahedralMesh input = MakeRandomMesh(500, 800, size, offset);
    TetrahedralMesh first = input;
    OrderSpatially(first);
    CheckSameMesh(first, input);
    EXPECT_LT(first.GetNumberOfPoints(), input.GetNumberOfPoints());
    ForEachThreadCount(
      [&]
      {
        TetrahedralMesh ordered = input;
        OrderSpatially(ordered);
        ExpectSame(ordered, first);
      });
  }
}

TEST(SpatialOrder, CoordinatesOfBothEnds)
{
  TetrahedralMesh input;
  const double largest = std::numeric_limits<double>::max();
  input.Points = { -largest, -largest, largest, largest, 0, 0, 0, largest, 0, 0, 0, -largest };
  input.Cells = { 3, 1, 0, 2 };
  TetrahedralMesh ordered = input;
  OrderSpatially(ordered);
  CheckSameMesh(ordered, input);
}

TEST(SpatialOrder, OriginalIdsAreComposed)
{
  TetrahedralMesh input = MakeRandomMesh(100, 300, 1, 0);
  TetrahedralMesh plain = input;
  OrderSpatially(plain);

  for (int i = 0; i < 100; ++i)
  {
    input.OriginalPoints.push_back(i % 10 == 0 ? -1 - i / 10 : 1000 + i);
  }
  for (int i = 0; i < 300; ++i)
  {
    input.OriginalCells.push_back(i / 6);
  }
  TetrahedralMesh ordered = input;
  OrderSpatially(ordered);
  EXPECT_EQ(ordered.Cells, plain.Cells);
  for (std::size_t i = 0; i < plain.OriginalPoints.size(); ++i)
  {
    EXPECT_EQ(ordered.OriginalPoints[i], input.OriginalPoints[plain.OriginalPoints[i]]);
  }
  for (std::size_t i = 0; i < plain.OriginalCells.size(); ++i)
  {
    EXPECT_EQ(ordered.OriginalCells[i], input.OriginalCells[plain.OriginalCells[i]]);
  }
}

TEST(SpatialOrder, PointsFollowHilbertCurve)
{
  // On the full grid of 2^k points Hilbert's curve goes from neighbor to neighbor, every time.
  constexpr int n = 16;
  std::vector<std::int32_t> numbers(n * n * n);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937_64 random(13);
  std::shuffle(numbers.begin(), numbers.end(), random);
  TetrahedralMesh mesh;
  for (const int number : numbers)
  {
    // Moved up a little, so that the curve's own grid of 2^21 has them in the middle of its blocks.
    mesh.Points.insert(
      mesh.Points.end(), { number % n + 0.01, number / n % n + 0.01, number / (n * n) + 0.01 });
  }
  mesh.Points.insert(mesh.Points.end(), { 0, 0, 0, n, n, n, n, 0, 0, 0, n, 0 });
  for (std::int32_t i = 0; i < n * n * n + 4; i += 4)
  {
    mesh.Cells.insert(mesh.Cells.end(), { i, i + 1, i + 2, i + 3 });
  }
  OrderSpatially(mesh);

  std::vector<double> previous;
  int steps = 0;
  for (std::size_t point = 0; point < mesh.GetNumberOfPoints(); ++point)
  {
    const std::vector<double> position(&mesh.Points[3 * point], &mesh.Points[3 * point] + 3);
    if (mesh.OriginalPoints[point] >= n * n * n)
    {
      continue; // one of the corners that set the size
    }
    if (!previous.empty())
    {
      double distance = 0;
      for (int i = 0; i < 3; ++i)
      {
        distance += std::abs(position[i] - previous[i]);
      }
      ASSERT_NEAR(distance, 1, 1e-9);
      ++steps;
    }
    previous = position;
  }
  EXPECT_EQ(steps, n * n * n - 1);
}
