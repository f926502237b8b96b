// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/CellComplex.h"
#include "Convexify/PocketFront.h"
#include "Convexify/PocketSearch.h"
#include "Convexify/PocketWrap.h"
#include "Convexify/SteinerPoint.h"

#include "Pockets.h"
#include "Rationals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace
{

using pockets::Pocket;
using tetralux::Cell;
using tetralux::Front;
using tetralux::Triangle;

/// The pocket of one cell: its faces from inside.
Front MakeFront(const Cell& cell)
{
  Front front;
  for (const auto& face : tetralux::OutwardFaces)
  {
    front.push_back({ cell[face[0]], cell[face[2]], cell[face[1]] });
  }
  return front;
}

void Append(Front& front, const Front& other)
{
  front.insert(front.end(), other.begin(), other.end());
}

std::vector<std::size_t> GetSizes(const std::vector<Front>& fronts)
{
  std::vector<std::size_t> sizes;
  for (const Front& front : fronts)
  {
    sizes.push_back(front.size());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

tetralux::PointNeighbors MakeNeighbors(const Pocket& pocket)
{
  return tetralux::PointNeighbors(tetralux::TriangulateDelaunay(pocket.Coordinates));
}

/// Points of an ellipsoid, and the triangles of their hull from inside: a convex pocket, of no five
/// points on one sphere.
Pocket MakeEllipsoid(int count)
{
  Pocket pocket;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < count; ++i)
  {
    const double x = normal(random), y = normal(random), z = normal(random);
    const double length = std::hypot(x, y, z);
    const double point[3] = { x / length, 1.7 * y / length, 0.6 * z / length };
    pocket.Coordinates.insert(pocket.Coordinates.end(), point, point + 3);
  }
  const tetralux::BoundaryTriangulation triangulation =
    tetralux::TriangulateDelaunay(pocket.Coordinates);
  for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
  {
    for (int i = 0; i < 4 && !triangulation.IsInfinite(cell); ++i)
    {
      if (triangulation.IsInfinite(triangulation.Neighbors[4 * std::size_t(cell) + i]))
      {
        const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
        const int* face = tetralux::OutwardFaces[i];
        pocket.Triangles.push_back({ ids[face[0]], ids[face[2]], ids[face[1]] });
      }
    }
  }
  return pocket;
}

/// A channel of five unit cubes in the shape of a U: no point of it sees all of its walls.
Pocket MakeChannel()
{
  tetralux::TetrahedralMesh mesh;
  const int cubes[5][2] = { { 0, 1 }, { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 } };
  std::map<std::array<int, 3>, std::int32_t> ids;
  for (const auto& [x, y] : cubes)
  {
    std::int32_t corners[8];
    for (int i = 0; i < 8; ++i)
    {
      const std::array<int, 3> at = { x + (i & 1), y + (i >> 1 & 1), i >> 2 };
      const auto [entry, isNew] = ids.try_emplace(at, static_cast<std::int32_t>(ids.size()));
      if (isNew)
      {
        mesh.Points.insert(mesh.Points.end(), at.begin(), at.end());
      }
      corners[i] = entry->second;
    }
    // Six cells around the diagonal, which conform from cube to cube.
    const int ways[6][2] = { { 1, 3 }, { 3, 2 }, { 2, 6 }, { 6, 4 }, { 4, 5 }, { 5, 1 } };
    for (const auto& way : ways)
    {
      const std::int32_t cell[4] = { corners[0], corners[way[0]], corners[way[1]], corners[7] };
      mesh.Cells.insert(mesh.Cells.end(), cell, cell + 4);
    }
  }
  const tetralux::BoundarySurface surface = pockets::MakeSurface(mesh);
  return { surface.Coordinates, pockets::Reverse(surface.Triangles) };
}

} // namespace

TEST(Pockets, KnownOnes)
{
  const Pocket octahedron = pockets::MakeOctahedron();
  EXPECT_TRUE(pockets::IsClosed(octahedron.Triangles));
  EXPECT_NEAR(octahedron.GetVolume(), 4. / 3, pockets::VolumeRounding);
  const Pocket schoenhardt = pockets::MakeSchoenhardt();
  EXPECT_TRUE(pockets::IsClosed(schoenhardt.Triangles));
  EXPECT_GT(schoenhardt.GetVolume(), 1);
  const Pocket channel = MakeChannel();
  EXPECT_TRUE(pockets::IsClosed(channel.Triangles));
  EXPECT_NEAR(channel.GetVolume(), 5, pockets::VolumeRounding);
}

TEST(PocketFront, PartsThatShareEdgesOrPoints)
{
  const std::vector<double> coordinates = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1,
    -1, 0, 0, 0, 1, 1 };
  const tetralux::ExactPoints points(coordinates.data());
  const Cell cell = { 0, 1, 2, 3 };
  struct
  {
    Cell Other;
    std::size_t Parts;
  } const cases[] = {
    { { 0, 1, 4, 5 }, 2 }, // the edge 0 1
    { { 0, 6, 4, 5 }, 2 }, // the point 0
    { { 1, 3, 2, 7 }, 1 }, // a face, which is left out
  };
  for (const auto& [other, parts] : cases)
  {
    Cell turned = other;
    if (points.Orient(turned[0], turned[1], turned[2], turned[3]) < 0)
    {
      std::swap(turned[0], turned[1]);
    }
    Front front;
    for (const Cell& each : { cell, turned })
    {
      for (const Triangle& triangle : MakeFront(each))
      {
        std::set<std::int32_t> ids(triangle.begin(), triangle.end());
        if (parts > 1 || ids != std::set<std::int32_t>{ 1, 2, 3 })
        {
          front.push_back(triangle);
        }
      }
    }
    std::mt19937_64 random(1);
    for (int order = 0; order < 10; ++order)
    {
      std::shuffle(front.begin(), front.end(), random);
      const auto split = tetralux::SplitFront(points, front);
      EXPECT_EQ(GetSizes(split),
        parts == 2 ? (std::vector<std::size_t>{ 4, 4 }) : std::vector<std::size_t>{ 6 });
      for (const Front& part : split)
      {
        EXPECT_TRUE(pockets::IsClosed(part));
      }
    }
  }
}

TEST(PocketFront, IslandsStayWithTheirPocket)
{
  // A small tetrahedron in a large one, seen from the space between them.
  Pocket pocket;
  for (const double size : { 10., 1. })
  {
    const double corners[12] = { -size, -size, -size, 3 * size, -size, -size, -size, 3 * size,
      -size, -size, -size, 3 * size };
    pocket.Coordinates.insert(pocket.Coordinates.end(), corners, corners + 12);
  }
  pocket.Triangles = MakeFront({ 0, 1, 2, 3 });
  Append(pocket.Triangles, pockets::Reverse(MakeFront({ 4, 5, 6, 7 })));
  EXPECT_EQ(GetSizes(tetralux::SplitFront(pocket.GetPoints(), pocket.Triangles)),
    (std::vector<std::size_t>{ 8 }));
}

TEST(PocketFront, OpenOnesBoundNothing)
{
  const Pocket octahedron = pockets::MakeOctahedron();
  Front open = octahedron.Triangles;
  open.pop_back();
  EXPECT_TRUE(tetralux::SplitFront(octahedron.GetPoints(), open).empty());
  Front twice = octahedron.Triangles;
  Append(twice, octahedron.Triangles);
  EXPECT_TRUE(tetralux::SplitFront(octahedron.GetPoints(), twice).empty());
  EXPECT_TRUE(tetralux::SplitFront(octahedron.GetPoints(), {}).empty());
}

TEST(PocketSearch, FillsAnOctahedron)
{
  const Pocket octahedron = pockets::MakeOctahedron();
  std::vector<Cell> joined;
  ASSERT_TRUE(tetralux::FillFromPoint(octahedron.GetPoints(), octahedron.Triangles, joined));
  EXPECT_EQ(joined.size(), 4u);
  EXPECT_TRUE(pockets::Fill(octahedron.Triangles, joined));
  EXPECT_NEAR(pockets::MeasureCells(octahedron.Coordinates, joined), octahedron.GetVolume(),
    pockets::VolumeRounding);

  std::vector<Cell> searched = { { 0, 1, 2, 3 } }; // what was there is kept
  ASSERT_TRUE(tetralux::SearchCells(octahedron.GetPoints(), octahedron.Triangles, 100, searched));
  EXPECT_EQ(searched[0], (Cell{ 0, 1, 2, 3 }));
  searched.erase(searched.begin());
  EXPECT_EQ(searched.size(), 4u);
  EXPECT_TRUE(pockets::Fill(octahedron.Triangles, searched));
  EXPECT_NEAR(pockets::MeasureCells(octahedron.Coordinates, searched), octahedron.GetVolume(),
    pockets::VolumeRounding);

  // Four cells take four steps.
  EXPECT_FALSE(tetralux::SearchCells(octahedron.GetPoints(), octahedron.Triangles, 3, searched));
  EXPECT_EQ(searched.size(), 4u);
}

TEST(PocketSearch, FillsAChannelThatNoPointSees)
{
  const Pocket channel = MakeChannel();
  std::vector<Cell> cells;
  EXPECT_FALSE(tetralux::FillFromPoint(channel.GetPoints(), channel.Triangles, cells));
  EXPECT_TRUE(cells.empty());
  ASSERT_TRUE(tetralux::SearchCells(channel.GetPoints(), channel.Triangles, 5000, cells));
  EXPECT_TRUE(pockets::Fill(channel.Triangles, cells));
  EXPECT_NEAR(pockets::MeasureCells(channel.Coordinates, cells), 5, pockets::VolumeRounding);
}

TEST(PocketSearch, NothingFillsSchoenhardtsPolyhedron)
{
  const Pocket pocket = pockets::MakeSchoenhardt();
  std::vector<Cell> cells;
  EXPECT_FALSE(tetralux::FillFromPoint(pocket.GetPoints(), pocket.Triangles, cells));
  EXPECT_FALSE(tetralux::SearchCells(pocket.GetPoints(), pocket.Triangles, 100000, cells));
  EXPECT_TRUE(cells.empty());
}

TEST(PocketSearch, PointsOfAFront)
{
  EXPECT_EQ(tetralux::GetFrontPoints({ { 7, 2, 5 }, { 5, 2, 1 } }),
    (std::vector<std::int32_t>{ 1, 2, 5, 7 }));
}

TEST(PocketSearch, DelaunayOrderIsThatOfEmptySpheres)
{
  // Of two apexes in front of a triangle, the sphere through the triangle and the second one holds
  // the first one.
  std::mt19937_64 random(1);
  int counts[2] = { 0, 0 };
  for (int i = 0; i < 500; ++i)
  {
    std::vector<double> coordinates(3 * 5);
    for (double& value : coordinates)
    {
      value = std::ldexp(static_cast<double>(random() >> 11), -53);
    }
    const tetralux::ExactPoints points(coordinates.data());
    if (points.Orient(0, 1, 2, 3) <= 0 || points.Orient(0, 1, 2, 4) <= 0)
    {
      continue;
    }
    const tetralux::DelaunayOrder order(points, { 0, 1, 2 });
    const bool isInside =
      rationals::GetSphereSide(points[0], points[1], points[2], points[4], points[3]) > 0;
    ++counts[isInside];
    EXPECT_EQ(order(3) < order(4), isInside);
  }
  EXPECT_GT(counts[0], 20);
  EXPECT_GT(counts[1], 20);
}

TEST(PocketSearch, CellsFitTriangles)
{
  const std::vector<double> coordinates = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.5, 0.5, 3, 0,
    0, 4, 0, 0, 3, 1, 0, -1, -1, 0.25 };
  const tetralux::ExactPoints points(coordinates.data());
  const Cell cell = { 0, 1, 2, 3 };
  EXPECT_TRUE(tetralux::CellFitsTriangle(points, cell, { 5, 6, 7 }));  // far away
  EXPECT_TRUE(tetralux::CellFitsTriangle(points, cell, { 0, 1, 2 }));  // its face, from in front
  EXPECT_FALSE(tetralux::CellFitsTriangle(points, cell, { 0, 2, 1 })); // and from behind
  EXPECT_TRUE(tetralux::CellFitsTriangle(points, cell, { 1, 2, 4 }));  // beside an edge
  EXPECT_FALSE(tetralux::CellFitsTriangle(points, cell, { 4, 5, 8 })); // through it
}

TEST(PocketWrap, FillsConvexPocketsWithDelaunaysCells)
{
  const Pocket pocket = MakeEllipsoid(40);
  const tetralux::BoundaryTriangulation triangulation =
    tetralux::TriangulateDelaunay(pocket.Coordinates);
  std::set<std::set<std::int32_t>> expected;
  for (std::int32_t cell = 0; cell < triangulation.GetNumberOfCells(); ++cell)
  {
    const std::int32_t* ids = &triangulation.Cells[4 * std::size_t(cell)];
    if (!triangulation.IsInfinite(cell))
    {
      expected.insert({ ids, ids + 4 });
    }
  }
  std::vector<Cell> cells;
  EXPECT_TRUE(tetralux::WrapFront(pocket.GetPoints(), tetralux::PointNeighbors(triangulation),
    pocket.Triangles, tetralux::WrapOrder::Delaunay, cells)
                .empty());
  EXPECT_TRUE(pockets::Fill(pocket.Triangles, cells));
  std::set<std::set<std::int32_t>> found;
  for (const Cell& cell : cells)
  {
    found.insert({ cell.begin(), cell.end() });
  }
  EXPECT_EQ(found, expected);
}

TEST(PocketWrap, OrdersOfAFlatBipyramid)
{
  // Delaunay has three cells about the axis. Two cells, one above the other, close more faces.
  const double side = std::sqrt(0.75);
  const Pocket pocket = { { 1, 0, 0, -0.5, side, 0, -0.5, -side, 0, 0, 0, 0.3, 0, 0, -0.3 },
    { { 0, 3, 1 }, { 1, 3, 2 }, { 2, 3, 0 }, { 1, 4, 0 }, { 2, 4, 1 }, { 0, 4, 2 } } };
  ASSERT_GT(pocket.GetVolume(), 0);
  for (const auto& [order, size] : { std::pair(tetralux::WrapOrder::Delaunay, std::size_t{ 3 }),
         std::pair(tetralux::WrapOrder::Closing, std::size_t{ 2 }) })
  {
    std::vector<Cell> cells;
    EXPECT_TRUE(
      tetralux::WrapFront(pocket.GetPoints(), MakeNeighbors(pocket), pocket.Triangles, order, cells)
        .empty());
    EXPECT_EQ(cells.size(), size);
    EXPECT_TRUE(pockets::Fill(pocket.Triangles, cells));
  }
}

TEST(PocketWrap, LeavesAPocketOrNothing)
{
  for (const Pocket& pocket : { pockets::MakeOctahedron(), MakeEllipsoid(40), MakeChannel() })
  {
    const tetralux::PointNeighbors neighbors = MakeNeighbors(pocket);
    for (const auto order : { tetralux::WrapOrder::Delaunay, tetralux::WrapOrder::Closing })
    {
      std::vector<Cell> cells;
      const Pocket left = { pocket.Coordinates,
        tetralux::WrapFront(pocket.GetPoints(), neighbors, pocket.Triangles, order, cells) };
      EXPECT_TRUE(pockets::IsClosed(left.Triangles));
      EXPECT_GT(cells.size(), 0u);
      EXPECT_NEAR(pockets::MeasureCells(pocket.Coordinates, cells) + left.GetVolume(),
        pocket.GetVolume(), pockets::VolumeRounding * pocket.GetVolume());
    }
  }
}

TEST(PocketWrap, LeavesSchoenhardtsPolyhedron)
{
  const Pocket pocket = pockets::MakeSchoenhardt();
  for (const auto order : { tetralux::WrapOrder::Delaunay, tetralux::WrapOrder::Closing })
  {
    std::vector<Cell> cells;
    const Front rest = tetralux::WrapFront(
      pocket.GetPoints(), MakeNeighbors(pocket), pocket.Triangles, order, cells);
    EXPECT_FALSE(rest.empty());
    EXPECT_TRUE(pockets::IsClosed(rest));
    const Pocket left = { pocket.Coordinates, rest };
    EXPECT_NEAR(pockets::MeasureCells(pocket.Coordinates, cells) + left.GetVolume(),
      pocket.GetVolume(), pockets::VolumeRounding);
  }
}

TEST(CellComplex, CellsComeAndGo)
{
  // Two cells on the two sides of a face.
  const Cell low = { 0, 2, 1, 4 };
  const Cell high = { 0, 1, 2, 3 };
  tetralux::CellComplex complex({ high });
  complex.Add({ low });
  EXPECT_EQ(complex.GetCells(), (std::vector<Cell>{ high, low }));
  EXPECT_EQ(complex.GetCell(1), low);

  // Behind a triangle of a pocket above: the high cell, then the low one.
  const Front pocket = { { 1, 2, 3 } };
  std::vector<std::int32_t> absorbed;
  const Front once = complex.Grow(pocket, absorbed);
  EXPECT_EQ(absorbed, (std::vector<std::int32_t>{ 0 }));
  EXPECT_EQ(once.size(), 3u);
  const Front twice = complex.Grow(once, absorbed);
  EXPECT_EQ(absorbed, (std::vector<std::int32_t>{ 0, 1 }));
  EXPECT_EQ(twice.size(), 5u);
  // Nothing is left to be taken in.
  EXPECT_EQ(complex.Grow(twice, absorbed), twice);
  EXPECT_EQ(absorbed.size(), 2u);

  complex.Remove({ 0 });
  EXPECT_EQ(complex.GetCells(), (std::vector<Cell>{ low }));
  absorbed.clear();
  EXPECT_EQ(complex.Grow(pocket, absorbed), pocket);
  EXPECT_TRUE(absorbed.empty());
  complex.Grow({ { 0, 1, 2 } }, absorbed);
  EXPECT_EQ(absorbed, (std::vector<std::int32_t>{ 1 }));
}

TEST(CellComplex, FrontsWithoutWhatCellsCover)
{
  const Pocket octahedron = pockets::MakeOctahedron();
  std::vector<Cell> cells;
  ASSERT_TRUE(tetralux::FillFromPoint(octahedron.GetPoints(), octahedron.Triangles, cells));
  EXPECT_TRUE(tetralux::CellComplex::Advance(octahedron.Triangles, cells).empty());
  // With a cell less its own pocket is left.
  const Cell last = cells.back();
  cells.pop_back();
  const Pocket left = { octahedron.Coordinates,
    tetralux::CellComplex::Advance(octahedron.Triangles, cells) };
  EXPECT_EQ(left.Triangles.size(), 4u);
  EXPECT_TRUE(pockets::Fill(left.Triangles, { last }));
  EXPECT_NEAR(left.GetVolume(), 1. / 3, pockets::VolumeRounding);

  // Growing by a cell undoes advancing by it.
  tetralux::CellComplex complex({ cells[0] });
  std::vector<std::int32_t> absorbed;
  const Pocket grown = { octahedron.Coordinates,
    complex.Grow(tetralux::CellComplex::Advance(octahedron.Triangles, { cells[0] }), absorbed) };
  EXPECT_EQ(absorbed.size(), 1u);
  EXPECT_NEAR(grown.GetVolume(), octahedron.GetVolume(), pockets::VolumeRounding);
}

TEST(SteinerPoint, SeesAllWherePossible)
{
  for (Pocket pocket : { pockets::MakeSchoenhardt(), pockets::MakeOctahedron(), MakeEllipsoid(30) })
  {
    // Also far away, and flattened.
    for (const double scale : { 1., 1e-6 })
    {
      for (std::size_t p = 0; p < pocket.Coordinates.size(); p += 3)
      {
        pocket.Coordinates[p + 2] = pocket.Coordinates[p + 2] * scale + (scale < 1 ? 100 : 0);
      }
      tetralux::SteinerPoint steiner;
      ASSERT_TRUE(tetralux::FindSteinerPoint(pocket.GetPoints(), pocket.Triangles, steiner));
      EXPECT_EQ(steiner.VisibleTriangles.size(), pocket.Triangles.size());
      std::vector<double> coordinates = pocket.Coordinates;
      coordinates.insert(coordinates.end(), steiner.Position.begin(), steiner.Position.end());
      const tetralux::ExactPoints points(coordinates.data());
      const auto id = static_cast<std::int32_t>(coordinates.size() / 3) - 1;
      for (const auto& [a, b, c] : pocket.Triangles)
      {
        EXPECT_GT(points.Orient(a, b, c, id), 0);
      }
    }
  }
}

TEST(SteinerPoint, SeesSomeWhereNoneSeesAll)
{
  const Pocket channel = MakeChannel();
  tetralux::SteinerPoint steiner;
  ASSERT_TRUE(tetralux::FindSteinerPoint(channel.GetPoints(), channel.Triangles, steiner));
  const std::size_t visible = steiner.VisibleTriangles.size();
  EXPECT_GT(visible, 4u); // the walls of a cube, at least some of them
  EXPECT_LT(visible, channel.Triangles.size());
  std::vector<double> coordinates = channel.Coordinates;
  coordinates.insert(coordinates.end(), steiner.Position.begin(), steiner.Position.end());
  const tetralux::ExactPoints points(coordinates.data());
  const auto id = static_cast<std::int32_t>(coordinates.size() / 3) - 1;
  std::vector<Cell> cells;
  for (const std::int32_t t : steiner.VisibleTriangles)
  {
    const auto [a, b, c] = channel.Triangles[t];
    cells.push_back({ a, b, c, id });
    for (const Triangle& triangle : channel.Triangles)
    {
      EXPECT_TRUE(tetralux::CellFitsTriangle(points, cells.back(), triangle));
    }
  }
  // What the cells leave is the rest of the channel.
  const Pocket left = { coordinates, tetralux::CellComplex::Advance(channel.Triangles, cells) };
  EXPECT_TRUE(pockets::IsClosed(left.Triangles));
  EXPECT_NEAR(
    pockets::MeasureCells(coordinates, cells) + left.GetVolume(), 5, pockets::VolumeRounding);
}
