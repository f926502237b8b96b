// SPDX-License-Identifier: BSD-3-Clause
// Which bands a picture is cast in, and what happens where there is no memory for one.
#include "GpuRayCast/RayBands.h"
#include "GpuRayCast/RayTargets.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/GraphicsCard.h"
#include "OpenGL/GraphicsMemory.h"

#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace
{

using tetralux::FindRowsOfBand;

tetralux::RayBandRequest MakeRequest(int width, int height, std::int64_t maximumBytes)
{
  tetralux::RayBandRequest request;
  request.Width = width;
  request.Height = height;
  request.BytesPerPixel = 10;
  request.MaximumBytes = maximumBytes;
  request.LargestSize = 1000;
  return request;
}

TEST(RayBands, AsFewAndAsEqualAsPossible)
{
  EXPECT_EQ(FindRowsOfBand(MakeRequest(100, 80, 1000 * 80)), 80);
  EXPECT_EQ(FindRowsOfBand(MakeRequest(100, 80, 1000 * 80 - 1)), 40); // two of 40
  EXPECT_EQ(FindRowsOfBand(MakeRequest(100, 80, 1000 * 30)), 27);     // 27, 27, 26
  EXPECT_EQ(FindRowsOfBand(MakeRequest(100, 80, 999)), 1);            // at least one row
  EXPECT_EQ(FindRowsOfBand(MakeRequest(100, 1, 1000)), 1);
  // 2^31 pixels and more.
  EXPECT_EQ(FindRowsOfBand(MakeRequest(1000, 1000000000, std::int64_t(1) << 60)), 1000);
}

TEST(RayBands, LimitsOfOpenGL)
{
  EXPECT_EQ(FindRowsOfBand(MakeRequest(1000, 1000, std::int64_t(1) << 40)), 1000);
  EXPECT_EQ(FindRowsOfBand(MakeRequest(1000, 1001, std::int64_t(1) << 40)), 501);
  try
  {
    FindRowsOfBand(MakeRequest(1001, 5, std::int64_t(1) << 40));
    ADD_FAILURE();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(
      error.what(), "the picture is 1001 pixels wide, and this OpenGL draws into at most 1000");
  }
}

TEST(RayBands, AreHalvedWhereThereIsNoMemory)
{
  std::vector<int> tried;
  const auto fitsUpTo = [&tried](int most)
  {
    return [&tried, most](int rows)
    {
      tried.push_back(rows);
      if (rows > most)
      {
        throw tetralux::OutOfGraphicsMemory("full");
      }
    };
  };
  EXPECT_EQ(tetralux::HalveRowsUntilMade(75, fitsUpTo(10)), 10);
  EXPECT_EQ(tried, (std::vector<int>{ 75, 38, 19, 10 }));
  tried.clear();
  EXPECT_THROW(tetralux::HalveRowsUntilMade(3, fitsUpTo(0)), tetralux::OutOfGraphicsMemory);
  EXPECT_EQ(tried, (std::vector<int>{ 3, 2, 1 }));
  // Other errors are not mended by fewer rows.
  EXPECT_THROW(tetralux::HalveRowsUntilMade(3, [](int) { throw std::runtime_error("other"); }),
    std::runtime_error);
}

// A packed state has 28 bits for four faces of each tetrahedron and two other numbers.
TEST(RayBands, StatesHaveRoomForMeshes)
{
  EXPECT_EQ(tetralux::RayTargets::FindObstacle((1 << 26) - 1), "");
  EXPECT_EQ(tetralux::RayTargets::FindObstacle(1 << 26),
    "the mesh has 67108864 tetrahedra, and rays on the graphics card tell apart at most 67108863");
}

// The driver's own word for it, where a picture is larger than what OpenGL in software makes; and
// what fits is made afterwards.
TEST(RayBands, DriversTellThatThereIsNoMemory)
{
  vtkNew<vtkHeadlessRenderWindow> window;
  window->SetSize(8, 8);
  window->Render();
  if (!tetralux::DescribeGraphicsCard(window).Software)
  {
    GTEST_SKIP() << "a graphics card may have the memory";
  }
  tetralux::FloatTarget picture;
  tetralux::FloatTarget::Settings settings;
  settings.Width = settings.Height = 1 << 14; // no side is too long, but the area is
  EXPECT_THROW(picture.Prepare(window, settings), tetralux::OutOfGraphicsMemory);
  EXPECT_EQ(picture.GetNumberOfBytes(), 0u);
  settings.Width = 7;
  settings.Height = 5;
  picture.Prepare(window, settings);
  EXPECT_EQ(picture.GetNumberOfBytes(), 7u * 5 * 16);
}

} // namespace
