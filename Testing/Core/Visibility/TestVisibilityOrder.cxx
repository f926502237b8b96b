// SPDX-License-Identifier: BSD-3-Clause

// Visibility orders against brute force: no ray may meet two cells in another order.

#include "Visibility/MeshOrder.h"
#include "Visibility/VisibilityOrder.h"

#include "Base/RadixSort.h"
#include "Generate/GeneratedMeshes.h"
#include "MeshParts.h"
#include "ReferenceOcclusion.h"
#include "ReferenceScenes.h"
#include "ThreadCounts.h"
#include "Walk/WalkMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tetralux;

constexpr auto FrontToBack = VisibilityDirection::FrontToBack;
constexpr auto BackToFront = VisibilityDirection::BackToFront;

struct Box
{
  std::array<double, 3> Center;
  double Diagonal;
};

Box GetBox(const TetrahedralMesh& mesh)
{
  double lo[3] = { 1e300, 1e300, 1e300 }, hi[3] = { -1e300, -1e300, -1e300 };
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    lo[i % 3] = std::min(lo[i % 3], mesh.Points[i]);
    hi[i % 3] = std::max(hi[i % 3], mesh.Points[i]);
  }
  return { { 0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), 0.5 * (lo[2] + hi[2]) },
    std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]) };
}

VisibilityView LookFrom(const std::array<double, 3>& eye)
{
  VisibilityView view;
  view.Eye = eye;
  return view;
}

VisibilityView LookAlong(const std::array<double, 3>& direction)
{
  VisibilityView view;
  view.Parallel = true;
  view.Direction = direction;
  return view;
}

/// From outside, from inside, exactly in planes of the mesh, and along its axes.
std::vector<VisibilityView> MakeViews(const TetrahedralMesh& mesh)
{
  const Box box = GetBox(mesh);
  const auto place = [&](double x, double y, double z)
  {
    return LookFrom({ box.Center[0] + x * box.Diagonal, box.Center[1] + y * box.Diagonal,
      box.Center[2] + z * box.Diagonal });
  };
  std::vector<VisibilityView> views = { place(0.9, 1.1, 1.3), place(-0.3, -0.8, 0.35),
    place(0.01, 0.02, -0.03), place(0.2, 0.1, 0.05), place(0, 0, 1.5), place(0, 0, 0),
    place(1e4, 2e4, -3e4), LookAlong({ 0, 0, -1 }), LookAlong({ 1, 0, 0 }), LookAlong({ 1, 1, 0 }),
    LookAlong({ -0.3, 0.5, 0.8 }), LookAlong({ 1e200, -2e200, 1.5e200 }) };
  // At a point, in the middle of an edge and of a face.
  const auto getPoint = [&](int corner)
  { return &mesh.Points[3 * mesh.Cells[mesh.Cells.size() / 2 / 4 * 4 + corner]]; };
  const double *a = getPoint(0), *b = getPoint(1), *c = getPoint(2);
  views.push_back(LookFrom({ a[0], a[1], a[2] }));
  views.push_back(LookFrom({ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) }));
  views.push_back(
    LookFrom({ (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3 }));
  return views;
}

/// Whether the order has each cell of the mesh once.
void ExpectAllCells(const std::vector<std::int32_t>& order, std::int64_t numberOfCells)
{
  std::vector<std::int32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> expected(numberOfCells);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(sorted, expected);
}

/// Those pairs whose cells are not both in the same cycle.
std::vector<OccludedPair> RemoveCycles(
  const std::vector<OccludedPair>& pairs, const VisibilityCycles& cycles)
{
  std::map<std::int32_t, std::int64_t> cycleOf;
  for (std::int64_t cycle = 0; cycle < cycles.GetNumberOfCycles(); ++cycle)
  {
    for (std::int64_t i = cycles.Begins[cycle]; i < cycles.Begins[cycle + 1]; ++i)
    {
      cycleOf[cycles.Cells[i]] = cycle;
    }
  }
  std::vector<OccludedPair> rest;
  for (const OccludedPair& pair : pairs)
  {
    const auto front = cycleOf.find(pair.Front), back = cycleOf.find(pair.Back);
    if (front == cycleOf.end() || back == cycleOf.end() || front->second != back->second)
    {
      rest.push_back(pair);
    }
  }
  return rest;
}

struct MeshCase
{
  std::string Name;
  std::map<std::string, double> Parameters;
};

class VisibilityOrders : public ::testing::TestWithParam<MeshCase>
{
};

TEST_P(VisibilityOrders, AreExact)
{
  WalkMesh mesh(GenerateMesh(GetParam().Name, GetParam().Parameters).Mesh);
  mesh.MakeConvex();
  VisibilityOrder order(mesh);
  ASSERT_TRUE(order.IsConvex()) << mesh.GetConvexification()->Refusal;
  VisibilityOrder plain(mesh, false);
  int number = 0;
  for (const VisibilityView& view : MakeViews(mesh.GetMesh()))
  {
    SCOPED_TRACE("view " + std::to_string(++number));
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 1, number);
    EXPECT_GT(pairs.size(), 200U);
    for (const VisibilityMethod method :
      { VisibilityMethod::Meshed, VisibilityMethod::MeshedNonConvex })
    {
      const std::vector<std::int32_t> front = order.Sort(view, method, FrontToBack);
      ExpectAllCells(front, mesh.GetNumberOfCells());
      EXPECT_TRUE(FindWrongPairs(RemoveCycles(pairs, order.GetCycles()), front).empty());
      std::vector<std::int32_t> back = order.Sort(view, method, BackToFront);
      std::reverse(back.begin(), back.end());
      EXPECT_EQ(front, back);
    }
    const auto& acrossGaps = plain.Sort(view, VisibilityMethod::MeshedAcrossGaps, FrontToBack);
    ExpectAllCells(acrossGaps, mesh.GetNumberOfCells());
    EXPECT_EQ(plain.GetUsedMethod(), VisibilityMethod::MeshedAcrossGaps);
    EXPECT_TRUE(FindWrongPairs(pairs, acrossGaps).empty());
    EXPECT_EQ(plain.GetCycles().GetNumberOfCycles(), 0);
  }
}

TEST_P(VisibilityOrders, AreExactByWhatCostsLess)
{
  WalkMesh mesh(GenerateMesh(GetParam().Name, GetParam().Parameters).Mesh);
  MeshOrder order(mesh);
  int number = 0;
  for (const VisibilityView& view : MakeViews(mesh.GetMesh()))
  {
    SCOPED_TRACE("view " + std::to_string(++number));
    const std::vector<std::int32_t>* front = order.Sort(view, OrderWish::Automatic, FrontToBack);
    ASSERT_NE(front, nullptr);
    ExpectAllCells(*front, mesh.GetNumberOfCells());
    EXPECT_NE(order.Get().GetUsedMethod(), VisibilityMethod::MeshedNonConvex);
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 1, number);
    EXPECT_TRUE(FindWrongPairs(pairs, *front).empty());
  }
}

/// As discontinuous finite elements and many exporters write them.
TEST_P(VisibilityOrders, AreExactWithPointsOfTheirOwn)
{
  const TetrahedralMesh shared = GenerateMesh(GetParam().Name, GetParam().Parameters).Mesh;
  WalkMesh mesh(SeparateCells(shared));
  EXPECT_FALSE(mesh.IsConvex());
  mesh.MakeConvex();
  EXPECT_FALSE(mesh.GetConvexification()->Refusal.empty());
  EXPECT_TRUE(mesh.GetConvexTables().Faces.empty());
  VisibilityOrder order(mesh);
  EXPECT_FALSE(order.IsConvex());
  int number = 0;
  for (const VisibilityView& view : MakeViews(mesh.GetMesh()))
  {
    SCOPED_TRACE("view " + std::to_string(++number));
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 1, number);
    EXPECT_GT(pairs.size(), 200U);
    const auto& acrossGaps = order.Sort(view, VisibilityMethod::MeshedAcrossGaps, FrontToBack);
    ExpectAllCells(acrossGaps, mesh.GetNumberOfCells());
    EXPECT_EQ(order.GetUsedMethod(), VisibilityMethod::MeshedAcrossGaps);
    EXPECT_TRUE(FindWrongPairs(pairs, acrossGaps).empty());
    EXPECT_EQ(order.GetCycles().GetNumberOfCycles(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, VisibilityOrders,
  ::testing::Values(MeshCase{ "random", { { "cells", 4 }, { "removed", 0 } } },
    MeshCase{ "random", { { "cells", 5 }, { "removed", 0.3 }, { "seed", 2 } } },
    MeshCase{ "random", { { "cells", 5 }, { "removed", 0.8 }, { "seed", 3 } } },
    MeshCase{ "schoenhardt", { { "cells", 1 } } },
    MeshCase{ "cubes", { { "count", 2 }, { "cells", 2 } } },
    MeshCase{ "cavity", { { "cells", 4 } } },
    MeshCase{ "ring", { { "around", 20 }, { "across", 2 } } },
    MeshCase{ "shared-edge", { { "cells", 3 } } },
    MeshCase{ "gear", { { "teeth", 5 }, { "across", 1 }, { "along", 1 } } },
    MeshCase{ "boundary-layer", { { "ratio", 1e6 }, { "cells", 4 }, { "layers", 6 } } }),
  [](const ::testing::TestParamInfo<MeshCase>& info)
  {
    std::string name = info.param.Name + std::to_string(info.index);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

/// Convex without any imaginary cell, far from the origin.
TEST(VisibilityOrder, IsExactAtAnOffset)
{
  TetrahedralMesh box =
    MakeBox(4, 4, 4, { 1e7, -1e7, 1e7 }, { 1e7 + 1e-2, -1e7 + 1e-2, 1e7 + 1e-2 }, 0.15);
  WalkMesh mesh(std::move(box));
  VisibilityOrder order(mesh);
  int number = 0;
  for (const VisibilityView& view : MakeViews(mesh.GetMesh()))
  {
    SCOPED_TRACE("view " + std::to_string(++number));
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 2, number);
    EXPECT_GT(pairs.size(), 1000U);
    const auto& front = order.Sort(view, VisibilityMethod::Meshed, FrontToBack);
    EXPECT_TRUE(FindWrongPairs(pairs, front).empty());
    EXPECT_EQ(order.GetCycles().GetNumberOfCycles(), 0);
  }
}

/// Two layers of hexahedra of five tetrahedra each, whose diagonals do not agree where they meet:
/// there, flat tetrahedra join them. Every third of the points between the layers is moved up and
/// down by motion, so that some of those are thin and some inverted.
TetrahedralMesh MakeLayersOnFlatCells(int size, double motion)
{
  TetrahedralMesh mesh;
  const auto getPoint = [size](int i, int j, int k)
  { return (k * (size + 1) + j) * (size + 1) + i; };
  for (int k = 0; k <= 2; ++k)
  {
    for (int j = 0; j <= size; ++j)
    {
      for (int i = 0; i <= size; ++i)
      {
        const double z = k == 1 ? 1 + motion * ((5 * i + 7 * j) % 3 - 1) : k;
        mesh.Points.insert(mesh.Points.end(), { double(i), double(j), z });
      }
    }
  }
  for (int k = 0; k < 2; ++k)
  {
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        // Corners whose coordinates' sum has one parity are cut off, the others are in the middle.
        std::vector<std::int32_t> middle;
        for (int corner = 0; corner < 8; ++corner)
        {
          const int x = i + (corner & 1), y = j + (corner >> 1 & 1), z = k + (corner >> 2);
          if ((x + y + z + k) % 2 == 0)
          {
            middle.push_back(getPoint(x, y, z));
            continue;
          }
          const auto other = [](int a, int first) { return a == first ? first + 1 : first; };
          mesh.Cells.insert(mesh.Cells.end(),
            { getPoint(x, y, z), getPoint(other(x, i), y, z), getPoint(x, other(y, j), z),
              getPoint(x, y, other(z, k)) });
        }
        mesh.Cells.insert(mesh.Cells.end(), middle.begin(), middle.end());
        if (k == 0)
        {
          mesh.Cells.insert(mesh.Cells.end(),
            { getPoint(i, j, 1), getPoint(i + 1, j, 1), getPoint(i, j + 1, 1),
              getPoint(i + 1, j + 1, 1) });
        }
      }
    }
  }
  return mesh;
}

TEST(VisibilityOrder, GoesThroughFlatAndInvertedCells)
{
  for (const double motion : { 0.0, 1e-9, 1e-3 })
  {
    WalkMesh mesh(MakeLayersOnFlatCells(5, motion));
    ASSERT_EQ(mesh.GetNumberOfCells(), 2 * 25 * 5 + 25);
    // Nothing but the cells' faces orders the layers: they must be one mesh.
    ASSERT_EQ(mesh.GetNumberOfComponents(), 1);
    ASSERT_EQ(mesh.GetNumberOfBoundaryFaces(), 4 * 25 + 4 * 5 * 4);
    VisibilityOrder order(mesh);
    for (const VisibilityView& view :
      { LookFrom({ 3, 2, 20 }), LookFrom({ -4, -7, -3 }), LookFrom({ 10, 3, 1.2 }),
        LookFrom({ 2.2, 2.7, 0.4 }), LookAlong({ 0, 0, 1 }), LookAlong({ 0.9, 0.2, -0.1 }) })
    {
      const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 4, 1);
      EXPECT_GT(pairs.size(), 500U);
      const auto& front = order.Sort(view, VisibilityMethod::Meshed, FrontToBack);
      ExpectAllCells(front, mesh.GetNumberOfCells());
      EXPECT_EQ(FindWrongPairs(RemoveCycles(pairs, order.GetCycles()), front).size(), 0U);
    }
  }
}

/// Two boxes whose faces touch, and do not match.
TEST(VisibilityOrder, IsExactAcrossContacts)
{
  TetrahedralMesh boxes = MakeBox(3, 3, 2, { 0, 0, 0 }, { 1, 1, 1 });
  const TetrahedralMesh other = MakeBox(4, 4, 2, { -0.2, -0.2, 1 }, { 1.3, 1.3, 1.5 });
  const std::int32_t first = static_cast<std::int32_t>(boxes.GetNumberOfPoints());
  boxes.Points.insert(boxes.Points.end(), other.Points.begin(), other.Points.end());
  for (const std::int32_t point : other.Cells)
  {
    boxes.Cells.push_back(first + point);
  }
  WalkMesh mesh(std::move(boxes));
  mesh.MakeConvex();
  EXPECT_FALSE(mesh.GetConvexification()->Refusal.empty());
  VisibilityOrder order(mesh);
  EXPECT_FALSE(order.IsConvex());
  int number = 0;
  for (const VisibilityView& view : MakeViews(mesh.GetMesh()))
  {
    SCOPED_TRACE("view " + std::to_string(++number));
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 2, number);
    const auto& front = order.Sort(view, VisibilityMethod::MeshedAcrossGaps, FrontToBack);
    EXPECT_EQ(FindWrongPairs(pairs, front).size(), 0U);
    EXPECT_EQ(order.GetCycles().GetNumberOfCycles(), 0);
  }
}

TEST(VisibilityOrder, OrdersWhatIsDrawnByWhatIsNot)
{
  WalkMesh mesh(GenerateMesh("random", { { "cells", 6 }, { "removed", 0 } }).Mesh);
  VisibilityOrder order(mesh);
  std::vector<std::uint8_t> drawn(mesh.GetNumberOfCells());
  for (std::size_t cell = 0; cell < drawn.size(); ++cell)
  {
    drawn[cell] = cell % 3 == 0;
  }
  const VisibilityView view = LookFrom({ 2, 3, 4 });
  for (const VisibilityMethod method :
    { VisibilityMethod::Meshed, VisibilityMethod::MeshedNonConvex,
      VisibilityMethod::MeshedAcrossGaps, VisibilityMethod::CentroidDistance })
  {
    for (const VisibilityDirection direction : { FrontToBack, BackToFront })
    {
      std::vector<std::int32_t> expected;
      for (const std::int32_t cell : order.Sort(view, method, direction))
      {
        if (drawn[cell] != 0)
        {
          expected.push_back(cell);
        }
      }
      EXPECT_EQ(order.Sort(view, method, direction, drawn), expected);
    }
  }
}

TEST(MeshOrder, MakesConvexWhatIsSeenOnceOnlyIfAsked)
{
  WalkMesh mesh(GenerateMesh("cubes", { { "count", 2 }, { "cells", 2 } }).Mesh);
  const VisibilityView view = MakeViews(mesh.GetMesh()).front();
  MeshOrder order(mesh);
  ASSERT_NE(order.Sort(view, OrderWish::Automatic, FrontToBack), nullptr);
  EXPECT_EQ(order.Get().GetUsedMethod(), VisibilityMethod::MeshedAcrossGaps);
  EXPECT_EQ(mesh.GetConvexification(), nullptr);
  EXPECT_GT(order.GetTableSeconds(), 0);
  EXPECT_EQ(order.GetConvexificationSeconds(), 0);

  // An abort leaves it as it was.
  EXPECT_EQ(order.Sort(view, OrderWish::Convexified, FrontToBack, {}, [](double) { return false; }),
    nullptr);
  EXPECT_EQ(mesh.GetConvexification(), nullptr);
  ASSERT_NE(order.Sort(view, OrderWish::Convexified, FrontToBack), nullptr);
  EXPECT_EQ(order.Get().GetUsedMethod(), VisibilityMethod::Meshed);
  EXPECT_EQ(order.GetRefusal(), "");
  ASSERT_NE(order.Sort(view, OrderWish::AcrossGaps, FrontToBack), nullptr);
  EXPECT_EQ(order.Get().GetUsedMethod(), VisibilityMethod::MeshedAcrossGaps);
  // What is convex by now stays it.
  ASSERT_NE(order.Sort(view, OrderWish::Automatic, FrontToBack), nullptr);
  EXPECT_EQ(order.Get().GetUsedMethod(), VisibilityMethod::Meshed);
  EXPECT_EQ(order.GetConvexificationSeconds(), 0);
}

TEST(MeshOrder, MakesConvexWhereGapsAreCostly)
{
  // Plates one behind the other: each one's back has the fronts of all others behind it.
  constexpr int NumberOfPlates = 120;
  TetrahedralMesh plates;
  for (int plate = 0; plate < NumberOfPlates; ++plate)
  {
    const std::int32_t first = 8 * plate;
    for (int corner = 0; corner < 8; ++corner)
    {
      plates.Points.insert(plates.Points.end(),
        { static_cast<double>(corner & 1), static_cast<double>(corner >> 1 & 1),
          plate + 0.5 * (corner >> 2) });
    }
    for (const auto& [a, b] :
      { std::pair{ 1, 3 }, { 3, 2 }, { 2, 6 }, { 6, 4 }, { 4, 5 }, { 5, 1 } })
    {
      plates.Cells.insert(plates.Cells.end(), { first, first + a, first + b, first + 7 });
    }
  }
  WalkMesh mesh(plates);
  MeshOrder order(mesh);
  VisibilityView view;
  view.Eye = { 0.4, 0.3, -NumberOfPlates };
  const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 1, 1);
  EXPECT_GT(pairs.size(), 10000U);
  // The first view finds out, and has an exact order already.
  for (const VisibilityMethod method :
    { VisibilityMethod::MeshedAcrossGaps, VisibilityMethod::Meshed, VisibilityMethod::Meshed })
  {
    const std::vector<std::int32_t>* front = order.Sort(view, OrderWish::Automatic, FrontToBack);
    ASSERT_NE(front, nullptr);
    EXPECT_EQ(order.Get().GetUsedMethod(), method) << order.GetRefusal();
    EXPECT_TRUE(FindWrongPairs(pairs, *front).empty());
  }
  EXPECT_EQ(order.GetConvexificationSeconds(), 0);
}

TEST(VisibilityOrder, DoesNotDependOnThreads)
{
  WalkMesh mesh(GenerateMesh("random", { { "cells", 20 } }).Mesh);
  mesh.MakeConvex();
  const VisibilityView view = LookFrom({ 2, 3, 4 });
  for (const VisibilityMethod method :
    { VisibilityMethod::Meshed, VisibilityMethod::MeshedNonConvex,
      VisibilityMethod::MeshedAcrossGaps, VisibilityMethod::CentroidDistance })
  {
    std::vector<std::int32_t> expected;
    ForEachThreadCount(
      [&]
      {
        VisibilityOrder order(mesh);
        const auto& cells = order.Sort(view, method, BackToFront);
        if (expected.empty())
        {
          expected = cells;
        }
        EXPECT_EQ(cells, expected);
      });
  }
}

/// Across empty space, the guess from centroids is right where parts of the mesh are far apart.
TEST(VisibilityOrder, GuessesAcrossEmptySpace)
{
  WalkMesh mesh(GenerateMesh("cubes", { { "count", 3 }, { "cells", 2 } }).Mesh);
  VisibilityOrder order(mesh);
  EXPECT_FALSE(order.IsConvex());
  const VisibilityView view = LookFrom({ 9, 8, 11 });
  const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 2, 1);
  EXPECT_EQ(
    FindWrongPairs(pairs, order.Sort(view, VisibilityMethod::MeshedNonConvex, FrontToBack)).size(),
    0U);
  EXPECT_GT(
    FindWrongPairs(pairs, order.Sort(view, VisibilityMethod::Meshed, FrontToBack)).size(), 0U);
}

TEST(VisibilityOrder, TakesAnyMesh)
{
  const VisibilityMethod methods[] = { VisibilityMethod::Meshed, VisibilityMethod::MeshedNonConvex,
    VisibilityMethod::MeshedAcrossGaps, VisibilityMethod::CentroidDistance };
  WalkMesh empty(TetrahedralMesh{});
  WalkMesh single(MakeCyclicTetrahedra(1));
  // All cells are flat.
  TetrahedralMesh plane = MakeBox(2, 2, 2, { 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t i = 2; i < plane.Points.size(); i += 3)
  {
    plane.Points[i] = 0;
  }
  WalkMesh flat(std::move(plane));
  // Cells overlap, and are turned at random.
  WalkMesh tangled(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 2));
  for (const WalkMesh* mesh : { &empty, &single, &flat, &tangled })
  {
    VisibilityOrder order(*mesh);
    for (const VisibilityMethod method : methods)
    {
      for (const VisibilityView& view :
        { LookFrom({ 2, 3, 4 }), LookFrom({ 0.2, 0.3, 0 }), LookAlong({ 0, 0, 1 }) })
      {
        ExpectAllCells(order.Sort(view, method, BackToFront), mesh->GetNumberOfCells());
      }
    }
  }
}

TEST(RadixSort, IsStableSort)
{
  std::mt19937_64 random(1);
  ForEachThreadCount(
    [&]
    {
      for (const std::size_t size : { 0, 1, 1000, 100000 })
      {
        for (const std::uint64_t values : { 1U, 100U, 4000000000U })
        {
          std::vector<KeyedItem> items(size);
          for (std::size_t i = 0; i < size; ++i)
          {
            items[i] = { static_cast<std::uint32_t>(random() % values),
              static_cast<std::int32_t>(i) };
          }
          std::vector<KeyedItem> expected = items;
          std::stable_sort(expected.begin(), expected.end(),
            [](const KeyedItem& a, const KeyedItem& b) { return a.Key < b.Key; });
          std::vector<KeyedItem> buffer;
          SortByKey(items, buffer);
          ASSERT_EQ(items.size(), expected.size());
          for (std::size_t i = 0; i < size; ++i)
          {
            ASSERT_EQ(items[i].Item, expected[i].Item);
          }
        }
      }
    });
}

TEST(RadixSort, OrdersFloats)
{
  const float infinity = std::numeric_limits<float>::infinity();
  const float values[] = { -infinity, -3e38F, -1, -1e-45F, 0, 1e-45F, 1e-38F, 1, 1.0000001F, 3e38F,
    infinity };
  for (std::size_t i = 1; i < std::size(values); ++i)
  {
    EXPECT_LT(GetSortableBits(values[i - 1]), GetSortableBits(values[i])) << values[i];
  }
}

TEST(VisibilityOrder, ReportsCycles)
{
  WalkMesh mesh(MakeCyclicTetrahedra(3));
  mesh.MakeConvex();
  ASSERT_TRUE(mesh.GetConvexification()->Refusal.empty()) << mesh.GetConvexification()->Refusal;
  VisibilityOrder order(mesh);
  for (const bool parallel : { false, true })
  {
    const VisibilityView view = parallel ? LookAlong({ 0, 0, -1 }) : LookFrom({ 0.01, 0.02, 30 });
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 1000, 1);
    ASSERT_EQ(pairs.size(), 3U);
    for (const VisibilityMethod method :
      { VisibilityMethod::Meshed, VisibilityMethod::MeshedAcrossGaps })
    {
      VisibilityOrder order(mesh, method == VisibilityMethod::Meshed);
      const auto& front = order.Sort(view, method, FrontToBack);
      ExpectAllCells(front, 3);
      EXPECT_EQ(FindWrongPairs(pairs, front).size(), 1U);
      const VisibilityCycles& cycles = order.GetCycles();
      EXPECT_EQ(cycles.GetNumberOfCycles(), 1);
      ASSERT_GE(cycles.Cells.size(), 3U);
      EXPECT_EQ(std::vector<std::int32_t>(cycles.Cells.begin(), cycles.Cells.begin() + 3),
        (std::vector<std::int32_t>{ 0, 1, 2 }));
      EXPECT_GT(cycles.IgnoredFaces, 0);
      EXPECT_GT(cycles.IgnoredArea, 0);
    }
  }
  // From the side there is an order.
  order.Sort(LookFrom({ 30, 5, 1 }), VisibilityMethod::Meshed, FrontToBack);
  EXPECT_EQ(order.GetCycles().GetNumberOfCycles(), 0);
  EXPECT_TRUE(order.GetCycles().Cells.empty());
}

} // namespace
