// SPDX-License-Identifier: BSD-3-Clause

// Compares two ways to find where the rays of a perspective picture cross the boundary of a mesh:
//
// hierarchy  as RayCastKernel.inl: each packet of eight rays goes through the boundary's BVH.
// raster     each boundary face is projected to the picture, put into the bins of the tiles that
//            its bounds touch, and tested against the packets within its bounds.
//
// Both decide by the same exact test, so the crossings must be the same; that is checked. Prints
// processor milliseconds of a frame, one thread.

#include "ComparisonMeshes.h"
#include "OwnedCrossings.h"
#include "RayCast/RayCastKernel.inl"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <numeric>
#include <utility>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

constexpr int ImageSize = 512;
constexpr int TileSize = 16;
constexpr int PacketsAcross = TileSize / 4; ///< packets are four pixels wide and two high
constexpr int PacketsOfTile = TileSize * TileSize / LaneCount;
constexpr int TilesAcross = ImageSize / TileSize;
constexpr int Runs = 3;

/// Pixels by which a face's bounds in the picture are grown: a hundred times what single precision
/// displaces a corner by (2^-22 radii, at 300 pixels a radius).
constexpr double BoundsMargin = 0.01;

KernelInput MakeInput(const WalkMesh& mesh, const RayGrid& grid)
{
  KernelInput in{};
  in.Points = mesh.GetPoints<float>();
  in.Faces = mesh.GetFaces();
  in.Entries = mesh.GetEntries();
  in.Nodes = mesh.GetBvh().Nodes.data();
  in.Triangles = mesh.GetBvh().Triangles.data();
  in.NumberOfCells = mesh.GetNumberOfCells();
  std::copy_n(mesh.GetCenter(), 3, in.Center);
  in.Radius = mesh.GetRadius();
  in.Grid = &grid;
  return in;
}

/// Calls found(x, y, crossings, buffer) for each packet.
template <class Found>
void FindByHierarchy(const KernelInput& in, Found&& found)
{
  OwnedCrossings buffer;
  PacketCrossings crossings;
  for (int tile = 0; tile < TilesAcross * TilesAcross; ++tile)
  {
    for (int packet = 0; packet < PacketsOfTile; ++packet)
    {
      const int x = tile % TilesAcross * TileSize + packet % PacketsAcross * 4;
      const int y = tile / TilesAcross * TileSize + packet / PacketsAcross * 2;
      const Rays<float> rays = MakeRays<float>(in, MakeWorldRays(*in.Grid, x, y));
      while (!FindCrossings(in, rays, MaskFromBits(0xff), buffer, crossings))
      {
      }
      found(x, y, crossings, buffer);
    }
  }
}

/// The pixels that a face may cover.
struct PixelBounds
{
  int X0, Y0, X1, Y1; ///< both ends included
};

class Rasterizer
{
public:
  Rasterizer(const WalkMesh& mesh, const PerspectiveView& view)
    : Mesh(mesh)
    , View(view)
    , In(MakeInput(mesh, view.Grid))
  {
  }

  template <class Found>
  void Find(Found&& found)
  {
    this->FillBins();
    for (int tile = 0; tile < TilesAcross * TilesAcross; ++tile)
    {
      while (!this->FindInTile(tile))
      {
      }
      for (int packet = 0; packet < PacketsOfTile; ++packet)
      {
        found(tile % TilesAcross * TileSize + packet % PacketsAcross * 4,
          tile / TilesAcross * TileSize + packet / PacketsAcross * 2, this->Crossings[packet],
          this->Buffers[packet]);
      }
    }
  }

private:
  PixelBounds GetBounds(const WalkEntry& entry) const
  {
    double lo[2] = { ImageSize, ImageSize };
    double hi[2] = { -1, -1 };
    for (const std::int32_t id : entry.Points)
    {
      const WalkPoint<float>& p = this->Mesh.GetPoints<float>()[id];
      const float x[3] = { p.X, p.Y, p.Z };
      double right = 0;
      double up = 0;
      double depth = 0;
      for (int a = 0; a < 3; ++a)
      {
        const double d = x[a] * this->In.Radius + this->In.Center[a] - this->View.Position[a];
        right += d * this->View.Right[a];
        up += d * this->View.Up[a];
        depth += d * this->View.Forward[a];
      }
      // The camera is outside of the bounding sphere: depth is positive.
      const double scale = 1 / (depth * this->View.Pixel);
      const double pixel[2] = { right * scale + 0.5 * (ImageSize - 1),
        up * scale + 0.5 * (ImageSize - 1) };
      for (int a = 0; a < 2; ++a)
      {
        lo[a] = std::min(lo[a], pixel[a]);
        hi[a] = std::max(hi[a], pixel[a]);
      }
    }
    const auto first = [](double v)
    { return static_cast<int>(std::ceil(std::max(v - BoundsMargin, 0.))); };
    const auto last = [](double v)
    { return static_cast<int>(std::floor(std::min(v + BoundsMargin, ImageSize - 1.))); };
    return { first(lo[0]), first(lo[1]), last(hi[0]), last(hi[1]) };
  }

  template <class Function>
  static void ForEachTile(const PixelBounds& b, Function&& function)
  {
    // Most faces of a fine mesh lie between the pixels.
    if (b.X0 > b.X1 || b.Y0 > b.Y1)
    {
      return;
    }
    for (int y = b.Y0 / TileSize; y <= b.Y1 / TileSize; ++y)
    {
      for (int x = b.X0 / TileSize; x <= b.X1 / TileSize; ++x)
      {
        function(y * TilesAcross + x);
      }
    }
  }

  void FillBins()
  {
    const std::int32_t n = this->Mesh.GetNumberOfBoundaryFaces();
    this->Bounds.resize(n);
    this->BinBegins.assign(TilesAcross * TilesAcross + 1, 0);
    for (std::int32_t b = 0; b < n; ++b)
    {
      this->Bounds[b] = this->GetBounds(this->Mesh.GetEntries()[b]);
      ForEachTile(this->Bounds[b], [this](int tile) { ++this->BinBegins[tile + 1]; });
    }
    for (int tile = 0; tile < TilesAcross * TilesAcross; ++tile)
    {
      this->BinBegins[tile + 1] += this->BinBegins[tile];
    }
    this->Bins.resize(this->BinBegins.back());
    std::vector<std::int32_t> ends(this->BinBegins);
    for (std::int32_t b = 0; b < n; ++b)
    {
      ForEachTile(this->Bounds[b], [&](int tile) { this->Bins[ends[tile]++] = b; });
    }
  }

  /// False where a buffer was too small; it is larger then.
  bool FindInTile(int tile)
  {
    if (this->BinBegins[tile] == this->BinBegins[tile + 1])
    {
      std::fill_n(&this->Crossings[0].Count[0], PacketsOfTile * LaneCount, 0);
      return true;
    }
    const int tileX = tile % TilesAcross * TileSize;
    const int tileY = tile / TilesAcross * TileSize;
    Rays<float> rays[PacketsOfTile];
    for (int packet = 0; packet < PacketsOfTile; ++packet)
    {
      rays[packet] = MakeRays<float>(this->In,
        MakeWorldRays(
          *this->In.Grid, tileX + packet % PacketsAcross * 4, tileY + packet / PacketsAcross * 2));
      std::fill_n(this->Crossings[packet].Count, LaneCount, 0);
    }
    for (std::int32_t k = this->BinBegins[tile]; k < this->BinBegins[tile + 1]; ++k)
    {
      const std::int32_t entry = this->Bins[k];
      const PixelBounds& b = this->Bounds[entry];
      const int x0 = (std::max(b.X0, tileX) - tileX) / 4;
      const int x1 = (std::min(b.X1, tileX + TileSize - 1) - tileX) / 4;
      const int y0 = (std::max(b.Y0, tileY) - tileY) / 2;
      const int y1 = (std::min(b.Y1, tileY + TileSize - 1) - tileY) / 2;
      for (int y = y0; y <= y1; ++y)
      {
        for (int x = x0; x <= x1; ++x)
        {
          const int packet = y * PacketsAcross + x;
          if (!AddCrossings(this->In, rays[packet], MaskFromBits(0xff),
                GetBeginOfEdges(rays[packet]), entry, this->Buffers[packet],
                this->Crossings[packet]))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  const WalkMesh& Mesh;
  const PerspectiveView& View;
  KernelInput In;
  std::vector<PixelBounds> Bounds;
  std::vector<std::int32_t> BinBegins, Bins;
  PacketCrossings Crossings[PacketsOfTile];
  OwnedCrossings Buffers[PacketsOfTile];
};

/// The crossings of all pixels: distance and face, ascending in both.
class CrossingLists
{
public:
  void operator()(int x, int y, const PacketCrossings& crossings, const CrossingBuffer& buffer)
  {
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      auto& list = this->Lists[(y + lane / 4) * ImageSize + x + lane % 4];
      const Crossing* first = buffer.Crossings + static_cast<std::int64_t>(lane) * buffer.Capacity;
      for (int k = 0; k < crossings.Count[lane]; ++k)
      {
        list.emplace_back(first[k].Distance, first[k].Entry);
      }
      std::sort(list.begin(), list.end());
    }
  }

  std::vector<std::vector<std::pair<double, std::int32_t>>> Lists{ ImageSize * ImageSize };
};

void CompareOn(ComparisonMesh source)
{
  const WalkMesh mesh(std::move(source.Mesh));
  const PerspectiveView view(mesh.GetCenter(), mesh.GetRadius(), ImageSize);
  const KernelInput in = MakeInput(mesh, view.Grid);
  Rasterizer rasterizer(mesh, view);

  CrossingLists byHierarchy, byRaster;
  FindByHierarchy(in, byHierarchy);
  rasterizer.Find(byRaster);
  std::size_t different = 0;
  for (std::size_t i = 0; i < byRaster.Lists.size(); ++i)
  {
    different += byHierarchy.Lists[i] != byRaster.Lists[i];
  }

  std::size_t found = 0;
  const auto count = [&found](int, int, const PacketCrossings& crossings, const CrossingBuffer&)
  { found += std::accumulate(crossings.Count, crossings.Count + LaneCount, std::size_t(0)); };
  const double hierarchy = MeasureBest(Runs, [&] { FindByHierarchy(in, count); });
  const double raster = MeasureBest(Runs, [&] { rasterizer.Find(count); });
  std::printf("%-24s %9d %10zu %10zu %10.1f %10.1f\n", source.Name.c_str(),
    mesh.GetNumberOfBoundaryFaces(), found / (2 * Runs), different, 1e3 * hierarchy, 1e3 * raster);
  std::fflush(stdout);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

int main()
{
  using namespace tetralux;
  try
  {
    std::printf(
      "Boundary faces, crossings, pixels where the two differ, ms a frame of 512 x 512\n\n"
      "%-24s %9s %10s %10s %10s %10s\n",
      "", "faces", "crossings", "different", "hierarchy", "raster");
    for (ComparisonMesh& mesh : ReadBluntFin())
    {
      TETRALUX_ISA::CompareOn(std::move(mesh));
    }
    for (const double cells : { 34., 74. })
    {
      TETRALUX_ISA::CompareOn(MakeComparisonMesh("ball", { { "cells", cells } }));
    }
    using Parameters = std::map<std::string, double>;
    for (const Parameters& p : { Parameters{ { "around", 130 }, { "across", 12 } },
           Parameters{ { "around", 300 }, { "across", 26 } } })
    {
      TETRALUX_ISA::CompareOn(MakeComparisonMesh("ring", p));
    }
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
