// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SimplexIntersection.h"

#include "Geometry/TetrahedronFaces.h"
#include "Rationals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

namespace
{

using rationals::Number;
using rationals::Point;

/// Points of few coordinates, so that most pairs of simplices touch in a point, an edge or a plane;
/// and how many of these are tried.
constexpr int PointsPerAxis = 4;
constexpr int NumberOfPairs = 600;

/// Draws points of a small lattice. Slanted: after a map that is exact in doubles and takes all
/// planes off the axes, far from the origin.
class LatticePoints
{
public:
  explicit LatticePoints(bool isSlanted)
  {
    for (int i = 0; i < PointsPerAxis * PointsPerAxis * PointsPerAxis; ++i)
    {
      const double x = i % PointsPerAxis;
      const double y = i / PointsPerAxis % PointsPerAxis;
      const double z = i / PointsPerAxis / PointsPerAxis;
      const double p[3] = { x, y, z };
      const double q[3] = { 1e7 + 0.125 * x + 0.25 * y, 5 * y - z, -1e7 + 0.5 * z + x };
      this->Coordinates.insert(this->Coordinates.end(), isSlanted ? q : p, (isSlanted ? q : p) + 3);
    }
  }

  tetralux::ExactPoints GetPoints() const
  {
    return tetralux::ExactPoints(this->Coordinates.data());
  }

  /// Different ids, some of which are those of another simplex.
  template <std::size_t Size, std::size_t OtherSize>
  std::array<std::int32_t, Size> Draw(const std::array<std::int32_t, OtherSize>& other)
  {
    std::array<std::int32_t, Size> ids;
    std::set<std::int32_t> used;
    for (std::int32_t& id : ids)
    {
      do
      {
        id = this->Random() % 4 == 0 && OtherSize > 0
          ? other[this->Random() % std::max<std::size_t>(OtherSize, 1)]
          : static_cast<std::int32_t>(this->Random() % (this->Coordinates.size() / 3));
      } while (!used.insert(id).second);
    }
    return ids;
  }
  std::array<std::int32_t, 3> DrawTriangle(const std::array<std::int32_t, 4>& other)
  {
    std::array<std::int32_t, 3> triangle;
    do
    {
      triangle = this->Draw<3>(other);
    } while (this->GetPoints().FindProjection(triangle[0], triangle[1], triangle[2]) < 0);
    return triangle;
  }
  std::array<std::int32_t, 4> DrawCell()
  {
    std::array<std::int32_t, 4> cell;
    do
    {
      cell = this->Draw<4>(std::array<std::int32_t, 1>{ 0 });
    } while (this->GetPoints().Orient(cell[0], cell[1], cell[2], cell[3]) <= 0);
    return cell;
  }

  template <std::size_t Size>
  std::vector<Point> GetCorners(const std::array<std::int32_t, Size>& ids) const
  {
    std::vector<Point> corners;
    for (const std::int32_t id : ids)
    {
      corners.push_back(rationals::MakePoint(&this->Coordinates[3 * std::size_t(id)]));
    }
    return corners;
  }

private:
  std::vector<double> Coordinates;
  std::mt19937_64 Random{ 1 };
};

template <std::size_t Size0, std::size_t Size1>
std::vector<std::int32_t> FindShared(
  std::array<std::int32_t, Size0> ids0, std::array<std::int32_t, Size1> ids1)
{
  std::sort(ids0.begin(), ids0.end());
  std::sort(ids1.begin(), ids1.end());
  std::vector<std::int32_t> shared;
  std::set_intersection(
    ids0.begin(), ids0.end(), ids1.begin(), ids1.end(), std::back_inserter(shared));
  return shared;
}

/// Whether all that two simplices have in common is the simplex of the points that they share: then
/// each corner of the intersection is one of these.
template <std::size_t Size0, std::size_t Size1>
bool MeetProperly(const LatticePoints& points, const std::array<std::int32_t, Size0>& ids0,
  const std::array<std::int32_t, Size1>& ids1)
{
  const auto corners =
    rationals::IntersectSimplices(points.GetCorners(ids0), points.GetCorners(ids1));
  std::vector<Point> allowed;
  for (const std::int32_t id : FindShared(ids0, ids1))
  {
    allowed.push_back(points.GetCorners(std::array<std::int32_t, 1>{ id })[0]);
  }
  return std::all_of(corners.begin(), corners.end(),
    [&allowed](const Point& corner)
    { return std::find(allowed.begin(), allowed.end(), corner) != allowed.end(); });
}

Point GetMiddle(const std::vector<Point>& points)
{
  Point middle = { 0, 0, 0 };
  for (const Point& point : points)
  {
    for (int a = 0; a < 3; ++a)
    {
      middle[a] += point[a] / points.size();
    }
  }
  return middle;
}

bool IsStrictlyInside(const std::vector<Point>& cell, const Point& point)
{
  for (const auto& face : tetralux::OutwardFaces)
  {
    const Point& origin = cell[face[0]];
    if (rationals::GetDeterminant(rationals::Subtract(cell[face[1]], origin),
          rationals::Subtract(cell[face[2]], origin), rationals::Subtract(point, origin)) >= 0)
    {
      return false;
    }
  }
  return true;
}

bool HaveArea(const std::vector<Point>& points)
{
  for (const Point& p : points)
  {
    for (const Point& q : points)
    {
      const Point u = rationals::Subtract(p, points[0]);
      const Point v = rationals::Subtract(q, points[0]);
      if (u[0] * v[1] != u[1] * v[0] || u[1] * v[2] != u[2] * v[1] || u[0] * v[2] != u[2] * v[0])
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

class SimplexIntersection : public testing::TestWithParam<bool>
{
protected:
  /// Fails unless both answers of a test came up often.
  void CheckCounts(int yes, int no) const
  {
    EXPECT_GT(yes, NumberOfPairs / 20);
    EXPECT_GT(no, NumberOfPairs / 20);
  }
};

TEST_P(SimplexIntersection, TrianglesMeetProperlyAsInRationals)
{
  LatticePoints points(GetParam());
  int counts[2] = { 0, 0 };
  for (int i = 0; i < NumberOfPairs; ++i)
  {
    const auto triangle0 = points.DrawTriangle({ 1, 2, 3, 4 });
    const auto triangle1 =
      points.DrawTriangle({ triangle0[0], triangle0[1], triangle0[2], triangle0[0] });
    if (FindShared(triangle0, triangle1).size() == 3)
    {
      continue;
    }
    const bool expected = MeetProperly(points, triangle0, triangle1);
    ++counts[expected];
    EXPECT_EQ(
      tetralux::TrianglesMeetProperly(points.GetPoints(), triangle0.data(), triangle1.data()),
      expected);
  }
  this->CheckCounts(counts[1], counts[0]);
}

TEST_P(SimplexIntersection, CellMeetsTriangleAsInRationals)
{
  LatticePoints points(GetParam());
  int proper[2] = { 0, 0 };
  int pierced[2] = { 0, 0 };
  int possible[2] = { 0, 0 };
  for (int i = 0; i < NumberOfPairs; ++i)
  {
    const auto cell = points.DrawCell();
    const auto triangle = points.DrawTriangle(cell);
    const auto corners = points.GetCorners(cell);
    const auto common = rationals::IntersectSimplices(corners, points.GetCorners(triangle));
    const bool isPierced = !common.empty() && IsStrictlyInside(corners, GetMiddle(common));
    ++pierced[isPierced];
    EXPECT_EQ(
      tetralux::TrianglePiercesCell(points.GetPoints(), cell.data(), triangle.data()), isPierced);

    int signs[4];
    for (int p = 0; p < 4; ++p)
    {
      signs[p] = points.GetPoints().Orient(triangle[0], triangle[1], triangle[2], cell[p]);
    }
    const bool isPossible =
      tetralux::CellCanMeetTriangle(points.GetPoints(), cell.data(), triangle.data(), signs);
    ++possible[isPossible];
    EXPECT_TRUE(isPossible || common.empty());

    if (FindShared(cell, triangle).size() == 3)
    {
      continue;
    }
    const bool expected = MeetProperly(points, cell, triangle);
    ++proper[expected];
    EXPECT_EQ(tetralux::CellMeetsTriangleProperly(points.GetPoints(), cell.data(), triangle.data()),
      expected);
  }
  this->CheckCounts(proper[1], proper[0]);
  this->CheckCounts(pierced[1], pierced[0]);
  this->CheckCounts(possible[1], possible[0]);
}

TEST_P(SimplexIntersection, CoplanarTrianglesOverlapAsInRationals)
{
  LatticePoints points(GetParam());
  int counts[2] = { 0, 0 };
  while (counts[0] + counts[1] < NumberOfPairs)
  {
    // The first lattice points are in one plane.
    auto triangle0 = points.DrawTriangle({ 0, 1, 2, 3 });
    auto triangle1 =
      points.DrawTriangle({ triangle0[0], triangle0[1], triangle0[2], triangle0[0] });
    for (int k = 0; k < 3; ++k)
    {
      triangle0[k] %= PointsPerAxis * PointsPerAxis;
      triangle1[k] %= PointsPerAxis * PointsPerAxis;
    }
    const tetralux::ExactPoints exact = points.GetPoints();
    const int axis = exact.FindProjection(triangle0[0], triangle0[1], triangle0[2]);
    if (axis < 0 || exact.FindProjection(triangle1[0], triangle1[1], triangle1[2]) < 0)
    {
      continue;
    }
    const auto common =
      rationals::IntersectSimplices(points.GetCorners(triangle0), points.GetCorners(triangle1));
    const bool expected = !common.empty() && HaveArea(common);
    ++counts[expected];
    EXPECT_EQ(tetralux::CoplanarTrianglesOverlap(exact, triangle0.data(), triangle1.data(), axis),
      expected);
  }
  this->CheckCounts(counts[1], counts[0]);
}

INSTANTIATE_TEST_SUITE_P(Lattices, SimplexIntersection, testing::Bool(),
  [](const auto& info) { return info.param ? "Slanted" : "Straight"; });
