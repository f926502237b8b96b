// SPDX-License-Identifier: BSD-3-Clause
#include "View/MeshToWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tetralux
{
namespace
{

struct Rows
{
  double Values[3][4] = {};
};

double GetLength(const Rows& rows, const double x[3])
{
  double square = 0;
  for (const auto& row : rows.Values)
  {
    const double y = row[0] * x[0] + row[1] * x[1] + row[2] * x[2];
    square += y * y;
  }
  return std::sqrt(square);
}

Rows MakeDiagonal(double x, double y, double z)
{
  Rows rows;
  rows.Values[0][0] = x;
  rows.Values[1][1] = y;
  rows.Values[2][2] = z;
  return rows;
}

TEST(MeshToWorld, DiagonalsAreExact)
{
  for (const double scale : { 1., 1e-200, 1e200 })
  {
    const Stretch stretch = MeasureStretch(MakeDiagonal(2 * scale, -scale, 8 * scale).Values);
    EXPECT_DOUBLE_EQ(stretch.Smallest, scale);
    EXPECT_DOUBLE_EQ(stretch.Largest, 8 * scale);
  }
  const Stretch inverse = MeasureMeshToWorld(MakeDiagonal(2, 1, 8).Values);
  EXPECT_EQ(inverse.Smallest, 1. / 8);
  EXPECT_EQ(inverse.Largest, 1);
}

TEST(MeshToWorld, BoundsTheLengthsOfRandomVectorsAndReachesThem)
{
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr double Rounding = 1e-14; // of a length, relative
  for (int round = 0; round < 200; ++round)
  {
    Rows rows;
    for (auto& row : rows.Values)
    {
      std::generate_n(row, 4, [&] { return normal(random); });
    }
    const Stretch stretch = MeasureStretch(rows.Values);
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0;
    for (int k = 0; k < 4000; ++k)
    {
      double x[3];
      std::generate_n(x, 3, [&] { return normal(random); });
      const double length = GetLength(rows, x) / std::hypot(x[0], x[1], x[2]);
      smallest = std::min(smallest, length);
      largest = std::max(largest, length);
    }
    EXPECT_LE(stretch.Smallest, smallest * (1 + Rounding));
    EXPECT_GE(stretch.Largest, largest * (1 - Rounding));
    // Some of the vectors are within a few degrees of the ones that are stretched most and least.
    EXPECT_LE(largest, stretch.Largest);
    EXPECT_GE(largest, 0.99 * stretch.Largest);
    EXPECT_LE(smallest, stretch.Smallest + 0.1 * stretch.Largest);
  }
}

TEST(MeshToWorld, RotationsStretchNothing)
{
  Rows rows;
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const double turned[3][3] = { { c, -s, 0 }, { s, c, 0 }, { 0, 0, 1 } };
  for (int i = 0; i < 3; ++i)
  {
    std::copy_n(turned[i], 3, rows.Values[i]);
  }
  EXPECT_DOUBLE_EQ(MeasureStretch(rows.Values).Smallest, 1);
  EXPECT_DOUBLE_EQ(MeasureStretch(rows.Values).Largest, 1);
}

TEST(MeshToWorld, SingularAndNotFinite)
{
  EXPECT_EQ(MeasureStretch(Rows().Values).Largest, 0);
  EXPECT_EQ(MeasureMeshToWorld(MakeDiagonal(1, 0, 1).Values).Largest,
    std::numeric_limits<double>::infinity());
  const double notANumber = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(MeasureStretch(MakeDiagonal(1, 1 / 0., 1).Values).Largest));
  EXPECT_TRUE(
    std::isnan(MeasureStretch(MakeDiagonal(notANumber, notANumber, notANumber).Values).Largest) ||
    MeasureStretch(MakeDiagonal(notANumber, notANumber, notANumber).Values).Largest == 0);
}

} // namespace
} // namespace tetralux
