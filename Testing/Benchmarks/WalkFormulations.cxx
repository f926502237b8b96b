// SPDX-License-Identifier: BSD-3-Clause

// Compares two ways to find the face through which a ray leaves a tetrahedron, ray by ray, in
// single and double precision, over the same neighbours and from the same entries:
//
// planes  Weiler et al. 2003, equations 1 and 2: the nearest of the faces' planes that face away
//         from the ray's start, the face of entry left out; the scalar by the cell's gradient.
// edges   as in RayCastKernel.inl: exact signs of the determinants of projected corners; the scalar
//         by interpolation on the face.
//
// Prints how many rays go wrong and the nanoseconds of a step.

#include "ComparisonMeshes.h"
#include "Walk/WalkMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <type_traits>

namespace tetralux
{
namespace
{

// All lengths are in radii of the mesh, around its centre, as in the tables.

constexpr int RandomRays = 100000;
constexpr int AimedRays = 10000;
constexpr int ReferenceRays = 100; ///< of each kind, that are compared with brute force
constexpr int TimingSize = 256;    ///< pixels along the edge of the picture that is timed
constexpr int TimingRuns = 5;

/// A ray that strays by more than this from what it should have walked is wrong: it would show in a
/// picture whose medium absorbs noticeably over a radius.
constexpr double LargestLengthError = 1e-4;

/// A cell that the ray misses by less is no wrong one: about eight roundings of single precision
/// coordinates.
constexpr double LargestMiss = 1e-6;

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Add(const Vector& a, double s, const Vector& b)
{
  return { a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2] };
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector Normalize(const Vector& a) { return Add({ 0, 0, 0 }, 1 / std::sqrt(Dot(a, a)), a); }

struct Ray
{
  Vector Point;     ///< the one nearest to the centre
  Vector Direction; ///< of length 1

  Ray(const Vector& point, const Vector& direction)
    : Direction(Normalize(direction))
  {
    this->Point = Add(point, -Dot(point, this->Direction), this->Direction);
  }
};

/// Where a ray crosses the boundary.
struct BoundaryCrossing
{
  double Distance;
  std::int32_t Entry; ///< -1 once walked from or to
};

struct Segment
{
  std::int32_t Cell;
  double Z0, Z1;
};

/// What the walk through one part of a mesh came to.
constexpr std::int32_t Lost = -1; ///< else the boundary face of the exit

// ----------------------------------------------------------------------------------------------
// Edges

template <class Real>
Real DifferenceOfProducts(Real a, Real b, Real c, Real d)
{
  const Real cd = c * d;
  const Real error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

template <class Real>
class EdgeWalk
{
public:
  static constexpr const char* Name = "edges";

  struct Corner
  {
    Real X, Y, Z, S;
    std::int32_t Id;
  };

  /// The ray's own frame, as in RayCastKernel.inl.
  struct Start
  {
    Real U[4], V[4], W[3];
  };

  explicit EdgeWalk(const WalkMesh& mesh)
    : Mesh(mesh)
    , Points(mesh.GetPoints<Real>())
    , Faces(mesh.GetFaces())
  {
  }

  static double GetBytesPerCell(const WalkMesh& mesh)
  {
    return 4 * sizeof(WalkFace) +
      sizeof(WalkPoint<Real>) * static_cast<double>(mesh.GetMesh().GetNumberOfPoints()) /
      mesh.GetNumberOfCells();
  }

  static Start MakeStart(const Ray& ray)
  {
    constexpr double Scale = 1099511627776.; // 2^40
    const Vector& n = ray.Direction;
    const double sign = n[2] < 0 ? -1 : 1;
    const double p = -1 / (sign + n[2]);
    const double q = n[0] * n[1] * p;
    const Vector u = { 1 + sign * n[0] * n[0] * p, sign * q, -sign * n[0] };
    const Vector v = { q, sign + n[1] * n[1] * p, -n[1] };
    Start start;
    for (int a = 0; a < 3; ++a)
    {
      start.U[a] = static_cast<Real>(u[a] * Scale);
      start.V[a] = static_cast<Real>(v[a] * Scale);
      start.W[a] = static_cast<Real>(n[a]);
    }
    start.U[3] = static_cast<Real>(-Dot(u, ray.Point) * Scale);
    start.V[3] = static_cast<Real>(-Dot(v, ray.Point) * Scale);
    return start;
  }

  Corner Project(const Start& ray, std::int32_t id) const
  {
    constexpr Real Smallest = static_cast<Real>(std::is_same_v<Real, float> ? 1. / 1024 : 0x1p-100);
    const WalkPoint<Real>& p = this->Points[id];
    const auto across = [&p](const Real(&r)[4])
    {
      const Real x = std::fma(r[0], p.X, std::fma(r[1], p.Y, std::fma(r[2], p.Z, r[3])));
      return std::fabs(x) < Smallest ? Real(0) : x;
    };
    return { across(ray.U), across(ray.V),
      std::fma(ray.W[0], p.X, std::fma(ray.W[1], p.Y, ray.W[2] * p.Z)), p.S, id };
  }

  static Real Det(const Corner& a, const Corner& b)
  {
    return DifferenceOfProducts(a.X, b.Y, a.Y, b.X);
  }

  static bool IsPositive(Real det, const Corner& a, const Corner& b)
  {
    if (det != 0)
    {
      return det > 0;
    }
    return a.Y != b.Y ? b.Y < a.Y : a.X != b.X ? a.X < b.X : b.Id > a.Id;
  }

  /// Corners counter-clockwise and the weights of each; false where the ray misses the face.
  bool Enter(const Start& ray, const WalkEntry& entry, Corner (&c)[3], Real (&w)[3]) const
  {
    for (int k = 0; k < 3; ++k)
    {
      c[k] = this->Project(ray, entry.Points[k]);
    }
    int positive = 0;
    for (int k = 0; k < 3; ++k)
    {
      const Corner& a = c[Next[k]];
      const Corner& b = c[Next[Next[k]]];
      const Real det = Det(a, b);
      positive += IsPositive(det, a, b);
      w[k] = std::fabs(det);
    }
    if (positive == 0)
    {
      std::swap(c[1], c[2]);
      std::swap(w[1], w[2]);
    }
    return positive == 0 || positive == 3;
  }

  static Real GetZ(const Corner (&c)[3], const Real (&w)[3])
  {
    return (w[0] * c[0].Z + w[1] * c[1].Z + w[2] * c[2].Z) / (w[0] + w[1] + w[2]);
  }

  /// Calls visit(cell, z0, s0, z1, s1) for each cell.
  template <class Visitor>
  std::int32_t Walk(const Start& ray, const BoundaryCrossing& from, Visitor&& visit) const
  {
    // Which corner is dropped, by the signs of det(p, corner) as bits.
    static constexpr int Dropped[8] = { 2, 2, 0, 0, 1, 2, 1, 2 };
    const WalkEntry& entry = this->Mesh.GetEntries()[from.Entry];
    Corner c[3];
    Real w[3];
    this->Enter(ray, entry, c, w);
    Real sum = w[0] + w[1] + w[2];
    Real z0 = (w[0] * c[0].Z + w[1] * c[1].Z + w[2] * c[2].Z) / sum;
    Real s0 = (w[0] * c[0].S + w[1] * c[1].S + w[2] * c[2].S) / sum;
    WalkFace next = { entry.Cell, entry.Opposite };
    for (std::int32_t steps = this->Mesh.GetNumberOfCells(); next.Cell >= 0; --steps)
    {
      if (steps == 0)
      {
        return Lost;
      }
      const std::int32_t cell = next.Cell;
      const Corner p = this->Project(ray, next.Point);
      const Real det[3] = { Det(p, c[0]), Det(p, c[1]), Det(p, c[2]) };
      const int k = Dropped[IsPositive(det[0], p, c[0]) + 2 * IsPositive(det[1], p, c[1]) +
        4 * IsPositive(det[2], p, c[2])];
      const int i = Next[k];
      const int j = Next[i];
      const std::int32_t id = c[k].Id;
      next = this->Faces[4 * cell + (id > p.Id) + (id > c[i].Id) + (id > c[j].Id)];
      c[k] = p;
      w[i] = std::fabs(det[j]);
      w[j] = std::fabs(det[i]);
      sum = w[0] + w[1] + w[2];
      const Real z1 = (w[0] * c[0].Z + w[1] * c[1].Z + w[2] * c[2].Z) / sum;
      const Real s1 = (w[0] * c[0].S + w[1] * c[1].S + w[2] * c[2].S) / sum;
      visit(cell, z0, s0, z1, s1);
      z0 = z1;
      s0 = s1;
    }
    return ~next.Cell;
  }

private:
  static constexpr int Next[3] = { 1, 2, 0 };

  const WalkMesh& Mesh;
  const WalkPoint<Real>* Points;
  const WalkFace* Faces;
};

// ----------------------------------------------------------------------------------------------
// Planes

/// What equations 1 and 2 read of a cell.
template <class Real>
struct CellPlanes
{
  Real Normal[4][3];        ///< outward, of length 1; zero for a face without area
  Real Offset[4];           ///< Normal . x on the face
  Real Gradient[4];         ///< the scalar is Gradient . (x, 1)
  std::int32_t Neighbor[4]; ///< 4 * cell + face, or ~b at boundary face b
};

template <class Real>
Vector GetPoint(const WalkMesh& mesh, std::int32_t id)
{
  const WalkPoint<Real>& p = mesh.GetPoints<Real>()[id];
  return { static_cast<double>(p.X), static_cast<double>(p.Y), static_cast<double>(p.Z) };
}

/// In double precision from exact coordinates, then rounded.
template <class Real>
std::vector<CellPlanes<Real>> MakePlanes(const WalkMesh& mesh)
{
  const std::vector<std::int32_t>& ids = mesh.GetMesh().Cells;
  std::vector<CellPlanes<Real>> result(mesh.GetNumberOfCells());
  for (std::size_t t = 0; t < result.size(); ++t)
  {
    CellPlanes<Real>& planes = result[t];
    Vector gradient = { 0, 0, 0 };
    double constant = 0;
    for (int i = 0; i < 4; ++i)
    {
      const Vector v = GetPoint<double>(mesh, ids[4 * t + i]);
      const Vector a = GetPoint<double>(mesh, ids[4 * t + (i + 1) % 4]);
      const Vector b = GetPoint<double>(mesh, ids[4 * t + (i + 2) % 4]);
      const Vector c = GetPoint<double>(mesh, ids[4 * t + (i + 3) % 4]);
      Vector n = Cross(Add(b, -1, a), Add(c, -1, a));
      const double area = std::sqrt(Dot(n, n));
      const double height = Dot(n, Add(v, -1, a));
      n = Add({ 0, 0, 0 }, area > 0 ? (height > 0 ? -1 : 1) / area : 0, n);
      for (int k = 0; k < 3; ++k)
      {
        planes.Normal[i][k] = static_cast<Real>(n[k]);
      }
      const double offset = Dot(n, a);
      planes.Offset[i] = static_cast<Real>(offset);
      if (height != 0)
      {
        // The point's share of the scalar goes from 0 on the face to 1 at the point.
        const double share =
          mesh.GetPoints<double>()[ids[4 * t + i]].S / -(std::fabs(height) / area);
        gradient = Add(gradient, share, n);
        constant -= share * offset;
      }
      const WalkFace face = mesh.GetFaces()[4 * t + i];
      planes.Neighbor[i] = face.Cell;
      if (face.Cell >= 0)
      {
        const std::int32_t* first = &ids[4 * static_cast<std::size_t>(face.Cell)];
        planes.Neighbor[i] = 4 * face.Cell +
          static_cast<std::int32_t>(std::find(first, first + 4, face.Point) - first);
      }
    }
    for (int k = 0; k < 3; ++k)
    {
      planes.Gradient[k] = static_cast<Real>(gradient[k]);
    }
    planes.Gradient[3] = static_cast<Real>(constant);
  }
  return result;
}

template <class Real>
class PlaneWalk
{
public:
  static constexpr const char* Name = "planes";

  struct Start
  {
    Real Point[3], Direction[3];
  };

  explicit PlaneWalk(const WalkMesh& mesh)
    : Mesh(mesh)
    , Cells(MakePlanes<Real>(mesh))
  {
  }

  static double GetBytesPerCell(const WalkMesh&) { return sizeof(CellPlanes<Real>); }

  static Start MakeStart(const Ray& ray)
  {
    Start start;
    for (int a = 0; a < 3; ++a)
    {
      start.Point[a] = static_cast<Real>(ray.Point[a]);
      start.Direction[a] = static_cast<Real>(ray.Direction[a]);
    }
    return start;
  }

  static Real Dot3(const Real* a, const Real* b)
  {
    return std::fma(a[0], b[0], std::fma(a[1], b[1], a[2] * b[2]));
  }

  template <class Visitor>
  std::int32_t Walk(const Start& ray, const BoundaryCrossing& from, Visitor&& visit) const
  {
    const WalkEntry& entry = this->Mesh.GetEntries()[from.Entry];
    std::int32_t cell = entry.Cell;
    const std::int32_t* ids = &this->Mesh.GetMesh().Cells[4 * static_cast<std::size_t>(cell)];
    int entryFace = static_cast<int>(std::find(ids, ids + 4, entry.Opposite) - ids);
    Real z0 = static_cast<Real>(from.Distance);
    const auto scalarAt = [&ray](const CellPlanes<Real>& planes, Real z)
    {
      const Real* g = planes.Gradient;
      return std::fma(z, Dot3(g, ray.Direction), Dot3(g, ray.Point) + g[3]);
    };
    Real s0 = scalarAt(this->Cells[cell], z0);
    for (std::int32_t steps = this->Mesh.GetNumberOfCells(); steps > 0; --steps)
    {
      const CellPlanes<Real>& planes = this->Cells[cell];
      Real z1 = std::numeric_limits<Real>::max();
      int exitFace = -1;
      for (int i = 0; i < 4; ++i)
      {
        const Real slope = Dot3(planes.Normal[i], ray.Direction);
        const Real z = (planes.Offset[i] - Dot3(planes.Normal[i], ray.Point)) / slope;
        const bool nearer = (i != entryFace) & (slope > 0) & (z < z1);
        z1 = nearer ? z : z1;
        exitFace = nearer ? i : exitFace;
      }
      if (exitFace < 0)
      {
        return Lost;
      }
      const Real s1 = scalarAt(planes, z1);
      visit(cell, z0, s0, z1, s1);
      z0 = z1;
      s0 = s1;
      const std::int32_t next = planes.Neighbor[exitFace];
      if (next < 0)
      {
        return ~next;
      }
      cell = next / 4;
      entryFace = next % 4;
    }
    return Lost;
  }

private:
  const WalkMesh& Mesh;
  std::vector<CellPlanes<Real>> Cells;
};

// ----------------------------------------------------------------------------------------------
// What should be walked

/// All crossings of a ray with the boundary, ascending, by the edge tests.
template <class Real>
void FindBoundaryCrossings(const WalkMesh& mesh, const EdgeWalk<Real>& edges, const Ray& ray,
  std::vector<BoundaryCrossing>& crossings)
{
  const auto start = EdgeWalk<Real>::MakeStart(ray);
  const BoundaryBvh& bvh = mesh.GetBvh();
  crossings.clear();
  std::vector<std::int32_t> stack = { 0 };
  while (!stack.empty())
  {
    const std::int32_t id = stack.back();
    stack.pop_back();
    const BoundaryBvh::Node& node = bvh.Nodes[id];
    const auto isNear = [&node](const Real(&r)[4])
    {
      Real x = r[3];
      Real reach = 0;
      for (int a = 0; a < 3; ++a)
      {
        x += r[a] * node.Center[a];
        reach += std::fabs(r[a]) * node.Half[a];
      }
      return std::fabs(x) <= reach;
    };
    if (!isNear(start.U) || !isNear(start.V))
    {
      continue;
    }
    if (node.Count == 0)
    {
      stack.push_back(node.First);
      stack.push_back(id + 1);
      continue;
    }
    for (int i = node.First; i < node.First + node.Count; ++i)
    {
      typename EdgeWalk<Real>::Corner c[3];
      Real w[3];
      if (edges.Enter(start, mesh.GetEntries()[bvh.Triangles[i]], c, w))
      {
        crossings.push_back({ static_cast<double>(edges.GetZ(c, w)), bvh.Triangles[i] });
      }
    }
  }
  std::sort(crossings.begin(), crossings.end(),
    [](const BoundaryCrossing& a, const BoundaryCrossing& b) { return a.Distance < b.Distance; });
}

/// How far a point is outside of a cell, at least.
double GetMiss(const CellPlanes<double>& cell, const Vector& x)
{
  double miss = 0;
  for (int i = 0; i < 4; ++i)
  {
    const Vector n = { cell.Normal[i][0], cell.Normal[i][1], cell.Normal[i][2] };
    miss = std::max(miss, Dot(n, x) - cell.Offset[i]);
  }
  return miss;
}

/// Length of a ray inside the mesh, each cell clipped on its own.
double GetLengthByBruteForce(const std::vector<CellPlanes<double>>& cells, const Ray& ray)
{
  std::vector<std::array<double, 2>> parts;
  for (const CellPlanes<double>& cell : cells)
  {
    double begin = -2;
    double end = 2;
    bool flat = false;
    for (int i = 0; i < 4; ++i)
    {
      const Vector n = { cell.Normal[i][0], cell.Normal[i][1], cell.Normal[i][2] };
      const double slope = Dot(n, ray.Direction);
      const double height = Dot(n, ray.Point) - cell.Offset[i];
      if (slope > 0)
      {
        end = std::min(end, -height / slope);
      }
      else if (slope < 0)
      {
        begin = std::max(begin, -height / slope);
      }
      else if (height > 0)
      {
        end = -2;
      }
      flat |= n == Vector{ 0, 0, 0 };
    }
    if (begin < end && !flat)
    {
      parts.push_back({ begin, end });
    }
  }
  // Their union: a ray in a face is in both of its cells.
  std::sort(parts.begin(), parts.end());
  double length = 0;
  double done = -2;
  for (const auto& [begin, end] : parts)
  {
    length += std::max(0., end - std::max(begin, done));
    done = std::max(done, end);
  }
  return length;
}

struct Failures
{
  int Lost = 0;   ///< no exit, or a loop
  int Astray = 0; ///< out of the mesh where the ray does not leave it
  int Wrong = 0;  ///< too long in cells that the ray misses, or too long altogether
  int Beside = 0; ///< out in the right place by another face: only a tolerance tells it from Astray
};

/// Walks a ray from all its entries and says what it came to.
template <class Walk>
void CheckRay(const Walk& walk, const std::vector<CellPlanes<double>>& cells, const Ray& ray,
  std::vector<BoundaryCrossing> crossings, Failures& failures)
{
  double expected = 0;
  for (std::size_t k = 0; k < crossings.size(); ++k)
  {
    expected += k % 2 ? crossings[k].Distance : -crossings[k].Distance;
  }
  const auto start = Walk::MakeStart(ray);
  double walked = 0;
  double outside = 0;
  double last = 0;
  bool beside = false;
  for (BoundaryCrossing& crossing : crossings)
  {
    if (crossing.Entry < 0)
    {
      continue;
    }
    const std::int32_t exit = walk.Walk(start, crossing,
      [&](std::int32_t cell, double z0, double, double z1, double)
      {
        const double length = std::fabs(z1 - z0);
        walked += length;
        last = z1;
        // A cell without volume has no inside, and rounding decides where on it a ray is.
        if (length > LargestMiss &&
          GetMiss(cells[cell], Add(ray.Point, 0.5 * (z0 + z1), ray.Direction)) > LargestMiss)
        {
          outside += length;
        }
      });
    crossing.Entry = -1;
    if (exit == Lost)
    {
      ++failures.Lost;
      return;
    }
    auto end = std::find_if(crossings.begin(), crossings.end(),
      [exit](const BoundaryCrossing& c) { return c.Entry == exit; });
    if (end == crossings.end())
    {
      beside = true;
      end = std::find_if(crossings.begin(), crossings.end(),
        [last](const BoundaryCrossing& c)
        { return c.Entry >= 0 && std::fabs(c.Distance - last) <= LargestLengthError; });
    }
    if (end == crossings.end())
    {
      ++failures.Astray;
      return;
    }
    end->Entry = -1;
  }
  failures.Beside += beside;
  failures.Wrong +=
    !(outside <= LargestLengthError && std::fabs(walked - expected) <= LargestLengthError);
}

// ----------------------------------------------------------------------------------------------
// Rays

enum RayKind
{
  ThroughSphere,
  AtVertices,
  AtEdgeMiddles,
  AlongAxes, ///< through a vertex
  NumberOfKinds
};

Vector MakeDirection(std::mt19937_64& random)
{
  std::normal_distribution<double> normal;
  return Normalize({ normal(random), normal(random), normal(random) });
}

/// Aimed at the points as the walk of this precision sees them.
template <class Real>
std::vector<Ray> MakeRaysOfKind(const WalkMesh& mesh, RayKind kind)
{
  std::mt19937_64 random(kind + 1);
  const std::vector<std::int32_t>& ids = mesh.GetMesh().Cells;
  std::uniform_int_distribution<std::size_t> anyCell(0, ids.size() / 4 - 1);
  std::vector<Ray> rays;
  const int n = kind == ThroughSphere ? RandomRays : AimedRays;
  for (int i = 0; i < n; ++i)
  {
    const Vector from = MakeDirection(random);
    if (kind == ThroughSphere)
    {
      rays.emplace_back(from, Add(MakeDirection(random), -1, from));
      continue;
    }
    const std::size_t cell = anyCell(random);
    const Vector a = GetPoint<Real>(mesh, ids[4 * cell]);
    if (kind == AlongAxes)
    {
      Vector axis = { 0, 0, 0 };
      axis[i % 3] = 1;
      rays.emplace_back(a, axis);
      continue;
    }
    const Vector b = GetPoint<Real>(mesh, ids[4 * cell + 1 + i % 3]);
    const Vector target = kind == AtVertices ? a : Add(Add(a, 0.5, b), -0.5, a);
    rays.emplace_back(target, Add(target, -1, from));
  }
  return rays;
}

std::vector<Ray> MakePicture()
{
  const double center[3] = { 0, 0, 0 };
  const RayGrid grid = PerspectiveView(center, 1, TimingSize).Grid;
  std::vector<Ray> rays;
  for (int y = 0; y < grid.Height; ++y)
  {
    for (int x = 0; x < grid.Width; ++x)
    {
      Vector direction;
      for (int a = 0; a < 3; ++a)
      {
        direction[a] = grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a];
      }
      rays.emplace_back(Vector{ grid.Origin[0], grid.Origin[1], grid.Origin[2] }, direction);
    }
  }
  return rays;
}

// ----------------------------------------------------------------------------------------------

template <class Walk>
double TimeStep(const Walk& walk, const std::vector<Ray>& rays,
  const std::vector<std::vector<BoundaryCrossing>>& crossings)
{
  std::vector<typename Walk::Start> starts;
  for (const Ray& ray : rays)
  {
    starts.push_back(Walk::MakeStart(ray));
  }
  std::int64_t steps = 0;
  double sum = 0;
  const double seconds = MeasureBest(TimingRuns,
    [&]
    {
      steps = 0;
      for (std::size_t r = 0; r < rays.size(); ++r)
      {
        // Into the first part of the mesh only; the sum keeps what a step computes.
        if (!crossings[r].empty())
        {
          walk.Walk(starts[r], crossings[r].front(),
            [&](std::int32_t, auto z0, auto s0, auto z1, auto s1)
            {
              sum += static_cast<double>((z1 - z0) * (s0 + s1));
              ++steps;
            });
        }
      }
    });
  if (!std::isfinite(sum))
  {
    std::printf("  (a sum that is not finite: degenerate planes)\n");
  }
  return 1e9 * seconds / static_cast<double>(steps);
}

template <class Walk, class Real>
void Compare(const WalkMesh& mesh, const std::vector<CellPlanes<double>>& cells)
{
  const Walk walk(mesh);
  const EdgeWalk<Real> edges(mesh);
  std::vector<BoundaryCrossing> crossings;
  Failures failures[NumberOfKinds];
  for (int kind = 0; kind < NumberOfKinds; ++kind)
  {
    for (const Ray& ray : MakeRaysOfKind<Real>(mesh, static_cast<RayKind>(kind)))
    {
      FindBoundaryCrossings(mesh, edges, ray, crossings);
      CheckRay(walk, cells, ray, crossings, failures[kind]);
    }
  }
  const std::vector<Ray> picture = MakePicture();
  std::vector<std::vector<BoundaryCrossing>> entries(picture.size());
  for (std::size_t r = 0; r < picture.size(); ++r)
  {
    FindBoundaryCrossings(mesh, edges, picture[r], entries[r]);
  }
  const double step = TimeStep(walk, picture, entries);
  std::printf("  %-6s %-6s", Walk::Name, std::is_same_v<Real, float> ? "float" : "double");
  for (const Failures& f : failures)
  {
    std::printf(" %4d %4d %4d %4d ", f.Lost, f.Astray, f.Wrong, f.Beside);
  }
  std::printf(" %8.1f %8.1f\n", step, Walk::GetBytesPerCell(mesh));
  std::fflush(stdout);
}

/// The largest difference between crossings in double precision and brute force.
double CompareWithBruteForce(const WalkMesh& mesh, const std::vector<CellPlanes<double>>& cells)
{
  const EdgeWalk<double> edges(mesh);
  std::vector<BoundaryCrossing> crossings;
  double largest = 0;
  for (const RayKind kind : { ThroughSphere, AtVertices, AtEdgeMiddles })
  {
    const std::vector<Ray> rays = MakeRaysOfKind<double>(mesh, kind);
    for (int r = 0; r < ReferenceRays; ++r)
    {
      FindBoundaryCrossings(mesh, edges, rays[r], crossings);
      double length = 0;
      for (std::size_t k = 0; k < crossings.size(); ++k)
      {
        length += k % 2 ? crossings[k].Distance : -crossings[k].Distance;
      }
      largest = std::max(largest, std::fabs(length - GetLengthByBruteForce(cells, rays[r])));
    }
  }
  return largest;
}

void CompareOn(ComparisonMesh source)
{
  WalkMesh mesh(std::move(source.Mesh));
  const std::vector<double> scalars = MapScalars(mesh.GetMesh(), source.Scalars);
  mesh.SetPointScalars<float>(scalars, 0, 1);
  mesh.SetPointScalars<double>(scalars, 0, 1);
  const std::vector<CellPlanes<double>> cells = MakePlanes<double>(mesh);
  std::printf("%s: lengths differ from brute force by at most %.1e\n", source.Name.c_str(),
    CompareWithBruteForce(mesh, cells));
  Compare<PlaneWalk<float>, float>(mesh, cells);
  Compare<PlaneWalk<double>, double>(mesh, cells);
  Compare<EdgeWalk<float>, float>(mesh, cells);
  Compare<EdgeWalk<double>, double>(mesh, cells);
}

} // namespace
} // namespace tetralux

int main()
{
  using namespace tetralux;
  try
  {
    std::printf(
      "Of %d rays through the bounding sphere and of %d each at vertices, at middles of\n"
      "edges and along axes through vertices, how many are lost (no exit, or a loop), go\n"
      "astray (out where the ray does not leave the mesh), are wrong (in cells that they\n"
      "miss), leave beside (in the right place, but by another face); processor\n"
      "nanoseconds of a step; bytes a tetrahedron\n\n",
      RandomRays, AimedRays);
    std::printf("%-16s%-21s%-21s%-21s%-21s%8s %8s\n", "", "sphere", "vertices", "edges", "axes",
      "ns", "bytes");
    for (ComparisonMesh& mesh : ReadBluntFin())
    {
      CompareOn(std::move(mesh));
    }
    for (const char* generator : { "ball", "boundary-layer", "ring" })
    {
      CompareOn(MakeComparisonMesh(generator));
    }
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
