// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/PerspectiveShift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace
{

using tetralux::FindPerspectiveShift;
using tetralux::RayGrid;
using tetralux::ScreenFrame;
using tetralux::ScreenPoint;
using tetralux::TetrahedralMesh;

/// Rays from (0, 0, distance) towards z = 0, a pixel of 0.1 there.
RayGrid MakeRays(double distance)
{
  RayGrid grid;
  grid.Width = grid.Height = 10;
  grid.Origin[2] = distance;
  grid.Direction[2] = -1;
  grid.DirectionStepX[0] = grid.DirectionStepY[1] = 0.1 / distance;
  return grid;
}

/// From the origin edges of length 1 across, and one along the rays, towards the eye.
TetrahedralMesh MakeCell()
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  mesh.Cells = { 0, 1, 2, 3 };
  return mesh;
}

double Find(double distance, const std::vector<std::uint8_t>& cells = {})
{
  const TetrahedralMesh mesh = MakeCell();
  const double center[3] = { 0.5, 0.5, 0.5 };
  const ScreenFrame frame(MakeRays(distance), center, 1);
  std::vector<ScreenPoint> points(4);
  frame.Project(mesh.Points, {}, 0, 1, points);
  return FindPerspectiveShift(frame, points, mesh, cells);
}

TEST(PerspectiveShift, IsThatOfTheLargestRatioOfDepths)
{
  for (const double distance : { 1.5, 2., 10., 1000. })
  {
    const double root = std::sqrt(distance / (distance - 1));
    // The slanted edges are longer by the root of 2, of the same ratio.
    EXPECT_NEAR(Find(distance), std::sqrt(2) * (root - 1) / (root + 1), 1e-12);
  }
}

/// The largest distance, along an edge, of the place that is on the ray from the one whose value
/// interpolation without correction takes.
TEST(PerspectiveShift, BoundsWhatIsInterpolated)
{
  const double near = 1, far = 3;
  double largest = 0;
  for (double share = 0; share <= 1; share += 1e-3)
  {
    const double right = share / far / ((1 - share) / near + share / far);
    largest = std::max(largest, std::abs(share - right));
  }
  const double root = std::sqrt(far / near);
  EXPECT_NEAR(largest, (root - 1) / (root + 1), 1e-5);
}

TEST(PerspectiveShift, OnlyOfCellsThatAreDrawn)
{
  EXPECT_EQ(Find(2, { 0 }), 0);
  EXPECT_GT(Find(2, { 1 }), 0);
}

TEST(PerspectiveShift, CellsThatReachBehindTheEyeHaveNoBound)
{
  EXPECT_EQ(Find(0.5), std::numeric_limits<double>::infinity());
  EXPECT_EQ(Find(0.5, { 0 }), 0);
}

} // namespace
