// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SeparatingNormal.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace
{

using Points = std::vector<std::array<double, 3>>;

constexpr unsigned Seed = 3;
constexpr int Cases = 50, Count = 30;

double Dot(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// How far points reach along a direction.
tetralux::SetExtent FindExtent(const Points& points, const std::array<double, 3>& direction)
{
  tetralux::SetExtent extent;
  for (const auto& point : points)
  {
    extent.Least = std::min(extent.Least, Dot(point, direction));
    extent.Greatest = std::max(extent.Greatest, Dot(point, direction));
  }
  return extent;
}

/// Random points on each side of a random plane, three of which both sets have on it.
void MakeParted(std::mt19937& random, double scale, Points& below, Points& above)
{
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    return std::array<double, 3>{ normal(random), normal(random), normal(random) };
  };
  const std::array<double, 3> direction = draw();
  const double square = Dot(direction, direction);
  below.clear();
  above.clear();
  for (int i = 0; i < Count; ++i)
  {
    std::array<double, 3> point = draw();
    const double along = Dot(point, direction) / square;
    if (i < 3)
    {
      for (int a = 0; a < 3; ++a)
      {
        point[a] = scale * (point[a] - along * direction[a] + 5);
      }
      below.push_back(point);
      above.push_back(point);
      continue;
    }
    for (double& x : point)
    {
      x = scale * (x + 5);
    }
    (along < 0 ? below : above).push_back(point);
  }
}

TEST(SeparatingNormal, PartsSetsThatTouch)
{
  std::mt19937 random(Seed);
  for (const double scale : { 1e-3, 1., 1e4 })
  {
    for (int i = 0; i < Cases; ++i)
    {
      Points below, above;
      MakeParted(random, scale, below, above);
      std::array<double, 3> normal;
      ASSERT_TRUE(tetralux::FindSeparatingNormal(below, above, normal));
      constexpr double Overlap = 1e-9; // of the size of about 6: rounding of the linear program
      EXPECT_LE(
        FindExtent(below, normal).Greatest, FindExtent(above, normal).Least + Overlap * 6 * scale);
    }
  }
}

TEST(SeparatingNormal, NoneWhereSetsOverlap)
{
  std::mt19937 random(Seed);
  for (int i = 0; i < Cases; ++i)
  {
    Points below, above;
    MakeParted(random, 1, below, above);
    // A point within the other set's hull: the middle of some of its points, off the plane.
    std::array<double, 3> inside{};
    for (const auto& point : above)
    {
      for (int a = 0; a < 3; ++a)
      {
        inside[a] += point[a] / static_cast<double>(above.size());
      }
    }
    below.push_back(inside);
    std::array<double, 3> normal;
    EXPECT_FALSE(tetralux::FindSeparatingNormal(below, above, normal));
  }
}

TEST(SeparatingNormal, AsFarAsCanBe)
{
  // In the middle between two squares.
  const Points below = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
  const Points above = { { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 } };
  std::array<double, 3> normal;
  ASSERT_TRUE(tetralux::FindSeparatingNormal(below, above, normal));
  constexpr double Rounding = 1e-9; // of the linear program
  EXPECT_NEAR(normal[0], 0, Rounding);
  EXPECT_NEAR(normal[1], 0, Rounding);
  EXPECT_EQ(normal[2], 1);
}

TEST(SeparatingNormal, OnePointTwice)
{
  std::array<double, 3> normal;
  EXPECT_FALSE(tetralux::FindSeparatingNormal({ { 1, 2, 3 } }, { { 1, 2, 3 } }, normal));
}

} // namespace
