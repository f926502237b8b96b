// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/ScreenFrame.h"

#include "View/RayGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace
{

using namespace tetralux;

using Vector = std::array<double, 3>;

/// The largest error of places, pixels, and of relative depths: some dozen roundings of coordinates
/// of up to a hundred.
constexpr double Tolerance = 1e-11;

constexpr double MeshRadius = 3;
constexpr double MeshCenter[3] = { 20, -5, 9 };

/// A camera aslant, and a mesh that is turned, stretched and moved against the world.
RayGrid MakeGrid(bool isPerspective)
{
  RayGrid grid;
  grid.Width = 40;
  grid.Height = 30;
  const double origin[3] = { 1, 2, 10 };
  const double direction[3] = { -0.3, -0.2, -1 };
  const double stepX[3] = { 0.02, 0.001, 0.002 };
  const double stepY[3] = { -0.001, 0.02, 0.003 };
  std::copy_n(origin, 3, grid.Origin);
  std::copy_n(direction, 3, grid.Direction);
  std::copy_n(stepX, 3, isPerspective ? grid.DirectionStepX : grid.OriginStepX);
  std::copy_n(stepY, 3, isPerspective ? grid.DirectionStepY : grid.OriginStepY);
  const double matrix[3][4] = { { 0, 2, 0, 20 }, { -0.5, 0, 0.1, -5 }, { 0.2, 0.1, 1.5, 9 } };
  std::copy_n(&matrix[0][0], 12, &grid.MeshFromWorld[0][0]);
  return grid;
}

/// The point of the world at t along the ray of pixel (x, y).
Vector GetWorldPoint(const RayGrid& grid, double x, double y, double t)
{
  Vector point;
  for (int a = 0; a < 3; ++a)
  {
    point[a] = grid.Origin[a] + x * grid.OriginStepX[a] + y * grid.OriginStepY[a] +
      t * (grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a]);
  }
  return point;
}

Vector ToMesh(const RayGrid& grid, const Vector& world)
{
  Vector point;
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    point[a] = row[0] * world[0] + row[1] * world[1] + row[2] * world[2] + row[3];
  }
  return point;
}

/// Draws places in the picture and depths.
class Places
{
public:
  double DrawX() { return 40 * this->Uniform(this->Random); }
  double DrawY() { return 30 * this->Uniform(this->Random); }
  double DrawDepth() { return 1 + 10 * this->Uniform(this->Random); }
  double DrawSigned() { return 2 * this->Uniform(this->Random) - 1; }

private:
  std::mt19937_64 Random{ 1 };
  std::uniform_real_distribution<double> Uniform{ 0, 1 };
};

} // namespace

class ScreenFrames : public testing::TestWithParam<bool>
{
protected:
  RayGrid Grid = MakeGrid(GetParam());
  ScreenFrame Frame{ this->Grid, MeshCenter, MeshRadius };
  Places Draw;
};

TEST_P(ScreenFrames, FindTheRayOfAPoint)
{
  EXPECT_EQ(this->Frame.IsPerspective(), GetParam());
  EXPECT_EQ(this->Frame.GetMiddle()[0], 19.5);
  EXPECT_EQ(this->Frame.GetMiddle()[1], 14.5);
  for (int i = 0; i < 100; ++i)
  {
    const double x = this->Draw.DrawX(), y = this->Draw.DrawY(), t = this->Draw.DrawDepth();
    const Vector world = GetWorldPoint(this->Grid, x, y, t);
    const Vector mesh = ToMesh(this->Grid, world);
    const ScreenPoint point = this->Frame.Project(mesh.data(), 0.25);
    EXPECT_NEAR(point.X, x, Tolerance * 40);
    EXPECT_NEAR(point.Y, y, Tolerance * 40);
    EXPECT_NEAR(point.Depth * this->Frame.GetDepthUnit(), t, Tolerance * t);
    EXPECT_EQ(point.Scalar, 0.25);
    EXPECT_TRUE(this->Frame.IsInFront(point));

    // The same by homogeneous world coordinates, relative to any position.
    const double position[3] = { 3, 4, 5 };
    const double weight = 0.5;
    const double relative[4] = { weight * (world[0] - position[0]),
      weight * (world[1] - position[1]), weight * (world[2] - position[2]), weight };
    const auto [numerator, denominator] = this->Frame.ProjectDepth(position, relative);
    EXPECT_NEAR(numerator / denominator, point.Depth, Tolerance);
  }
}

TEST_P(ScreenFrames, BehindTheEyePlacesAreHomogeneous)
{
  for (int i = 0; i < 20; ++i)
  {
    const double x = this->Draw.DrawX(), y = this->Draw.DrawY(), t = -this->Draw.DrawDepth();
    const Vector mesh = ToMesh(this->Grid, GetWorldPoint(this->Grid, x, y, t));
    const ScreenPoint point = this->Frame.Project(mesh.data(), 0);
    EXPECT_EQ(this->Frame.IsInFront(point), !GetParam());
    const double factor = GetParam() ? point.Depth : 1;
    EXPECT_LT(point.Depth, 0);
    EXPECT_NEAR(point.X, x * factor, Tolerance * 40);
    EXPECT_NEAR(point.Y, y * factor, Tolerance * 40);
  }
}

TEST_P(ScreenFrames, ManyPointsAsOne)
{
  std::vector<double> points;
  std::vector<double> scalars;
  for (int i = 0; i < 10; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      points.push_back(MeshCenter[a] + MeshRadius * this->Draw.DrawSigned());
    }
    scalars.push_back(i);
  }
  std::vector<ScreenPoint> result(10);
  this->Frame.Project(points, scalars, 2, 4, result);
  for (int i = 0; i < 10; ++i)
  {
    const ScreenPoint expected = this->Frame.Project(&points[3 * std::size_t(i)], (i - 2) / 4.);
    EXPECT_EQ(result[i].X, expected.X);
    EXPECT_EQ(result[i].Y, expected.Y);
    EXPECT_EQ(result[i].Depth, expected.Depth);
    EXPECT_EQ(result[i].Scalar, expected.Scalar);
  }
  this->Frame.Project(points, {}, 2, 4, result);
  EXPECT_EQ(result[3].Scalar, 0);
}

TEST_P(ScreenFrames, PlanesHaveTheirSides)
{
  int sides[2] = { 0, 0 };
  for (int i = 0; i < 300; ++i)
  {
    const double x = this->Draw.DrawX(), y = this->Draw.DrawY(), t = this->Draw.DrawDepth();
    const Vector world = GetWorldPoint(this->Grid, x, y, t);
    const std::array<double, 4> plane = { this->Draw.DrawSigned(), this->Draw.DrawSigned(),
      this->Draw.DrawSigned(), 3 * this->Draw.DrawSigned() };
    const double value = plane[0] * world[0] + plane[1] * world[1] + plane[2] * world[2] + plane[3];
    // Planes of fragments are in single precision, and their numbers at most 1.
    constexpr double smallest = 1e-3;
    if (std::abs(value) < smallest)
    {
      continue;
    }
    const ScreenPlane seen = this->Frame.ProjectPlane(plane);
    const double depth = t / this->Frame.GetDepthUnit();
    const double z = GetParam() ? 1 / depth : -depth;
    EXPECT_EQ(
      seen.Constant + seen.X * (x - 19.5) + seen.Y * (y - 14.5) + seen.Z * z > 0, value > 0);
    ++sides[value > 0];
  }
  EXPECT_GT(sides[0], 30);
  EXPECT_GT(sides[1], 30);
}

TEST_P(ScreenFrames, LimitsKeepCellsThatPlanesCut)
{
  // Cells along a line in the world, x = 0, 1, 2, 3.
  std::vector<ScreenPoint> points;
  std::vector<std::int32_t> cells;
  for (int cell = 0; cell < 4; ++cell)
  {
    const double corners[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (const auto& corner : corners)
    {
      const Vector mesh =
        ToMesh(this->Grid, { corner[0] + cell, corner[1] + 0.5, corner[2] + 0.5 });
      cells.push_back(static_cast<std::int32_t>(points.size()));
      points.push_back(this->Frame.Project(mesh.data(), 0));
    }
  }
  // x >= 1.5 leaves out the first cell and cuts the second one; x >= -1 cuts nothing.
  const std::vector<std::array<double, 4>> planes = { { 1, 0, 0, -1.5 }, { 1, 0, 0, 1 } };
  const auto limits = this->Frame.FindLimits(planes, points, cells, {});
  EXPECT_EQ(limits.Planes.size(), 1u);
  EXPECT_EQ(limits.Cells, (std::vector<std::uint8_t>{ 0, 1, 1, 1 }));
  const std::vector<std::uint8_t> candidates = { 1, 1, 0, 1 };
  EXPECT_EQ(this->Frame.FindLimits(planes, points, cells, candidates).Cells,
    (std::vector<std::uint8_t>{ 0, 1, 0, 1 }));
  EXPECT_TRUE(
    this->Frame.FindLimits({ planes.data() + 1, 1 }, points, cells, candidates).Cells.empty());
}

TEST_P(ScreenFrames, RaysMustSpanSpace)
{
  RayGrid flat = this->Grid;
  std::fill_n(flat.DirectionStepY, 3, 0);
  std::fill_n(flat.OriginStepY, 3, 0);
  EXPECT_THROW(ScreenFrame(flat, MeshCenter, MeshRadius), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Cameras, ScreenFrames, testing::Bool(),
  [](const auto& info) { return info.param ? "Perspective" : "Parallel"; });
