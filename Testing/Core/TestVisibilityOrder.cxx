// SPDX-License-Identifier: BSD-3-Clause

// Visibility orders against brute force: no ray may meet two cells in another order.

#include "VisibilityOrder.h"

#include "GeneratedMeshes.h"
#include "ReferenceOcclusion.h"
#include "ReferenceScenes.h"
#include "ThreadCounts.h"
#include "WalkMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
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

TEST_P(VisibilityOrders, OfMeshesMadeConvexAreExact)
{
  WalkMesh mesh(GenerateMesh(GetParam().Name, GetParam().Parameters).Mesh);
  mesh.MakeConvex();
  VisibilityOrder order(mesh);
  ASSERT_TRUE(order.IsConvex()) << mesh.GetConvexification()->Refusal;
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
    MeshCase{ "shared-edge", { { "cells", 3 } } }, MeshCase{ "cycle", { { "cells", 1 } } },
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
    const auto& front = order.Sort(view, VisibilityMethod::Meshed, FrontToBack);
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
  // From the side there is an order.
  order.Sort(LookFrom({ 30, 5, 1 }), VisibilityMethod::Meshed, FrontToBack);
  EXPECT_EQ(order.GetCycles().GetNumberOfCycles(), 0);
  EXPECT_TRUE(order.GetCycles().Cells.empty());
}

} // namespace
