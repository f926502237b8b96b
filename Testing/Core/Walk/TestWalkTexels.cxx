// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/WalkTexels.h"

#include "Generate/GeneratedMeshes.h"
#include "Walk/CellOrientation.h"
#include "Walk/WalkMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace
{

using tetralux::WalkMesh;
using tetralux::WalkTexels;

WalkMesh MakeRing()
{
  return WalkMesh(tetralux::GenerateMesh(
    "cylinder-with-hole", { { "across", 2 }, { "around", 12 }, { "along", 3 }, { "hole", 0.5 } })
                    .Mesh);
}

WalkTexels MakeTexels(const WalkMesh& mesh)
{
  return tetralux::MakeWalkTexels(mesh.GetTables(),
    tetralux::OrientCells(mesh.GetMesh().Points, mesh.GetMesh().Cells, mesh.GetTables().Faces));
}

// Each boundary face once, with the face's own index, and seen from outside: a ray that comes in
// has the cell behind the face.
TEST(WalkTexels, Entries)
{
  const WalkMesh mesh = MakeRing();
  const WalkTexels texels = MakeTexels(mesh);
  const auto numberOfFaces = static_cast<std::size_t>(mesh.GetNumberOfBoundaryFaces());
  ASSERT_EQ(texels.Entries.size(), 4 * numberOfFaces);
  const auto& points = mesh.GetMesh().Points;
  std::set<std::int32_t> seen;
  for (std::size_t k = 0; k < numberOfFaces; ++k)
  {
    const std::int32_t* entry = &texels.Entries[4 * k];
    EXPECT_TRUE(seen.insert(entry[3]).second);
    const tetralux::WalkFace& face = mesh.GetFaces()[entry[3]];
    ASSERT_LT(face.Cell, 0);
    const std::int32_t* cell = &mesh.GetMesh().Cells[4 * static_cast<std::size_t>(entry[3] / 4)];
    EXPECT_EQ(face.Point, cell[entry[3] % 4]);
    std::set<std::int32_t> corners(entry, entry + 3);
    corners.insert(face.Point);
    EXPECT_EQ(corners, std::set<std::int32_t>(cell, cell + 4));
    // Along the normal of the points in their order lies the cell.
    double edges[3][3];
    const std::int32_t others[3] = { entry[1], entry[2], face.Point };
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        edges[i][a] = points[3 * static_cast<std::size_t>(others[i]) + a] -
          points[3 * static_cast<std::size_t>(entry[0]) + a];
      }
    }
    double height = 0;
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      height += edges[2][a] * (edges[0][b] * edges[1][c] - edges[0][c] * edges[1][b]);
    }
    EXPECT_GT(height, 0);
  }
}

// By the links from the root every node is found once, and every entry in its leaf; each box
// contains the points of the leaves below.
TEST(WalkTexels, Links)
{
  const WalkMesh mesh = MakeRing();
  const WalkTexels texels = MakeTexels(mesh);
  const auto numberOfNodes = static_cast<std::int32_t>(texels.Links.size() / 2);
  ASSERT_EQ(texels.Boxes.size(), 8 * static_cast<std::size_t>(numberOfNodes));
  std::vector<std::vector<std::int32_t>> paths{ { 0 } };
  std::int32_t visited = 0;
  std::set<std::int32_t> entries;
  while (!paths.empty())
  {
    const std::vector<std::int32_t> path = paths.back();
    paths.pop_back();
    ASSERT_LT(++visited, numberOfNodes + 1);
    const std::int32_t node = path.back();
    ASSERT_LT(node, numberOfNodes);
    const std::int32_t second = texels.Links[2 * node];
    const std::int32_t leaf = texels.Links[2 * node + 1];
    if (leaf == 0)
    {
      for (const std::int32_t child : { node + 1, second })
      {
        paths.push_back(path);
        paths.back().push_back(child);
      }
      continue;
    }
    for (std::int32_t entry = leaf / 8; entry < leaf / 8 + leaf % 8; ++entry)
    {
      EXPECT_TRUE(entries.insert(entry).second);
      const tetralux::WalkPoint<float>& point =
        mesh.GetPoints<float>()[texels.Entries[4 * static_cast<std::size_t>(entry)]];
      for (const std::int32_t above : path)
      {
        const float* box = &texels.Boxes[8 * static_cast<std::size_t>(above)];
        EXPECT_LE(std::abs(point.X - box[0]), box[3]);
        EXPECT_LE(std::abs(point.Y - box[1]), box[4]);
        EXPECT_LE(std::abs(point.Z - box[2]), box[5]);
      }
    }
  }
  EXPECT_EQ(visited, numberOfNodes);
  EXPECT_EQ(entries.size(), static_cast<std::size_t>(mesh.GetNumberOfBoundaryFaces()));
}

TEST(WalkTexels, EmptyMesh)
{
  const WalkMesh mesh{ tetralux::TetrahedralMesh() };
  const WalkTexels texels = MakeTexels(mesh);
  EXPECT_TRUE(texels.Entries.empty());
  EXPECT_TRUE(texels.Links.empty());
}

} // namespace
