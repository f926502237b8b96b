// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/FaceNeighbors.h"

#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

namespace
{

using tetralux::FaceNeighbors;
using tetralux::FindFaceNeighbors;

/// The same by a map from faces to the cells that have them.
FaceNeighbors FindSlowly(const std::vector<std::int32_t>& cells)
{
  std::map<std::array<std::int32_t, 3>, std::vector<std::int32_t>> sharing;
  for (std::size_t face = 0; face < cells.size(); ++face)
  {
    std::array<std::int32_t, 3> points;
    for (std::size_t i = 0; i < 3; ++i)
    {
      points[i] = cells[face / 4 * 4 + (face + 1 + i) % 4];
    }
    std::sort(points.begin(), points.end());
    sharing[points].push_back(static_cast<std::int32_t>(face));
  }

  FaceNeighbors result;
  result.Neighbors.assign(cells.size(), -1);
  result.NeighborFaces.assign(cells.size(), 0);
  for (const auto& [points, faces] : sharing)
  {
    if (faces.size() == 2)
    {
      for (int i = 0; i < 2; ++i)
      {
        result.Neighbors[faces[i]] = faces[1 - i] / 4;
        result.NeighborFaces[faces[i]] = static_cast<std::uint8_t>(faces[1 - i] % 4);
      }
    }
    result.NumberOfNonManifoldFaces += faces.size() > 2;
  }

  // Components by flooding.
  std::vector<bool> isSeen(cells.size() / 4, false);
  for (std::size_t seed = 0; seed < isSeen.size(); ++seed)
  {
    result.NumberOfComponents += !isSeen[seed];
    std::vector<std::size_t> stack(isSeen[seed] ? 0 : 1, seed);
    isSeen[seed] = true;
    while (!stack.empty())
    {
      const std::size_t cell = stack.back();
      stack.pop_back();
      for (std::size_t face = 4 * cell; face < 4 * cell + 4; ++face)
      {
        const std::int32_t neighbor = result.Neighbors[face];
        if (neighbor >= 0 && !isSeen[neighbor])
        {
          isSeen[neighbor] = true;
          stack.push_back(neighbor);
        }
      }
    }
  }

  for (std::size_t face = 0; face < cells.size(); ++face)
  {
    if (result.Neighbors[face] == -1)
    {
      result.Neighbors[face] = ~static_cast<std::int32_t>(result.BoundaryFaces.size());
      result.BoundaryFaces.push_back(static_cast<std::int32_t>(face));
    }
  }
  return result;
}

void ExpectSame(const FaceNeighbors& actual, const FaceNeighbors& expected)
{
  EXPECT_EQ(actual.Neighbors, expected.Neighbors);
  EXPECT_EQ(actual.NeighborFaces, expected.NeighborFaces);
  EXPECT_EQ(actual.BoundaryFaces, expected.BoundaryFaces);
  EXPECT_EQ(actual.NumberOfNonManifoldFaces, expected.NumberOfNonManifoldFaces);
  EXPECT_EQ(actual.NumberOfComponents, expected.NumberOfComponents);
}

std::vector<std::int32_t> MakeRandomCells(int numberOfCells, int numberOfPoints, int seed)
{
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::int32_t> draw(0, numberOfPoints - 1);
  std::vector<std::int32_t> cells;
  while (cells.size() < 4u * numberOfCells)
  {
    std::array<std::int32_t, 4> cell;
    std::generate(cell.begin(), cell.end(), [&] { return draw(random); });
    std::array<std::int32_t, 4> sorted = cell;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
    {
      cells.insert(cells.end(), cell.begin(), cell.end());
    }
  }
  return cells;
}

/// Cubes of a grid of n^3, each in six tetrahedra around its diagonal, in random order.
std::vector<std::int32_t> MakeShuffledGrid(int n)
{
  std::mt19937_64 random(11);
  std::vector<std::array<std::int32_t, 4>> cells;
  const std::int32_t steps[3] = { 1, n + 1, (n + 1) * (n + 1) };
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    const std::int32_t corner =
      cube % n * steps[0] + cube / n % n * steps[1] + cube / (n * n) * steps[2];
    std::array<int, 3> axes = { 0, 1, 2 };
    do
    {
      std::array<std::int32_t, 4> cell = { corner, 0, 0, 0 };
      for (int i = 0; i < 3; ++i)
      {
        cell[i + 1] = cell[i] + steps[axes[i]];
      }
      std::shuffle(cell.begin(), cell.end(), random);
      cells.push_back(cell);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  std::shuffle(cells.begin(), cells.end(), random);
  std::vector<std::int32_t> flat;
  for (const auto& cell : cells)
  {
    flat.insert(flat.end(), cell.begin(), cell.end());
  }
  return flat;
}

} // namespace

TEST(FaceNeighbors, NoCells)
{
  const std::vector<std::int32_t> none;
  ForEachThreadCount(
    [&]
    {
      ExpectSame(FindFaceNeighbors(none, 0), FaceNeighbors{});
      ExpectSame(FindFaceNeighbors(none, 5), FaceNeighbors{});
    });
}

TEST(FaceNeighbors, OneCell)
{
  const FaceNeighbors result = FindFaceNeighbors(std::vector<std::int32_t>{ 7, 2, 9, 4 }, 10);
  EXPECT_EQ(result.Neighbors, (std::vector<std::int32_t>{ ~0, ~1, ~2, ~3 }));
  EXPECT_EQ(result.NeighborFaces, (std::vector<std::uint8_t>{ 0, 0, 0, 0 }));
  EXPECT_EQ(result.BoundaryFaces, (std::vector<std::int32_t>{ 0, 1, 2, 3 }));
  EXPECT_EQ(result.NumberOfNonManifoldFaces, 0);
  EXPECT_EQ(result.NumberOfComponents, 1);
}

TEST(FaceNeighbors, TwoCells)
{
  // They share the face 1 2 3: opposite to the first point of one, to the third of the other.
  const FaceNeighbors result =
    FindFaceNeighbors(std::vector<std::int32_t>{ 0, 1, 2, 3, 3, 1, 4, 2 }, 5);
  EXPECT_EQ(result.Neighbors, (std::vector<std::int32_t>{ 1, ~0, ~1, ~2, ~3, ~4, 0, ~5 }));
  EXPECT_EQ(result.NeighborFaces, (std::vector<std::uint8_t>{ 2, 0, 0, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(result.BoundaryFaces, (std::vector<std::int32_t>{ 1, 2, 3, 4, 5, 7 }));
  EXPECT_EQ(result.NumberOfComponents, 1);
}

TEST(FaceNeighbors, FaceOfThreeCellsIsBoundary)
{
  const FaceNeighbors result =
    FindFaceNeighbors(std::vector<std::int32_t>{ 0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5 }, 6);
  EXPECT_EQ(result.BoundaryFaces.size(), 12u);
  EXPECT_EQ(result.NumberOfNonManifoldFaces, 1);
  EXPECT_EQ(result.NumberOfComponents, 3);
}

TEST(FaceNeighbors, SharedEdgeDoesNotConnect)
{
  const FaceNeighbors result =
    FindFaceNeighbors(std::vector<std::int32_t>{ 0, 1, 2, 3, 0, 1, 4, 5 }, 6);
  EXPECT_EQ(result.BoundaryFaces.size(), 8u);
  EXPECT_EQ(result.NumberOfComponents, 2);
}

TEST(FaceNeighbors, RandomCells)
{
  // From many cells a face, to a few, to hardly any shared face.
  for (const int numberOfPoints : { 5, 8, 20, 60, 400 })
  {
    const auto cells = MakeRandomCells(500, numberOfPoints, numberOfPoints);
    const FaceNeighbors expected = FindSlowly(cells);
    ForEachThreadCount([&] { ExpectSame(FindFaceNeighbors(cells, numberOfPoints), expected); });
  }
}

TEST(FaceNeighbors, ShuffledGrid)
{
  constexpr int n = 9;
  const auto cells = MakeShuffledGrid(n);
  const FaceNeighbors expected = FindSlowly(cells);
  ASSERT_EQ(expected.BoundaryFaces.size(), 12u * n * n);
  ASSERT_EQ(expected.NumberOfComponents, 1);
  ForEachThreadCount(
    [&] { ExpectSame(FindFaceNeighbors(cells, (n + 1) * (n + 1) * (n + 1)), expected); });
}

TEST(FaceNeighbors, ManyCellsAroundOnePoint)
{
  // All faces in one bucket: a fan of tetrahedra around the edge 0 1, and a random
  // crowd at point 0.
  constexpr std::int32_t n = 5000;
  std::vector<std::int32_t> cells;
  for (std::int32_t i = 0; i < n; ++i)
  {
    cells.insert(cells.end(), { 2 + i, 1, 2 + (i + 1) % n, 0 });
  }
  auto crowd = MakeRandomCells(n, 100, 3);
  for (std::size_t i = 0; i < crowd.size(); i += 4)
  {
    const std::int32_t points[4] = { 0, crowd[i] + 10, crowd[i + 1] + 10, crowd[i + 2] + 10 };
    cells.insert(cells.end(), points, points + 4);
  }
  const FaceNeighbors expected = FindSlowly(cells);
  ForEachThreadCount([&] { ExpectSame(FindFaceNeighbors(cells, n + 2), expected); });
}
