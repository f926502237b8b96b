// SPDX-License-Identifier: BSD-3-Clause
#include "BusTraffic/TrafficSimulator.h"

#include "BusTraffic/BankedCache.h"
#include "BusTraffic/FrameBufferCache.h"
#include "BusTraffic/SetCache.h"
#include "TriangleCaster/HullDepths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetralux
{
namespace
{

constexpr int Size = TrafficFrame::TileSize;

/// The cell that a raypoint is in, and where in it.
struct CellPoint
{
  int Cell[3];
  double Part[3]; ///< 0..1
};

/// One run with a kind of texture cache.
template <class CacheT>
class Simulation
{
public:
  Simulation(const TrafficFrame& frame, const TrafficRun& run, const CacheT& cache)
    : Frame(frame)
    , Run(run)
    , Cache(cache)
    , DepthOfDirection(frame.Planes.GetDepthOfDirection(frame.Grid.Direction))
  {
  }

  TrafficCounts CountByTriangles()
  {
    for (const TrafficTriangle& triangle : this->Frame.Triangles)
    {
      this->Begin();
      bool opaque = false;
      for (int plane = triangle.Front; plane <= triangle.Back && !opaque; ++plane)
      {
        opaque = this->CastTriangle(triangle, plane) && this->Run.EndTriangles;
      }
      this->ForEachPixel(triangle, [&](int x, int y) { this->Pixels.Set(triangle.Tile, x, y); });
    }
    return this->Finish();
  }

  TrafficCounts CountByPlanes()
  {
    for (int plane = this->Frame.LastPlane; plane >= this->Frame.FirstPlane; --plane)
    {
      for (const TrafficTriangle& triangle : this->Frame.Triangles)
      {
        if (triangle.Front <= plane && plane <= triangle.Back)
        {
          this->CastTriangle(triangle, plane);
          this->ForEachPixel(
            triangle, [&](int x, int y) { this->Pixels.Blend(triangle.Tile, x, y); });
        }
      }
    }
    return this->Finish();
  }

private:
  bool UsesOpacity() const { return this->Run.EndTriangles || this->Run.SkipFills; }

  void Begin() { std::fill_n(this->Translucency, Size * Size, 1.); }

  template <class VisitT>
  void ForEachPixel(const TrafficTriangle& triangle, const VisitT& visit) const
  {
    for (int y = 0; y < Size; ++y)
    {
      for (int x = 0; x < Size; ++x)
      {
        if (GetTriangleOfPixel(x, y) == triangle.Half)
        {
          visit(x, y);
        }
      }
    }
  }

  /// Returns whether all pixels are opaque now.
  bool CastTriangle(const TrafficTriangle& triangle, int plane)
  {
    const int x0 = triangle.Tile % this->Frame.GetColumns() * Size;
    const int y0 = triangle.Tile / this->Frame.GetColumns() * Size;
    const double t = (this->Frame.Planes.Origin + (plane + 0.5) * this->Frame.Planes.Distance) /
      this->DepthOfDirection;
    bool opaque = true;
    ++this->Counts.PTriangles;
    this->ForEachPixel(triangle,
      [&](int x, int y)
      {
        ++this->Counts.Pixels;
        double& translucency = this->Translucency[y * Size + x];
        CellPoint point;
        if (this->FindCell(x0 + x, y0 + y, t, point))
        {
          this->CastRaypoint(point, translucency);
        }
        opaque = opaque && translucency < OpaqueTranslucency;
      });
    return opaque;
  }

  void CastRaypoint(const CellPoint& point, double& translucency)
  {
    const bool fill = !this->Run.SkipFills || translucency >= OpaqueTranslucency;
    const int misses = this->Cache.ReadCell(point.Cell[0], point.Cell[1], point.Cell[2], fill);
    ++this->Counts.Raypoints;
    this->Counts.Misses += misses;
    this->Counts.Hits += 8 - misses;
    this->Counts.TextureBytes += fill ? misses * CacheT::BytesOfFill : 0;
    if (this->UsesOpacity())
    {
      translucency *= 1 - this->Run.Opacity[this->Interpolate(point)] / 255.;
    }
  }

  /// Returns whether the point of a pixel's ray is within the volume.
  bool FindCell(int x, int y, double t, CellPoint& point) const
  {
    const RayGrid& grid = this->Frame.Grid;
    for (int a = 0; a < 3; ++a)
    {
      const double place = grid.Origin[a] + x * grid.OriginStepX[a] + y * grid.OriginStepY[a] +
        t * (grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a]);
      const int last = this->Frame.Volume.Dimensions[a] - 1;
      if (!(place >= 0 && place <= last))
      {
        return false;
      }
      point.Cell[a] = std::min(static_cast<int>(place), last - 1);
      point.Part[a] = place - point.Cell[a];
    }
    return true;
  }

  /// The nearest of 8 bits.
  int Interpolate(const CellPoint& point) const
  {
    const int* dimensions = this->Frame.Volume.Dimensions;
    const auto* values = static_cast<const std::uint8_t*>(this->Frame.Volume.Values);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1;
      std::size_t index = 0;
      for (int a = 2; a >= 0; --a)
      {
        const int side = corner >> a & 1;
        weight *= side != 0 ? point.Part[a] : 1 - point.Part[a];
        index = index * dimensions[a] + point.Cell[a] + side;
      }
      sum += weight * values[index];
    }
    return static_cast<int>(std::lround(sum));
  }

  TrafficCounts Finish()
  {
    this->Pixels.Flush();
    this->Counts.STriangles = static_cast<std::int64_t>(this->Frame.Triangles.size());
    this->Counts.FrameBytesRead = this->Pixels.GetBytesRead();
    this->Counts.FrameBytesWritten = this->Pixels.GetBytesWritten();
    return this->Counts;
  }

  const TrafficFrame& Frame;
  const TrafficRun& Run;
  CacheT Cache;
  FrameBufferCache Pixels;
  TrafficCounts Counts;
  double DepthOfDirection;
  double Translucency[Size * Size] = {}; ///< of the pixels of a tile
};

template <class CacheT>
TrafficCounts Simulate(const TrafficFrame& frame, const TrafficRun& run, const CacheT& cache)
{
  Simulation<CacheT> simulation(frame, run, cache);
  return run.Order == TrafficOrder::Triangles ? simulation.CountByTriangles()
                                              : simulation.CountByPlanes();
}

} // namespace

std::vector<TrafficCounts> SimulateTraffic(const TrafficFrame& frame, Span<const TrafficRun> runs)
{
  std::vector<TrafficCounts> counts(runs.size());
  const auto size = static_cast<std::int64_t>(runs.size());
#pragma omp parallel for schedule(dynamic)
  for (std::int64_t i = 0; i < size; ++i)
  {
    const TextureCacheKind& kind = runs[i].Cache;
    counts[i] = kind.Banked
      ? Simulate(frame, runs[i], BankedCache(kind.Bytes > 1 << 10 ? 2 : 1))
      : Simulate(frame, runs[i], SetCache(kind.Bytes, kind.Ways, frame.Volume.Dimensions));
  }
  return counts;
}

} // namespace tetralux
