// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/PixelProjection.h"

#include "ReferenceScenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{

using tetralux::PixelProjection;
using tetralux::RayGrid;

const double Center[3] = { 0.4, -0.2, 0.3 };
constexpr double Radius = 1.7;

// Points on the ray of a pixel, in front of the eye, are seen in its middle.
void ExpectPixels(RayGrid grid)
{
  const double place[3][4] = { { 1.2, 0.1, 0, 0.3 }, { -0.2, 0.7, 0.1, -0.1 },
    { 0, 0.3, -1.1, 0.2 } };
  tetralux::PlaceMesh(grid, place);
  const PixelProjection projection(grid, Center, Radius);
  EXPECT_TRUE(projection.Regular);
  for (const auto& [i, j] : { std::pair<int, int>{ 0, 0 }, { 12, 57 }, { 79, 3 } })
  {
    for (const double t : { 0.5, 3., 40. })
    {
      std::array<double, 4> point{ 0, 0, 0, 1 };
      for (int a = 0; a < 3; ++a)
      {
        point[a] = (grid.MeshFromWorld[a][3] - Center[a]) / Radius;
        for (int b = 0; b < 3; ++b)
        {
          const double x = grid.Origin[b] + i * grid.OriginStepX[b] + j * grid.OriginStepY[b] +
            t * (grid.Direction[b] + i * grid.DirectionStepX[b] + j * grid.DirectionStepY[b]);
          point[a] += grid.MeshFromWorld[a][b] * x / Radius;
        }
      }
      double image[3] = { 0, 0, 0 };
      for (int row = 0; row < 3; ++row)
      {
        for (int column = 0; column < 4; ++column)
        {
          image[row] += projection.Rows[row][column] * point[column];
        }
      }
      EXPECT_NEAR(image[0] / image[2], i + 0.5, 1e-9);
      EXPECT_NEAR(image[1] / image[2], j + 0.5, 1e-9);
    }
  }
}

TEST(PixelProjection, Perspective)
{
  ExpectPixels(
    tetralux::MakePerspectiveGrid({ 7, 5, 9 }, { 0.2, 0.1, 0 }, { 0, 1, 0.1 }, 35, 80, 60));
}

TEST(PixelProjection, Parallel)
{
  ExpectPixels(
    tetralux::MakeParallelGrid({ 7, 5, 9 }, { 0.2, 0.1, 0 }, { 0, 1, 0.1 }, 1.3, 80, 60));
}

TEST(PixelProjection, EyeAmongTheMesh)
{
  for (const double distance : { 0., 1.6, 2. })
  {
    const RayGrid grid =
      tetralux::MakePerspectiveGrid({ Center[0], Center[1], Center[2] + distance },
        { Center[0], Center[1], Center[2] - 5 }, { 0, 1, 0 }, 35, 80, 60);
    EXPECT_EQ(PixelProjection(grid, Center, Radius).Regular, distance > Radius);
  }
}

} // namespace
