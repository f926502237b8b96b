// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/WalkMesh.h"

#include "Generate/GeneratedMeshes.h"
#include "MeshParts.h"
#include "ReferenceScenes.h"

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

using tetralux::MakeBox;
using tetralux::TetrahedralMesh;
using tetralux::WalkEntry;
using tetralux::WalkFace;
using tetralux::WalkMesh;
using tetralux::WalkPoint;

/// A coordinate of the single precision table is computed in double precision, then rounded.
constexpr double FloatRounding = 1.01 / (1 << 24);

/// Checks the topology of the tables against the cells themselves.
void CheckTables(const WalkMesh& mesh)
{
  const std::vector<std::int32_t>& cells = mesh.GetMesh().Cells;
  const std::int32_t numberOfCells = mesh.GetNumberOfCells();
  std::vector<int> timesSeen(mesh.GetNumberOfBoundaryFaces(), 0);
  for (std::int32_t t = 0; t < numberOfCells; ++t)
  {
    const std::int32_t* points = &cells[4 * t];
    ASSERT_TRUE(points[0] < points[1] && points[1] < points[2] && points[2] < points[3]);
    for (int i = 0; i < 4; ++i)
    {
      const WalkFace& face = mesh.GetFaces()[4 * t + i];
      std::set<std::int32_t> corners(points, points + 4);
      corners.erase(points[i]);
      if (face.Cell >= 0)
      {
        // The cell behind has the three points and the one that is told.
        corners.insert(face.Point);
        const std::int32_t* others = &cells[4 * face.Cell];
        ASSERT_EQ(corners, std::set<std::int32_t>(others, others + 4));
        ASSERT_NE(face.Cell, t);
        continue;
      }
      const std::int32_t b = ~face.Cell;
      ASSERT_LT(b, mesh.GetNumberOfBoundaryFaces());
      ++timesSeen[b];
      const WalkEntry& entry = mesh.GetEntries()[b];
      ASSERT_EQ(entry.Cell, t);
      ASSERT_EQ(entry.Opposite, points[i]);
      ASSERT_TRUE(entry.Points[0] < entry.Points[1] && entry.Points[1] < entry.Points[2]);
      ASSERT_EQ(corners, std::set<std::int32_t>(entry.Points, entry.Points + 3));
      ASSERT_EQ(face.Point, points[i]);
    }
  }
  EXPECT_TRUE(std::all_of(timesSeen.begin(), timesSeen.end(), [](int n) { return n == 1; }));
  EXPECT_EQ(mesh.GetBvh().Triangles.size(), timesSeen.size());
}

/// Checks that the coordinates are those of the mesh, relative to its centre, and within 1.
template <class Real>
void CheckCoordinates(const WalkMesh& mesh, double rounding)
{
  const std::vector<double>& points = mesh.GetMesh().Points;
  for (std::size_t p = 0; p < mesh.GetMesh().GetNumberOfPoints(); ++p)
  {
    const WalkPoint<Real>& point = mesh.GetPoints<Real>()[p];
    const Real x[3] = { point.X, point.Y, point.Z };
    double squared = 0;
    for (int a = 0; a < 3; ++a)
    {
      const long double expected =
        (static_cast<long double>(points[3 * p + a]) - mesh.GetCenter()[a]) / mesh.GetRadius();
      ASSERT_LE(std::abs(static_cast<double>(x[a] - expected)), rounding);
      squared += static_cast<double>(x[a]) * x[a];
    }
    ASSERT_LE(std::sqrt(squared), 1 + 4 * rounding);
  }
}

TEST(WalkMesh, Empty)
{
  TetrahedralMesh onlyPoints;
  onlyPoints.Points = { 0, 0, 0, 1, 0, 0 };
  for (const TetrahedralMesh& input : { TetrahedralMesh(), onlyPoints })
  {
    WalkMesh mesh(input);
    EXPECT_EQ(mesh.GetNumberOfCells(), 0);
    EXPECT_EQ(mesh.GetNumberOfBoundaryFaces(), 0);
    EXPECT_EQ(mesh.GetNumberOfComponents(), 0);
    EXPECT_EQ(mesh.GetNumberOfNonManifoldFaces(), 0);
    EXPECT_EQ(mesh.GetMesh().GetNumberOfPoints(), 0u); // no cell uses them
    EXPECT_EQ(mesh.GetRadius(), 1);
    EXPECT_TRUE(mesh.GetBvh().Nodes.empty());
    mesh.SetPointScalars<float>({}, 0, 1);
    mesh.SetPointScalars<double>({}, 0, 1);
    EXPECT_EQ(mesh.GetTableSize(), 0u);
  }
}

TEST(WalkMesh, OneCell)
{
  TetrahedralMesh input;
  input.Points = { 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2 };
  input.Cells = { 3, 1, 0, 2 };
  const WalkMesh mesh(input);
  EXPECT_EQ(mesh.GetNumberOfCells(), 1);
  EXPECT_EQ(mesh.GetNumberOfBoundaryFaces(), 4);
  EXPECT_EQ(mesh.GetNumberOfComponents(), 1);
  EXPECT_DOUBLE_EQ(mesh.GetRadius(), std::sqrt(3.));
  EXPECT_EQ(mesh.GetCenter()[0], 1);
  CheckTables(mesh);
  CheckCoordinates<float>(mesh, FloatRounding);
}

TEST(WalkMesh, CellsAtOnePointHaveARadius)
{
  TetrahedralMesh input;
  for (int p = 0; p < 4; ++p)
  {
    input.Points.insert(input.Points.end(), { 3, 4, 5 });
  }
  input.Cells = { 0, 1, 2, 3 };
  const WalkMesh mesh(input);
  EXPECT_EQ(mesh.GetRadius(), 1);
  CheckTables(mesh);
  CheckCoordinates<float>(mesh, 0);
}

TEST(WalkMesh, TablesMatchTheCells)
{
  const WalkMesh box(MakeBox(7, 5, 6, { -1, 0, 2 }, { 4, 1, 3 }, 0.1));
  EXPECT_EQ(box.GetNumberOfCells(), 7 * 5 * 6 * 5);
  EXPECT_EQ(box.GetNumberOfBoundaryFaces(), 2 * 2 * (7 * 5 + 5 * 6 + 6 * 7));
  EXPECT_EQ(box.GetNumberOfComponents(), 1);
  CheckTables(box);
  CheckCoordinates<float>(box, FloatRounding);

  // Nothing but chance: faces of many cells, duplicates, repeated points.
  std::mt19937_64 generator(4);
  TetrahedralMesh input;
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 3 * 25; ++i)
  {
    input.Points.push_back(unit(generator));
  }
  for (int i = 0; i < 4 * 3000; ++i)
  {
    input.Cells.push_back(static_cast<std::int32_t>(generator() % 25));
  }
  const WalkMesh random(input);
  EXPECT_GT(random.GetRemovedCells().Duplicates, 0);
  EXPECT_GT(random.GetRemovedCells().RepeatedPoints, 0);
  EXPECT_GT(random.GetNumberOfNonManifoldFaces(), 0);
  EXPECT_EQ(random.GetNumberOfCells() + random.GetRemovedCells().Total(), 3000);
  CheckTables(random);
}

TEST(WalkMesh, SmallCellsFarAway)
{
  // 1e7 away, 1e-3 large: what double precision leaves of that, relative to the mesh's own centre.
  constexpr double Offset = 1e7;
  constexpr double Size = 8e-3;
  const WalkMesh mesh(
    MakeBox(8, 8, 8, { Offset, Offset, Offset }, { Offset + Size, Offset + Size, Offset + Size }));
  EXPECT_NEAR(mesh.GetRadius(), 0.5 * std::sqrt(3.) * Size, 1e-8);
  CheckTables(mesh);
  CheckCoordinates<float>(mesh, FloatRounding);
}

TEST(WalkMesh, CoordinatesOfAnySize)
{
  // Up to where the sum of two of them overflows, down to where numbers lose digits.
  for (const double size : { 1e308, 1e150, 1e-150, 1e-300, 1e-310 })
  {
    SCOPED_TRACE(size);
    const WalkMesh mesh(MakeBox(3, 3, 3, { -size, -size, -size }, { size, size, size }));
    EXPECT_EQ(mesh.GetNumberOfCells(), 135);
    CheckTables(mesh);
    for (std::size_t p = 0; p < mesh.GetMesh().GetNumberOfPoints(); ++p)
    {
      const WalkPoint<float>& point = mesh.GetPoints<float>()[p];
      ASSERT_TRUE(std::isfinite(point.X) && std::isfinite(point.Y) && std::isfinite(point.Z));
      ASSERT_LE(std::hypot(point.X, point.Y, point.Z), 1 + 4 * FloatRounding);
    }
  }
}

TEST(WalkMesh, ScalarsAreMappedAndBoundedAndMayBeMissing)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  WalkMesh mesh(MakeBox(1, 1, 1, { 0, 0, 0 }, { 1, 1, 1 }));
  ASSERT_EQ(mesh.GetMesh().GetNumberOfPoints(), 8u);
  const std::vector<double> scalars = { 3, 5, -7, NaN, Infinity, -Infinity, 1e300, -1e300 };
  mesh.SetPointScalars<float>(scalars, 1, 4);
  const WalkPoint<float>* points = mesh.GetPoints<float>();
  EXPECT_EQ(points[0].S, 0.5f);
  EXPECT_EQ(points[1].S, 1.f);
  EXPECT_EQ(points[2].S, -2.f);
  for (int p = 3; p < 6; ++p)
  {
    EXPECT_TRUE(std::isnan(points[p].S));
  }
  EXPECT_GT(points[6].S, 1e20f);
  EXPECT_LT(points[7].S, -1e20f);
  EXPECT_TRUE(std::isfinite(points[6].S - points[7].S));

  // The double precision table comes on demand, and is filled apart from the other.
  EXPECT_EQ(mesh.GetPoints<double>(), nullptr);
  mesh.SetPointScalars<double>(std::vector<double>(8, 0.1), 0, 1);
  EXPECT_EQ(mesh.GetPoints<double>()[2].S, 0.1);
  EXPECT_EQ(mesh.GetPoints<float>()[2].S, -2.f);
  CheckCoordinates<double>(mesh, 1e-15);
}

TEST(WalkMesh, TableSizeIsBounded)
{
  // 32 bytes a tetrahedron for the topology, 16 a point. A boundary face has its entry, its place
  // in the tree, and fewer than two nodes.
  WalkMesh mesh(MakeBox(20, 20, 20, { 0, 0, 0 }, { 1, 1, 1 }));
  const std::size_t cells = mesh.GetMesh().GetNumberOfCells();
  const std::size_t points = mesh.GetMesh().GetNumberOfPoints();
  const std::size_t faces = mesh.GetNumberOfBoundaryFaces();
  const std::size_t tables = 32 * cells + 16 * points;
  const std::size_t aFace =
    sizeof(WalkEntry) + sizeof(std::int32_t) + 2 * sizeof(tetralux::BoundaryBvh::Node);
  EXPECT_GE(mesh.GetTableSize(), tables);
  EXPECT_LE(mesh.GetTableSize(), tables + aFace * faces);
  const std::size_t before = mesh.GetTableSize();
  mesh.SetPointScalars<double>(std::vector<double>(points, 0.), 0, 1);
  EXPECT_EQ(mesh.GetTableSize(), before + 32 * points);
}

TEST(WalkMesh, Convexity)
{
  EXPECT_TRUE(WalkMesh(tetralux::MakeBox(4, 3, 2, { 0, 0, 0 }, { 1, 1, 1 }, 0.15)).IsConvex());
  WalkMesh pipe(tetralux::GenerateMesh(
    "cylinder-with-hole", { { "across", 1 }, { "around", 8 }, { "along", 2 } })
                  .Mesh);
  EXPECT_FALSE(pipe.IsConvex());
  pipe.MakeConvex();
  EXPECT_FALSE(pipe.IsConvex());
}

TEST(WalkMesh, PartsThatTouchAreNotConvex)
{
  // Faces that coincide, and others that only touch.
  for (const int cells : { 2, 3 })
  {
    TetrahedralMesh boxes = tetralux::MakeBox(2, 2, 2, { 0, 0, 0 }, { 1, 1, 1 });
    tetralux::AddMesh(boxes, tetralux::MakeBox(cells, cells, cells, { 1, 0, 0 }, { 2, 1, 1 }));
    WalkMesh mesh(std::move(boxes));
    EXPECT_FALSE(mesh.IsConvex());
    mesh.MakeConvex();
    EXPECT_FALSE(mesh.IsConvex());
    EXPECT_FALSE(mesh.GetConvexification()->Refusal.empty());
    EXPECT_TRUE(mesh.GetConvexTables().Faces.empty());
  }
}

/// A pyramid of two cells whose apex has two points, 0 and 1, and a flat cell between both, as
/// around the axis of a structured grid; and another cell on one of its faces.
TetrahedralMesh MakePyramidWithSeam(
  const std::array<std::int32_t, 3>& face, const std::array<double, 3>& apex)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 2, 0, 0, 2, 0, -2, 0, 0, 2, 0, -2, 0, 0, 2, 0, 0 };
  mesh.Points.insert(mesh.Points.end(), apex.begin(), apex.end());
  mesh.Cells = { 0, 2, 3, 4, 1, 2, 3, 5, 0, 1, 2, 3, face[0], face[1], face[2], 6 };
  return mesh;
}

TEST(WalkMesh, ImaginaryCellsShareFacesWithTheMesh)
{
  // Below: no imaginary cell is put on a face with the second point.
  WalkMesh below(MakePyramidWithSeam({ 2, 3, 4 }, { -0.5, 0, -0.5 }));
  EXPECT_FALSE(below.IsConvex());
  below.MakeConvex();
  EXPECT_EQ(below.GetConvexification()->Refusal, "");
  EXPECT_GT(below.GetConvexification()->GetNumberOfCells(), 0);
  EXPECT_FALSE(below.GetConvexTables().Faces.empty());

  WalkMesh beside(MakePyramidWithSeam({ 1, 2, 5 }, { 3, -3, 3 }));
  beside.MakeConvex();
  EXPECT_NE(beside.GetConvexification()->Refusal.find("cells touch without sharing points"),
    std::string::npos)
    << beside.GetConvexification()->Refusal;
  EXPECT_TRUE(beside.GetConvexTables().Faces.empty());
}

TEST(WalkMesh, ReportsProgressAndEndsWhereItIsTold)
{
  const TetrahedralMesh mesh = MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0);
  std::vector<double> shares;
  const WalkMesh whole(mesh,
    [&shares](double share)
    {
      shares.push_back(share);
      return true;
    });
  EXPECT_TRUE(whole.IsComplete());
  EXPECT_GT(whole.GetNumberOfBoundaryFaces(), 0);
  ASSERT_GE(shares.size(), 3u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.front(), 0);
  EXPECT_LT(shares.back(), 1);

  for (std::size_t last = 0; last < shares.size(); ++last)
  {
    std::size_t calls = 0;
    const WalkMesh ended(mesh, [&](double) { return calls++ < last; });
    EXPECT_EQ(calls, last + 1);
    EXPECT_FALSE(ended.IsComplete());
    EXPECT_EQ(ended.GetNumberOfCells(), 0);
  }
}

} // namespace
