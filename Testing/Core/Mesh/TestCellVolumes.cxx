// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CellVolumes.h"

#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using tetralux::CellVolumes;
using tetralux::MeasureCells;
using tetralux::TetrahedralMesh;

/// The corner of a box of size a x b x c at an offset: a tetrahedron of volume a b c / 6.
TetrahedralMesh MakeCorner(double a, double b, double c, double offset = 0)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, a, 0, 0, 0, b, 0, 0, 0, c };
  for (double& coordinate : mesh.Points)
  {
    coordinate += offset;
  }
  mesh.Cells = { 0, 1, 2, 3 };
  return mesh;
}

} // namespace

TEST(CellVolumes, EmptyMesh)
{
  const CellVolumes volumes = MeasureCells(TetrahedralMesh{});
  EXPECT_EQ(volumes.Total, 0);
  EXPECT_EQ(volumes.NumberOfZero, 0);
  EXPECT_EQ(volumes.NumberOfInverted, 0);
  EXPECT_EQ(volumes.ShortestEdge, 0);
  EXPECT_EQ(volumes.LongestEdge, 0);
}

TEST(CellVolumes, OneCell)
{
  TetrahedralMesh mesh = MakeCorner(1, 2, 3);
  CellVolumes volumes = MeasureCells(mesh);
  EXPECT_DOUBLE_EQ(volumes.Total, 1);
  EXPECT_EQ(volumes.NumberOfZero, 0);
  EXPECT_EQ(volumes.NumberOfInverted, 0);
  EXPECT_DOUBLE_EQ(volumes.ShortestEdge, 1);
  EXPECT_DOUBLE_EQ(volumes.LongestEdge, std::sqrt(13));

  mesh.Cells = { 0, 2, 1, 3 };
  volumes = MeasureCells(mesh);
  EXPECT_DOUBLE_EQ(volumes.Total, 1);
  EXPECT_EQ(volumes.NumberOfInverted, 1);
}

TEST(CellVolumes, SmallCellsFarAway)
{
  // 2^-10 is exact at an offset of 1e7, so that the volume has its full precision.
  const double size = std::ldexp(1, -10);
  for (const double offset : { 1e7, -1e7 })
  {
    const CellVolumes volumes = MeasureCells(MakeCorner(size, size, size, offset));
    EXPECT_DOUBLE_EQ(volumes.Total, size * size * size / 6);
    EXPECT_EQ(volumes.NumberOfZero, 0);
    EXPECT_DOUBLE_EQ(volumes.ShortestEdge, size);
    EXPECT_DOUBLE_EQ(volumes.LongestEdge, size * std::sqrt(2));
  }
}

TEST(CellVolumes, ThinIsNotZero)
{
  for (const double thickness : { 1e-6, 1e-12, 1e-100 })
  {
    const CellVolumes volumes = MeasureCells(MakeCorner(1, 1, thickness));
    EXPECT_DOUBLE_EQ(volumes.Total, thickness / 6);
    EXPECT_EQ(volumes.NumberOfZero, 0);
    EXPECT_DOUBLE_EQ(volumes.ShortestEdge, thickness);
  }
}

TEST(CellVolumes, FlatCellsInAnyDirection)
{
  // Whole numbers, so that four points are exactly in a plane, and so large that the products of
  // their differences are rounded: the determinant comes out as noise.
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> draw(-(1 << 30), 1 << 30);
  TetrahedralMesh mesh;
  constexpr int numberOfCells = 1000;
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    double vectors[2][3];
    std::generate_n(vectors[0], 3, [&] { return draw(random); });
    std::generate_n(vectors[1], 3, [&] { return draw(random); });
    const double factors[4][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 3, -5 } };
    for (int corner = 0; corner < 4; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        mesh.Points.push_back(
          factors[corner][0] * vectors[0][axis] + factors[corner][1] * vectors[1][axis]);
      }
      mesh.Cells.push_back(4 * cell + corner);
    }
  }
  CellVolumes volumes = MeasureCells(mesh);
  EXPECT_EQ(volumes.NumberOfZero, numberOfCells);
  EXPECT_EQ(volumes.NumberOfInverted, 0);
  EXPECT_EQ(volumes.Total, 0);
  EXPECT_GT(volumes.ShortestEdge, 0);

  // One part in 2^40 out of the plane is not noise.
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    mesh.Points[12 * cell] += std::ldexp(1, -10);
  }
  volumes = MeasureCells(mesh);
  EXPECT_LT(volumes.NumberOfZero, numberOfCells / 100);
}

TEST(CellVolumes, EdgesOfLengthZero)
{
  TetrahedralMesh mesh = MakeCorner(1, 2, 3);
  std::copy_n(&mesh.Points[0], 3, &mesh.Points[9]);
  CellVolumes volumes = MeasureCells(mesh);
  EXPECT_EQ(volumes.NumberOfZero, 1);
  EXPECT_DOUBLE_EQ(volumes.ShortestEdge, 1);
  EXPECT_DOUBLE_EQ(volumes.LongestEdge, std::sqrt(5));

  std::fill(mesh.Points.begin(), mesh.Points.end(), 4);
  volumes = MeasureCells(mesh);
  EXPECT_EQ(volumes.NumberOfZero, 1);
  EXPECT_EQ(volumes.ShortestEdge, 0);
  EXPECT_EQ(volumes.LongestEdge, 0);
}

TEST(CellVolumes, SameForAnyNumberOfThreads)
{
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> draw(-1, 1);
  TetrahedralMesh mesh;
  for (int i = 0; i < 3 * 1000; ++i)
  {
    mesh.Points.push_back(draw(random));
  }
  for (int i = 0; i < 4 * 50000; ++i)
  {
    mesh.Cells.push_back(static_cast<std::int32_t>(random() % 1000));
  }
  const CellVolumes first = MeasureCells(mesh);
  EXPECT_GT(first.NumberOfInverted, 20000);
  EXPECT_GT(first.NumberOfZero, 50); // repeated points
  ForEachThreadCount(
    [&]
    {
      const CellVolumes volumes = MeasureCells(mesh);
      EXPECT_EQ(volumes.Total, first.Total);
      EXPECT_EQ(volumes.NumberOfZero, first.NumberOfZero);
      EXPECT_EQ(volumes.NumberOfInverted, first.NumberOfInverted);
      EXPECT_EQ(volumes.ShortestEdge, first.ShortestEdge);
      EXPECT_EQ(volumes.LongestEdge, first.LongestEdge);
    });
}
