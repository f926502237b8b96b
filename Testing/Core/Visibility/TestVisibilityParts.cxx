// SPDX-License-Identifier: BSD-3-Clause
#include "MeshParts.h"
#include "Visibility/FaceBins.h"
#include "Visibility/MeasureTriangle.h"
#include "Visibility/TwinFaces.h"
#include "Visibility/VisibilityArrows.h"
#include "Visibility/VisibilityCycles.h"
#include "Visibility/VisibilityGaps.h"

#include "Generate/GeneratedMeshes.h"
#include "Rationals.h"
#include "ReferenceOcclusion.h"
#include "ReferenceScenes.h"
#include "Walk/WalkMesh.h"

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

using namespace tetralux;

VisibilityView LookFrom(double x, double y, double z)
{
  VisibilityView view;
  view.Eye = { x, y, z };
  return view;
}

VisibilityView LookAlong(double x, double y, double z)
{
  VisibilityView view;
  view.Parallel = true;
  view.Direction = { x, y, z };
  return view;
}

/// A mesh and all that an order is made from. Cells are in the order of the walk's tables.
struct Scene
{
  explicit Scene(const TetrahedralMesh& mesh)
    : Mesh(mesh)
  {
    this->Geometry.Points = this->Mesh.GetMesh().Points;
    this->Geometry.Cells = this->Mesh.GetMesh().Cells;
    this->Geometry.Faces = this->Mesh.GetTables().Faces;
    this->Geometry.Boundary = &this->Mesh.GetTables();
    this->Geometry.RelativePoints = this->Mesh.GetPoints<float>();
    std::copy_n(this->Mesh.GetCenter(), 3, this->Geometry.Center.begin());
    this->Geometry.Radius = this->Mesh.GetRadius();
  }

  std::vector<std::uint8_t> Point(const VisibilityView& view) const
  {
    std::vector<std::uint8_t> arrows(this->Geometry.GetNumberOfCells());
    VisibilityArrows(this->Geometry).Point(view, arrows);
    return arrows;
  }

  VisibilityGaps FindGaps(const VisibilityView& view) const
  {
    VisibilityGaps gaps;
    EXPECT_TRUE(tetralux::FindGaps(
      this->Geometry, VisibilityArrows(this->Geometry), FindTwinFaces(this->Geometry), view, gaps));
    return gaps;
  }

  /// For each cell those that it hides, by faces and by gaps.
  std::vector<std::set<std::int32_t>> FindHidden(const VisibilityView& view) const
  {
    const std::vector<std::uint8_t> arrows = this->Point(view);
    const VisibilityGaps gaps = this->FindGaps(view);
    std::vector<std::set<std::int32_t>> hidden(arrows.size());
    for (std::size_t cell = 0; cell < arrows.size(); ++cell)
    {
      for (int face = 0; face < 4; ++face)
      {
        if ((arrows[cell] >> face & 1) != 0)
        {
          hidden[cell].insert(this->Geometry.Faces[4 * cell + face].Cell);
        }
      }
      if (!gaps.Cells.empty())
      {
        hidden[cell].insert(&gaps.Cells[gaps.Begins[cell]], &gaps.Cells[0] + gaps.Begins[cell + 1]);
      }
    }
    return hidden;
  }

  WalkMesh Mesh;
  VisibilityGeometry Geometry;
};

/// On which side of a triangle the viewer is, as GetOrientation(triangle, viewer) says it.
int GetViewerSide(const double* a, const double* b, const double* c, const VisibilityView& view)
{
  if (!view.Parallel)
  {
    return rationals::GetOrientation(a, b, c, view.Eye.data());
  }
  const rationals::Point origin = rationals::MakePoint(a);
  return -rationals::GetDeterminant(rationals::Subtract(rationals::MakePoint(b), origin),
    rationals::Subtract(rationals::MakePoint(c), origin),
    rationals::MakePoint(view.Direction.data()))
            .sign();
}

TetrahedralMesh MakeTwoCells()
{
  // One above the other, by the face z = 0.
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, 1, 0.25, 0.25, -1 };
  mesh.Cells = { 0, 1, 2, 3, 0, 1, 2, 4 };
  return mesh;
}

/// Two equal cells, the second one moved.
TetrahedralMesh MakeTwoCellsApart(double x, double y, double z)
{
  TetrahedralMesh mesh;
  const double corners[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.25, 0.25, 1 } };
  for (int cell = 0; cell < 2; ++cell)
  {
    for (const auto& corner : corners)
    {
      mesh.Points.insert(
        mesh.Points.end(), { corner[0] + cell * x, corner[1] + cell * y, corner[2] + cell * z });
      mesh.Cells.push_back(static_cast<std::int32_t>(mesh.Cells.size()));
    }
  }
  return mesh;
}

TetrahedralMesh MoveAlongZ(TetrahedralMesh mesh, double z)
{
  for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += z;
  }
  return mesh;
}

/// The place of an input's cell in the tables.
std::int32_t FindCell(const Scene& scene, std::int64_t original)
{
  const auto& cells = scene.Mesh.GetMesh().OriginalCells;
  return cells.empty()
    ? static_cast<std::int32_t>(original)
    : static_cast<std::int32_t>(std::find(cells.begin(), cells.end(), original) - cells.begin());
}

/// Where a ray from an origin along a direction meets a triangle, in lengths of the direction; not
/// finite where it misses.
double FindHit(
  const FaceBins::Corner& origin, const FaceBins::Corner& direction, const FaceBins::Face& face)
{
  const auto minus = [](const FaceBins::Corner& a, const FaceBins::Corner& b) {
    return FaceBins::Corner{ a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  };
  const auto cross = [](const FaceBins::Corner& a, const FaceBins::Corner& b)
  {
    return FaceBins::Corner{ a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
      a[0] * b[1] - a[1] * b[0] };
  };
  const auto dot = [](const FaceBins::Corner& a, const FaceBins::Corner& b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto e1 = minus(face[1], face[0]);
  const auto e2 = minus(face[2], face[0]);
  const auto p = cross(direction, e2);
  const auto t = minus(origin, face[0]);
  const auto q = cross(t, e1);
  const double determinant = dot(e1, p);
  const double u = dot(t, p) / determinant;
  const double v = dot(direction, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 ? dot(e2, q) / determinant
                                        : std::numeric_limits<double>::infinity();
}

TEST(FaceBins, HaveAllThatIsAtTheSamePlace)
{
  // Small faces, and a few that cover many bins.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  std::vector<FaceBins::Face> faces(400);
  std::vector<std::uint8_t> binned(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const double size = f % 50 == 0 ? 1 : 0.1;
    const FaceBins::Corner middle = { place(random), place(random), place(random) };
    for (FaceBins::Corner& corner : faces[f])
    {
      for (int a = 0; a < 3; ++a)
      {
        corner[a] = (1 - 0.5 * size) * middle[a] + size * place(random);
      }
    }
    binned[f] = f % 3 != 0;
  }
  for (const VisibilityView& view :
    { LookAlong(0.3, -0.2, -1), LookAlong(0, 1, 0), LookFrom(1.5, 0.4, 0.8), LookFrom(0, 0, 1e6) })
  {
    const FaceBins bins(view, faces, binned);
    ASSERT_TRUE(bins.IsUsable());
    int pairs = 0;
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      std::vector<int> visits(faces.size(), 0);
      const std::int64_t looked =
        bins.ForEach(static_cast<std::int64_t>(f), [&](std::int32_t other) { ++visits[other]; });
      EXPECT_GE(looked, std::count(visits.begin(), visits.end(), 1));
      FaceBins::Corner middle;
      FaceBins::Corner direction;
      for (int a = 0; a < 3; ++a)
      {
        middle[a] = (faces[f][0][a] + faces[f][1][a] + faces[f][2][a]) / 3;
        direction[a] = view.Parallel ? view.Direction[a] : middle[a] - view.Eye[a];
      }
      for (std::size_t other = 0; other < faces.size(); ++other)
      {
        EXPECT_LE(visits[other], binned[other]);
        if (binned[other] && std::isfinite(FindHit(middle, direction, faces[other])))
        {
          EXPECT_EQ(visits[other], 1) << f << " " << other;
          ++pairs;
        }
      }
    }
    EXPECT_GT(pairs, 300);
  }
}

TEST(FaceBins, AreNoneBesideTheViewer)
{
  const std::vector<FaceBins::Face> faces = { { { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0, 0.1, 0 } } } };
  const std::vector<std::uint8_t> binned = { 1 };
  EXPECT_FALSE(FaceBins(LookFrom(0, 0, 0), faces, binned).IsUsable());
  EXPECT_FALSE(FaceBins(LookFrom(0, 0, 0.01), faces, binned).IsUsable());
  EXPECT_TRUE(FaceBins(LookFrom(0, 0, 0.5), faces, binned).IsUsable());
}

} // namespace

TEST(VisibilityArrows, TwoCells)
{
  const Scene scene(MakeTwoCells());
  const std::int32_t upper = FindCell(scene, 0);
  const std::int32_t lower = FindCell(scene, 1);
  for (const VisibilityView& view : { LookFrom(0.3, 0.2, 5), LookAlong(0.1, 0, -1) })
  {
    const std::vector<std::uint8_t> arrows = scene.Point(view);
    EXPECT_NE(arrows[upper] & HidingFaces, 0);
    EXPECT_EQ(arrows[lower] & HidingFaces, 0);
    EXPECT_NE(arrows[upper] & EnteredCell, 0);
    EXPECT_EQ(arrows[lower] & EnteredCell, 0); // its sides are turned away
  }
  for (const VisibilityView& view : { LookFrom(0.3, 0.2, -5), LookAlong(0.1, 0, 1) })
  {
    const std::vector<std::uint8_t> arrows = scene.Point(view);
    EXPECT_EQ(arrows[upper] & HidingFaces, 0);
    EXPECT_NE(arrows[lower] & HidingFaces, 0);
  }
  // A viewer in the plane of the face: neither hides the other.
  for (const VisibilityView& view : { LookFrom(9, 4, 0), LookAlong(1, -3, 0) })
  {
    const std::vector<std::uint8_t> arrows = scene.Point(view);
    EXPECT_EQ((arrows[upper] | arrows[lower]) & HidingFaces, 0);
    EXPECT_NE(arrows[upper] & arrows[lower] & EnteredCell, 0);
  }
}

TEST(VisibilityArrows, AsTheSidesOfPlanesInRationals)
{
  for (const double jitter : { 0., 1. })
  {
    const Scene scene(
      GenerateMesh("random", { { "cells", 3 }, { "jitter", jitter }, { "removed", 0.2 } }).Mesh);
    const VisibilityArrows sorter(scene.Geometry);
    // From outside, inside, in planes of the lattice, far away.
    for (const VisibilityView& view :
      { LookFrom(2, 3, 4), LookFrom(0.4, 0.6, 0.5), LookFrom(1. / 3, 0.5, 7), LookFrom(0, 0, 0),
        LookFrom(1e8, 2e8, -1e8), LookAlong(0, 0, 1), LookAlong(1, 1, 0), LookAlong(0.2, -3, 1) })
    {
      const std::vector<std::uint8_t> arrows = scene.Point(view);
      for (std::int64_t cell = 0; cell < scene.Geometry.GetNumberOfCells(); ++cell)
      {
        const auto corners = scene.Geometry.GetCorners(cell);
        std::uint8_t expected = 0;
        for (int face = 0; face < 4; ++face)
        {
          const double* a = corners[face == 0 ? 1 : 0];
          const double* b = corners[face < 2 ? 2 : 1];
          const double* c = corners[face < 3 ? 3 : 2];
          const int side = rationals::GetOrientation(a, b, c, corners[face]);
          const int viewer = GetViewerSide(a, b, c, view);
          const bool isBoundary = scene.Geometry.Faces[4 * cell + face].Cell < 0;
          if (viewer == side && !isBoundary)
          {
            expected |= static_cast<std::uint8_t>(1 << face);
          }
          if (viewer == -side && viewer != 0 && isBoundary)
          {
            expected |= EnteredCell;
          }
        }
        ASSERT_EQ(arrows[cell], expected) << "cell " << cell;
      }
    }
    for (const WalkEntry& entry : scene.Geometry.Boundary->Entries)
    {
      EXPECT_EQ(sorter.GetBoundarySide(entry),
        rationals::GetOrientation(scene.Geometry.GetPoint(entry.Points[0]),
          scene.Geometry.GetPoint(entry.Points[1]), scene.Geometry.GetPoint(entry.Points[2]),
          scene.Geometry.GetPoint(entry.Opposite)));
    }
  }
}

TEST(VisibilityGaps, TwoCellsApart)
{
  // One behind the other: what they have in common is the whole of their equal shadows.
  const Scene scene(MakeTwoCellsApart(0, 0, 3));
  const std::int32_t low = FindCell(scene, 0);
  const std::int32_t high = FindCell(scene, 1);
  for (const bool isFromAbove : { true, false })
  {
    const VisibilityGaps gaps = scene.FindGaps(LookAlong(0, 0, isFromAbove ? -2 : 2));
    const std::int32_t front = isFromAbove ? high : low;
    ASSERT_EQ(gaps.Cells.size(), 1u);
    EXPECT_EQ(gaps.Cells[0], isFromAbove ? low : high);
    EXPECT_EQ(gaps.Begins[front], 0);
    EXPECT_EQ(gaps.Begins[front + 1], 1);
    // Half a square unit, in squared radii; sizes are stored in single precision.
    const double radius = scene.Geometry.Radius;
    EXPECT_NEAR(gaps.Sizes[0] * radius * radius, 0.5, 1e-6);
  }
  EXPECT_TRUE(scene.FindGaps(LookAlong(1, 0, 0)).Cells.empty());
  EXPECT_TRUE(scene.FindGaps(LookFrom(10, 0.2, 2)).Cells.empty()); // between them
  EXPECT_EQ(scene.FindGaps(LookFrom(0.2, 0.2, 50)).Cells, (std::vector<std::int32_t>{ low }));

  // Side by side they hide nothing of each other, also where they touch.
  EXPECT_TRUE(Scene(MakeTwoCellsApart(2, 0, 0)).FindGaps(LookAlong(0, 0, 1)).Cells.empty());
  EXPECT_TRUE(Scene(MakeTwoCellsApart(1, 0, 0)).FindGaps(LookAlong(0, 0, 1)).Cells.empty());
}

TEST(TwinFaces, AreTwoAtOnePlace)
{
  // Three cells; the first two touch by a face, whose corners they have in different orders.
  TetrahedralMesh mesh = SeparateCells(MakeTwoCells());
  std::swap(mesh.Cells[0], mesh.Cells[2]);
  AddMesh(mesh, MoveAlongZ(MakeTwoCellsApart(9, 0, 0), 20));
  mesh.Points[0] = -0.; // the same place as 0
  const Scene scene(mesh);
  const std::vector<std::int32_t> twins = FindTwinFaces(scene.Geometry);
  ASSERT_EQ(twins.size(), 16U);
  EXPECT_EQ(std::count(twins.begin(), twins.end(), -1), 14);
  for (std::size_t face = 0; face < twins.size(); ++face)
  {
    if (twins[face] >= 0)
    {
      EXPECT_EQ(twins[twins[face]], static_cast<std::int32_t>(face));
      const auto& entries = scene.Geometry.Boundary->Entries;
      const std::int32_t cells[] = { entries[face].Cell, entries[twins[face]].Cell };
      EXPECT_EQ(
        std::minmax(cells[0], cells[1]), std::minmax(FindCell(scene, 0), FindCell(scene, 1)));
    }
  }
  // Of four at one place none is another's twin; outer faces are at one place with those of copies.
  AddMesh(mesh, SeparateCells(MakeTwoCells()));
  const auto ofMore = FindTwinFaces(Scene(mesh).Geometry);
  EXPECT_EQ(std::count(ofMore.begin(), ofMore.end(), -1), 4 + 8);
}

TEST(VisibilityGaps, KnowSlivers)
{
  for (const double common : { 1e-8, 1e-3 })
  {
    // The second box is below the first, and beside it but for a strip.
    TetrahedralMesh mesh = MakeBox(1, 1, 1, { 0, 0, 0 }, { 1, 1, 1 });
    AddMesh(mesh, MakeBox(1, 1, 1, { 1 - common, 0, -3 }, { 2, 1, -2 }));
    const VisibilityGaps gaps = Scene(mesh).FindGaps(LookAlong(0, 0, -1));
    EXPECT_FALSE(gaps.Cells.empty());
    EXPECT_EQ(gaps.Slivers, std::vector<std::uint8_t>(gaps.Cells.size(), common < 1e-6 ? 1 : 0));
  }
}

TEST(VisibilityCycles, SliversAreIgnoredFirst)
{
  // Three cells in a circle; whichever arrow is a sliver, the others give the order.
  const Scene scene(MakeCyclicTetrahedra(3));
  const VisibilityView along = LookAlong(0, 0, -1);
  VisibilityGaps gaps = scene.FindGaps(along);
  ASSERT_EQ(gaps.Cells.size(), 3U);
  for (std::int32_t from = 0; from < 3; ++from)
  {
    gaps.Slivers.assign(3, 0);
    gaps.Slivers[gaps.Begins[from]] = 1;
    VisibilityCycles cycles;
    const std::vector<std::int32_t> order =
      SortWithCycles(scene.Geometry, along, scene.Point(along), gaps, {}, cycles);
    EXPECT_EQ(cycles.GetNumberOfCycles(), 0);
    EXPECT_EQ(cycles.IgnoredFaces, 0);
    ASSERT_EQ(order.size(), 3U);
    EXPECT_EQ(order[2], gaps.Cells[gaps.Begins[from]]); // hidden by the sliver alone
  }
}

TEST(VisibilityGaps, WithArrowsLeadToAllThatRaysMeet)
{
  for (const auto& [name, parameters] :
    { std::pair<const char*, std::map<std::string, double>>{ "cavity", { { "cells", 3 } } },
      { "cubes", { { "count", 2 }, { "cells", 1 } } },
      { "random", { { "cells", 3 }, { "removed", 0.4 } } } })
  {
    SCOPED_TRACE(name);
    const Scene scene(GenerateMesh(name, parameters).Mesh);
    for (const VisibilityView& view : { LookFrom(3, 4, 5), LookAlong(0.3, 0.5, 1) })
    {
      const auto hidden = scene.FindHidden(view);
      // What each cell hides by some path.
      std::vector<std::set<std::int32_t>> reached(hidden.size());
      for (std::size_t cell = 0; cell < hidden.size(); ++cell)
      {
        std::vector<std::int32_t> path(hidden[cell].begin(), hidden[cell].end());
        while (!path.empty())
        {
          const std::int32_t next = path.back();
          path.pop_back();
          if (reached[cell].insert(next).second)
          {
            path.insert(path.end(), hidden[next].begin(), hidden[next].end());
          }
        }
      }
      const auto pairs = FindOccludedPairs(scene.Mesh.GetMesh(), view, 10, 1);
      EXPECT_GT(pairs.size(), 10u);
      for (const OccludedPair& pair : pairs)
      {
        EXPECT_EQ(reached[pair.Front].count(pair.Back), 1u) << pair.Front << " " << pair.Back;
        EXPECT_EQ(reached[pair.Back].count(pair.Front), 0u);
      }
    }
  }
}

TEST(VisibilityCycles, ThreeCellsInACircle)
{
  const Scene scene(MakeCyclicTetrahedra(3));
  const VisibilityView along = LookAlong(0, 0, -1);
  const VisibilityGaps gaps = scene.FindGaps(along);
  ASSERT_EQ(gaps.Cells.size(), 3u);
  VisibilityCycles cycles;
  const std::vector<std::int32_t> order =
    SortWithCycles(scene.Geometry, along, scene.Point(along), gaps, {}, cycles);
  EXPECT_EQ(cycles.GetNumberOfCycles(), 1);
  EXPECT_EQ(cycles.Cells, (std::vector<std::int32_t>{ 0, 1, 2 }));
  EXPECT_EQ(cycles.Begins, (std::vector<std::int64_t>{ 0, 3 }));
  EXPECT_EQ(cycles.IgnoredFaces, 1);
  EXPECT_FLOAT_EQ(static_cast<float>(cycles.IgnoredArea),
    *std::min_element(gaps.Sizes.begin(), gaps.Sizes.end()));
  EXPECT_EQ(std::set<std::int32_t>(order.begin(), order.end()).size(), 3u);

  // From the side there is an order: each cell behind all that it hides.
  const VisibilityView side = LookAlong(1, 0.2, 0.1);
  cycles = {};
  const std::vector<std::int32_t> sorted =
    SortWithCycles(scene.Geometry, side, scene.Point(side), scene.FindGaps(side), {}, cycles);
  EXPECT_EQ(cycles.GetNumberOfCycles(), 0);
  EXPECT_EQ(cycles.IgnoredFaces, 0);
  const auto hidden = scene.FindHidden(side);
  std::set<std::int32_t> before;
  for (const std::int32_t cell : sorted)
  {
    EXPECT_TRUE(
      std::includes(before.begin(), before.end(), hidden[cell].begin(), hidden[cell].end()));
    before.insert(cell);
  }
  EXPECT_EQ(before.size(), 3u);
}

TEST(VisibilityCycles, CellsOnNoCycleAreInOrder)
{
  // Two circles, one below the other, and a cube below them that is full of holes.
  TetrahedralMesh mesh = MakeCyclicTetrahedra(3);
  AddMesh(mesh, MoveAlongZ(MakeCyclicTetrahedra(4), -3));
  AddMesh(
    mesh, MoveAlongZ(GenerateMesh("random", { { "cells", 3 }, { "removed", 0.3 } }).Mesh, -6));
  const Scene scene(mesh);
  const VisibilityView view = LookAlong(0, 0, -1);
  VisibilityCycles cycles;
  const std::vector<std::int32_t> order =
    SortWithCycles(scene.Geometry, view, scene.Point(view), scene.FindGaps(view), {}, cycles);
  ASSERT_EQ(static_cast<std::int64_t>(order.size()), scene.Geometry.GetNumberOfCells());
  EXPECT_EQ(cycles.GetNumberOfCycles(), 2);
  std::vector<std::int64_t> cycleOf(order.size(), -1);
  for (std::int64_t cycle = 0; cycle < cycles.GetNumberOfCycles(); ++cycle)
  {
    for (std::int64_t i = cycles.Begins[cycle]; i < cycles.Begins[cycle + 1]; ++i)
    {
      EXPECT_EQ(cycleOf[cycles.Cells[i]], -1);
      cycleOf[cycles.Cells[i]] = cycle;
    }
  }
  std::vector<std::size_t> places(order.size());
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    places[order[place]] = place;
  }
  const auto hidden = scene.FindHidden(view);
  std::int64_t wrong = 0;
  for (std::size_t cell = 0; cell < hidden.size(); ++cell)
  {
    for (const std::int32_t behind : hidden[cell])
    {
      const bool isWrong = places[behind] > places[cell];
      wrong += isWrong;
      EXPECT_TRUE(!isWrong || (cycleOf[cell] >= 0 && cycleOf[cell] == cycleOf[behind]));
    }
  }
  EXPECT_EQ(wrong, cycles.IgnoredFaces);
}

TEST(MeasureTriangle, KnownSizes)
{
  const double x[3] = { 1, 0, 0 }, y[3] = { 0, 1, 0 }, z[3] = { 0, 0, 1 };
  const double pi = std::acos(-1.);
  // An eighth of the sphere, and half a square seen from in front and aslant.
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(MeasureTriangle({ x, y, z }, LookFrom(0, 0, 0)), pi / 2, 4 * rounding);
  const double o[3] = { 0, 0, 0 };
  EXPECT_NEAR(MeasureTriangle({ o, x, y }, LookAlong(0, 0, -3)), 0.5, rounding);
  EXPECT_NEAR(MeasureTriangle({ o, x, y }, LookAlong(0, 1, 1)), std::sqrt(0.125), rounding);
  EXPECT_EQ(MeasureTriangle({ o, x, y }, LookAlong(1, 1, 0)), 0);
  EXPECT_EQ(MeasureTriangle({ o, x, y }, LookFrom(5, 6, 0)), 0);
}
