// SPDX-License-Identifier: BSD-3-Clause
#include "PaperTraversal.h"

#include "Isosurface/IsopolygonExtraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr int MaximumRays = MaximumPacketEdge * MaximumPacketEdge;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// From the origin of the rays.
struct RelativePolygon
{
  Vector Edges[4]; ///< a ray's direction is inside where the products with all are 0 or more
  Vector Normal;
  double Height; ///< of the plane along the normal
};

RelativePolygon MakeRelativePolygon(const Isopolygon& polygon, const Vector& origin)
{
  Vector corners[4];
  for (int i = 0; i < 4; ++i)
  {
    corners[i] = { polygon.X[i] - origin[0], polygon.Y[i] - origin[1], polygon.Z[i] - origin[2] };
  }
  RelativePolygon result;
  result.Normal = { 0, 0, 0 };
  for (int i = 0; i < 4; ++i)
  {
    result.Edges[i] = Cross(corners[i], corners[(i + 1) % 4]);
    for (int a = 0; a < 3; ++a)
    {
      result.Normal[a] += result.Edges[i][a];
    }
  }
  result.Height = Dot(result.Normal, corners[0]);
  if (result.Height < 0)
  {
    for (Vector& edge : result.Edges)
    {
      edge = { -edge[0], -edge[1], -edge[2] };
    }
  }
  return result;
}

/// A picture's rays in the coordinates of the tree.
class PaperRays
{
public:
  PaperRays(const RayGrid& grid, const MeshFrame& frame)
  {
    for (int a = 0; a < 3; ++a)
    {
      if (grid.OriginStepX[a] != 0 || grid.OriginStepY[a] != 0)
      {
        throw std::invalid_argument("the paper's traversal needs rays of a common origin");
      }
      const double* row = grid.MeshFromWorld[a];
      const auto turn = [&](const double* v)
      { return (row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) / frame.Radius; };
      this->Origin[a] = turn(grid.Origin) + (row[3] - frame.Center[a]) / frame.Radius;
      this->Direction[a] = turn(grid.Direction);
      this->StepX[a] = turn(grid.DirectionStepX);
      this->StepY[a] = turn(grid.DirectionStepY);
    }
  }

  Vector GetDirection(int x, int y) const
  {
    Vector direction;
    for (int a = 0; a < 3; ++a)
    {
      direction[a] = this->Direction[a] + x * this->StepX[a] + y * this->StepY[a];
    }
    return direction;
  }

  Vector Origin;

private:
  Vector Direction, StepX, StepY;
};

class PaperPacket
{
public:
  PaperPacket(const MinMaxTree& tree, const MinMaxRanges& ranges, const IsopolygonSource& source,
    const PaperRays& rays, const PaperIdeas& ideas)
    : Tree(tree)
    , Ranges(ranges)
    , Source(source)
    , Rays(rays)
    , Ideas(ideas)
  {
    for (int v = 0; v < source.NumberOfValues; ++v)
    {
      this->Steps.push_back(ranges.GetStep(source.Values[v]));
    }
  }

  /// Traces the rays of some pixels.
  void Trace(int x0, int y0, int x1, int y1)
  {
    this->SetRays(x0, y0, x1, y1);
    ++this->Counts.Packets;
    if (!this->Tree.Nodes.empty() && this->Holds(0))
    {
      this->Traverse();
    }
    this->Counts.Hits += std::count_if(this->Far.begin(), this->Far.begin() + this->Size,
      [](double distance) { return distance < Infinity; });
  }

  PaperCounts Counts;

private:
  /// A node to visit, and the first ray that is active in it.
  struct Visit
  {
    std::int32_t Node;
    int First;
  };

  void SetRays(int x0, int y0, int x1, int y1)
  {
    this->Size = 0;
    for (int y = y0; y < y1; ++y)
    {
      for (int x = x0; x < x1; ++x)
      {
        const Vector direction = this->Rays.GetDirection(x, y);
        this->Directions[this->Size] = direction;
        this->Reciprocals[this->Size] = { 1 / direction[0], 1 / direction[1], 1 / direction[2] };
        this->Far[this->Size] = Infinity;
        ++this->Size;
      }
    }
    this->Farthest = Infinity;
    const int row = x1 - x0;
    this->Corners = { 0, row - 1, this->Size - row, this->Size - 1 };
    for (int a = 0; a < 3; ++a)
    {
      this->Least[a] = this->Largest[a] = this->Reciprocals[0][a];
      for (int i = 1; i < this->Size; ++i)
      {
        this->Least[a] = std::min(this->Least[a], this->Reciprocals[i][a]);
        this->Largest[a] = std::max(this->Largest[a], this->Reciprocals[i][a]);
      }
      // Where rays run both ways, no interval of reciprocals bounds them.
      this->Bounded[a] = std::isfinite(this->Least[a]) && std::isfinite(this->Largest[a]) &&
        (this->Least[a] > 0 || this->Largest[a] < 0);
    }
  }

  bool Holds(std::int32_t node)
  {
    ++this->Counts.NodeRangeTests;
    const MinMaxTree::Range range = this->Ranges.Nodes[node];
    return std::any_of(this->Steps.begin(), this->Steps.end(),
      [range](std::int32_t step) { return MinMaxRanges::Holds(range, step); });
  }

  bool Hits(const MinMaxTree::Node& node, int ray)
  {
    ++this->Counts.RayBoxTests;
    double near = 0;
    double far = this->Far[ray];
    for (int a = 0; a < 3; ++a)
    {
      const double t0 = (node.Lower[a] - this->Rays.Origin[a]) * this->Reciprocals[ray][a];
      const double t1 = (node.Upper[a] - this->Rays.Origin[a]) * this->Reciprocals[ray][a];
      const double low = t0 < t1 ? t0 : t1;
      const double high = t0 < t1 ? t1 : t0;
      // What is not a number, on a side of the box and along it, cuts nothing.
      near = low > near ? low : near;
      far = high < far ? high : far;
    }
    return near <= far;
  }

  /// Whether intervals show that each ray misses. They are of the numbers in Hits, rounded alike.
  bool FrustumMisses(const MinMaxTree::Node& node)
  {
    ++this->Counts.BoxFrustumTests;
    double near = 0;
    double far = this->Farthest;
    for (int a = 0; a < 3; ++a)
    {
      if (this->Bounded[a])
      {
        const bool forward = this->Least[a] > 0;
        const double entry = (forward ? node.Lower[a] : node.Upper[a]) - this->Rays.Origin[a];
        const double exit = (forward ? node.Upper[a] : node.Lower[a]) - this->Rays.Origin[a];
        near = std::max(near, std::min(entry * this->Least[a], entry * this->Largest[a]));
        far = std::min(far, std::max(exit * this->Least[a], exit * this->Largest[a]));
      }
    }
    const bool misses = near > far;
    this->Counts.BoxFrustumMisses += misses;
    return misses;
  }

  /// Tests II to IV: the first active ray below a node; Size: the packet misses it. Of a leaf III
  /// alone counts (V), unless it is off.
  int FindFirst(const MinMaxTree::Node& node, int first)
  {
    if (node.Count > 0 && this->Ideas.FrustumTest)
    {
      return this->FrustumMisses(node) ? this->Size : first;
    }
    if (this->Ideas.SpeculativeDescent && this->Hits(node, first))
    {
      return first;
    }
    if (this->Ideas.FrustumTest && this->FrustumMisses(node))
    {
      return this->Size;
    }
    const bool together = !this->Ideas.SpeculativeDescent && !this->Ideas.FirstActiveRay;
    int found = this->Size;
    for (int ray = first + (this->Ideas.SpeculativeDescent ? 1 : 0); ray < this->Size; ++ray)
    {
      if (this->Hits(node, ray) && found == this->Size)
      {
        found = ray;
        if (!together)
        {
          break;
        }
      }
    }
    return found < this->Size && !this->Ideas.FirstActiveRay ? first : found;
  }

  /// Whether the first child is nearer along a ray.
  bool IsFirstNearer(const MinMaxTree::Node& one, const MinMaxTree::Node& other, int ray) const
  {
    double along = 0;
    for (int a = 0; a < 3; ++a)
    {
      const double offset =
        (double{ other.Lower[a] } - one.Lower[a]) + (double{ other.Upper[a] } - one.Upper[a]);
      along += this->Directions[ray][a] * offset;
    }
    return along >= 0;
  }

  void Traverse()
  {
    std::array<Visit, MinMaxTree::MaximumDepth + 1> stack;
    int top = 0;
    stack[top++] = { 0, 0 };
    const std::vector<MinMaxTree::Node>& nodes = this->Tree.Nodes;
    while (top > 0)
    {
      Visit visit = stack[--top];
      const bool held = !this->Ideas.Bifurcations || this->Descend(visit.Node);
      const MinMaxTree::Node& node = nodes[visit.Node];
      const int first = held ? this->FindFirst(node, visit.First) : this->Size;
      if (first == this->Size)
      {
        continue;
      }
      if (node.Count > 0)
      {
        this->TestLeaf(node, first);
        continue;
      }
      std::int32_t children[2] = { visit.Node + 1, node.First };
      if (!this->IsFirstNearer(nodes[children[0]], nodes[children[1]], first))
      {
        std::swap(children[0], children[1]);
      }
      for (int c = 1; c >= 0; --c)
      {
        if (this->Ideas.Bifurcations || this->Holds(children[c]))
        {
          stack[top++] = { children[c], first };
        }
      }
    }
  }

  /// Idea I: goes down to a leaf, or to where both children hold a value. Returns whether there is
  /// such a node: a value may be between the ranges of both children.
  bool Descend(std::int32_t& id)
  {
    while (this->Tree.Nodes[id].Count == 0)
    {
      const bool one = this->Holds(id + 1);
      const bool other = this->Holds(this->Tree.Nodes[id].First);
      if (one == other)
      {
        return one;
      }
      id = one ? id + 1 : this->Tree.Nodes[id].First;
    }
    return true;
  }

  void TestLeaf(const MinMaxTree::Node& node, int first)
  {
    bool changed = false;
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      this->Counts.CellRangeTests += this->Ideas.CellRanges ? 1 : 0;
      bool any = false;
      TETRALUX_ISA::ForEachIsopolygon(this->Source, this->Tree.Cells[i],
        [&](const Isopolygon& polygon)
        {
          any = true;
          ++this->Counts.Extractions;
          changed |= this->TestPolygon(polygon, first);
        });
      this->Counts.Extractions += !any && !this->Ideas.CellRanges ? 1 : 0;
    }
    if (changed)
    {
      this->Farthest = *std::max_element(this->Far.begin(), this->Far.begin() + this->Size);
    }
  }

  /// Returns whether a ray hits the polygon before what it hit.
  bool TestPolygon(const Isopolygon& polygon, int first)
  {
    const RelativePolygon relative = MakeRelativePolygon(polygon, this->Rays.Origin);
    if (this->Ideas.FrustumTest && this->FrustumMisses(relative))
    {
      return false;
    }
    bool any = false;
    for (int ray = first; ray < this->Size; ++ray)
    {
      ++this->Counts.RayPolygonTests;
      const Vector& direction = this->Directions[ray];
      const double distance = relative.Height / Dot(relative.Normal, direction);
      const bool hit = distance > 0 && distance < this->Far[ray] &&
        std::all_of(std::begin(relative.Edges), std::end(relative.Edges),
          [&](const Vector& edge) { return Dot(edge, direction) >= 0; });
      this->Far[ray] = hit ? distance : this->Far[ray];
      any |= hit;
    }
    return any;
  }

  bool FrustumMisses(const RelativePolygon& polygon)
  {
    ++this->Counts.PolygonFrustumTests;
    const bool misses = std::any_of(std::begin(polygon.Edges), std::end(polygon.Edges),
      [this](const Vector& edge)
      {
        return std::all_of(this->Corners.begin(), this->Corners.end(),
          [&](int corner) { return Dot(edge, this->Directions[corner]) < 0; });
      });
    this->Counts.PolygonFrustumMisses += misses;
    return misses;
  }

  const MinMaxTree& Tree;
  const MinMaxRanges& Ranges;
  const IsopolygonSource& Source;
  const PaperRays& Rays;
  const PaperIdeas Ideas;
  std::vector<std::int32_t> Steps; ///< of the values

  int Size = 0;
  std::array<Vector, MaximumRays> Directions, Reciprocals;
  std::array<double, MaximumRays> Far; ///< distance of the nearest hit, in lengths of the direction
  double Farthest = Infinity;          ///< of them all
  std::array<int, 4> Corners{};        ///< the outermost rays
  Vector Least{}, Largest{};           ///< of the reciprocals
  std::array<bool, 3> Bounded{};
};

} // namespace

void PaperCounts::Add(const PaperCounts& other)
{
  this->Packets += other.Packets;
  this->NodeRangeTests += other.NodeRangeTests;
  this->CellRangeTests += other.CellRangeTests;
  this->RayBoxTests += other.RayBoxTests;
  this->BoxFrustumTests += other.BoxFrustumTests;
  this->BoxFrustumMisses += other.BoxFrustumMisses;
  this->Extractions += other.Extractions;
  this->PolygonFrustumTests += other.PolygonFrustumTests;
  this->PolygonFrustumMisses += other.PolygonFrustumMisses;
  this->RayPolygonTests += other.RayPolygonTests;
  this->Hits += other.Hits;
}

PaperCounts TraceAsPaper(const MinMaxTree& tree, const MinMaxRanges& ranges,
  const IsopolygonSource& source, const RayGrid& grid, int packetEdge, const PaperIdeas& ideas)
{
  const PaperRays rays(grid, source.Frame);
  PaperCounts counts;
#pragma omp parallel
  {
    PaperPacket packet(tree, ranges, source, rays, ideas);
#pragma omp for schedule(dynamic)
    for (int y = 0; y < grid.Height; y += packetEdge)
    {
      for (int x = 0; x < grid.Width; x += packetEdge)
      {
        packet.Trace(
          x, y, std::min(x + packetEdge, grid.Width), std::min(y + packetEdge, grid.Height));
      }
    }
#pragma omp critical
    counts.Add(packet.Counts);
  }
  return counts;
}

} // namespace tetralux
