// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CoincidentPoints.h"

#include "MeshParts.h"
#include "ReferenceScenes.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace
{

using tetralux::CoincidentPoints;
using tetralux::FindCoincidentPoints;
using tetralux::TetrahedralMesh;

constexpr double FloatTolerance = 4. * std::numeric_limits<float>::epsilon();
constexpr double DoubleTolerance = 4. * std::numeric_limits<double>::epsilon();

std::vector<std::int32_t> GetAllPoints(const TetrahedralMesh& mesh)
{
  std::vector<std::int32_t> points(mesh.GetNumberOfPoints());
  std::iota(points.begin(), points.end(), 0);
  return points;
}

CoincidentPoints FindAll(const TetrahedralMesh& mesh, double tolerance)
{
  return FindCoincidentPoints(mesh, GetAllPoints(mesh), tolerance);
}

/// A box of jittered cells, each with points of its own, somewhere and of some size.
TetrahedralMesh MakeSeparateCells(double offset, double size)
{
  const double end = offset + size;
  TetrahedralMesh mesh = tetralux::SeparateCells(
    tetralux::MakeBox(3, 4, 2, { offset, offset, offset }, { end, end, end }, 0.15));
  mesh.OriginalPoints.clear();
  return mesh;
}

/// The same by a map of coordinates.
CoincidentPoints FindByMap(const TetrahedralMesh& mesh)
{
  CoincidentPoints result;
  std::map<std::tuple<double, double, double>, std::int64_t> firsts;
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &mesh.Points[3 * p];
    const auto [first, isNew] =
      firsts.emplace(std::make_tuple(x[0], x[1], x[2]), static_cast<std::int64_t>(p));
    if (!isNew)
    {
      result.Points.push_back(static_cast<std::int64_t>(p));
      result.Firsts.push_back(first->second);
    }
  }
  return result;
}

TEST(CoincidentPoints, NoneWherePointsAreShared)
{
  const TetrahedralMesh mesh = tetralux::MakeBox(6, 5, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  EXPECT_TRUE(FindAll(mesh, FloatTolerance).Points.empty());
  EXPECT_TRUE(FindAll(TetrahedralMesh(), FloatTolerance).Points.empty());
}

TEST(CoincidentPoints, SameCoordinatesInAnyUnit)
{
  for (const auto& [offset, size] :
    { std::pair(0., 1.), std::pair(1e7, 1.), std::pair(-3., 1e30), std::pair(0., 1e-30) })
  {
    SCOPED_TRACE(testing::Message() << "size " << size << " at " << offset);
    const TetrahedralMesh mesh = MakeSeparateCells(offset, size);
    const CoincidentPoints expected = FindByMap(mesh);
    ASSERT_GT(expected.Points.size(), mesh.GetNumberOfPoints() / 2);
    EXPECT_TRUE(FindAll(mesh, 0) == expected);
    EXPECT_TRUE(FindAll(mesh, DoubleTolerance) == expected);
  }
}

TEST(CoincidentPoints, LastBitsMayDiffer)
{
  for (const double size : { 1., 1e30, 1e-30 })
  {
    SCOPED_TRACE(size);
    TetrahedralMesh mesh = MakeSeparateCells(0, size);
    const CoincidentPoints expected = FindByMap(mesh);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> bits(-0.5, 0.5);
    for (double& x : mesh.Points)
    {
      x += bits(random) * FloatTolerance * size;
    }
    EXPECT_TRUE(FindAll(mesh, FloatTolerance) == expected);
    EXPECT_TRUE(FindAll(mesh, DoubleTolerance).Points.empty());
  }
}

TEST(CoincidentPoints, CellsSmallerThanTheToleranceKeepTheirPoints)
{
  // A cell of a millionth of the mesh's place: all of its points are within the tolerance.
  TetrahedralMesh mesh = MakeSeparateCells(1e7, 1e-1);
  const CoincidentPoints expected = FindByMap(mesh);
  const CoincidentPoints found = FindAll(mesh, FloatTolerance);
  EXPECT_TRUE(found == expected);
  EXPECT_EQ(found.Distance, 0);
}

TEST(CoincidentPoints, FarFromTheOriginInSinglePrecision)
{
  // As coordinates of a map: rounded to half a unit, cells of 50. Many distinct points are within
  // the tolerance of each other in any one direction.
  TetrahedralMesh mesh = tetralux::SeparateCells(
    tetralux::MakeBox(20, 20, 20, { 5e6, 5e6, 5e6 }, { 5e6 + 1e3, 5e6 + 1e3, 5e6 + 1e3 }));
  mesh.OriginalPoints.clear();
  const CoincidentPoints expected = FindByMap(mesh);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> bits(-0.49, 0.49);
  for (double& x : mesh.Points)
  {
    x += bits(random) * FloatTolerance * 5e6;
  }
  EXPECT_TRUE(FindAll(mesh, FloatTolerance) == expected);
}

TEST(CoincidentPoints, OnlyCandidatesAndPointsOfTheInput)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
  mesh.OriginalPoints = { 7, 3, 5, -1, 2 };
  const CoincidentPoints all = FindAll(mesh, FloatTolerance);
  EXPECT_EQ(all.Points, std::vector<std::int64_t>({ 5, 7 }));
  EXPECT_EQ(all.Firsts, std::vector<std::int64_t>({ 2, 2 }));
  const std::vector<std::int32_t> candidates = { 1, 2, 0 };
  const CoincidentPoints some = FindCoincidentPoints(mesh, candidates, FloatTolerance);
  EXPECT_EQ(some.Points, std::vector<std::int64_t>({ 7 }));
  EXPECT_EQ(some.Firsts, std::vector<std::int64_t>({ 5 }));
}

TEST(CoincidentPoints, PointsThatAreNoNumbersStayAlone)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TetrahedralMesh mesh;
  for (const double x : { 1., nan, infinity, 1., nan, infinity, 1. })
  {
    mesh.Points.insert(mesh.Points.end(), { 2, x, 3 });
  }
  const CoincidentPoints found = FindAll(mesh, FloatTolerance);
  EXPECT_EQ(found.Points, std::vector<std::int64_t>({ 3, 6 }));
  EXPECT_EQ(found.Firsts, std::vector<std::int64_t>({ 0, 0 }));
}

TEST(CoincidentPoints, DoNotDependOnTheNumberOfThreads)
{
  const TetrahedralMesh mesh = MakeSeparateCells(0, 1);
  const CoincidentPoints expected = FindByMap(mesh);
  ForEachThreadCount([&] { EXPECT_TRUE(FindAll(mesh, FloatTolerance) == expected); });
}

} // namespace
