// SPDX-License-Identifier: BSD-3-Clause
#ifndef TreePackets_h
#define TreePackets_h

// Packets of rays that go through the min/max tree, clip rays to cells, and are measured by turns:
// what TreeMaximum.cxx and TreeSkipping.cxx share. Pictures of 512 x 512, two threads, median
// milliseconds of frames by the clock and by the processor, where waiting threads should sleep
// (OMP_WAIT_POLICY=passive).

#include "Base/ParallelTiles.h"
#include "Base/Stopwatch.h"
#include "ComparisonMeshes.h"
#include "Hierarchy/MinMaxTree.h"
#include "Isosurface/FrustumTraversal.h"
#include "RayCast/RayCaster.h"
#include "Walk/WalkMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

constexpr int ImageSize = 512;
constexpr int Threads = 2;
constexpr int Runs = 7;

/// Pixels by which a cell's bounds in the picture are grown: a hundred times what single precision
/// rounds a pixel's coordinates by (2^-15 at most).
constexpr float BoundsMargin = 0.003f;

/// A face whose plane passes the eye nearer than this, in heights of the cell, counts as this near:
/// keys on it stay numbers.
constexpr double LeastEyeDistance = 1e-12;

/// A point in the frame of the rays.
struct FramePoint
{
  double X, Y, Depth, Scalar;
};

/// A point's pixel.
struct Pixel
{
  float U, V;
};

/// What is looked for and counted in a frame; one a thread, on cache lines of its own.
struct alignas(64) Counts
{
  std::int64_t Nodes = 0;  ///< tested against a frustum
  std::int64_t Leaves = 0; ///< that were visited
  std::int64_t Cells = 0;  ///< that rays were clipped to
  std::int64_t Hits = 0;   ///< rays in cells
};

/// A mesh, its tree, and a view of both.
class Subject
{
public:
  explicit Subject(ComparisonMesh source)
    : Name(std::move(source.Name))
    , Walk(std::make_shared<WalkMesh>(std::move(source.Mesh)))
    , Scalars(MapScalars(this->Walk->GetMesh(), source.Scalars))
    , View(this->Walk->GetCenter(), this->Walk->GetRadius(), ImageSize)
    , Tree(BuildMinMaxTree(
        this->Walk->GetMesh(), this->Walk->GetCenter(), this->Walk->GetRadius(), {}))
    , Ranges(MakeMinMaxRanges(this->Tree, this->Walk->GetMesh(), this->Scalars, 0))
  {
    MeshFrame mesh;
    std::copy_n(this->Walk->GetCenter(), 3, mesh.Center);
    mesh.Radius = this->Walk->GetRadius();
    this->Frame = MakeRayFrame(this->View.Grid, mesh);
    this->Scene.Mesh.SetMesh(this->Walk);
    this->Scene.Mesh.SetPointScalars(this->Scalars);
    this->Points.resize(this->Scalars.size());
    this->Pixels.resize(this->Scalars.size());
    const std::vector<std::int32_t>& ids = this->Walk->GetMesh().Cells;
    for (const std::int32_t cell : this->Tree.Cells)
    {
      const auto first = ids.begin() + 4 * static_cast<std::ptrdiff_t>(cell);
      this->LeafCells.insert(this->LeafCells.end(), first, first + 4);
    }
  }

  /// Brings the points into the frame of the rays: a part of each frame by the tree.
  void ProjectPoints()
  {
    const std::vector<double>& points = this->Walk->GetMesh().Points;
    const double* center = this->Walk->GetCenter();
    const double scale = 1 / this->Walk->GetRadius();
    const auto n = static_cast<std::int64_t>(this->Points.size());
#pragma omp parallel for num_threads(Threads)
    for (std::int64_t p = 0; p < n; ++p)
    {
      double x[3], q[3];
      for (int a = 0; a < 3; ++a)
      {
        x[a] = (points[3 * p + a] - center[a]) * scale;
      }
      Transform(this->Frame, x, q);
      this->Points[p] = { q[0], q[1], q[2], this->Scalars[p] };
      this->Pixels[p] = { static_cast<float>(q[0] / q[2]), static_cast<float>(q[1] / q[2]) };
    }
  }

  RayCastStatistics Cast(Precision arithmetic = Precision::Single)
  {
    RayCastOptions options;
    options.MaximumError = 1e-9; // rays end where they leave
    options.Arithmetic = arithmetic;
    options.NumberOfThreads = Threads;
    return CastRays(this->Scene, this->View.Grid, {}, options, this->Colors, this->Depths);
  }

  std::string Name;
  std::shared_ptr<WalkMesh> Walk;
  std::vector<double> Scalars;
  PerspectiveView View;
  MinMaxTree Tree;
  MinMaxRanges Ranges;
  RayFrame Frame;
  VolumeScene Scene;
  std::vector<std::int32_t> LeafCells; ///< point ids of cells in the order of the leaves
  std::vector<FramePoint> Points;
  std::vector<Pixel> Pixels;
  std::vector<float> Colors = std::vector<float>(4 * ImageSize * ImageSize);
  std::vector<float> Depths = std::vector<float>(ImageSize * ImageSize);
};

/// A function of u and v, from the middle of a packet on.
struct Linear
{
  float Constant, U, V;

  TETRALUX_INLINE Float8 operator()(Float8 u, Float8 v) const
  {
    return Fma(Float8(this->U), u, Fma(Float8(this->V), v, Float8(this->Constant)));
  }
};

/// A cell as the rays of a packet see it. In barycentric coordinates each face is a plane, on which
/// the key is linear in u and v; all rays come from the eye, so that they enter by the same faces.
/// Keys are relative to that of the cell's middle.
class PlacedCell
{
public:
  /// u0, v0: the middle of the packet.
  TETRALUX_INLINE PlacedCell(const FramePoint* const (&points)[4], double u0, double v0)
  {
    double p[4][3];
    for (int i = 0; i < 4; ++i)
    {
      const FramePoint& q = *points[i];
      p[i][0] = q.X - u0 * q.Depth;
      p[i][1] = q.Y - v0 * q.Depth;
      p[i][2] = q.Depth;
    }
    double e[3][3];
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        e[i][a] = p[i + 1][a] - p[0][a];
      }
    }
    double gradients[4][3];
    Cross(e[1], e[2], gradients[1]);
    Cross(e[2], e[0], gradients[2]);
    Cross(e[0], e[1], gradients[3]);
    const double volume = Dot(e[0], gradients[1]);
    this->Empty = volume == 0;
    const double scale = 1 / volume;
    double slope[3] = { 0, 0, 0 };
    double eye[4] = { 1, 0, 0, 0 };
    for (int a = 0; a < 3; ++a)
    {
      for (int i = 1; i < 4; ++i)
      {
        gradients[i][a] *= scale;
        slope[a] += (points[i]->Scalar - points[0]->Scalar) * gradients[i][a];
      }
      gradients[0][a] = -(gradients[1][a] + gradients[2][a] + gradients[3][a]);
    }
    for (int i = 1; i < 4; ++i)
    {
      eye[i] = -Dot(gradients[i], p[0]);
      eye[0] -= eye[i];
    }
    const double key = 4 / (p[0][2] + p[1][2] + p[2][2] + p[3][2]);
    this->Key = static_cast<float>(key);
    for (int i = 0; i < 4; ++i)
    {
      this->Back[i] = eye[i] > 0;
      const double distance = std::max(std::fabs(eye[i]), LeastEyeDistance);
      const double factor = this->Back[i] ? -1 / distance : 1 / distance;
      this->Faces[i] = { static_cast<float>(gradients[i][2] * factor - key),
        static_cast<float>(gradients[i][0] * factor),
        static_cast<float>(gradients[i][1] * factor) };
    }
    const double depth = 1 / key;
    const double atEye = points[0]->Scalar - Dot(slope, p[0]);
    this->Along = { static_cast<float>(slope[2] * depth), static_cast<float>(slope[0] * depth),
      static_cast<float>(slope[1] * depth) };
    this->Middle = { static_cast<float>(atEye + slope[2] * depth), this->Along.U, this->Along.V };
  }

  /// Which rays go through the cell, and the keys where.
  TETRALUX_INLINE Mask8 Clip(Float8 u, Float8 v, Float8& far, Float8& near) const
  {
    constexpr float Infinity = std::numeric_limits<float>::infinity();
    far = -Infinity;
    near = Infinity;
    for (int i = 0; i < 4; ++i)
    {
      const Float8 key = this->Faces[i](u, v);
      if (this->Back[i])
      {
        far = Max(key, far);
      }
      else
      {
        near = Min(key, near);
      }
    }
    return far < near;
  }

  /// The larger of the scalars at both ends.
  TETRALUX_INLINE Float8 GetLarger(Float8 u, Float8 v, Float8 far, Float8 near) const
  {
    return this->GetScalar(u, v, Select(Float8(0.f) < this->Along(u, v), far, near));
  }

  TETRALUX_INLINE Float8 GetScalar(Float8 u, Float8 v, Float8 key) const
  {
    return this->Middle(u, v) - this->Along(u, v) * (key / this->GetKey(key));
  }

  /// The key that is not relative to the cell's.
  TETRALUX_INLINE Float8 GetKey(Float8 key) const { return key + Float8(this->Key); }

  bool Empty;

private:
  static TETRALUX_INLINE void Cross(const double* a, const double* b, double* result)
  {
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
  }
  static TETRALUX_INLINE double Dot(const double* a, const double* b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  Linear Faces[4];
  bool Back[4]; ///< whether rays leave by the face
  Linear Along, Middle;
  float Key;
};

enum class Order
{
  Nearer,
  Larger
};

/// The chunks of a packet of Edge x Edge pixels that a cell may touch.
struct ChunkBounds
{
  int X0, Y0, X1, Y1; ///< both ends included
  bool IsEmpty() const { return this->X0 > this->X1 || this->Y0 > this->Y1; }
};

/// A packet of primary rays.
template <int Edge>
class Packet
{
public:
  static constexpr int Columns = Edge / RayPacket::ChunkWidth;
  static constexpr int Rows = Edge / RayPacket::ChunkHeight;

  Packet(const Subject& subject, const Tile& tile, Counts& counts)
    : Mesh(subject)
    , Cells(subject.LeafCells.data())
    , X(tile.X0)
    , Y(tile.Y0)
    , Frustum(subject.Frame, MakeBounds(tile), this->None)
    , Counted(counts)
  {
    std::fill_n(this->Largest, Edge * Edge, -std::numeric_limits<float>::infinity());
    std::fill_n(this->ChunkLeast, Columns * Rows, -std::numeric_limits<float>::infinity());
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      this->LaneU[lane] =
        static_cast<float>(lane % RayPacket::ChunkWidth) - 0.5f * static_cast<float>(Edge - 1);
      this->LaneV[lane] =
        static_cast<float>(lane / RayPacket::ChunkWidth) - 0.5f * static_cast<float>(Edge - 1);
    }
  }

  /// Calls visit(node) with the leaves that the packet's frustum touches; those of nodes that
  /// isSkipped(id) holds for at the time are left out.
  template <class IsSkipped, class Visit>
  TETRALUX_INLINE void Walk(Order order, const IsSkipped& isSkipped, const Visit& visit)
  {
    std::int32_t stack[MinMaxTree::MaximumDepth + 1];
    int depth = 0;
    float nearness[2];
    if (isSkipped(0) || this->Misses(0, nearness[0]))
    {
      return;
    }
    stack[depth++] = 0;
    while (depth > 0)
    {
      const std::int32_t id = stack[--depth];
      if (isSkipped(id))
      {
        continue;
      }
      const MinMaxTree::Node& node = this->Mesh.Tree.Nodes[id];
      if (node.Count > 0)
      {
        ++this->Counted.Leaves;
        visit(node);
        continue;
      }
      const std::int32_t children[2] = { id + 1, node.First };
      bool hits[2];
      for (int i = 0; i < 2; ++i)
      {
        hits[i] = !isSkipped(children[i]) && !this->Misses(children[i], nearness[i]);
      }
      int first = 0;
      if (hits[0] && hits[1])
      {
        const std::vector<MinMaxTree::Range>& ranges = this->Mesh.Ranges.Nodes;
        first = order == Order::Nearer ? nearness[1] > nearness[0]
                                       : ranges[children[1]].Largest > ranges[children[0]].Largest;
      }
      // What is pushed last comes first.
      for (const int i : { 1 - first, first })
      {
        if (hits[i])
        {
          stack[depth++] = children[i];
        }
      }
    }
  }

  /// Finds the largest scalar along each ray.
  void FindLargest(Order order)
  {
    this->Walk(
      order,
      [this](std::int32_t id) { return this->Mesh.Ranges.Nodes[id].Largest < this->LeastStep; },
      [this](const MinMaxTree::Node& node)
      {
        bool changed = false;
        for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
        {
          changed |= this->Raise(i);
        }
        if (changed)
        {
          this->UpdateLeast();
        }
      });
  }

  /// Calls function(chunk, u, v, far, near, hits, cell) where rays of a chunk go through a cell.
  /// place: of the cell in the order of the leaves.
  /// isSkipped(chunk): chunks to leave out.
  template <class IsSkipped, class Function>
  TETRALUX_INLINE void ClipTo(
    std::int32_t place, const IsSkipped& isSkipped, const Function& function)
  {
    const std::int32_t* ids = this->Cells + 4 * static_cast<std::size_t>(place);
    const ChunkBounds bounds = this->GetBounds(ids);
    if (bounds.IsEmpty())
    {
      return;
    }
    bool any = false;
    for (int y = bounds.Y0; y <= bounds.Y1; ++y)
    {
      for (int x = bounds.X0; x <= bounds.X1; ++x)
      {
        any |= !isSkipped(y * Columns + x);
      }
    }
    if (!any)
    {
      return;
    }
    ++this->Counted.Cells;
    const FramePoint* const points[4] = { &this->Mesh.Points[ids[0]], &this->Mesh.Points[ids[1]],
      &this->Mesh.Points[ids[2]], &this->Mesh.Points[ids[3]] };
    constexpr double Half = 0.5 * (Edge - 1);
    const PlacedCell cell(points, this->X + Half, this->Y + Half);
    if (cell.Empty)
    {
      return;
    }
    for (int y = bounds.Y0; y <= bounds.Y1; ++y)
    {
      for (int x = bounds.X0; x <= bounds.X1; ++x)
      {
        const int chunk = y * Columns + x;
        if (isSkipped(chunk))
        {
          continue;
        }
        const Float8 u =
          LoadFloat8(this->LaneU) + Float8(static_cast<float>(x * RayPacket::ChunkWidth));
        const Float8 v =
          LoadFloat8(this->LaneV) + Float8(static_cast<float>(y * RayPacket::ChunkHeight));
        Float8 far, near;
        const Mask8 hits = cell.Clip(u, v, far, near);
        if (Any(hits))
        {
          this->Counted.Hits += __builtin_popcount(Bits(hits));
          function(chunk, u, v, far, near, hits, cell);
        }
      }
    }
  }

  void Write(std::vector<float>& picture) const
  {
    for (int i = 0; i < Edge * Edge; ++i)
    {
      picture[this->GetPixel(i)] = std::max(0.f, this->Largest[i]);
    }
  }

private:
  static RayPacket MakeBounds(const Tile& tile)
  {
    RayPacket packet;
    packet.LowU = tile.X0;
    packet.HighU = tile.X1 - 1;
    packet.LowV = tile.Y0;
    packet.HighV = tile.Y1 - 1;
    return packet;
  }

  TETRALUX_INLINE bool Misses(std::int32_t id, float& nearness)
  {
    ++this->Counted.Nodes;
    return this->Frustum.Misses(this->Mesh.Tree.Nodes[id], nearness);
  }

  TETRALUX_INLINE ChunkBounds GetBounds(const std::int32_t* ids) const
  {
    float lowU = this->Mesh.Pixels[ids[0]].U, highU = lowU;
    float lowV = this->Mesh.Pixels[ids[0]].V, highV = lowV;
    for (int i = 1; i < 4; ++i)
    {
      const Pixel& pixel = this->Mesh.Pixels[ids[i]];
      lowU = std::min(lowU, pixel.U);
      highU = std::max(highU, pixel.U);
      lowV = std::min(lowV, pixel.V);
      highV = std::max(highV, pixel.V);
    }
    const auto first = [](float low, int origin)
    {
      const float from = low - BoundsMargin - static_cast<float>(origin);
      return std::max(static_cast<int>(std::ceil(from)), 0);
    };
    const auto last = [](float high, int origin)
    {
      const float to = high + BoundsMargin - static_cast<float>(origin);
      return std::min(static_cast<int>(std::floor(to)), Edge - 1);
    };
    const int x0 = first(lowU, this->X), x1 = last(highU, this->X);
    const int y0 = first(lowV, this->Y), y1 = last(highV, this->Y);
    if (x0 > x1 || y0 > y1) // most cells of a fine mesh lie between the pixels
    {
      return { 0, 0, -1, -1 };
    }
    return { x0 / RayPacket::ChunkWidth, y0 / RayPacket::ChunkHeight, x1 / RayPacket::ChunkWidth,
      y1 / RayPacket::ChunkHeight };
  }

  /// Where a ray's pixel is in a picture.
  int GetPixel(int ray) const
  {
    const int chunk = ray / LaneCount;
    const int lane = ray % LaneCount;
    const int x = chunk % Columns * RayPacket::ChunkWidth + lane % RayPacket::ChunkWidth;
    const int y = chunk / Columns * RayPacket::ChunkHeight + lane / RayPacket::ChunkWidth;
    return (this->Y + y) * ImageSize + this->X + x;
  }

  TETRALUX_INLINE void UpdateLeast()
  {
    this->Least = *std::min_element(this->ChunkLeast, this->ChunkLeast + Columns * Rows);
    this->LeastStep = this->Mesh.Ranges.GetStep(this->Least);
  }

  static TETRALUX_INLINE float GetLeast(const float* lanes)
  {
    float least = lanes[0];
#pragma omp simd reduction(min : least)
    for (int i = 0; i < LaneCount; ++i)
    {
      least = lanes[i] < least ? lanes[i] : least;
    }
    return least;
  }

  /// Whether a chunk's least maximum may have changed.
  TETRALUX_INLINE bool Raise(std::int32_t place)
  {
    const std::int32_t* ids = this->Cells + 4 * static_cast<std::size_t>(place);
    const auto scalar = [&](int i) { return this->Mesh.Points[ids[i]].Scalar; };
    const auto most =
      static_cast<float>(std::max(std::max(scalar(0), scalar(1)), std::max(scalar(2), scalar(3))));
    if (most <= this->Least)
    {
      return false;
    }
    bool changed = false;
    this->ClipTo(
      place, [&](int chunk) { return most <= this->ChunkLeast[chunk]; },
      [&](
        int chunk, Float8 u, Float8 v, Float8 far, Float8 near, Mask8 hits, const PlacedCell& cell)
      {
        float* largest = this->Largest + chunk * LaneCount;
        const Float8 before = LoadFloat8(largest);
        const Float8 found = Min(cell.GetLarger(u, v, far, near), Float8(most));
        const Mask8 larger = hits & (before < found);
        if (!Any(larger))
        {
          return;
        }
        Store(largest, Select(larger, found, before));
        this->ChunkLeast[chunk] = GetLeast(largest);
        changed = true;
      });
    return changed;
  }

  const Subject& Mesh;
  const std::int32_t* Cells;
  int X, Y;
  TraceLimits None;
  PacketFrustum Frustum;
  Counts& Counted;
  float Least = -std::numeric_limits<float>::infinity(); ///< of the rays' present maxima
  std::int32_t LeastStep = -1;                           ///< MinMaxRanges::GetStep of Least
  alignas(32) float Largest[Edge * Edge];
  float ChunkLeast[Columns * Rows];
  alignas(32) float LaneU[LaneCount], LaneV[LaneCount];
};

/// Calls function(packet, tile) for each packet of the picture.
template <int Edge, class Function>
Counts ForEachPacket(const Subject& subject, const Function& function)
{
  Counts counts[Threads];
  ForEachTile(TileGrid{ ImageSize, ImageSize, Edge }, Threads, {},
    [&](const Tile& tile, int thread)
    {
      Packet<Edge> packet(subject, tile, counts[thread]);
      function(packet);
    });
  Counts all;
  for (const Counts& one : counts)
  {
    all.Nodes += one.Nodes;
    all.Leaves += one.Leaves;
    all.Cells += one.Cells;
    all.Hits += one.Hits;
  }
  return all;
}

/// Medians, in milliseconds.
struct Times
{
  double Wall;
  double Processor; ///< of all threads
};

double GetMedian(std::vector<double>& times)
{
  std::nth_element(times.begin(), times.begin() + Runs / 2, times.end());
  return 1e3 * times[Runs / 2];
}

/// Runs all ways by turns.
std::vector<Times> MeasureByTurns(const std::vector<std::function<void()>>& ways)
{
  std::vector<std::vector<double>> wall(ways.size()), processor(ways.size());
  for (int run = 0; run < Runs; ++run)
  {
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
      const Stopwatch watch;
      const double begin = GetProcessorTime();
      ways[i]();
      processor[i].push_back(GetProcessorTime() - begin);
      wall[i].push_back(watch.GetSeconds());
    }
  }
  std::vector<Times> times;
  for (std::size_t i = 0; i < ways.size(); ++i)
  {
    times.push_back({ GetMedian(wall[i]), GetMedian(processor[i]) });
  }
  return times;
}

std::vector<std::unique_ptr<Subject>> MakeSubjects()
{
  std::vector<ComparisonMesh> meshes = ReadBluntFin();
  meshes.push_back(MakeComparisonMesh("ball", { { "cells", 34 } }));
  meshes.push_back(MakeComparisonMesh("ball", { { "cells", 74 } }));
  meshes.push_back(MakeComparisonMesh("ring", { { "around", 300 }, { "across", 26 } }));
  std::vector<std::unique_ptr<Subject>> subjects;
  for (ComparisonMesh& mesh : meshes)
  {
    subjects.push_back(std::make_unique<Subject>(std::move(mesh)));
  }
  return subjects;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
