// SPDX-License-Identifier: BSD-3-Clause

// Cell-to-cell ray casting of packets of eight rays (Garrity 1990; Weiler et al. 2003, section 3),
// by two-dimensional edge tests that carry the entry face along.
//
// Each ray sees the mesh in a frame of its own: x and y across the ray, z along it, the ray at
// x = y = 0. A cell is entered through the triangle a b c, whose projections surround the origin.
// The cell's fourth point p replaces one of them: the ray leaves through the one triangle of p and
// two of a, b, c that surrounds the origin, and the signs of the three determinants det(p, a),
// det(p, b), det(p, c) tell which. The next cell is then known together with its fourth point
// (WalkFace), so that a step reads 8 bytes of topology and one point.
//
// Why no ray is lost or counted twice, in single precision too:
// * A projection is rounded, but it is the same whichever cell asks: it moves points of the mesh by
//   an ulp, the same way for all cells around them.
// * The determinants of the rounded projections have exact signs (DifferenceOfProducts). A
//   determinant of exactly zero, a ray through an edge or a vertex, is decided as if the ray were
//   displaced by (e, e^2), e infinitely small (simulation of simplicity, Edelsbrunner and Muecke
//   1990). So each edge passes each ray on one side, for every cell that has the edge.
// * Whatever a tetrahedron became in the projection - flat, inverted - the origin is inside none or
//   two of its four triangles. Steps are thus a pairing of faces: a walk that starts at a boundary
//   face visits no cell twice and ends at another boundary face.
//
// Boundary crossings are found by the same determinants, so they come in pairs, too: walking from
// the nearest one strikes off the one where the walk ends, and the next one left is a re-entry.

#include "RayCastKernel.h"
#include "SegmentIntegral.h"

#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Projections are scaled by this, so that products of two of them stay normal numbers down to the
/// smallest that differ from zero (SmallestProjection squared, times 2^-24).
constexpr double ProjectionScale = 1099511627776.; // 2^40

/// Scaled projections below this are zero: 2^-50 radii in single, 2^-140 in double precision, far
/// below the rounding of the coordinates that they come from.
template <class Real>
constexpr Real SmallestProjection();
template <>
constexpr float SmallestProjection<float>()
{
  return 1.f / 1024;
}
template <>
constexpr double SmallestProjection<double>()
{
  return 7.888609052210118e-31; // 2^-100
}

/// Largest optical depth of a segment that is told from opaque; keeps products finite.
constexpr float LargestDepth = 1e30f;

/// The most intervals that six cropping planes can leave of a ray.
constexpr int MaximumIntervals = 4;

template <class Real>
struct Rays
{
  using V = typename LanesOf<Real>::Type;
  V U[4], V_[4]; ///< x = U . (point, 1), y = V_ . (point, 1), scaled by ProjectionScale
  V W[3];        ///< z = W . point: world distance from the point of the ray nearest to the centre
  Double8 Start; ///< world distance of that point from the start of the ray
};

/// One corner of the triangle that the ray goes through, seen in the ray's frame.
template <class Real>
struct Corner
{
  using V = typename LanesOf<Real>::Type;
  V X, Y, Z, S;
  Int8 Id;
};

template <class V>
TETRALUX_INLINE V Dot(const V (&a)[3], V x, V y, V z)
{
  return Fma(a[0], x, Fma(a[1], y, a[2] * z));
}

template <class Real>
TETRALUX_INLINE Corner<Real> Project(const Rays<Real>& rays, typename LanesOf<Real>::Type x,
  typename LanesOf<Real>::Type y, typename LanesOf<Real>::Type z, typename LanesOf<Real>::Type s,
  Int8 id)
{
  using V = typename LanesOf<Real>::Type;
  Corner<Real> c;
  const V smallest = SmallestProjection<Real>();
  c.X = Fma(rays.U[0], x, Fma(rays.U[1], y, Fma(rays.U[2], z, rays.U[3])));
  c.Y = Fma(rays.V_[0], x, Fma(rays.V_[1], y, Fma(rays.V_[2], z, rays.V_[3])));
  c.X = Keep(smallest <= Abs(c.X), c.X);
  c.Y = Keep(smallest <= Abs(c.Y), c.Y);
  c.Z = Dot(rays.W, x, y, z);
  c.S = s;
  c.Id = id;
  return c;
}

template <class Real>
TETRALUX_INLINE Corner<Real> LoadCorner(const Rays<Real>& rays, const void* points, Int8 id)
{
  typename LanesOf<Real>::Type x, y, z, s;
  GatherRows(static_cast<const Real*>(points), id, x, y, z, s);
  return Project(rays, x, y, z, s, id);
}

template <class Real>
TETRALUX_INLINE Corner<Real> Select(Mask8 m, const Corner<Real>& a, const Corner<Real>& b)
{
  return { Select(m, a.X, b.X), Select(m, a.Y, b.Y), Select(m, a.Z, b.Z), Select(m, a.S, b.S),
    Select(m, a.Id, b.Id) };
}

template <class Real>
TETRALUX_INLINE typename LanesOf<Real>::Type Det(const Corner<Real>& a, const Corner<Real>& b)
{
  return DifferenceOfProducts(a.X, b.Y, a.Y, b.X);
}

/// Whether a zero det(a, b) counts as positive: the sign of
/// -e (b.y - a.y) + e^2 (b.x - a.x), and by ids where the projections coincide.
template <class Real>
TETRALUX_INLINE Mask8 TieIsPositive(const Corner<Real>& a, const Corner<Real>& b)
{
  const Mask8 sameY = a.Y == b.Y;
  const Mask8 sameX = a.X == b.X;
  return (b.Y < a.Y) | (sameY & ((a.X < b.X) | (sameX & (b.Id > a.Id))));
}

template <class V, class Real>
TETRALUX_INLINE Mask8 IsPositive(V det, const Corner<Real>& a, const Corner<Real>& b)
{
  return (V(Real(0)) < det) | ((det == V(Real(0))) & TieIsPositive(a, b));
}

/// A value between three by weights whose sum is 1, that of a left out. By differences: a constant
/// stays exactly what it is, also next to a step of the transfer function.
template <class V>
TETRALUX_INLINE V Blend(V wb, V wc, V a, V b, V c)
{
  return Fma(wb, b - a, Fma(wc, c - a, a));
}

/// Which rays go through a triangle, and where.
template <class Real>
struct TriangleHit
{
  using V = typename LanesOf<Real>::Type;
  Mask8 Hit;
  Mask8 Clockwise; ///< all three determinants negative
  V BC, CA, AB;    ///< det(b, c), det(c, a), det(a, b)
};

template <class Real>
TETRALUX_INLINE TriangleHit<Real> TestTriangle(
  const Corner<Real>& a, const Corner<Real>& b, const Corner<Real>& c)
{
  TriangleHit<Real> t;
  t.BC = Det(b, c);
  t.CA = Det(c, a);
  t.AB = Det(a, b);
  using V = typename LanesOf<Real>::Type;
  const V zero = Real(0);
  Mask8 p = zero < t.BC;
  Mask8 q = zero < t.CA;
  Mask8 r = zero < t.AB;
  if (Any((t.BC == zero) | (t.CA == zero) | (t.AB == zero)))
  {
    p = IsPositive(t.BC, b, c);
    q = IsPositive(t.CA, c, a);
    r = IsPositive(t.AB, a, b);
  }
  const Mask8 all = MaskFromBits(0xff);
  t.Clockwise = AndNot(all, p | q | r);
  t.Hit = (p & q & r) | t.Clockwise;
  return t;
}

/// The rays of eight pixels, four in a row and two rows, from (x, y).
template <class Real>
TETRALUX_INLINE Rays<Real> MakeRays(
  const KernelInput& in, int px, int py, Double8 (&origin)[3], Double8 (&direction)[3])
{
  const RayGrid& grid = *in.Grid;
  double laneX[Width], laneY[Width];
  for (int i = 0; i < Width; ++i)
  {
    laneX[i] = px + i % 4;
    laneY[i] = py + i / 4;
  }
  const Double8 x = LoadDouble8(laneX);
  const Double8 y = LoadDouble8(laneY);
  for (int a = 0; a < 3; ++a)
  {
    origin[a] = Fma(Double8(grid.OriginStepX[a]), x,
      Fma(Double8(grid.OriginStepY[a]), y, Double8(grid.Origin[a])));
    direction[a] = Fma(Double8(grid.DirectionStepX[a]), x,
      Fma(Double8(grid.DirectionStepY[a]), y, Double8(grid.Direction[a])));
  }
  const Double8 length = Sqrt(Dot(direction, direction[0], direction[1], direction[2]));
  for (int a = 0; a < 3; ++a)
  {
    direction[a] = direction[a] / length;
  }

  // In the coordinates of the tables; d is the change for one world unit along the ray.
  Double8 o[3], d[3];
  const Double8 scale = 1 / in.Radius;
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const Double8 m[3] = { row[0], row[1], row[2] };
    o[a] = (Dot(m, origin[0], origin[1], origin[2]) + Double8(row[3] - in.Center[a])) * scale;
    d[a] = Dot(m, direction[0], direction[1], direction[2]) * scale;
  }
  const Double8 dd = Dot(d, d[0], d[1], d[2]);
  const Double8 start = Dot(d, o[0], o[1], o[2]) / dd; // minus the distance of the nearest point
  const Double8 dLength = Sqrt(dd);
  Double8 n[3];
  for (int a = 0; a < 3; ++a)
  {
    o[a] = o[a] - start * d[a];
    n[a] = d[a] / dLength;
  }
  // Two vectors across the ray (Duff et al., Building an Orthonormal Basis, Revisited, 2017).
  const Double8 one = 1.;
  const Double8 sign = Select(n[2] < Double8(0.), Double8(-1.), one);
  const Double8 p = Double8(-1.) / (sign + n[2]);
  const Double8 q = n[0] * n[1] * p;
  const Double8 u[3] = { one + sign * n[0] * n[0] * p, sign * q, Double8(0.) - sign * n[0] };
  const Double8 v[3] = { q, sign + n[1] * n[1] * p, Double8(0.) - n[1] };

  Rays<Real> rays;
  const auto convert = [](Double8 value)
  {
    if constexpr (sizeof(Real) == sizeof(float))
    {
      return ToFloat(value);
    }
    else
    {
      return value;
    }
  };
  const Double8 large = ProjectionScale;
  for (int a = 0; a < 3; ++a)
  {
    rays.U[a] = convert(u[a] * large);
    rays.V_[a] = convert(v[a] * large);
    rays.W[a] = convert(d[a] / dd);
  }
  // From the rounded vectors, so that the ray goes through the point nearest to the centre.
  rays.U[3] = convert(Double8(0.) - Dot(u, o[0], o[1], o[2]) * large);
  rays.V_[3] = convert(Double8(0.) - Dot(v, o[0], o[1], o[2]) * large);
  rays.Start = Double8(0.) - start;
  return rays;
}

/// Which part of each ray counts, by distance from the point nearest to the centre; several parts
/// with cropping.
struct Intervals
{
  int Count;
  Double8 Begin[MaximumIntervals], End[MaximumIntervals];
};

/// The parts of one ray that the cropping regions keep: intersects [begin, end] with them.
inline int CropRay(const KernelInput& in, const double origin[3], const double direction[3],
  double begin, double end, double (&begins)[MaximumIntervals], double (&ends)[MaximumIntervals])
{
  // Where the ray crosses the planes, ascending.
  double cuts[8];
  int n = 0;
  cuts[n++] = begin;
  for (int p = 0; p < 6; ++p)
  {
    const int a = p / 2;
    const double t = (in.CroppingPlanes[p] - origin[a]) / direction[a];
    if (begin < t && t < end)
    {
      int i = n++;
      for (; i > 1 && cuts[i - 1] > t; --i)
      {
        cuts[i] = cuts[i - 1];
      }
      cuts[i] = t;
    }
  }
  cuts[n] = end;
  int count = 0;
  bool open = false;
  for (int i = 0; i < n; ++i)
  {
    if (!(cuts[i] < cuts[i + 1]))
    {
      continue;
    }
    // The region of the middle; beyond the largest number there is no middle, but also no mesh.
    constexpr double Far = 1e150;
    const double lo = cuts[i] > -Far ? cuts[i] : -Far;
    const double hi = cuts[i + 1] < Far ? cuts[i + 1] : Far;
    const double t = lo + 0.5 * (hi - lo);
    int region = 0;
    int weight = 1;
    for (int a = 0; a < 3; ++a)
    {
      const double x = origin[a] + t * direction[a];
      region += weight * ((x >= in.CroppingPlanes[2 * a]) + (x >= in.CroppingPlanes[2 * a + 1]));
      weight *= 3;
    }
    if (!((in.CroppingFlags >> region) & 1u))
    {
      open = false;
    }
    else if (open)
    {
      ends[count - 1] = cuts[i + 1];
    }
    else if (count < MaximumIntervals)
    {
      open = true;
      begins[count] = cuts[i];
      ends[count++] = cuts[i + 1];
    }
  }
  return count;
}

TETRALUX_INLINE Intervals LimitRays(const KernelInput& in, int px, int py, Double8 start,
  const Double8 (&origin)[3], const Double8 (&direction)[3])
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  Intervals result;
  Double8 begin = -Infinity;
  Double8 end = Infinity;
  const Double8 zero = 0.;
  for (int p = 0; p < in.NumberOfPlanes; ++p)
  {
    const double* plane = in.Planes[p].data();
    const Double8 n[3] = { plane[0], plane[1], plane[2] };
    const Double8 height = Dot(n, origin[0], origin[1], origin[2]) + Double8(plane[3]);
    const Double8 slope = Dot(n, direction[0], direction[1], direction[2]);
    const Double8 t = (zero - height) / slope;
    begin = Select(zero < slope, Max(begin, t), begin);
    end = Select(slope < zero, Min(end, t), end);
    // Parallel to the plane: all or nothing.
    end = Select((slope == zero) & (height < zero), Double8(-Infinity), end);
  }
  if (in.MaximumDistances)
  {
    double farthest[Width];
    for (int i = 0; i < Width; ++i)
    {
      const int x = px + i % 4;
      const int y = py + i / 4;
      farthest[i] = x < in.Grid->Width && y < in.Grid->Height
        ? static_cast<double>(
            in.MaximumDistances[static_cast<std::int64_t>(y) * in.Grid->Width + x])
        : -Infinity;
    }
    end = Min(end, LoadDouble8(farthest));
  }
  result.Count = 1;
  if (in.CroppingPlanes)
  {
    double o[3][Width], d[3][Width], b[Width], e[Width];
    for (int a = 0; a < 3; ++a)
    {
      const double* row = in.Grid->MeshFromWorld[a];
      const Double8 m[3] = { row[0], row[1], row[2] };
      Store(o[a], Dot(m, origin[0], origin[1], origin[2]) + Double8(row[3]));
      Store(d[a], Dot(m, direction[0], direction[1], direction[2]));
    }
    Store(b, begin);
    Store(e, end);
    double begins[MaximumIntervals][Width], ends[MaximumIntervals][Width];
    result.Count = 0;
    for (int i = 0; i < Width; ++i)
    {
      const double origin1[3] = { o[0][i], o[1][i], o[2][i] };
      const double direction1[3] = { d[0][i], d[1][i], d[2][i] };
      double begins1[MaximumIntervals], ends1[MaximumIntervals];
      const int count = CropRay(in, origin1, direction1, b[i], e[i], begins1, ends1);
      for (int k = 0; k < MaximumIntervals; ++k)
      {
        begins[k][i] = k < count ? begins1[k] : Infinity;
        ends[k][i] = k < count ? ends1[k] : -Infinity;
      }
      result.Count = count > result.Count ? count : result.Count;
    }
    for (int k = 0; k < result.Count; ++k)
    {
      result.Begin[k] = LoadDouble8(begins[k]) - start;
      result.End[k] = LoadDouble8(ends[k]) - start;
    }
    return result;
  }
  result.Begin[0] = begin - start;
  result.End[0] = end - start;
  return result;
}

/// The crossings of eight rays with the boundary, each ray's in ascending distance.
struct PacketCrossings
{
  int Count[Width];
};

/// False where the buffer was too small; it is larger then.
template <class Real>
inline bool FindCrossings(const KernelInput& in, const Rays<Real>& rays, Mask8 active,
  CrossingBuffer& buffer, PacketCrossings& crossings)
{
  for (int& n : crossings.Count)
  {
    n = 0;
  }
  if (!in.Nodes)
  {
    return true;
  }
  Float8 u[4], v[4], absU[3], absV[3];
  for (int a = 0; a < 4; ++a)
  {
    u[a] = ToFloat(rays.U[a]);
    v[a] = ToFloat(rays.V_[a]);
  }
  for (int a = 0; a < 3; ++a)
  {
    absU[a] = Abs(u[a]);
    absV[a] = Abs(v[a]);
  }
  // One child waits for each level above.
  std::int32_t stack[BoundaryBvh::MaximumDepth + 1];
  int top = 0;
  stack[top++] = 0;
  while (top > 0)
  {
    const std::int32_t nodeId = stack[--top];
    const BoundaryBvh::Node& node = in.Nodes[nodeId];
    // The box projected to the bounds of its shadow: no divisions, no special directions.
    const Float8 cx = node.Center[0], cy = node.Center[1], cz = node.Center[2];
    const Float8 hx = node.Half[0], hy = node.Half[1], hz = node.Half[2];
    const Float8 x = Fma(u[0], cx, Fma(u[1], cy, Fma(u[2], cz, u[3])));
    const Float8 y = Fma(v[0], cx, Fma(v[1], cy, Fma(v[2], cz, v[3])));
    const Mask8 near = (Abs(x) <= Dot(absU, hx, hy, hz)) & (Abs(y) <= Dot(absV, hx, hy, hz));
    if (!Any(near & active))
    {
      continue;
    }
    if (node.Count == 0)
    {
      stack[top++] = node.First;
      stack[top++] = nodeId + 1;
      continue;
    }
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      const std::int32_t entryId = in.Triangles[i];
      const WalkEntry& entry = in.Entries[entryId];
      const auto* points = static_cast<const WalkPoint<Real>*>(in.Points);
      Corner<Real> corners[3];
      for (int c = 0; c < 3; ++c)
      {
        const WalkPoint<Real>& p = points[entry.Points[c]];
        corners[c] = Project(rays, p.X, p.Y, p.Z, p.S, Int8(entry.Points[c]));
      }
      const TriangleHit<Real> t = TestTriangle(corners[0], corners[1], corners[2]);
      const Mask8 hit = t.Hit & active;
      unsigned bits = Bits(hit);
      if (bits == 0)
      {
        continue;
      }
      Real z[Width];
      const auto scale = typename LanesOf<Real>::Type(Real(1)) / (t.BC + t.CA + t.AB);
      Store(z, Blend(t.CA * scale, t.AB * scale, corners[0].Z, corners[1].Z, corners[2].Z));
      for (int lane = 0; bits != 0; ++lane, bits >>= 1)
      {
        if (!(bits & 1u))
        {
          continue;
        }
        int& count = crossings.Count[lane];
        if (count == buffer.Capacity)
        {
          buffer.Grow(buffer);
          return false;
        }
        // Insertion keeps the list ascending; lists are short.
        Crossing* list = buffer.Crossings + static_cast<std::int64_t>(lane) * buffer.Capacity;
        int k = count++;
        for (; k > 0 && list[k - 1].Distance > z[lane]; --k)
        {
          list[k] = list[k - 1];
        }
        list[k] = { z[lane], entryId };
      }
    }
  }
  return true;
}

/// What has been gathered along eight rays so far.
template <class Real>
struct Radiance
{
  using V = typename LanesOf<Real>::Type;
  Float8 Red = 0.f, Green = 0.f, Blue = 0.f;
  Float8 Transmittance = 1.f;
  V First = std::numeric_limits<Real>::infinity(); ///< distance of the first contribution
  Int8 Interval = 0; ///< where in the transfer function the last scalar was

  TETRALUX_INLINE void Add(Mask8 valid, V z, Float8 red, Float8 green, Float8 blue,
    Float8 transmittance, Mask8 contributes)
  {
    this->Red = Select(valid, Fma(this->Transmittance, red, this->Red), this->Red);
    this->Green = Select(valid, Fma(this->Transmittance, green, this->Green), this->Green);
    this->Blue = Select(valid, Fma(this->Transmittance, blue, this->Blue), this->Blue);
    this->Transmittance = Select(valid, this->Transmittance * transmittance, this->Transmittance);
    this->First = Select(contributes, Min(this->First, z), this->First);
  }
};

/// A cell of constant attenuation and colour from z0 to z1.
template <class Real, class V>
TETRALUX_INLINE void IntegrateCell(
  const KernelInput& in, Radiance<Real>& radiance, Mask8 valid, V z0, V z1, Int8 cell)
{
  Float8 attenuation, red, green, blue;
  GatherRows(reinterpret_cast<const float*>(in.CellValues), cell, attenuation, red, green, blue);
  const Float8 depth = Min(attenuation * ToFloat(z1 - z0), Float8(LargestDepth));
  const Mask8 contributes = valid & (Float8(0.f) < depth);
  if (!Any(contributes))
  {
    return;
  }
  Float8 opacity, transmittance;
  IntegrateConstant(depth, opacity, transmittance);
  radiance.Add(
    contributes, z0, red * opacity, green * opacity, blue * opacity, transmittance, contributes);
}

/// A cell whose scalar runs linearly from s0 at z0 to s1 at z1: cut at the nodes of the transfer
/// function, each piece integrated in closed form.
template <class Real, class V>
TETRALUX_INLINE void IntegratePieces(
  const KernelInput& in, Radiance<Real>& radiance, Mask8 valid, V z0, V s0, V z1, V s1)
{
  // A scalar that is not a number spoils the whole cell: it contributes nothing.
  const V ds = s1 - s0;
  valid = valid & (ds == ds);
  const auto* table = in.Intervals;
  while (Any(valid))
  {
    // Neighbouring rays are mostly in the same interval: one load for all of them.
    const unsigned bits = Bits(valid);
    std::int32_t indices[Width];
    Store(indices, radiance.Interval);
    int leader = 0;
    while (!((bits >> leader) & 1u))
    {
      ++leader;
    }
    const bool uniform = !Any(AndNot(valid, radiance.Interval == Int8(indices[leader])));
    Float8 lo, hi, reference, attenuation;
    Float8 attenuationSlope, red, green, blue;
    Float8 redSlope, greenSlope, blueSlope;
    if (uniform)
    {
      const IntervalTable::Interval& t = table[indices[leader]];
      lo = t.Lo;
      hi = t.Hi;
      reference = t.Reference;
      attenuation = t.Attenuation;
      attenuationSlope = t.AttenuationSlope;
      red = t.Color[0];
      green = t.Color[1];
      blue = t.Color[2];
      redSlope = t.ColorSlope[0];
      greenSlope = t.ColorSlope[1];
      blueSlope = t.ColorSlope[2];
    }
    else
    {
      const Int8 row = radiance.Interval + radiance.Interval + radiance.Interval;
      const auto* rows = reinterpret_cast<const float*>(table);
      Float8 unused;
      GatherRows(rows, row, lo, hi, reference, attenuation);
      GatherRows(rows, row + Int8(1), attenuationSlope, red, green, blue);
      GatherRows(rows, row + Int8(2), redSlope, greenSlope, blueSlope, unused);
    }
    V bottom, head, origin;
    if constexpr (sizeof(Real) == sizeof(float))
    {
      bottom = lo;
      head = hi;
      origin = reference;
    }
    else
    {
      bottom = ToDouble(lo);
      head = ToDouble(hi);
      origin = ToDouble(reference);
    }

    // The interval left from the last cell is mostly still the right one, else one of the next. A
    // constant scalar at a node belongs to the interval above it, whatever was seen before; compared
    // as the node was rounded.
    const Float8 f0 = ToFloat(s0);
    const Float8 f1 = ToFloat(s1);
    const Mask8 below = valid & (f0 < lo);
    const Mask8 above = valid & ((hi < f0) | ((hi == f0) & (f0 <= f1)));
    if (Any(below | above))
    {
      radiance.Interval = radiance.Interval + Ones(above) - Ones(below);
      continue;
    }

    const Mask8 last = (lo <= f1) & (f1 <= hi);
    const Mask8 more = AndNot(valid, last);
    V z = z1;
    V s = s1;
    if (Any(more))
    {
      s = Min(Max(s1, bottom), head);
      z = Select(last, z1, Fma((s - s0) / (s1 - s0), z1 - z0, z0));
    }
    V x[2] = { s0, s };
    if constexpr (sizeof(Real) > sizeof(float))
    {
      // What was compared as rounded may lie just outside of the interval, where the slope of one
      // only a few roundings wide leads far.
      x[0] = Min(Max(s0, bottom), head);
      x[1] = Min(Max(s, bottom), head);
    }
    const Float8 x0 = ToFloat(x[0] - origin);
    const Float8 x1 = ToFloat(x[1] - origin);
    const Float8 length = Keep(valid, ToFloat(z - z0));
    const Float8 zero = 0.f;
    const Float8 largest = LargestDepth;
    // Rounding may leave an attenuation just below zero where the function comes down to it.
    const Float8 d0 = Max(zero, Min(Fma(attenuationSlope, x0, attenuation) * length, largest));
    const Float8 d1 = Max(zero, Min(Fma(attenuationSlope, x1, attenuation) * length, largest));
    const Mask8 contributes = valid & (zero < d0 + d1);
    if (Any(contributes))
    {
      const SegmentWeights w = IntegrateSegment(d0, d1);
      const auto mix = [&](Float8 color, Float8 slope)
      { return Fma(Fma(slope, x0, color), w.Front, Fma(slope, x1, color) * w.Back); };
      radiance.Add(contributes, z0, mix(red, redSlope), mix(green, greenSlope),
        mix(blue, blueSlope), w.Transmittance, contributes);
    }
    if (!Any(more))
    {
      return;
    }
    const Mask8 rising = more & (s0 < s1);
    radiance.Interval = radiance.Interval + Ones(rising) - Ones(AndNot(more, rising));
    z0 = z;
    s0 = s;
    valid = more;
  }
}

/// Eight rays of neighbouring pixels on their way through the mesh.
///
/// The rays that are in the mesh take one cell each in every step.
template <class Real, bool CellData>
class Packet
{
public:
  using V = typename LanesOf<Real>::Type;

  Packet(const KernelInput& in, CrossingBuffer& buffer, KernelCounts& counts)
    : In(in)
    , Buffer(buffer)
    , Counts(counts)
  {
  }

  /// Casts the rays of the pixels from (x, y), those of them below (x1, y1).
  void Cast(int x, int y, int x1, int y1)
  {
    this->PixelX = x;
    this->PixelY = y;
    this->Inside = 0;
    for (int i = 0; i < Width; ++i)
    {
      this->Inside |= static_cast<unsigned>(x + i % 4 < x1 && y + i / 4 < y1) << i;
    }
    Double8 origin[3], direction[3];
    this->Ray = MakeRays<Real>(this->In, x, y, origin, direction);
    this->Limits = LimitRays(this->In, x, y, this->Ray.Start, origin, direction);
    this->Part = 0;
    this->Result = Radiance<Real>();
    this->BeginPart();
    while (this->Running)
    {
      this->Walk();
      this->Integrate();
    }
    this->WritePixels();
  }

private:
  /// From the face a b c of each ray's cell to the one that the fourth point makes with two of them.
  TETRALUX_INLINE void Walk()
  {
    const Corner<Real> p = LoadCorner<Real>(this->Ray, this->In.Points, this->Point);
    const V pa = Det(p, this->A);
    const V pb = Det(p, this->B);
    const V pc = Det(p, this->C);
    const V zero = Real(0);
    Mask8 aSide = zero < pa;
    Mask8 bSide = zero < pb;
    Mask8 cSide = zero < pc;
    if (Any((pa == zero) | (pb == zero) | (pc == zero)))
    {
      aSide = IsPositive(pa, p, this->A);
      bSide = IsPositive(pb, p, this->B);
      cSide = IsPositive(pc, p, this->C);
    }
    const Mask8 dropA = AndNot(bSide, cSide);
    const Mask8 dropB = AndNot(cSide, aSide);
    const Mask8 keepC = dropA | dropB;

    // The exit face is opposite to the dropped point, whose place among the cell's ascending ids
    // is the number of smaller ones.
    const Int8 dropped = Select(dropA, this->A.Id, Select(dropB, this->B.Id, this->C.Id));
    this->A.Id = Select(dropA, p.Id, this->A.Id);
    this->B.Id = Select(dropB, p.Id, this->B.Id);
    this->C.Id = Select(keepC, this->C.Id, p.Id);
    const Int8 face =
      Ones(dropped > this->A.Id) + Ones(dropped > this->B.Id) + Ones(dropped > this->C.Id);
    this->CellBefore = this->Cell;
    GatherPairs(reinterpret_cast<const std::int32_t*>(this->In.Faces),
      ShiftLeft(this->Cell, 2) + face, this->Cell, this->Point);

    // det(p, x) is the weight of the corner across; the replaced corner keeps its weight for p.
    const V wa = Select(dropA, this->WA, Abs(Select(dropB, pc, pb)));
    const V wb = Select(dropB, this->WB, Abs(Select(dropA, pc, pa)));
    this->WC = Select(keepC, Abs(Select(dropA, pb, pa)), this->WC);
    this->WA = wa;
    this->WB = wb;
    Replace(this->A, dropA, p);
    Replace(this->B, dropB, p);
    Replace(this->C, AndNot(MaskFromBits(0xff), keepC), p);
  }

  /// The integral over the cells of the last Walk, and what follows for rays at their end.
  TETRALUX_INLINE void Integrate()
  {
    const V z0 = this->Z;
    const V s0 = this->S;
    this->Interpolate();
    const V z1 = this->Z;
    const V s1 = this->S;
    const Mask8 running = MaskFromBits(this->Running);
    Mask8 valid = AndNot(running, z0 == z1);
    V zFrom = z0;
    V zTo = z1;
    V sFrom = s0;
    V sTo = s1;
    const Mask8 backward = z1 < z0;
    if (Any(running & (backward | (z0 < this->Near) | (this->Far < z1))))
    {
      // An inverted cell among others is walked from its far side to its near one; it is seen as
      // any other cell.
      const V zNear = Min(z0, z1);
      const V zFar = Max(z0, z1);
      zFrom = Max(zNear, this->Near);
      zTo = Min(zFar, this->Far);
      valid = valid & (zFrom < zTo);
      if constexpr (!CellData)
      {
        const V sNear = Select(backward, s1, s0);
        const V sFar = Select(backward, s0, s1);
        // By shares of the cell: a slope may overflow.
        const V ds = sFar - sNear;
        const V dz = zFar - zNear;
        sFrom = Select(zNear < this->Near, Fma((zFrom - zNear) / dz, ds, sNear), sNear);
        sTo = Select(this->Far < zFar, Fma((zTo - zNear) / dz, ds, sNear), sFar);
      }
    }
    if constexpr (CellData)
    {
      IntegrateCell<Real>(this->In, this->Result, valid, zFrom, zTo, this->CellBefore);
    }
    else
    {
      IntegratePieces<Real>(this->In, this->Result, valid, zFrom, sFrom, zTo, sTo);
    }
    ++this->Counts.Steps;
    this->Counts.Segments += __builtin_popcount(this->Running);

    // Rays that are opaque or past their end are done; rays that left the mesh may enter again.
    const Mask8 done = this->IsOpaque() | (this->Far <= z1);
    const Mask8 outside = Int8(0) > this->Cell;
    const unsigned doneBits = Bits(done) & this->Running;
    const unsigned outsideBits = Bits(outside);
    if ((doneBits | outsideBits) != 0)
    {
      this->Leave(outside, outsideBits, doneBits);
    }
  }

  static TETRALUX_INLINE void Replace(Corner<Real>& corner, Mask8 m, const Corner<Real>& p)
  {
    corner.X = Select(m, p.X, corner.X);
    corner.Y = Select(m, p.Y, corner.Y);
    corner.Z = Select(m, p.Z, corner.Z);
    corner.S = Select(m, p.S, corner.S);
  }

  TETRALUX_INLINE Mask8 IsOpaque() const
  {
    return this->Result.Transmittance <= Float8(this->In.MinimumTransmittance);
  }

  /// Distance and scalar where each ray goes through its triangle.
  TETRALUX_INLINE void Interpolate()
  {
    // Weights are areas as large as 2^84: made shares first, so that no product overflows.
    const V scale = V(Real(1)) / (this->WA + this->WB + this->WC);
    const V b = this->WB * scale;
    const V c = this->WC * scale;
    this->Z = Blend(b, c, this->A.Z, this->B.Z, this->C.Z);
    if constexpr (!CellData)
    {
      this->S = Blend(b, c, this->A.S, this->B.S, this->C.S);
    }
  }

  Crossing* GetCrossings(int lane) const
  {
    return this->Buffer.Crossings + static_cast<std::int64_t>(lane) * this->Buffer.Capacity;
  }

  /// Starts the next part of the rays that has anything in it, if there is one.
  void BeginPart()
  {
    for (; this->Part < this->Limits.Count; ++this->Part)
    {
      const Double8 begin = this->Limits.Begin[this->Part];
      const Double8 end = this->Limits.End[this->Part];
      const unsigned active = this->Inside & Bits(begin < end) & ~Bits(this->IsOpaque());
      // Walking strikes crossings off, so each part of the rays finds them anew.
      while (
        !FindCrossings(this->In, this->Ray, MaskFromBits(active), this->Buffer, this->Crossings))
      {
      }
      unsigned hit = 0;
      for (int i = 0; i < Width; ++i)
      {
        this->Cursor[i] = 0;
        hit |= static_cast<unsigned>(this->Crossings.Count[i] > 0) << i;
      }
      Store(this->FarOf, end);
      if constexpr (sizeof(Real) == sizeof(float))
      {
        this->Near = ToFloat(begin);
        this->Far = ToFloat(end);
      }
      else
      {
        this->Near = begin;
        this->Far = end;
      }
      // Lanes without a ray rest in any cell; lanes with one are put where they start.
      this->Cell = 0;
      this->Point = 0;
      this->Running = 0;
      if (active & hit)
      {
        this->A = this->B = this->C = LoadCorner<Real>(this->Ray, this->In.Points, Int8(0));
        this->WA = this->WB = this->WC = Real(1);
        this->Z = this->S = Real(0);
        this->Enter(active & hit);
      }
      if (this->Running)
      {
        return;
      }
    }
  }

  /// The nearest crossing of a ray that was not walked from or to yet; -1 where there is none.
  std::int32_t TakeEntry(int lane)
  {
    Crossing* list = this->GetCrossings(lane);
    int& k = this->Cursor[lane];
    const int n = this->Crossings.Count[lane];
    while (k < n && list[k].Entry < 0)
    {
      ++k;
    }
    if (k == n || list[k].Distance > this->FarOf[lane])
    {
      return -1;
    }
    const std::int32_t entry = list[k].Entry;
    list[k].Entry = -1;
    return entry;
  }

  /// Puts the rays of some lanes at their next entry into the mesh, if they have one.
  void Enter(unsigned lanes)
  {
    std::int32_t cells[Width] = {}, opposites[Width] = {}, corners[3][Width] = {};
    for (int lane = 0; lane < Width; ++lane)
    {
      if (!((lanes >> lane) & 1u))
      {
        continue;
      }
      const std::int32_t entryId = this->TakeEntry(lane);
      if (entryId < 0)
      {
        lanes &= ~(1u << lane);
        continue;
      }
      const WalkEntry& entry = this->In.Entries[entryId];
      for (int k = 0; k < 3; ++k)
      {
        corners[k][lane] = entry.Points[k];
      }
      cells[lane] = entry.Cell;
      opposites[lane] = entry.Opposite;
      ++this->Counts.Paths;
    }
    if (lanes == 0)
    {
      return;
    }
    const Mask8 start = MaskFromBits(lanes);
    const Corner<Real> p = LoadCorner<Real>(this->Ray, this->In.Points, LoadInt8(corners[0]));
    const Corner<Real> q = LoadCorner<Real>(this->Ray, this->In.Points, LoadInt8(corners[1]));
    const Corner<Real> r = LoadCorner<Real>(this->Ray, this->In.Points, LoadInt8(corners[2]));
    const TriangleHit<Real> t = TestTriangle(p, q, r);
    // Counter-clockwise from here on: a step replaces one corner and keeps the others' places.
    this->A = Select(start, p, this->A);
    this->B = Select(start, Select(t.Clockwise, r, q), this->B);
    this->C = Select(start, Select(t.Clockwise, q, r), this->C);
    this->WA = Select(start, Abs(t.BC), this->WA);
    this->WB = Select(start, Abs(Select(t.Clockwise, t.AB, t.CA)), this->WB);
    this->WC = Select(start, Abs(Select(t.Clockwise, t.CA, t.AB)), this->WC);
    this->Cell = Select(start, LoadInt8(cells), this->Cell);
    this->Point = Select(start, LoadInt8(opposites), this->Point);
    this->Interpolate();
    this->Running |= lanes;
  }

  /// Ends or re-enters the rays that left the mesh, ends those that are done.
  void Leave(Mask8 outside, unsigned outsideBits, unsigned doneBits)
  {
    const unsigned leaving = this->Running & outsideBits & ~doneBits;
    this->Running &= ~(doneBits | outsideBits);
    std::int32_t exits[Width];
    Store(exits, this->Cell);
    // Lanes at rest go on from cell to cell without effect; what they load must exist.
    this->Cell = Select(outside, Int8(0), this->Cell);
    this->Point = Select(outside, Int8(0), this->Point);
    for (int lane = 0; lane < Width; ++lane)
    {
      if (!((leaving >> lane) & 1u))
      {
        continue;
      }
      Crossing* list = this->GetCrossings(lane);
      for (int k = this->Cursor[lane]; k < this->Crossings.Count[lane]; ++k)
      {
        if (list[k].Entry == ~exits[lane])
        {
          list[k].Entry = -1;
          break;
        }
      }
    }
    if (leaving)
    {
      this->Enter(leaving);
    }
    if (this->Running == 0)
    {
      ++this->Part;
      this->BeginPart();
    }
  }

  void WritePixels()
  {
    float red[Width], green[Width], blue[Width], transmittance[Width];
    Real first[Width];
    double start[Width];
    Store(red, this->Result.Red);
    Store(green, this->Result.Green);
    Store(blue, this->Result.Blue);
    Store(transmittance, this->Result.Transmittance);
    Store(first, this->Result.First);
    Store(start, this->Ray.Start);
    for (int i = 0; i < Width; ++i)
    {
      if (!((this->Inside >> i) & 1u))
      {
        continue;
      }
      const std::int64_t pixel =
        static_cast<std::int64_t>(this->PixelY + i / 4) * this->In.Grid->Width + this->PixelX +
        i % 4;
      float* color = this->In.Colors + 4 * pixel;
      color[0] = red[i];
      color[1] = green[i];
      color[2] = blue[i];
      color[3] = 1.f - transmittance[i];
      const bool contributed = first[i] < std::numeric_limits<Real>::infinity();
      this->In.Depths[pixel] =
        contributed ? static_cast<float>(start[i] + static_cast<double>(first[i])) : -1.f;
    }
  }

  const KernelInput& In;
  CrossingBuffer& Buffer;
  KernelCounts& Counts;

  // The rays and what is left to do for them.
  int PixelX, PixelY;
  unsigned Inside;      ///< lanes with a pixel
  unsigned Running = 0; ///< lanes whose ray is in the mesh
  Rays<Real> Ray;
  Intervals Limits;
  int Part; ///< of the limits
  double FarOf[Width];
  PacketCrossings Crossings;
  int Cursor[Width]; ///< first crossing of each ray that may still be an entry

  // Where the rays are: in a cell, on the triangle A B C through which they entered it.
  V Near, Far; ///< ends of the part
  Corner<Real> A, B, C;
  V WA, WB, WC; ///< weights of the corners at the ray, twice the areas across; not normalised
  V Z, S;       ///< distance and scalar there
  Int8 Cell, CellBefore;
  Int8 Point; ///< the cell's fourth point

  Radiance<Real> Result;
};

template <class Real, bool CellData>
void CastRays(const KernelInput& in, int x0, int y0, int x1, int y1, CrossingBuffer& buffer,
  KernelCounts& counts)
{
  Packet<Real, CellData> packet(in, buffer, counts);
  for (int y = y0; y < y1; y += 2)
  {
    for (int x = x0; x < x1; x += 4)
    {
      packet.Cast(x, y, x1, y1);
    }
  }
}

RayCastKernels MakeRayCastKernels()
{
  return { &CastRays<float, false>, &CastRays<double, false>, &CastRays<float, true>,
    &CastRays<double, true> };
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
