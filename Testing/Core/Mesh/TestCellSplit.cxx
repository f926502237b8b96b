// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CellSplit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace
{

using Id = std::int64_t;
using Point = std::array<double, 3>;
using Triangle = std::array<Id, 3>;

/// A cell by the numbers of its points; 5 points: pyramid, 6: wedge, 8: hexahedron.
using Cell = std::vector<Id>;

std::vector<std::array<Id, 4>> Split(const Cell& ids)
{
  Id tets[6 * 4];
  const int count = ids.size() == 5 ? tetralux::SplitPyramid(ids.data(), tets)
    : ids.size() == 6               ? tetralux::SplitWedge(ids.data(), tets)
                                    : tetralux::SplitHexahedron(ids.data(), tets);
  std::vector<std::array<Id, 4>> result(count);
  for (int i = 0; i < count; ++i)
  {
    std::copy_n(tets + 4 * i, 4, result[i].begin());
  }
  return result;
}

double GetVolume(const Point& a, const Point& b, const Point& c, const Point& d)
{
  double u[3][3];
  for (int i = 0; i < 3; ++i)
  {
    u[0][i] = b[i] - a[i];
    u[1][i] = c[i] - a[i];
    u[2][i] = d[i] - a[i];
  }
  return (u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
           u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
           u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0])) /
    6;
}

/// The faces that belong to one tetrahedron alone.
std::set<Triangle> GetSurface(const std::vector<std::array<Id, 4>>& tets)
{
  std::map<Triangle, int> counts;
  for (const auto& tet : tets)
  {
    for (int i = 0; i < 4; ++i)
    {
      Triangle face = { tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4] };
      std::sort(face.begin(), face.end());
      ++counts[face];
    }
  }
  std::set<Triangle> surface;
  for (const auto& [face, count] : counts)
  {
    EXPECT_LE(count, 2);
    if (count == 1)
    {
      surface.insert(face);
    }
  }
  return surface;
}

/// The triangles on the surface of the quadrilaterals and triangles, split as CellSplit.h says.
std::set<Triangle> GetExpectedSurface(const std::vector<Cell>& faces)
{
  std::set<Triangle> surface;
  for (Cell face : faces)
  {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    for (std::size_t i = 2; i < face.size(); ++i)
    {
      Triangle triangle = { face[0], face[i - 1], face[i] };
      std::sort(triangle.begin(), triangle.end());
      surface.insert(triangle);
    }
  }
  return surface;
}

/// Point numbers of the faces of a pyramid, wedge or hexahedron.
std::vector<Cell> GetFaces(std::size_t cellSize)
{
  switch (cellSize)
  {
    case 5:
      return { { 0, 1, 2, 3 }, { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };
    case 6:
      return { { 0, 1, 2 }, { 3, 4, 5 }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 2, 0, 3, 5 } };
    default:
      return { { 0, 1, 2, 3 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 },
        { 3, 0, 4, 7 } };
  }
}

Cell Select(const Cell& ids, const Cell& numbers)
{
  Cell selected;
  for (const Id number : numbers)
  {
    selected.push_back(ids[number]);
  }
  return selected;
}

/// Splits the cell under every order of its ids.
void CheckEveryOrder(const std::vector<Point>& points, double volume)
{
  Cell ids(points.size());
  std::iota(ids.begin(), ids.end(), 10);
  std::set<std::size_t> sizes;
  do
  {
    std::map<Id, Point> pointOf;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      pointOf[ids[i]] = points[i];
    }
    const auto tets = Split(ids);
    sizes.insert(tets.size());

    double sum = 0;
    for (const auto& tet : tets)
    {
      const double part =
        GetVolume(pointOf[tet[0]], pointOf[tet[1]], pointOf[tet[2]], pointOf[tet[3]]);
      ASSERT_GT(part, 0.01 * volume);
      sum += part;
    }
    ASSERT_NEAR(sum, volume, 1e-12);

    std::vector<Cell> faces;
    for (const Cell& face : GetFaces(ids.size()))
    {
      faces.push_back(Select(ids, face));
    }
    ASSERT_EQ(GetSurface(tets), GetExpectedSurface(faces));
  } while (std::next_permutation(ids.begin(), ids.end()));

  EXPECT_EQ(sizes,
    points.size() == 8 ? std::set<std::size_t>({ 5, 6 })
                       : std::set<std::size_t>({ points.size() - 3 }));
}

/// Splits the cells under random orders of the ids; faces that cells share must match.
void CheckShared(const std::vector<Cell>& cells, Id numberOfPoints)
{
  std::mt19937_64 random(7);
  std::vector<Id> order(numberOfPoints);
  std::iota(order.begin(), order.end(), 0);
  for (int trial = 0; trial < 1000; ++trial)
  {
    std::shuffle(order.begin(), order.end(), random);
    std::vector<std::array<Id, 4>> tets;
    std::map<std::set<Id>, std::vector<Cell>> faces;
    for (const Cell& cell : cells)
    {
      const Cell ids = Select(order, cell);
      const auto split = Split(ids);
      tets.insert(tets.end(), split.begin(), split.end());
      for (const Cell& face : GetFaces(cell.size()))
      {
        const Cell faceIds = Select(ids, face);
        faces[{ faceIds.begin(), faceIds.end() }].push_back(faceIds);
      }
    }
    std::vector<Cell> surfaceFaces;
    for (const auto& [ids, sharing] : faces)
    {
      if (sharing.size() == 1)
      {
        surfaceFaces.push_back(sharing[0]);
      }
    }
    ASSERT_EQ(GetSurface(tets), GetExpectedSurface(surfaceFaces));
  }
}

const std::vector<Point> Cube = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
  { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

/// Point numbers of the hexahedron (i, j, k) in a grid with n points along an axis.
Cell GetGridHexahedron(int i, int j, int k, int n)
{
  Cell ids;
  for (const Point& corner : Cube)
  {
    ids.push_back(static_cast<Id>((k + corner[2]) * n * n + (j + corner[1]) * n + i + corner[0]));
  }
  return ids;
}

} // namespace

TEST(CellSplit, PyramidInEveryOrder)
{
  CheckEveryOrder({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.4, 0.3, 1 } }, 1. / 3);
}

TEST(CellSplit, WedgeInEveryOrder)
{
  // As vtkWedge has it: the normal of the first three points points away from the other three.
  CheckEveryOrder(
    { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 2 }, { 0, 1, 2 }, { 1, 0, 2 } }, 1);
}

TEST(CellSplit, HexahedronInEveryOrder)
{
  // A frustum: its faces are plane, but it has no symmetry that could hide a swap of axes.
  CheckEveryOrder({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 2, 0 }, { 0, 2, 0 }, { 0, 0, 3 }, { 2, 0, 3 },
                    { 2, 1, 3 }, { 0, 1, 3 } },
    14);
}

TEST(CellSplit, SharedFacesOfHexahedra)
{
  std::vector<Cell> cells;
  for (int cell = 0; cell < 8; ++cell)
  {
    cells.push_back(GetGridHexahedron(cell & 1, cell >> 1 & 1, cell >> 2, 3));
  }
  CheckShared(cells, 27);
}

TEST(CellSplit, SharedFacesOfMixedCells)
{
  // A hexahedron with pyramids on four of its faces and wedges on the others; a second wedge stands
  // on the first, and a pyramid on the second.
  CheckShared({ { 0, 1, 2, 3, 4, 5, 6, 7 }, { 0, 1, 2, 3, 8 }, { 4, 7, 6, 5, 9 },
                { 0, 4, 5, 1, 10 }, { 2, 6, 7, 3, 11 }, { 1, 2, 12, 5, 6, 13 },
                { 1, 12, 14, 5, 13, 15 }, { 0, 3, 16, 4, 7, 17 }, { 12, 13, 15, 14, 18 } },
    19);
}

TEST(CellSplit, StructuredParity)
{
  std::vector<std::array<Id, 4>> tets;
  double volume = 0;
  for (int cell = 0; cell < 27; ++cell)
  {
    const int i = cell % 3;
    const int j = cell / 3 % 3;
    const int k = cell / 9;
    const Cell ids = GetGridHexahedron(i, j, k, 4);
    Id split[5 * 4];
    ASSERT_EQ(tetralux::SplitStructuredHexahedron(ids.data(), (i + j + k) % 2 != 0, split), 5);
    for (int t = 0; t < 5; ++t)
    {
      Point corners[4];
      for (int c = 0; c < 4; ++c)
      {
        const Id id = split[4 * t + c];
        corners[c] = { double(id % 4), double(id / 4 % 4), double(id / 16) };
      }
      const double part = GetVolume(corners[0], corners[1], corners[2], corners[3]);
      EXPECT_GT(part, 0.1);
      volume += part;
      tets.push_back({ split[4 * t], split[4 * t + 1], split[4 * t + 2], split[4 * t + 3] });
    }
  }
  EXPECT_NEAR(volume, 27, 1e-12);
  EXPECT_EQ(GetSurface(tets).size(), 6u * 9 * 2);
}
