// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/VolumeScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace tetralux
{
namespace
{

/// One cell, whose longest edge is from (1, 0, 0) to (0, 0, 2).
VolumeScene MakeScene()
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2 };
  mesh.Cells = { 0, 1, 2, 3 };
  VolumeScene scene;
  scene.SetMesh(std::make_shared<WalkMesh>(std::move(mesh)));
  return scene;
}

TEST(VolumeScene, NoSegmentIsLongerThanTheLongestEdgeInTheWorld)
{
  VolumeScene scene = MakeScene();
  const double edge = std::sqrt(5.);
  RayGrid grid;
  // The bound is that of all directions together: at most the root of three too long.
  EXPECT_GE(scene.GetLongestSegment(grid), edge);
  EXPECT_LE(scene.GetLongestSegment(grid), 1.001 * std::sqrt(3.) * edge);

  // The mesh ten times as large in the world, moved, and sheared.
  const double rows[3][4] = { { 0.1, 0.1, 0, 5 }, { 0, 0.1, 0, 7 }, { 0, 0, 0.1, -3 } };
  std::copy_n(&rows[0][0], 12, &grid.MeshFromWorld[0][0]);
  // Its longest edge is (-1, 0, 2) in the mesh, (-10, 0, 20) in the world; (0, 1, 0) is
  // (-10, 10, 0).
  EXPECT_GE(scene.GetLongestSegment(grid), 10 * edge);
  EXPECT_LE(scene.GetLongestSegment(grid), 10 * edge * 2.001);

  const double singular[3][4] = {};
  std::copy_n(&singular[0][0], 12, &grid.MeshFromWorld[0][0]);
  EXPECT_FALSE(scene.GetLongestSegment(grid) < std::numeric_limits<double>::infinity());
}

TEST(VolumeScene, VersionsTellWhatChanged)
{
  VolumeScene scene = MakeScene();
  scene.SetCellScalars({ 0.5 });
  TransferFunction function;
  function.Nodes = { { 0, { { 1, 1, 1 }, 0 }, { { 1, 1, 1 }, 0 } },
    { 1, { { 1, 1, 1 }, 1 }, { { 1, 1, 1 }, 1 } } };
  scene.SetTransferFunction(function);
  scene.GetCellValues();
  const std::uint64_t first = scene.GetCellValuesVersion();
  scene.GetCellValues();
  EXPECT_EQ(scene.GetCellValuesVersion(), first);
  function.Nodes[1].Right.Attenuation = function.Nodes[1].Left.Attenuation = 2;
  scene.SetTransferFunction(function);
  EXPECT_EQ(scene.GetCellValues()[0].Attenuation, 1);
  EXPECT_NE(scene.GetCellValuesVersion(), first);

  const std::uint64_t table = scene.GetTableVersion();
  scene.SetTable(nullptr, 0);
  EXPECT_NE(scene.GetTableVersion(), table);
}

} // namespace
} // namespace tetralux
