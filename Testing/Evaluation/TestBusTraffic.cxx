// SPDX-License-Identifier: BSD-3-Clause
#include "BusTraffic/BankedCache.h"
#include "BusTraffic/FrameBufferCache.h"
#include "BusTraffic/PaperTraffic.h"
#include "BusTraffic/SetCache.h"
#include "BusTraffic/TrafficFrame.h"
#include "BusTraffic/TrafficSimulator.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <list>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

namespace
{

using namespace tetralux;

constexpr int Threshold = 100;

/// A ball with some holes, and what is around it.
struct Ball
{
  std::vector<std::uint8_t> Values;
  ImageVolume Volume;

  Ball()
  {
    const int points[3] = { 40, 36, 30 };
    for (int z = 0; z < points[2]; ++z)
    {
      for (int y = 0; y < points[1]; ++y)
      {
        for (int x = 0; x < points[0]; ++x)
        {
          const double radius = std::hypot(x - 20., y - 17., z - 15.);
          const double wave = 40 * std::sin(0.9 * x) * std::sin(0.7 * y) * std::sin(0.8 * z);
          const double value = 140 + wave - 8 * std::max(radius - 11, 0.);
          this->Values.push_back(static_cast<std::uint8_t>(std::min(std::max(value, 0.), 255.)));
        }
      }
    }
    std::copy(points, points + 3, this->Volume.Dimensions);
    this->Volume.Type = ImageScalar::UInt8;
    this->Volume.Values = this->Values.data();
  }
};

TrafficView MakeView(bool parallel)
{
  TrafficView view;
  view.Azimuth = 0.4;
  view.Elevation = 0.6;
  view.Roll = 0.2;
  view.Extent = 34;
  view.ViewAngle = parallel ? 0 : 0.5;
  return view;
}

TrafficFrame MakeFrame(const Ball& ball, bool parallel)
{
  return MakeTrafficFrame(ball.Volume, MakeView(parallel), Threshold, 0.75, 64);
}

OpacityTable MakeConstant(int opacity)
{
  OpacityTable table;
  table.fill(static_cast<std::uint8_t>(opacity));
  return table;
}

TrafficRun MakeRun(TrafficOrder order, const TextureCacheKind& cache)
{
  TrafficRun run;
  run.Order = order;
  run.Cache = cache;
  return run;
}

TrafficCounts Simulate(const TrafficFrame& frame, const TrafficRun& run)
{
  return SimulateTraffic(frame, { &run, 1 }).front();
}

const TextureCacheKind Kinds[] = { { true, 1 << 10, 1 }, { true, 1 << 13, 1 },
  { false, 4 << 10, 8 }, { false, 6 << 10, 12 } };

TEST(BankedCache, CubesOfItsSizeFit)
{
  for (const int bits : { 1, 2 })
  {
    BankedCache cache(bits);
    const int size = 4 << bits;
    for (const int pass : { 0, 1 })
    {
      int misses = 0;
      for (int cell = 0; cell < (size - 1) * (size - 1) * (size - 1); ++cell)
      {
        const int x = cell % (size - 1), y = cell / (size - 1) % (size - 1);
        const int z = cell / (size - 1) / (size - 1);
        misses += cache.ReadCell(12 + x, 4 + y, 20 + z, true);
      }
      EXPECT_EQ(misses, pass == 0 ? size * size * size / 8 : 0);
    }
    // A cube at the same entries takes the place.
    EXPECT_EQ(cache.ReadCell(12 + size, 4, 20, true), 8);
    EXPECT_EQ(cache.ReadCell(12, 4, 20, true), 8);
    EXPECT_EQ(cache.ReadCell(12, 4, 20, true), 0);
  }
}

TEST(BankedCache, WithoutFillsNothingIsReplaced)
{
  BankedCache cache(1);
  EXPECT_EQ(cache.ReadCell(0, 0, 0, false), 8);
  EXPECT_EQ(cache.ReadCell(0, 0, 0, true), 8);
  EXPECT_EQ(cache.ReadCell(8, 0, 0, false), 8);
  EXPECT_EQ(cache.ReadCell(0, 0, 0, false), 0);
}

TEST(SetCache, IsThatOfLists)
{
  const int dimensions[3] = { 50, 40, 30 };
  constexpr int Ways = 3, Sets = 4;
  SetCache cache(Ways * Sets * 64, Ways, dimensions);
  std::vector<std::list<int>> sets(Sets); // the last used first
  std::mt19937 generator(1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const int x = generator() % 40, y = generator() % 3, z = generator() % 3;
    const bool fill = generator() % 4 != 0;
    int misses = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const int line = (((z + corner / 4) * 40 + y + corner / 2 % 2) * 50 + x + corner % 2) / 64;
      std::list<int>& set = sets[line % Sets];
      const std::size_t before = set.size();
      const bool found = std::find(set.begin(), set.end(), line) != set.end();
      misses += found ? 0 : 1;
      if (found || fill)
      {
        set.remove(line);
        set.push_front(line);
        if (set.size() > Ways)
        {
          set.pop_back();
        }
      }
      ASSERT_LE(before, set.size());
    }
    ASSERT_EQ(cache.ReadCell(x, y, z, fill), misses);
    hits += 8 - misses;
  }
  EXPECT_GT(hits, 10000);
  EXPECT_LT(hits, 150000);
}

TEST(FrameBufferCache, ReadsBlocksAndWritesPixels)
{
  FrameBufferCache cache;
  const auto blend = [&cache](int tile, bool above)
  {
    for (int y = 0; y < 8; ++y)
    {
      for (int x = 0; x < 8; ++x)
      {
        if ((y > x) == above)
        {
          cache.Blend(tile, x, y);
        }
      }
    }
  };
  blend(0, false);
  EXPECT_EQ(cache.GetBytesRead(), 3 * 48);
  blend(0, true);
  blend(0, true);
  EXPECT_EQ(cache.GetBytesRead(), 4 * 48);
  EXPECT_EQ(cache.GetBytesWritten(), 0);
  blend(1, true); // all blocks but the lower right one
  EXPECT_EQ(cache.GetBytesRead(), 7 * 48);
  EXPECT_EQ(cache.GetBytesWritten(), 48 * 3);
  cache.Flush();
  EXPECT_EQ(cache.GetBytesWritten(), 64 * 3 + 28 * 3);
  cache.Set(2, 0, 0);
  cache.Flush();
  EXPECT_EQ(cache.GetBytesRead(), 7 * 48);
  EXPECT_EQ(cache.GetBytesWritten(), 64 * 3 + 28 * 3 + 3);
}

/// Visits all points of all planes: visit(tile, half, plane, interpolated value), the value -1
/// outside of the volume. Without the code under test, but for the grid.
template <class VisitT>
void ForEachPoint(const TrafficFrame& frame, const VisitT& visit)
{
  const RayGrid& grid = frame.Grid;
  const auto* values = static_cast<const std::uint8_t*>(frame.Volume.Values);
  const int* points = frame.Volume.Dimensions;
  double along = 0;
  for (int a = 0; a < 3; ++a)
  {
    along += grid.Direction[a] * frame.Planes.Normal[a];
  }
  for (int y = 0; y < grid.Height; ++y)
  {
    for (int x = 0; x < grid.Width; ++x)
    {
      for (int plane = 0; plane < frame.Planes.Count; ++plane)
      {
        const double depth = frame.Planes.Origin + (plane + 0.5) * frame.Planes.Distance;
        double place[3];
        bool inside = true;
        for (int a = 0; a < 3; ++a)
        {
          place[a] = grid.Origin[a] + x * grid.OriginStepX[a] + y * grid.OriginStepY[a] +
            depth / along *
              (grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a]);
          inside = inside && place[a] >= 0 && place[a] <= points[a] - 1;
        }
        double value = -1;
        if (inside)
        {
          value = 0;
          for (int corner = 0; corner < 8; ++corner)
          {
            double weight = 1;
            int index[3];
            for (int a = 0; a < 3; ++a)
            {
              const double low = std::min(std::floor(place[a]), points[a] - 2.);
              const int side = corner >> a & 1;
              index[a] = static_cast<int>(low) + side;
              weight *= side != 0 ? place[a] - low : 1 - (place[a] - low);
            }
            value += weight * values[(index[2] * points[1] + index[1]) * points[0] + index[0]];
          }
        }
        visit(y / 8 * (grid.Width / 8) + x / 8, x % 8 >= y % 8 ? 0 : 1, plane, value);
      }
    }
  }
}

/// The planes of each S-triangle, first and last; none: the first is larger.
std::vector<std::array<int, 2>> ListPlanes(const TrafficFrame& frame)
{
  std::vector<std::array<int, 2>> planes(2 * frame.GetColumns() * frame.GetColumns(), { 0, -1 });
  for (const TrafficTriangle& triangle : frame.Triangles)
  {
    planes[2 * triangle.Tile + triangle.Half] = { triangle.Front, triangle.Back };
  }
  return planes;
}

TEST(TrafficFrame, TrianglesLeaveNothingVisibleOut)
{
  const Ball ball;
  for (const bool parallel : { false, true })
  {
    const TrafficFrame frame = MakeFrame(ball, parallel);
    const std::vector<std::array<int, 2>> planes = ListPlanes(frame);
    std::int64_t visible = 0, leftOut = 0, missed = 0;
    ForEachPoint(frame,
      [&](int tile, int half, int plane, double value)
      {
        const std::array<int, 2>& range = planes[2 * tile + half];
        const bool cast = range[0] <= plane && plane <= range[1];
        visible += value >= Threshold ? 1 : 0;
        leftOut += value >= 0 && !cast ? 1 : 0;
        missed += value >= Threshold && !cast ? 1 : 0;
      });
    EXPECT_EQ(missed, 0);
    EXPECT_GT(visible, 10000);
    EXPECT_GT(leftOut, 10000);
    EXPECT_GT(frame.Triangles.size(), 40u);
    EXPECT_LT(frame.Triangles.size(), 128u);
    EXPECT_EQ(frame.GetDepthsOfPixels(), 32 * frame.GetDepthsOfTriangles());
    std::set<int> used;
    for (const std::array<int, 2>& range : planes)
    {
      for (int plane = range[0]; plane <= range[1]; ++plane)
      {
        used.insert(plane);
      }
    }
    EXPECT_EQ(frame.GetNumberOfPlanes(), static_cast<int>(used.size()));
  }
}

TEST(TrafficFrame, OtherTypesAreRefused)
{
  Ball ball;
  ball.Volume.Type = ImageScalar::Int8;
  EXPECT_THROW(MakeFrame(ball, true), std::invalid_argument);
}

TEST(TrafficSimulator, CountsAreThoseOfAllPoints)
{
  const Ball ball;
  for (const bool parallel : { false, true })
  {
    const TrafficFrame frame = MakeFrame(ball, parallel);
    const std::vector<std::array<int, 2>> planes = ListPlanes(frame);
    std::int64_t pixels = 0, raypoints = 0, pTriangles = 0;
    ForEachPoint(frame,
      [&](int tile, int half, int plane, double value)
      {
        const std::array<int, 2>& range = planes[2 * tile + half];
        const bool cast = range[0] <= plane && plane <= range[1];
        pixels += cast ? 1 : 0;
        raypoints += cast && value >= 0 ? 1 : 0;
      });
    for (const std::array<int, 2>& range : planes)
    {
      pTriangles += range[1] - range[0] + 1;
    }
    EXPECT_LT(raypoints, pixels);
    for (const TrafficOrder order : { TrafficOrder::Triangles, TrafficOrder::Planes })
    {
      for (const TextureCacheKind& kind : Kinds)
      {
        const TrafficCounts counts = Simulate(frame, MakeRun(order, kind));
        EXPECT_EQ(counts.Pixels, pixels);
        EXPECT_EQ(counts.Raypoints, raypoints);
        EXPECT_EQ(counts.PTriangles, pTriangles);
        EXPECT_EQ(counts.STriangles, static_cast<std::int64_t>(frame.Triangles.size()));
        EXPECT_EQ(8 * counts.Raypoints, counts.Hits + counts.Misses);
        EXPECT_EQ(counts.TextureBytes, (kind.Banked ? 16 : 64) * counts.Misses);
        EXPECT_GT(counts.Misses, 0);
        EXPECT_GT(counts.Hits, counts.Misses);
      }
    }
  }
}

TEST(TrafficSimulator, TheOrderOfTrianglesReadsNoPixels)
{
  const Ball ball;
  const TrafficFrame frame = MakeFrame(ball, false);
  std::int64_t pixels = 0;
  for (const TrafficTriangle& triangle : frame.Triangles)
  {
    pixels += triangle.Half == 0 ? 36 : 28;
  }
  const TrafficCounts counts = Simulate(frame, MakeRun(TrafficOrder::Triangles, Kinds[0]));
  EXPECT_EQ(counts.FrameBytesRead, 0);
  EXPECT_EQ(counts.FrameBytesWritten, 3 * pixels);
  EXPECT_EQ(counts.GetBytes(), counts.TextureBytes + 3 * pixels);
  EXPECT_DOUBLE_EQ(counts.GetBandwidth(), 30e-6 * counts.GetBytes());
}

TEST(TrafficSimulator, TheOrderOfPlanesReadsABlockForItsPixels)
{
  const Ball ball;
  // Pixels of the lower and the upper S-triangle in the four blocks of 4 x 4 pixels of a tile.
  constexpr int Pixels[2][4] = { { 10, 16, 0, 10 }, { 6, 0, 16, 6 } };
  for (const bool parallel : { false, true })
  {
    const TrafficFrame frame = MakeFrame(ball, parallel);
    const std::vector<std::array<int, 2>> planes = ListPlanes(frame);
    std::int64_t blocks = 0, written = 0;
    int owners[4] = { -1, -1, -1, -1 };
    bool changed[2][4] = {};
    const auto leave = [&](int block)
    {
      for (const int half : { 0, 1 })
      {
        written += changed[half][block] ? Pixels[half][block] : 0;
        changed[half][block] = false;
      }
    };
    for (int plane = frame.Planes.Count - 1; plane >= 0; --plane)
    {
      for (std::size_t i = 0; i < planes.size(); ++i)
      {
        const int tile = static_cast<int>(i / 2), half = static_cast<int>(i % 2);
        for (int block = 0; block < 4; ++block)
        {
          if (planes[i][0] <= plane && plane <= planes[i][1] && Pixels[half][block] > 0)
          {
            if (owners[block] != tile)
            {
              leave(block);
              ++blocks;
            }
            owners[block] = tile;
            changed[half][block] = true;
          }
        }
      }
    }
    for (int block = 0; block < 4; ++block)
    {
      leave(block);
    }
    const TrafficCounts counts = Simulate(frame, MakeRun(TrafficOrder::Planes, Kinds[0]));
    EXPECT_EQ(counts.FrameBytesRead, 48 * blocks);
    EXPECT_EQ(counts.FrameBytesWritten, 3 * written);
    // Few pixels stay from plane to plane.
    EXPECT_LE(written, counts.Pixels);
    EXPECT_GT(written, counts.Pixels * 99 / 100);
    EXPECT_GT(counts.FrameBytesRead, counts.FrameBytesWritten);
  }
}

TEST(TrafficSimulator, OpaqueTrianglesEnd)
{
  const Ball ball;
  const TrafficFrame frame = MakeFrame(ball, true);
  TrafficRun run = MakeRun(TrafficOrder::Triangles, Kinds[1]);
  const TrafficCounts all = Simulate(frame, run);
  run.EndTriangles = true;
  run.Opacity = MakeConstant(0);
  const TrafficCounts transparent = Simulate(frame, run);
  EXPECT_EQ(transparent.PTriangles, all.PTriangles);
  EXPECT_EQ(transparent.Misses, all.Misses);

  // A raypoint halves translucency: the eighth makes it less than 1 / 255, in S-triangles that are
  // wholly in the volume. Of opacity 1, the first one does.
  for (const auto& [opacity, raypoints] : { std::array{ 255, 1 }, std::array{ 128, 8 } })
  {
    run.Opacity = MakeConstant(opacity);
    const std::vector<std::array<int, 2>> planes = ListPlanes(frame);
    std::vector<std::array<int, 64>> seen(planes.size()); // raypoints, for the n-th plane
    std::vector<int> used(planes.size(), 0);
    ForEachPoint(frame,
      [&](int tile, int half, int plane, double value)
      {
        const int i = 2 * tile + half;
        const int n = plane - planes[i][0];
        if (n >= 0 && plane <= planes[i][1])
        {
          ASSERT_LT(n, 64);
          seen[i][n] += value >= 0 ? 1 : 0;
        }
      });
    std::int64_t expected = 0;
    int early = 0;
    for (const TrafficTriangle& triangle : frame.Triangles)
    {
      const int i = 2 * triangle.Tile + triangle.Half;
      const int count = triangle.Back - triangle.Front + 1;
      const int pixels = triangle.Half == 0 ? 36 : 28;
      bool whole = count >= raypoints;
      for (int n = 0; n < raypoints && whole; ++n)
      {
        whole = seen[i][n] == pixels;
      }
      early += whole && count > raypoints ? 1 : 0;
      expected += whole ? raypoints : count;
    }
    const TrafficCounts counts = Simulate(frame, run);
    EXPECT_GT(early, 20);
    // Others may end as well, later.
    EXPECT_LE(counts.PTriangles, expected);
    EXPECT_GE(counts.PTriangles,
      raypoints * static_cast<std::int64_t>(frame.Triangles.size()) - all.PTriangles / 10);
    EXPECT_EQ(8 * counts.Raypoints, counts.Hits + counts.Misses);
    EXPECT_EQ(counts.FrameBytesWritten, all.FrameBytesWritten);
  }
}

TEST(TrafficSimulator, OpaquePixelsSaveFillsAlone)
{
  const Ball ball;
  const TrafficFrame frame = MakeFrame(ball, true);
  for (const TextureCacheKind& kind : Kinds)
  {
    TrafficRun run = MakeRun(TrafficOrder::Triangles, kind);
    run.EndTriangles = true;
    for (int value = 0; value < 256; ++value)
    {
      run.Opacity[value] = static_cast<std::uint8_t>(value < 90 ? 0 : value);
    }
    const TrafficCounts ended = Simulate(frame, run);
    run.SkipFills = true;
    const TrafficCounts saved = Simulate(frame, run);
    EXPECT_EQ(saved.PTriangles, ended.PTriangles);
    EXPECT_EQ(saved.Raypoints, ended.Raypoints);
    EXPECT_EQ(8 * saved.Raypoints, saved.Hits + saved.Misses);
    EXPECT_LT(saved.TextureBytes, ended.TextureBytes);
    EXPECT_LT(saved.TextureBytes, (kind.Banked ? 16 : 64) * saved.Misses);
    EXPECT_EQ(saved.FrameBytesWritten, ended.FrameBytesWritten);
  }
}

TEST(TrafficSimulator, ThreadsChangeNothing)
{
  const Ball ball;
  const TrafficFrame frame = MakeFrame(ball, false);
  std::vector<TrafficRun> runs;
  for (const TextureCacheKind& kind : Kinds)
  {
    runs.push_back(MakeRun(TrafficOrder::Triangles, kind));
    runs.push_back(MakeRun(TrafficOrder::Planes, kind));
  }
  std::vector<std::int64_t> misses;
  for (const TrafficRun& run : runs)
  {
    misses.push_back(Simulate(frame, run).Misses);
  }
  ForEachThreadCount(
    [&]
    {
      const std::vector<TrafficCounts> counts = SimulateTraffic(frame, runs);
      for (std::size_t i = 0; i < runs.size(); ++i)
      {
        EXPECT_EQ(counts[i].Misses, misses[i]);
      }
    });
}

TEST(PaperTraffic, RowsAreThoseOfThePaper)
{
  // MB/s as printed, in the order of the tables; all but one are rounded.
  constexpr int Printed[] = { 616, 551, 179, 121, 410, 349, 709, 1694, 982, 496, 241, 101, 982, 496,
    2426, 2354, 6037, 19110, 2383, 2143 };
  const std::vector<PaperRow> rows = MakePaperRows();
  ASSERT_EQ(rows.size(), std::size(Printed));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    EXPECT_NEAR(rows[i].Counts.GetBandwidth(), Printed[i], 1) << i;
  }
  EXPECT_EQ(rows[0].Counts.Hits, 49129695);
  EXPECT_EQ(rows[7].Counts.TextureBytes, 53799168);
  EXPECT_EQ(rows[19].Counts.Hits, 27279610);
  for (const PaperRow& row : rows)
  {
    EXPECT_EQ(row.Counts.FrameBytesRead % 48, 0);
    EXPECT_EQ(row.Counts.FrameBytesRead == 0, row.Order == TrafficOrder::Triangles);
  }
}

TEST(PaperTraffic, Table1IsArithmetic)
{
  EXPECT_NEAR(GetTriangleRate(256, 256), 5, 0.5);
  EXPECT_NEAR(GetTriangleRate(512, 512), 40, 2);
  EXPECT_NEAR(GetTriangleRate(1024, 1024), 320, 16);
}

} // namespace
