// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/CellOrientation.h"

#include "Generate/GeneratedMeshes.h"
#include "ReferenceScenes.h"
#include "Walk/WalkMesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{

using tetralux::WalkMesh;

std::vector<std::uint8_t> Orient(const WalkMesh& mesh)
{
  return tetralux::OrientCells(mesh.GetMesh().Points, mesh.GetMesh().Cells, mesh.GetTables().Faces);
}

double GetSignedVolume(const tetralux::TetrahedralMesh& mesh, std::size_t cell)
{
  const auto edge = [&](int i, int a)
  {
    return mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[4 * cell + i]) + a] -
      mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[4 * cell]) + a];
  };
  double volume = 0;
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    volume += edge(1, a) * (edge(2, b) * edge(3, c) - edge(2, c) * edge(3, b));
  }
  return volume;
}

// Of neighbours, the face has opposite orders: told by permutations, not as the function tells.
void ExpectConsistent(const WalkMesh& mesh, const std::vector<std::uint8_t>& positive)
{
  const auto& cells = mesh.GetMesh().Cells;
  ASSERT_EQ(positive.size(), mesh.GetMesh().GetNumberOfCells());
  // The face's points as seen from inside of the cell, rotated so that the smallest is first.
  const auto orderFace = [&](std::size_t cell, int face)
  {
    std::array<std::int32_t, 4> order;
    std::copy_n(&cells[4 * cell], 4, order.begin());
    if (!positive[cell])
    {
      std::swap(order[0], order[1]);
    }
    const std::int32_t opposite = cells[4 * cell + face];
    // An even permutation that brings the opposite point to the front.
    while (order[0] != opposite)
    {
      order = order[3] == opposite
        ? std::array<std::int32_t, 4>{ order[3], order[2], order[1], order[0] }
        : std::array<std::int32_t, 4>{ order[1], order[2], order[0], order[3] };
    }
    std::array<std::int32_t, 3> triangle{ order[1], order[2], order[3] };
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    return triangle;
  };
  for (std::size_t cell = 0; cell < positive.size(); ++cell)
  {
    for (int face = 0; face < 4; ++face)
    {
      const tetralux::WalkFace& behind = mesh.GetFaces()[4 * cell + face];
      if (behind.Cell < 0)
      {
        continue;
      }
      const std::int32_t* other = &cells[4 * static_cast<std::size_t>(behind.Cell)];
      const auto place = static_cast<int>(std::find(other, other + 4, behind.Point) - other);
      ASSERT_LT(place, 4);
      std::array<std::int32_t, 3> here = orderFace(cell, face);
      const std::array<std::int32_t, 3> there =
        orderFace(static_cast<std::size_t>(behind.Cell), place);
      std::swap(here[1], here[2]);
      ASSERT_EQ(here, there) << "cell " << cell << ", face " << face;
    }
  }
}

TEST(CellOrientation, OfVolumes)
{
  const WalkMesh mesh(tetralux::MakeBox(5, 4, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15));
  const std::vector<std::uint8_t> positive = Orient(mesh);
  ExpectConsistent(mesh, positive);
  for (std::size_t cell = 0; cell < positive.size(); ++cell)
  {
    EXPECT_EQ(positive[cell] != 0, GetSignedVolume(mesh.GetMesh(), cell) > 0);
  }
}

// Cells turned inside out and flat ones among others; a mirrored part stays as it is in space.
TEST(CellOrientation, InvertedAndFlatCells)
{
  tetralux::TetrahedralMesh box = tetralux::MakeBox(6, 5, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.9, 7);
  for (std::size_t p = 0; p < box.GetNumberOfPoints(); p += 5)
  {
    box.Points[3 * p + 1] = std::round(box.Points[3 * p + 1]);
  }
  const WalkMesh mesh(std::move(box));
  const std::vector<std::uint8_t> positive = Orient(mesh);
  ExpectConsistent(mesh, positive);
  double sum = 0;
  std::size_t inverted = 0;
  for (std::size_t cell = 0; cell < positive.size(); ++cell)
  {
    const double volume = GetSignedVolume(mesh.GetMesh(), cell) * (positive[cell] ? 1 : -1);
    sum += volume;
    inverted += volume <= 0;
  }
  EXPECT_GT(sum, 0);
  EXPECT_GT(inverted, 10u);
}

TEST(CellOrientation, PartsByThemselves)
{
  // The second of two tetrahedra is flat, the third is far away.
  tetralux::TetrahedralMesh input;
  input.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.3, 0.3, 0, 5, 5, 5, 6, 5, 5, 5, 6, 5, 5, 5,
    4 };
  input.Cells = { 0, 1, 2, 3, 0, 1, 2, 4, 5, 6, 7, 8 };
  const WalkMesh mesh(std::move(input));
  const std::vector<std::uint8_t> positive = Orient(mesh);
  ExpectConsistent(mesh, positive);
  for (std::size_t cell = 0; cell < positive.size(); ++cell)
  {
    const double volume = GetSignedVolume(mesh.GetMesh(), cell);
    EXPECT_TRUE(volume == 0 || positive[cell] == (volume > 0));
  }
}

// A ring of cells, each joined to the next by a face, the last one to the first one so that it
// comes back mirrored.
TEST(CellOrientation, MirroredRingHasNone)
{
  // Consecutive points make a cell; the last three are the first three in another order.
  tetralux::TetrahedralMesh input;
  constexpr int Length = 8;
  for (int p = 0; p < Length; ++p)
  {
    input.Points.insert(input.Points.end(), { std::cos(0.7 * p), std::sin(1.3 * p), 0.2 * p * p });
  }
  const auto add = [&](std::array<std::int32_t, 4> cell)
  { input.Cells.insert(input.Cells.end(), cell.begin(), cell.end()); };
  for (int p = 0; p + 3 < Length; ++p)
  {
    add({ p, p + 1, p + 2, p + 3 });
  }
  std::vector<int> numberOfNone;
  for (const bool mirrored : { false, true })
  {
    tetralux::TetrahedralMesh ring = input;
    const auto close = [&](std::array<std::int32_t, 6> strip)
    {
      for (int k = 0; k + 3 < 6; ++k)
      {
        ring.Cells.insert(ring.Cells.end(), &strip[k], &strip[k] + 4);
      }
    };
    close(mirrored ? std::array<std::int32_t, 6>{ 5, 6, 7, 0, 2, 1 }
                   : std::array<std::int32_t, 6>{ 5, 6, 7, 0, 1, 2 });
    const WalkMesh mesh(std::move(ring));
    EXPECT_EQ(mesh.GetNumberOfCells(), 8);
    numberOfNone.push_back(Orient(mesh).empty());
  }
  // One of both closes without a mirror.
  EXPECT_EQ(numberOfNone[0] + numberOfNone[1], 1);
}

} // namespace
