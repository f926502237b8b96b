// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SeparatingPlanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace
{

using Box = std::array<double, 6>;
using tetralux::SeparatingPlanes;
using tetralux::SetExtents;

std::vector<SetExtents> AlongAxes(const std::vector<Box>& boxes)
{
  std::vector<SetExtents> extents(3);
  for (int axis = 0; axis < 3; ++axis)
  {
    extents[axis].Direction = { 0, 0, 0 };
    extents[axis].Direction[axis] = 1;
    for (const Box& box : boxes)
    {
      extents[axis].Sets.push_back({ box[2 * axis], box[2 * axis + 1] });
    }
  }
  return extents;
}

/// Boxes that fill a box, in random order, cut at random planes.
std::vector<Box> CutAtRandom(int count, std::mt19937& random)
{
  std::vector<Box> boxes = { { -1, 1, -2, 2, 0, 1 } };
  std::uniform_real_distribution<double> share(0.2, 0.8);
  while (static_cast<int>(boxes.size()) < count)
  {
    Box& cut = boxes[std::uniform_int_distribution<std::size_t>(0, boxes.size() - 1)(random)];
    const int axis = std::uniform_int_distribution<int>(0, 2)(random);
    const double at = cut[2 * axis] + share(random) * (cut[2 * axis + 1] - cut[2 * axis]);
    Box rest = cut;
    cut[2 * axis + 1] = at;
    rest[2 * axis] = at;
    boxes.push_back(rest);
  }
  std::shuffle(boxes.begin(), boxes.end(), random);
  return boxes;
}

/// Where a ray enters and leaves a box, in units of its direction; entry above exit if it does not.
std::pair<double, double> Intersect(
  const Box& box, const std::array<double, 3>& origin, const std::array<double, 3>& direction)
{
  double entry = 0, exit = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = (box[2 * axis] - origin[axis]) / direction[axis];
    const double high = (box[2 * axis + 1] - origin[axis]) / direction[axis];
    entry = std::max(entry, std::min(low, high));
    exit = std::min(exit, std::max(low, high));
  }
  return { entry, exit };
}

TEST(SeparatingPlanes, RaysMeetBoxesInTheirOrder)
{
  constexpr unsigned Seed = 7;
  constexpr int Partitions = 20, Boxes = 9, Eyes = 10, Rays = 50;
  constexpr double Rounding = 1e-12; // of places up to 10
  std::mt19937 random(Seed);
  std::uniform_real_distribution<double> place(-3, 3);
  int met = 0;
  for (int partition = 0; partition < Partitions; ++partition)
  {
    const std::vector<Box> boxes = CutAtRandom(Boxes, random);
    SeparatingPlanes planes;
    ASSERT_TRUE(planes.Find(AlongAxes(boxes)));
    for (int i = 0; i < Eyes; ++i)
    {
      const std::array<double, 3> eye = { place(random), place(random), place(random) };
      const std::vector<int> order = planes.FindOrder({ eye[0], eye[1], eye[2], 1 });
      ASSERT_EQ(order.size(), boxes.size());
      for (int ray = 0; ray < Rays; ++ray)
      {
        const std::array<double, 3> direction = { place(random), place(random), place(random) };
        double reached = 0;
        for (const int box : order)
        {
          const auto [entry, exit] = Intersect(boxes[box], eye, direction);
          if (entry < exit)
          {
            EXPECT_GE(entry, reached - Rounding);
            reached = exit;
            ++met;
          }
        }
      }
    }
  }
  EXPECT_GT(met, Partitions * Eyes * Rays / 4);
}

TEST(SeparatingPlanes, ParallelRays)
{
  const std::vector<Box> boxes = { { 1, 2, 0, 1, 0, 1 }, { 0, 1, 0, 1, 0, 1 } };
  SeparatingPlanes planes;
  ASSERT_TRUE(planes.Find(AlongAxes(boxes)));
  EXPECT_EQ(planes.FindOrder({ 1, 0, 0, 0 }), (std::vector<int>{ 0, 1 }));
  EXPECT_EQ(planes.FindOrder({ -1, 0, 0, 0 }), (std::vector<int>{ 1, 0 }));
}

/// Gaps are cut in their middle, and boxes of sets fill the box of all.
TEST(SeparatingPlanes, BoxesFillTheWhole)
{
  const std::vector<Box> boxes = { { 3, 4, 0, 1, 0, 1 }, { 0, 1, 0, 2, 0, 1 },
    { 0, 2, 3, 5, 0, 1 } };
  const Box whole = { 0, 4, 0, 5, 0, 1 };
  SeparatingPlanes planes;
  ASSERT_TRUE(planes.Find(AlongAxes(boxes)));
  EXPECT_EQ(planes.CutBox(0, whole), (Box{ 2.5, 4, 0, 5, 0, 1 }));
  EXPECT_EQ(planes.CutBox(1, whole), (Box{ 0, 2.5, 0, 2.5, 0, 1 }));
  EXPECT_EQ(planes.CutBox(2, whole), (Box{ 0, 2.5, 2.5, 5, 0, 1 }));
}

TEST(SeparatingPlanes, SetsWithoutPointsComeLast)
{
  constexpr double Most = std::numeric_limits<double>::max();
  const Box none = { Most, -Most, Most, -Most, Most, -Most };
  const std::vector<Box> boxes = { none, { 0, 1, 0, 1, 0, 1 }, none, { 1, 2, 0, 1, 0, 1 } };
  SeparatingPlanes planes;
  ASSERT_TRUE(planes.Find(AlongAxes(boxes)));
  EXPECT_EQ(planes.FindOrder({ 5, 0, 0, 1 }), (std::vector<int>{ 3, 1, 0, 2 }));
  EXPECT_EQ(planes.CutBox(0, { 0, 2, 0, 1, 0, 1 }), (Box{ 2, 2, 1, 1, 1, 1 }));
}

/// Around the one in the middle each box reaches over an end of the next: every plane cuts one.
TEST(SeparatingPlanes, PinwheelHasNone)
{
  const std::vector<Box> boxes = { { 0, 2, 0, 1, 0, 1 }, { 2, 3, 0, 2, 0, 1 }, { 1, 3, 2, 3, 0, 1 },
    { 0, 1, 1, 3, 0, 1 }, { 1, 2, 1, 2, 0, 1 } };
  SeparatingPlanes planes;
  EXPECT_FALSE(planes.Find(AlongAxes(boxes)));
}

TEST(SeparatingPlanes, OverlapOfRoundingCounts)
{
  SeparatingPlanes planes;
  const auto find = [&](double overlap) {
    return planes.Find(AlongAxes({ { 0, 1 + overlap, 0, 1, 0, 1 }, { 1, 2, 0, 1, 0, 1 } }));
  };
  EXPECT_TRUE(find(tetralux::SeparationOverlap));
  EXPECT_FALSE(find(4 * tetralux::SeparationOverlap));
}

/// Two triangles of a square, parted along its diagonal alone.
TEST(SeparatingPlanes, ObliqueDirections)
{
  std::vector<SetExtents> extents = AlongAxes({ { 0, 1, 0, 1, 0, 1 }, { 0, 1, 0, 1, 0, 1 } });
  SeparatingPlanes planes;
  EXPECT_FALSE(planes.Find(extents));
  extents.push_back({ { 1, 1, 0 }, { { 1, 2 }, { 0, 1 } } });
  ASSERT_TRUE(planes.Find(extents));
  EXPECT_EQ(planes.FindOrder({ 3, 3, 0, 1 }), (std::vector<int>{ 0, 1 }));
  EXPECT_EQ(planes.FindOrder({ 0.2, 0.2, 0, 1 }), (std::vector<int>{ 1, 0 }));
}

} // namespace
