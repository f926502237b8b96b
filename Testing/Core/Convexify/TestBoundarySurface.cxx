// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/BoundarySurface.h"

#include "Mesh/CellVolumes.h"
#include "Pockets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace
{

using tetralux::BoundarySurface;
using tetralux::Obstacle;
using tetralux::TetrahedralMesh;
using tetralux::Triangle;

double MeasureMesh(const TetrahedralMesh& mesh)
{
  double volume = 0;
  for (std::size_t i = 0; i < mesh.Cells.size(); i += 4)
  {
    const std::int32_t* ids = &mesh.Cells[i];
    volume += std::abs(pockets::MeasureCell(mesh.Points, { ids[0], ids[1], ids[2], ids[3] }));
  }
  return volume;
}

std::string FindObstacle(const TetrahedralMesh& mesh)
{
  Obstacle obstacle;
  tetralux::FindBoundarySurface(
    mesh, tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()), obstacle);
  return obstacle.Reason;
}

bool IsConvex(const BoundarySurface& surface)
{
  return tetralux::IsConvexSurface(
    tetralux::ExactPoints(surface.Coordinates.data()), surface.Triangles);
}

/// Two unit tetrahedra with points of their own, the second one moved.
TetrahedralMesh MakePair(double x, double y, double z)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  for (int i = 0; i < 4; ++i)
  {
    const double moved[3] = { mesh.Points[3 * i] + x, mesh.Points[3 * i + 1] + y,
      mesh.Points[3 * i + 2] + z };
    mesh.Points.insert(mesh.Points.end(), moved, moved + 3);
  }
  mesh.Cells = { 0, 1, 2, 3, 4, 5, 6, 7 };
  return mesh;
}

} // namespace

TEST(BoundarySurface, OneCellInAnyOrderOfPoints)
{
  const std::vector<double> points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  std::array<std::int32_t, 4> order = { 0, 1, 2, 3 };
  do
  {
    TetrahedralMesh mesh;
    mesh.Points = points;
    mesh.Cells.assign(order.begin(), order.end());
    const BoundarySurface surface = pockets::MakeSurface(mesh);
    ASSERT_EQ(surface.Triangles.size(), 4u);
    EXPECT_TRUE(pockets::IsClosed(surface.Triangles));
    EXPECT_DOUBLE_EQ(
      tetralux::MeasureEnclosedVolume(surface.Coordinates, surface.Triangles), 1. / 6);
    EXPECT_FALSE(surface.HasInvertedCells);
    EXPECT_EQ(surface.PointIds, (std::vector<std::int32_t>{ 0, 1, 2, 3 }));
    EXPECT_TRUE(IsConvex(surface));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(BoundarySurface, PointsAtTheSamePlaceAreOne)
{
  // Two halves of a pyramid, each with points of its own: their common face is inside.
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1 };
  mesh.Cells = { 0, 1, 2, 3, 4, 5, 6, 7 };
  const BoundarySurface surface = pockets::MakeSurface(mesh);
  EXPECT_EQ(surface.Triangles.size(), 6u);
  EXPECT_EQ(surface.PointIds, (std::vector<std::int32_t>{ 0, 1, 2, 3, 6 }));
  EXPECT_EQ(surface.MergedIds, (std::vector<std::int32_t>{ 0, 1, 2, 3, 0, 2, 6, 3 }));
  EXPECT_TRUE(pockets::IsClosed(surface.Triangles));
  EXPECT_DOUBLE_EQ(tetralux::MeasureEnclosedVolume(surface.Coordinates, surface.Triangles), 1. / 3);
}

TEST(BoundarySurface, CollapsedCells)
{
  TetrahedralMesh mesh = MakePair(0, 0, 0);
  mesh.Cells = { 0, 1, 2, 3, 0, 4, 1, 2 }; // 0 and 4 are at the same place
  const std::vector<std::int32_t> merged = { 0, 1, 2, 3, 0, -1, -1, -1 };
  EXPECT_FALSE(tetralux::IsCollapsed(mesh, merged, 0));
  EXPECT_TRUE(tetralux::IsCollapsed(mesh, merged, 1));
  // Points inside, without an id, are not at the same place.
  EXPECT_FALSE(tetralux::IsCollapsed(mesh, { -1, -1, -1, 3, -1, -1, -1, -1 }, 0));
}

TEST(BoundarySurface, InvertedCellsAreSeen)
{
  // Two cells on the same side of their common face: one is turned against the other.
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.2, 0.2, 2 };
  mesh.Cells = { 0, 1, 2, 3, 0, 1, 2, 4 };
  EXPECT_TRUE(pockets::MakeSurface(mesh).HasInvertedCells);
  mesh.Points.back() = -2;
  EXPECT_FALSE(pockets::MakeSurface(mesh).HasInvertedCells);
}

TEST(BoundarySurface, Obstacles)
{
  EXPECT_EQ(FindObstacle(MakePair(2, 0, 0)), "");
  // Three cells around a triangle, by points at the same place.
  TetrahedralMesh mesh = MakePair(0, 0, 0);
  mesh.Points.insert(mesh.Points.end(), { 0.5, 0.5, 2, 0, 0, -1 });
  mesh.Cells = { 0, 1, 2, 3, 4, 5, 6, 8, 0, 1, 2, 9 };
  EXPECT_EQ(FindObstacle(mesh), "three cells share a face");
  // A cell with three points in a row.
  TetrahedralMesh flat;
  flat.Points = { 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 1 };
  flat.Cells = { 0, 1, 2, 3 };
  EXPECT_EQ(FindObstacle(flat), "a boundary face has no area");
}

TEST(BoundarySurface, OneSidedRingHasNoOrientation)
{
  // A ring of seven cells, each of which has three points of the one before it. It closes by the
  // first three points, in their order or with two of them swapped, which turns the last cell over.
  TetrahedralMesh mesh;
  std::mt19937_64 random(1);
  for (int i = 0; i < 3 * 7; ++i)
  {
    mesh.Points.push_back(static_cast<double>(random() % 1000));
  }
  for (const bool isSwapped : { false, true })
  {
    const std::int32_t ring[10] = { 0, 1, 2, 3, 4, 5, 6, isSwapped, !isSwapped, 2 };
    mesh.Cells.clear();
    for (int i = 0; i < 7; ++i)
    {
      mesh.Cells.insert(mesh.Cells.end(), ring + i, ring + i + 4);
    }
    EXPECT_EQ(
      FindObstacle(mesh), isSwapped ? "cells that share faces can't be oriented alike" : "");
  }
}

TEST(BoundarySurface, OfGeneratedMeshes)
{
  for (const auto& [name, mesh] : pockets::GenerateMeshes())
  {
    SCOPED_TRACE(name);
    const auto neighbors = tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints());
    const BoundarySurface surface = pockets::MakeSurface(mesh);
    EXPECT_EQ(surface.Triangles.size(), neighbors.BoundaryFaces.size());
    EXPECT_TRUE(pockets::IsClosed(surface.Triangles));
    const double volume = MeasureMesh(mesh);
    EXPECT_NEAR(tetralux::MeasureEnclosedVolume(surface.Coordinates, surface.Triangles), volume,
      pockets::VolumeRounding * volume);
    const tetralux::ExactPoints points(mesh.Points.data());
    for (std::size_t t = 0; t < surface.Triangles.size(); ++t)
    {
      const std::int32_t cell = surface.Faces[t] / 4;
      const auto [a, b, c] = surface.Triangles[t];
      const std::int32_t apex = mesh.Cells[surface.Faces[t]];
      EXPECT_EQ(std::count(&mesh.Cells[4 * cell], &mesh.Cells[4 * cell] + 4, apex), 1);
      // The cell is on the negative side of its face.
      EXPECT_LT(
        points.Orient(surface.PointIds[a], surface.PointIds[b], surface.PointIds[c], apex), 0);
    }
    EXPECT_EQ(tetralux::FindSelfIntersection(surface).Reason, "");
    EXPECT_FALSE(IsConvex(surface));
  }
}

TEST(ConvexSurface, KnownSurfaces)
{
  const pockets::Pocket octahedron = pockets::MakeOctahedron();
  const tetralux::ExactPoints points = octahedron.GetPoints();
  const tetralux::Front outside = pockets::Reverse(octahedron.Triangles);
  EXPECT_TRUE(tetralux::IsConvexSurface(points, outside));
  EXPECT_TRUE(tetralux::IsConvexSurface(points, {}));
  // From inside, with a hole, twice.
  EXPECT_FALSE(tetralux::IsConvexSurface(points, octahedron.Triangles));
  EXPECT_FALSE(tetralux::IsConvexSurface(points, { outside.begin() + 2, outside.end() }));
  tetralux::Front twice = outside;
  twice.insert(twice.end(), outside.begin(), outside.end());
  EXPECT_FALSE(tetralux::IsConvexSurface(points, twice));

  const pockets::Pocket schoenhardt = pockets::MakeSchoenhardt();
  EXPECT_FALSE(
    tetralux::IsConvexSurface(schoenhardt.GetPoints(), pockets::Reverse(schoenhardt.Triangles)));

  // Two cells apart, also with shadows apart: each is convex, but not both together.
  EXPECT_FALSE(IsConvex(pockets::MakeSurface(MakePair(3, 0, 0))));
  EXPECT_FALSE(IsConvex(pockets::MakeSurface(MakePair(3, 5, 7))));
}

TEST(ConvexSurface, CoplanarTriangles)
{
  // A cube is convex with any diagonals, but not with a corner that is pushed in or pulled out.
  tetralux::TetrahedralMesh cube =
    tetralux::GenerateMesh("cubes", { { "count", 1 }, { "cells", 2 } }).Mesh;
  EXPECT_TRUE(IsConvex(pockets::MakeSurface(cube)));
  const tetralux::BoundarySurface surface = pockets::MakeSurface(cube);
  for (const double way : { -1e-15, 1e-15 })
  {
    tetralux::BoundarySurface changed = surface;
    for (std::size_t p = 0; p < changed.Coordinates.size(); p += 3)
    {
      const double* x = &surface.Coordinates[p];
      if (x[0] == 0.5 && x[1] == 0.5 && x[2] == 1) // the middle of the top
      {
        changed.Coordinates[p + 2] += way;
      }
    }
    EXPECT_EQ(IsConvex(changed), way > 0);
  }
}

TEST(SelfIntersection, OfTwoCells)
{
  // Apart; with a face in a face, deep in each other, touching in a point that is not shared, and
  // at the same place.
  EXPECT_EQ(tetralux::FindSelfIntersection(pockets::MakeSurface(MakePair(2, 0, 0))).Reason, "");
  const std::array<double, 3> shifts[] = { { 0.25, 0.25, 0.25 }, { 0.25, 0, 0 }, { 0.5, 0.25, 0 },
    { 0, 0, 0.9 }, { 0.25, 0.25, 0.5 }, { 0, 0, 0 } };
  for (const auto& [x, y, z] : shifts)
  {
    const Obstacle obstacle =
      tetralux::FindSelfIntersection(pockets::MakeSurface(MakePair(x, y, z)));
    EXPECT_EQ(obstacle.Reason, "the boundary intersects itself");
    const auto [first, second] = std::minmax(obstacle.Cells[0], obstacle.Cells[1]);
    EXPECT_EQ(first, 0);
    EXPECT_EQ(second, 1);
    const double shift[3] = { x, y, z };
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_GE(obstacle.Point[a], shift[a]);
      EXPECT_LE(obstacle.Point[a], 1);
    }
  }
  EXPECT_EQ(tetralux::FindSelfIntersection({}).Reason, "");
}
