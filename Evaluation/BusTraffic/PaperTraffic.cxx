// SPDX-License-Identifier: BSD-3-Clause
#include "BusTraffic/PaperTraffic.h"

#include "BusTraffic/BankedCache.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tetralux
{
namespace
{

constexpr int Small = 1 << 10;
constexpr int Large = 1 << 13;

/// Opacities that grow from 0 at one value to a largest one, in 255ths, at another.
OpacityTable MakeRamp(int first, int last, int largest)
{
  OpacityTable table;
  for (int value = 0; value < static_cast<int>(table.size()); ++value)
  {
    const double part = std::clamp((value - first) / static_cast<double>(last - first), 0., 1.);
    table[value] = static_cast<std::uint8_t>(std::lround(part * largest));
  }
  return table;
}

/// The other columns follow: 8 voxels a raypoint are hits or misses, and each miss brings a line.
TrafficCounts MakeCounts(
  std::int64_t raypoints, std::int64_t misses, std::int64_t read, std::int64_t written)
{
  TrafficCounts counts;
  counts.Raypoints = raypoints;
  counts.Hits = 8 * raypoints - misses;
  counts.Misses = misses;
  counts.TextureBytes = BankedCache::BytesOfFill * misses;
  counts.FrameBytesRead = read;
  counts.FrameBytesWritten = written;
  return counts;
}

PaperRow MakeTriangleRow(const char* scene, TrafficOpacity opacity, int size, int cacheBytes,
  std::int64_t pTriangles, std::int64_t sTriangles, std::int64_t raypoints, std::int64_t misses,
  std::int64_t written)
{
  PaperRow row;
  row.Scene = scene;
  row.Size = size;
  row.CacheBytes = cacheBytes;
  row.EndTriangles = opacity != TrafficOpacity::Any;
  row.Opacity = opacity;
  row.Counts = MakeCounts(raypoints, misses, 0, written);
  row.Counts.PTriangles = pTriangles;
  row.Counts.STriangles = sTriangles;
  return row;
}

PaperRow MakePlaneRow(const char* scene, int size, int cacheBytes, std::int64_t raypoints,
  std::int64_t misses, std::int64_t read, std::int64_t written)
{
  PaperRow row;
  row.Scene = scene;
  row.Order = TrafficOrder::Planes;
  row.Size = size;
  row.CacheBytes = cacheBytes;
  row.Counts = MakeCounts(raypoints, misses, read, written);
  return row;
}

} // namespace

PaperScene MakePaperBrain()
{
  PaperScene scene;
  scene.Name = "brain";
  scene.FileName = "brain.vti";
  // Fitted: see PaperScene. The face looks at the camera from the side, upright.
  scene.View.Azimuth = 0;
  scene.View.Elevation = 0.815;
  scene.View.Roll = 1.5708;
  scene.View.ViewAngle = 0.5893;
  scene.View.Extent = 151.5;
  scene.HullThreshold = 16;
  // The data have no index bits of materials, so there is one table in place of the paper's four.
  scene.Opaque = MakeRamp(40, 110, 255);
  scene.Translucent = MakeRamp(40, 120, 85);
  scene.Planes = 253;
  return scene;
}

PaperScene MakePaperEngine()
{
  PaperScene scene;
  scene.Name = "engine";
  scene.FileName = "engine.vti";
  // Fitted: see PaperScene.
  scene.View.Azimuth = -0.0686;
  scene.View.Elevation = -0.9796;
  scene.View.Roll = 1.52;
  scene.View.ViewAngle = 0.5548;
  scene.View.Extent = 236.57;
  scene.HullThreshold = 40;
  scene.Opaque = MakeRamp(60, 170, 255);
  scene.Translucent = MakeRamp(120, 255, 48);
  scene.Planes = 233;
  return scene;
}

std::vector<PaperRow> MakePaperRows()
{
  constexpr TrafficOpacity Any = TrafficOpacity::Any;
  constexpr TrafficOpacity Opaque = TrafficOpacity::Opaque;
  constexpr TrafficOpacity Translucent = TrafficOpacity::Translucent;
  const char* brain = "brain";
  const char* engine = "engine";
  return {
    MakeTriangleRow(brain, Any, 256, Small, 196999, 1816, 6300309, 1272777, 174120),
    MakeTriangleRow(brain, Any, 256, Large, 196999, 1816, 6300309, 1136354, 174120),
    MakeTriangleRow(brain, Opaque, 256, Small, 57307, 1816, 1833306, 362519, 174120),
    MakeTriangleRow(brain, Opaque, 256, Large, 57307, 1816, 1833306, 240856, 174120),
    MakeTriangleRow(brain, Translucent, 256, Small, 133323, 1816, 4263945, 843473, 174120),
    MakeTriangleRow(brain, Translucent, 256, Large, 133323, 1816, 4263945, 715188, 174120),
    MakeTriangleRow(brain, Translucent, 512, Large, 481865, 7093, 15415406, 1434982, 680544),
    MakeTriangleRow(brain, Translucent, 1024, Large, 1765039, 27661, 56425601, 3362448, 2654472),
    MakeTriangleRow(engine, Any, 256, Small, 120801, 1343, 3785584, 2038646, 128688),
    MakeTriangleRow(engine, Any, 256, Large, 120801, 1343, 3785584, 1026090, 128688),
    MakeTriangleRow(engine, Opaque, 256, Small, 30148, 1343, 953630, 496079, 128688),
    MakeTriangleRow(engine, Opaque, 256, Large, 30148, 1343, 953630, 203400, 128688),
    MakeTriangleRow(engine, Translucent, 256, Small, 120794, 1343, 3785518, 2038626, 128688),
    MakeTriangleRow(engine, Translucent, 256, Large, 120794, 1343, 3785518, 1026070, 128688),
    MakePlaneRow(brain, 256, Small, 6300309, 2674958, 19167456, 18904236),
    MakePlaneRow(brain, 256, Large, 6300309, 2524678, 19167456, 18904236),
    MakePlaneRow(brain, 512, Large, 23802207, 3603320, 72151536, 71412348),
    MakePlaneRow(brain, 1024, Large, 90020181, 5764038, 274692288, 270069492),
    MakePlaneRow(engine, 256, Small, 3785584, 3504967, 11772768, 11578164),
    MakePlaneRow(engine, 256, Large, 3785584, 3005062, 11772768, 11578164),
  };
}

double GetTriangleRate(int planes, int size)
{
  constexpr double FramesPerSecond = 10;
  constexpr double PixelsPerTriangle = 0.5 * TrafficFrame::TileSize * TrafficFrame::TileSize;
  return 1e-6 * FramesPerSecond * planes * size * size / PixelsPerTriangle;
}

} // namespace tetralux
