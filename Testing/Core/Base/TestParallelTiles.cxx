// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ParallelTiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

constexpr int ThreadCounts[] = { 1, 2, 3, 7 };

const std::function<bool(double)> NoProgress;

/// As a tile takes in practice, so that others are at work meanwhile.
void Work() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

TEST(ParallelTiles, EveryPixelIsInOneTile)
{
  for (const int threads : ThreadCounts)
  {
    for (const TileGrid& grid :
      { TileGrid{ 37, 23, 8 }, TileGrid{ 32, 16, 8 }, TileGrid{ 3, 2, 8 }, TileGrid{ 5, 4, 1 } })
    {
      std::vector<std::atomic<int>> visits(grid.Width * grid.Height);
      EXPECT_TRUE(ForEachTile(grid, threads, NoProgress,
        [&](const Tile& tile, int)
        {
          EXPECT_LE(tile.X1 - tile.X0, grid.Size);
          EXPECT_LE(tile.Y1 - tile.Y0, grid.Size);
          for (int y = tile.Y0; y < tile.Y1; ++y)
          {
            for (int x = tile.X0; x < tile.X1; ++x)
            {
              ++visits.at(y * grid.Width + x);
            }
          }
        }));
      for (const std::atomic<int>& visit : visits)
      {
        EXPECT_EQ(visit, 1);
      }
    }
  }
}

TEST(ParallelTiles, EmptyPicturesHaveNoTiles)
{
  double last = -1;
  const auto progress = [&](double share)
  {
    last = share;
    return true;
  };
  EXPECT_TRUE(ForEachTile(
    TileGrid{ 0, 5, 8 }, 2, progress, [](const Tile&, int) { FAIL() << "there is no tile"; }));
  EXPECT_EQ(last, 1);
}

TEST(ParallelTiles, CallsOfAThreadNumberNeverOverlap)
{
  for (const int threads : ThreadCounts)
  {
    std::vector<std::atomic<int>> running(threads);
    ForEachTile(TileGrid{ 20, 10, 1 }, threads, NoProgress,
      [&](const Tile&, int thread)
      {
        EXPECT_EQ(running.at(thread)++, 0);
        Work();
        --running.at(thread);
      });
  }
}

TEST(ParallelTiles, ProgressComesFromTheCallingThreadAndEndsWithOne)
{
  for (const int threads : ThreadCounts)
  {
    const std::thread::id caller = std::this_thread::get_id();
    std::vector<double> shares;
    std::atomic<int> done{ 0 };
    const TileGrid grid{ 30, 20, 1 };
    const auto progress = [&](double share)
    {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_LE(std::lround(share * grid.GetCount()), done);
      shares.push_back(share);
      return true;
    };
    EXPECT_TRUE(ForEachTile(grid, threads, progress,
      [&](const Tile&, int)
      {
        Work();
        ++done;
      }));
    // Six hundred tiles of 0.2 ms are many intervals, unless there are very many threads.
    ASSERT_GE(shares.size(), 2u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.back(), 1);
    EXPECT_LT(shares[0], 1);
  }
}

TEST(ParallelTiles, ProgressGoesOnWhileOtherThreadsWork)
{
  std::atomic<bool> otherWorks{ false };
  int reportsMeanwhile = 0;
  const auto progress = [&](double)
  {
    reportsMeanwhile += otherWorks ? 1 : 0;
    return true;
  };
  std::atomic<bool> otherCame{ false };
  EXPECT_TRUE(ForEachTile(TileGrid{ 2, 1, 1 }, 2, progress,
    [&](const Tile&, int thread)
    {
      if (thread == 0)
      {
        // Leaves the other tile to the other thread, which may take seconds on a busy machine.
        const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!otherCame && std::chrono::steady_clock::now() < last)
        {
          std::this_thread::sleep_for(ReportInterval);
        }
        return;
      }
      otherCame = true;
      otherWorks = true;
      std::this_thread::sleep_for(20 * ReportInterval);
      otherWorks = false;
    }));
  EXPECT_TRUE(otherCame);
  EXPECT_GE(reportsMeanwhile, 2);
}

TEST(ParallelTiles, AbortLeavesTilesUndone)
{
  for (const int threads : ThreadCounts)
  {
    std::atomic<int> done{ 0 };
    int reports = 0;
    const auto progress = [&](double)
    {
      ++reports;
      return false;
    };
    const TileGrid grid{ 100, 100, 1 };
    EXPECT_FALSE(ForEachTile(grid, threads, progress,
      [&](const Tile&, int)
      {
        Work();
        ++done;
      }));
    EXPECT_LT(done, grid.GetCount());
    EXPECT_EQ(reports, 1); // no further one, not with 1 either
  }
}

TEST(ParallelTiles, ExceptionsOfTilesReachTheCaller)
{
  for (const int threads : ThreadCounts)
  {
    for (const int bad : { 0, 57, 99 })
    {
      std::atomic<int> done{ 0 };
      const auto cast = [&](const Tile& tile, int)
      {
        if (tile.X0 == bad)
        {
          throw std::runtime_error("tile " + std::to_string(bad));
        }
        ++done;
      };
      try
      {
        ForEachTile(TileGrid{ 100, 1, 1 }, threads, NoProgress, cast);
        ADD_FAILURE() << "nothing was thrown";
      }
      catch (const std::runtime_error& e)
      {
        EXPECT_EQ(e.what(), "tile " + std::to_string(bad));
      }
      EXPECT_LE(done, 99);
    }
  }
}

TEST(ParallelTiles, ExceptionsOfAllTilesBecomeOne)
{
  EXPECT_THROW(ForEachTile(TileGrid{ 100, 1, 1 }, 7, NoProgress,
                 [](const Tile&, int) { throw std::runtime_error("every tile"); }),
    std::runtime_error);
}

TEST(ParallelTiles, ExceptionsOfProgressReachTheCaller)
{
  for (const int threads : ThreadCounts)
  {
    std::atomic<int> done{ 0 };
    const TileGrid grid{ 100, 100, 1 };
    const auto progress = [](double) -> bool { throw std::runtime_error("enough"); };
    EXPECT_THROW(ForEachTile(grid, threads, progress,
                   [&](const Tile&, int)
                   {
                     Work();
                     ++done;
                   }),
      std::runtime_error);
    EXPECT_LT(done, grid.GetCount());
  }
}

} // namespace
