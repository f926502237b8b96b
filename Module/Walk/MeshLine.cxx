// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/MeshLine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetralux
{

/// A point as a line sees it: x and y across, z along it.
template <class Real>
struct MeshLine<Real>::Corner
{
  double X, Y, Z, S;
  std::int32_t Id;
};

/// Where the line crosses the boundary.
template <class Real>
struct MeshLine<Real>::Crossing
{
  double Distance;
  std::int32_t Entry; ///< -1 where it leaves
};

/// A triangle that the line goes through: where, the scalar there, and the tangent of the angle
/// between the line and its normal.
template <class Real>
struct MeshLine<Real>::Place
{
  double Z, S, Slope;
};

/// Of the cell of four corners: its volume times six, and how the scalar changes across the line.
template <class Real>
struct MeshLine<Real>::CellShape
{
  double Volume, Gradient;
};

namespace
{

template <class Corner>
double Det(const Corner& a, const Corner& b)
{
  return a.X * b.Y - a.Y * b.X;
}

/// On which side of the line from a to b the line of sight passes: the exact sign of Det. Where
/// that is 0, the sign for a line displaced by (e, e^2) with an infinitesimal e > 0; still 0 only
/// where both corners are seen as one.
template <class Corner>
int FindSide(const Corner& a, const Corner& b)
{
  const double p = a.X * b.Y;
  const double q = a.Y * b.X;
  if (p != q)
  {
    return p > q ? 1 : -1; // rounding is monotonic
  }
  const double pRest = std::fma(a.X, b.Y, -p);
  const double qRest = std::fma(a.Y, b.X, -q);
  if (pRest != qRest)
  {
    return pRest > qRest ? 1 : -1;
  }
  if (a.Y != b.Y)
  {
    return a.Y > b.Y ? 1 : -1;
  }
  return a.X != b.X ? (b.X > a.X ? 1 : -1) : 0;
}

/// std::hypot, which takes longer than all else of a step.
double MeasureLength(double x, double y)
{
  // Squares of what is in here are normal numbers, or a share of 2^-52 of the other one.
  constexpr double Smallest = 1e-140;
  constexpr double Largest = 1e140;
  const double largest = std::max(std::abs(x), std::abs(y));
  return Smallest < largest && largest < Largest ? std::sqrt(x * x + y * y) : std::hypot(x, y);
}

template <class Place, class Corner>
Place Interpolate(const Corner& a, const Corner& b, const Corner& c)
{
  const double wa = Det(b, c), wb = Det(c, a), wc = Det(a, b);
  const double sum = wa + wb + wc;
  // The normal is (x, y, sum), as long as the triangle is large.
  const double x = (b.Y - a.Y) * (c.Z - a.Z) - (b.Z - a.Z) * (c.Y - a.Y);
  const double y = (b.Z - a.Z) * (c.X - a.X) - (b.X - a.X) * (c.Z - a.Z);
  // By differences, so that a constant scalar stays what it is.
  const double s = a.S + (wb * (b.S - a.S) + wc * (c.S - a.S)) / sum;
  return { (wa * a.Z + wb * b.Z + wc * c.Z) / sum, s, MeasureLength(x, y) / std::abs(sum) };
}

template <class CellShape, class Corner>
CellShape FindShape(const Corner& a, const Corner& b, const Corner& c, const Corner& d)
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

template <class Corner>
bool IsInside(const Corner& a, const Corner& b, const Corner& c)
{
  const int side = FindSide(a, b);
  return side != 0 && FindSide(b, c) == side && FindSide(c, a) == side;
}

} // namespace

template <class Real>
MeshLine<Real>::MeshLine(const WalkMesh& mesh, Span<const double> scalars, bool ofCells,
  const std::array<double, 3>& point, const std::array<double, 3>& direction)
  : Mesh(mesh)
  , Points(mesh.GetPoints<Real>())
  , Scalars(scalars)
  , ScalarsOfCells(ofCells)
  , Origin(point)
  , Along(direction)
{
  // Any two directions across: of Duff et al., Building an orthonormal basis, revisited (2017).
  const std::array<double, 3>& n = direction;
  const double sign = std::copysign(1., n[2]);
  const double a = -1 / (sign + n[2]);
  const double b = n[0] * n[1] * a;
  this->AcrossX = { 1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0] };
  this->AcrossY = { b, sign + n[1] * n[1] * a, -n[1] };
}

template <class Real>
std::vector<LinePassage> MeshLine<Real>::Walk() const
{
  std::vector<LinePassage> passages;
  std::vector<Crossing> crossings = this->FindCrossings();
  for (std::size_t k = 0; k < crossings.size(); ++k)
  {
    if (crossings[k].Entry < 0)
    {
      continue;
    }
    const std::int32_t exit = this->WalkFrom(crossings[k].Entry, passages);
    for (std::size_t i = k + 1; i < crossings.size(); ++i)
    {
      crossings[i].Entry = crossings[i].Entry == exit ? -1 : crossings[i].Entry;
    }
  }
  return passages;
}

template <class Real>
typename MeshLine<Real>::Corner MeshLine<Real>::See(std::int32_t id) const
{
  const WalkPoint<Real>& p = this->Points[id];
  const std::array<double, 3> d = { p.X - this->Origin[0], p.Y - this->Origin[1],
    p.Z - this->Origin[2] };
  const auto dot = [&d](const std::array<double, 3>& v)
  { return d[0] * v[0] + d[1] * v[1] + d[2] * v[2]; };
  return { dot(this->AcrossX), dot(this->AcrossY), dot(this->Along),
    this->ScalarsOfCells ? 0 : this->Scalars[id], id };
}

template <class Real>
std::vector<typename MeshLine<Real>::Crossing> MeshLine<Real>::FindCrossings() const
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
        crossings.push_back({ Interpolate<Place>(a, b, c).Z, entry });
      }
    }
  }
  std::sort(crossings.begin(), crossings.end(),
    [](const Crossing& a, const Crossing& b) { return a.Distance < b.Distance; });
  return crossings;
}

/// From an entry to where the line leaves the mesh: which boundary face that is.
template <class Real>
std::int32_t MeshLine<Real>::WalkFrom(
  std::int32_t entryId, std::vector<LinePassage>& passages) const
{
  const WalkEntry& entry = this->Mesh.GetEntries()[entryId];
  Corner a = this->See(entry.Points[0]), b = this->See(entry.Points[1]),
         c = this->See(entry.Points[2]);
  if (FindSide(a, b) < 0)
  {
    std::swap(b, c); // counter-clockwise from here on
  }
  Place place = Interpolate<Place>(a, b, c);
  bool first = true;
  WalkFace behind = { entry.Cell, entry.Opposite };
  // No walk visits a cell twice.
  for (std::int32_t steps = this->Mesh.GetNumberOfCells(); behind.Cell >= 0 && steps > 0; --steps)
  {
    const Corner p = this->See(behind.Point);
    const bool aSide = FindSide(p, a) > 0, bSide = FindSide(p, b) > 0, cSide = FindSide(p, c) > 0;
    // The exit face is opposite to the corner that p replaces.
    Corner& replaced = bSide && !cSide ? a : cSide && !aSide ? b : c;
    const std::int32_t dropped = replaced.Id;
    const auto shape = FindShape<CellShape>(a, b, c, p);
    replaced = p;
    const int face = (dropped > a.Id) + (dropped > b.Id) + (dropped > c.Id);
    const std::int32_t cell = behind.Cell;
    behind = this->Mesh.GetFaces()[4 * static_cast<std::size_t>(cell) + face];

    const Place next = Interpolate<Place>(a, b, c);
    const double front = this->ScalarsOfCells ? this->Scalars[cell] : place.S;
    const double back = this->ScalarsOfCells ? this->Scalars[cell] : next.S;
    passages.push_back({ cell, place.Z, next.Z, front, back, place.Slope, next.Slope,
      shape.Gradient, shape.Volume, first, behind.Cell < 0 });
    place = next;
    first = false;
  }
  return ~behind.Cell;
}

template class MeshLine<float>;
template class MeshLine<double>;

} // namespace tetralux
