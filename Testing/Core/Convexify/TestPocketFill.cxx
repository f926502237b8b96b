// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/PocketFill.h"
#include "Convexify/PocketFinder.h"

#include "Pockets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using pockets::Pocket;
using tetralux::BoundarySurface;
using tetralux::BoundaryTriangulation;
using tetralux::Cell;
using tetralux::EmptySpace;
using tetralux::Front;
using tetralux::Obstacle;

/// The volume of the hull less that of the mesh.
double MeasureEmptySpace(const BoundarySurface& surface, const BoundaryTriangulation& triangulation)
{
  double hull = 0;
  for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
    if (!triangulation.IsInfinite(cell))
    {
      hull += pockets::MeasureCell(surface.Coordinates, { ids[0], ids[1], ids[2], ids[3] });
    }
  }
  return hull - tetralux::MeasureEnclosedVolume(surface.Coordinates, surface.Triangles);
}

struct Filling
{
  std::vector<double> Coordinates;
  std::vector<Cell> Cells;
  Front Flat;
  Obstacle Why;
};

Filling FillPocket(const Pocket& pocket, const std::function<bool(double)>& progress = {})
{
  EmptySpace space;
  space.Pockets = { pocket.Triangles };
  Filling filling;
  filling.Coordinates = pocket.Coordinates;
  filling.Cells = tetralux::FillPockets(std::move(space),
    tetralux::PointNeighbors(tetralux::TriangulateDelaunay(pocket.Coordinates)),
    filling.Coordinates, filling.Flat, filling.Why, progress);
  return filling;
}

} // namespace

TEST(PocketFinder, ConvexMeshHasNone)
{
  tetralux::TetrahedralMesh mesh =
    tetralux::GenerateMesh("cubes", { { "count", 1 }, { "cells", 2 } }).Mesh;
  const BoundarySurface surface = pockets::MakeSurface(mesh);
  Obstacle obstacle;
  const EmptySpace space =
    tetralux::FindPockets(surface, tetralux::TriangulateDelaunay(surface.Coordinates), obstacle);
  EXPECT_EQ(obstacle.Reason, "");
  EXPECT_TRUE(space.Cells.empty());
  EXPECT_TRUE(space.Pockets.empty());
}

TEST(PocketFinder, DelaunayCellsBetweenTwoCells)
{
  // Two cells that touch in a point, all faces of which are Delaunay: no pockets are left.
  tetralux::TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1 };
  mesh.Cells = { 0, 1, 2, 3, 0, 5, 4, 6 };
  const BoundarySurface surface = pockets::MakeSurface(mesh);
  Obstacle obstacle;
  const EmptySpace space =
    tetralux::FindPockets(surface, tetralux::TriangulateDelaunay(surface.Coordinates), obstacle);
  EXPECT_EQ(obstacle.Reason, "");
  EXPECT_EQ(space.MissingFaces, 0);
  EXPECT_TRUE(space.Pockets.empty());
  // An octahedron about the origin, of eight such cells.
  EXPECT_EQ(space.Cells.size(), 6u);
  EXPECT_NEAR(pockets::MeasureCells(surface.Coordinates, space.Cells), 1, pockets::VolumeRounding);
}

TEST(PocketFinder, FindsWhatIsMissingAndFillsTheRest)
{
  std::int64_t missing = 0;
  for (const auto& [name, mesh] : pockets::GenerateMeshes())
  {
    SCOPED_TRACE(name);
    const BoundarySurface surface = pockets::MakeSurface(mesh);
    const BoundaryTriangulation triangulation = tetralux::TriangulateDelaunay(surface.Coordinates);
    const double volume = MeasureEmptySpace(surface, triangulation);
    Obstacle obstacle;
    EmptySpace space = tetralux::FindPockets(surface, triangulation, obstacle);
    ASSERT_EQ(obstacle.Reason, "");
    missing += space.MissingFaces;
    double found = pockets::MeasureCells(surface.Coordinates, space.Cells);
    for (const Front& front : space.Pockets)
    {
      EXPECT_TRUE(pockets::IsClosed(front));
      const Pocket pocket = { surface.Coordinates, front };
      EXPECT_GT(pocket.GetVolume(), -pockets::VolumeRounding); // some are flat to rounding
      found += pocket.GetVolume();
    }
    EXPECT_NEAR(found, volume, pockets::VolumeRounding * (1 + volume));

    Filling filling;
    filling.Coordinates = surface.Coordinates;
    filling.Cells = tetralux::FillPockets(std::move(space), tetralux::PointNeighbors(triangulation),
      filling.Coordinates, filling.Flat, filling.Why, {});
    ASSERT_EQ(filling.Why.Reason, "");
    const Pocket flat = { filling.Coordinates, filling.Flat };
    EXPECT_NEAR(pockets::MeasureCells(filling.Coordinates, filling.Cells) + flat.GetVolume(),
      volume, pockets::VolumeRounding * (1 + volume));
  }
  EXPECT_GT(missing, 100);
}

TEST(PocketFinder, CellsInsideOfOthersAreRefused)
{
  // A small cell that is meant to be solid inside of a large one that is solid as well.
  tetralux::TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8, 1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 1, 2 };
  mesh.Cells = { 0, 1, 2, 3, 4, 5, 6, 7 };
  const BoundarySurface surface = pockets::MakeSurface(mesh);
  Obstacle obstacle;
  tetralux::FindPockets(surface, tetralux::TriangulateDelaunay(surface.Coordinates), obstacle);
  EXPECT_EQ(obstacle.Reason, "cells of the mesh lie inside of others");
}

TEST(PocketFill, AddsAPointToSchoenhardtsPolyhedron)
{
  const Pocket pocket = pockets::MakeSchoenhardt();
  const Filling filling = FillPocket(pocket);
  EXPECT_EQ(filling.Why.Reason, "");
  EXPECT_TRUE(filling.Flat.empty());
  EXPECT_EQ(filling.Coordinates.size(), pocket.Coordinates.size() + 3);
  EXPECT_EQ(filling.Cells.size(), pocket.Triangles.size()); // one from each triangle to the point
  EXPECT_TRUE(pockets::Fill(pocket.Triangles, filling.Cells));
  EXPECT_NEAR(pockets::MeasureCells(filling.Coordinates, filling.Cells), pocket.GetVolume(),
    pockets::VolumeRounding);
}

TEST(PocketFill, AddsNoPointToConvexPockets)
{
  const Pocket pocket = pockets::MakeOctahedron();
  const Filling filling = FillPocket(pocket);
  EXPECT_EQ(filling.Why.Reason, "");
  EXPECT_EQ(filling.Coordinates.size(), pocket.Coordinates.size());
  EXPECT_TRUE(pockets::Fill(pocket.Triangles, filling.Cells));
}

TEST(PocketFill, PocketsThinnerThanRoundingAreLeftEmpty)
{
  // So flat, and so far from the origin, that there is no room for a point in it.
  Pocket pocket = pockets::MakeSchoenhardt();
  for (std::size_t p = 2; p < pocket.Coordinates.size(); p += 3)
  {
    pocket.Coordinates[p] = 1 + pocket.Coordinates[p] * std::numeric_limits<double>::epsilon();
  }
  const Filling filling = FillPocket(pocket);
  EXPECT_EQ(filling.Why.Reason, "");
  EXPECT_EQ(filling.Coordinates.size(), pocket.Coordinates.size());
  EXPECT_TRUE(filling.Cells.empty());
  EXPECT_EQ(filling.Flat, pocket.Triangles);
}

TEST(PocketFill, EndsWhenItIsTold)
{
  int calls = 0;
  const Filling filling = FillPocket(pockets::MakeSchoenhardt(),
    [&calls](double fraction)
    {
      ++calls;
      EXPECT_GE(fraction, 0);
      return false;
    });
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(filling.Cells.empty());
  EXPECT_EQ(filling.Why.Reason, "");
}
