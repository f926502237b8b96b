// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/MeshRays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

/// A point as a line sees it: x and y across, z along it.
struct Corner
{
  double X, Y, Z, S;
  std::int32_t Id;
};

double Det(const Corner& a, const Corner& b) { return a.X * b.Y - a.Y * b.X; }

/// std::hypot, which takes longer than all else of a step.
double MeasureLength(double x, double y)
{
  // Squares of what is in here are normal numbers, or a share of 2^-52 of the other one.
  constexpr double Smallest = 1e-140;
  constexpr double Largest = 1e140;
  const double largest = std::max(std::abs(x), std::abs(y));
  return Smallest < largest && largest < Largest ? std::sqrt(x * x + y * y) : std::hypot(x, y);
}

/// The walk of RayCastKernel.inl for one line: by the sides on which it passes the edges. Nothing
/// is done about lines exactly through edges, which are not drawn at random.
class MeshLine
{
public:
  /// point and direction, of length 1, as the tables of the mesh have them.
  MeshLine(const WalkMesh& mesh, Span<const double> scalars, bool ofCells, const Vector& point,
    const Vector& direction)
    : Mesh(mesh)
    , Points(mesh.GetPoints<float>())
    , Scalars(scalars)
    , ScalarsOfCells(ofCells)
    , Origin(point)
    , Along(direction)
  {
    // Any two directions across: of Duff et al., Building an orthonormal basis, revisited (2017).
    const Vector& n = direction;
    const double sign = std::copysign(1., n[2]);
    const double a = -1 / (sign + n[2]);
    const double b = n[0] * n[1] * a;
    this->AcrossX = { 1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0] };
    this->AcrossY = { b, sign + n[1] * n[1] * a, -n[1] };
  }

  /// The segments of all cells that the line goes through; lengths times scale.
  /// density: how likely it is drawn through a place in one of the cells, in any unit.
  std::vector<RaySegment> Walk(double scale, double& density) const
  {
    std::vector<RaySegment> segments;
    density = 0;
    std::vector<Crossing> crossings = this->FindCrossings();
    for (std::size_t k = 0; k < crossings.size(); ++k)
    {
      if (crossings[k].Entry < 0)
      {
        continue;
      }
      const std::int32_t exit = this->WalkFrom(crossings[k].Entry, scale, segments, density);
      for (std::size_t i = k + 1; i < crossings.size(); ++i)
      {
        crossings[i].Entry = crossings[i].Entry == exit ? -1 : crossings[i].Entry;
      }
    }
    return segments;
  }

private:
  /// Where the line crosses the boundary.
  struct Crossing
  {
    double Distance;
    std::int32_t Entry; ///< -1 where it leaves
  };

  /// A triangle that the line goes through: where, the scalar there, and the tangent of the angle
  /// between the line and its normal.
  struct Place
  {
    double Z, S, Slope;
  };

  Corner See(std::int32_t id) const
  {
    const WalkPoint<float>& p = this->Points[id];
    const Vector d = { p.X - this->Origin[0], p.Y - this->Origin[1], p.Z - this->Origin[2] };
    const auto dot = [&d](const Vector& v) { return d[0] * v[0] + d[1] * v[1] + d[2] * v[2]; };
    return { dot(this->AcrossX), dot(this->AcrossY), dot(this->Along),
      this->ScalarsOfCells ? 0 : this->Scalars[id], id };
  }

  static Place Interpolate(const Corner& a, const Corner& b, const Corner& c)
  {
    const double wa = Det(b, c), wb = Det(c, a), wc = Det(a, b);
    const double sum = wa + wb + wc;
    // The normal is (x, y, sum), as long as the triangle is large.
    const double x = (b.Y - a.Y) * (c.Z - a.Z) - (b.Z - a.Z) * (c.Y - a.Y);
    const double y = (b.Z - a.Z) * (c.X - a.X) - (b.X - a.X) * (c.Z - a.Z);
    return { (wa * a.Z + wb * b.Z + wc * c.Z) / sum, (wa * a.S + wb * b.S + wc * c.S) / sum,
      MeasureLength(x, y) / std::abs(sum) };
  }

  /// Of the cell of four corners: its volume times six, and how the scalar changes across the line.
  struct CellShape
  {
    double Volume, Gradient;
  };

  static CellShape FindShape(const Corner& a, const Corner& b, const Corner& c, const Corner& d)
  {
    const Corner e[3] = { { b.X - a.X, b.Y - a.Y, b.Z - a.Z, b.S - a.S, 0 },
      { c.X - a.X, c.Y - a.Y, c.Z - a.Z, c.S - a.S, 0 },
      { d.X - a.X, d.Y - a.Y, d.Z - a.Z, d.S - a.S, 0 } };
    double x = 0, y = 0, volume = 0;
    for (int i = 0; i < 3; ++i)
    {
      const Corner& p = e[(i + 1) % 3];
      const Corner& q = e[(i + 2) % 3];
      x += e[i].S * (p.Y * q.Z - p.Z * q.Y);
      y += e[i].S * (p.Z * q.X - p.X * q.Z);
      volume += e[i].Z * Det(p, q);
    }
    const double gradient = MeasureLength(x, y) / std::abs(volume);
    return { std::abs(volume), std::isfinite(gradient) ? gradient : 0 };
  }

  static bool IsInside(const Corner& a, const Corner& b, const Corner& c)
  {
    const bool side = Det(a, b) > 0;
    return (Det(b, c) > 0) == side && (Det(c, a) > 0) == side;
  }

  std::vector<Crossing> FindCrossings() const
  {
    std::vector<Crossing> crossings;
    const BoundaryBvh& bvh = this->Mesh.GetBvh();
    std::vector<std::int32_t> stack(bvh.Nodes.empty() ? 0 : 1, 0);
    while (!stack.empty())
    {
      const std::int32_t nodeId = stack.back();
      stack.pop_back();
      const BoundaryBvh::Node& node = bvh.Nodes[nodeId];
      // The shadow of the box across the line.
      double x = 0, y = 0, halfX = 0, halfY = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double d = node.Center[axis] - this->Origin[axis];
        x += this->AcrossX[axis] * d;
        y += this->AcrossY[axis] * d;
        halfX += std::abs(this->AcrossX[axis]) * node.Half[axis];
        halfY += std::abs(this->AcrossY[axis]) * node.Half[axis];
      }
      if (std::abs(x) > halfX || std::abs(y) > halfY)
      {
        continue;
      }
      if (node.Count == 0)
      {
        stack.push_back(node.First);
        stack.push_back(nodeId + 1);
      }
      for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
      {
        const std::int32_t entry = bvh.Triangles[i];
        const std::int32_t* points = this->Mesh.GetEntries()[entry].Points;
        const Corner a = this->See(points[0]), b = this->See(points[1]), c = this->See(points[2]);
        if (IsInside(a, b, c))
        {
          crossings.push_back({ Interpolate(a, b, c).Z, entry });
        }
      }
    }
    std::sort(crossings.begin(), crossings.end(),
      [](const Crossing& a, const Crossing& b) { return a.Distance < b.Distance; });
    return crossings;
  }

  /// From an entry to where the line leaves the mesh: which boundary face that is.
  std::int32_t WalkFrom(
    std::int32_t entryId, double scale, std::vector<RaySegment>& segments, double& density) const
  {
    const WalkEntry& entry = this->Mesh.GetEntries()[entryId];
    Corner a = this->See(entry.Points[0]), b = this->See(entry.Points[1]),
           c = this->See(entry.Points[2]);
    if (Det(a, b) < 0)
    {
      std::swap(b, c); // counter-clockwise from here on
    }
    Place place = Interpolate(a, b, c);
    bool first = true;
    WalkFace behind = { entry.Cell, entry.Opposite };
    // No walk visits a cell twice.
    for (std::int32_t steps = this->Mesh.GetNumberOfCells(); behind.Cell >= 0 && steps > 0; --steps)
    {
      const Corner p = this->See(behind.Point);
      const bool aSide = Det(p, a) > 0, bSide = Det(p, b) > 0, cSide = Det(p, c) > 0;
      // The exit face is opposite to the corner that p replaces.
      Corner& replaced = bSide && !cSide ? a : cSide && !aSide ? b : c;
      const std::int32_t dropped = replaced.Id;
      const CellShape shape = FindShape(a, b, c, p);
      replaced = p;
      const int face = (dropped > a.Id) + (dropped > b.Id) + (dropped > c.Id);
      const std::int32_t cell = behind.Cell;
      behind = this->Mesh.GetFaces()[4 * static_cast<std::size_t>(cell) + face];

      const Place next = Interpolate(a, b, c);
      const double length = scale * std::abs(next.Z - place.Z); // also of inverted cells
      const double front = this->ScalarsOfCells ? this->Scalars[cell] : place.S;
      const double back = this->ScalarsOfCells ? this->Scalars[cell] : next.S;
      if (length > 0 && std::isfinite(front) && std::isfinite(back))
      {
        segments.push_back(
          { front, back, length, shape.Gradient, place.Slope, next.Slope, first, behind.Cell < 0 });
      }
      if (shape.Volume > 0)
      {
        density += std::abs(next.Z - place.Z) / shape.Volume;
      }
      place = next;
      first = false;
    }
    return ~behind.Cell;
  }

  const WalkMesh& Mesh;
  const WalkPoint<float>* Points;
  Span<const double> Scalars;
  bool ScalarsOfCells;
  Vector Origin, Along, AcrossX, AcrossY;
};

// As many as are integrated in some 30 milliseconds of one thread.
constexpr std::size_t EnoughSegments = 100000;
constexpr std::size_t FewestRays = 64;
constexpr std::size_t MostRays = 1024;

} // namespace

RaySample DrawMeshRays(const WalkMesh& mesh, Span<const double> scalars, double scale, bool ofCells)
{
  RaySample sample;
  const std::int32_t numberOfCells = mesh.GetNumberOfCells();
  if (numberOfCells == 0)
  {
    return sample;
  }
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<std::int32_t> anyCell(0, numberOfCells - 1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal(0, 1);
  const auto draw = [&]() -> std::pair<Vector, Vector>
  {
    // Anywhere in a cell: exponentially distributed weights of its corners are evenly distributed.
    const std::int32_t* corners =
      &mesh.GetMesh().Cells[4 * static_cast<std::size_t>(anyCell(generator))];
    Vector point{}, direction{};
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const WalkPoint<float>& p = mesh.GetPoints<float>()[corners[corner]];
      const double weight = -std::log(1 - unit(generator));
      point = { point[0] + weight * p.X, point[1] + weight * p.Y, point[2] + weight * p.Z };
      sum += weight;
    }
    double length = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] /= sum;
      direction[axis] = normal(generator);
      length = std::hypot(length, direction[axis]);
    }
    return { point, { direction[0] / length, direction[1] / length, direction[2] / length } };
  };
  const auto walk = [&](std::size_t count)
  {
    std::vector<std::pair<Vector, Vector>> lines(count);
    std::generate(lines.begin(), lines.end(), draw);
    const std::size_t first = sample.Rays.size();
    sample.Rays.resize(first + count);
    sample.Weights.resize(first + count);
    const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(dynamic, 8)
    for (std::ptrdiff_t i = 0; i < n; ++i)
    {
      const MeshLine line(mesh, scalars, ofCells, lines[i].first, lines[i].second);
      double density;
      sample.Rays[first + i] = line.Walk(scale * mesh.GetRadius(), density);
      sample.Weights[first + i] = density > 0 ? 1 / density : 0;
    }
  };
  walk(FewestRays);
  std::size_t segments = 0;
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    segments += ray.size();
  }
  const std::size_t enough = EnoughSegments * FewestRays / std::max<std::size_t>(segments, 1);
  walk(std::clamp(enough, FewestRays, MostRays) - FewestRays);
  return sample;
}

} // namespace tetralux
