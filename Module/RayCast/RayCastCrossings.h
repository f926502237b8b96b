// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastCrossings_h
#define tetralux_RayCastCrossings_h

// Where the rays of a packet cross the boundary.

#include "RayCast/RayCastFrame.h"
#include "View/RayDisplacements.h"

#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

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
  const Mask8 all = MaskFromBits(AllLanes);
  t.Clockwise = AndNot(all, p | q | r);
  t.Hit = (p & q & r) | t.Clockwise;
  return t;
}

/// What the projection of a point may be off by across a ray, in radii: four times the rounding of
/// a coordinate, which is rounded in the tables and by each of the three sums that project it.
template <class Real>
constexpr double ProjectionRounding = 2. * std::numeric_limits<Real>::epsilon();

/// How much farther than ShiftRounding rays are displaced.
constexpr float DisplacementRatio = static_cast<float>(FarthestDisplacement / ShiftRounding);

/// The number of each ray's crossings with the boundary, which CrossingBuffer holds in ascending
/// distance; and which rays pass an edge of the boundary so closely that rounding may decide on
/// which side.
struct PacketCrossings
{
  int Count[LaneCount];
  unsigned NearEdges;
  unsigned Displaced = 0;       ///< rays that were displaced
  double ShiftError[LaneCount]; ///< of each ray, see KernelInput::ShiftFactor
};

/// Which rays pass the edge from a to b within a distance, by det(a, b), behind a begin.
template <class Real>
TETRALUX_INLINE Mask8 IsNearEdge(const Corner<Real>& a, const Corner<Real>& b,
  typename LanesOf<Real>::Type det, typename LanesOf<Real>::Type distance,
  typename LanesOf<Real>::Type begin)
{
  using V = typename LanesOf<Real>::Type;
  const V x = b.X - a.X;
  const V y = b.Y - a.Y;
  // The length by the sum of its coordinates: up to 1.4 times too long.
  const V length = Abs(x) + Abs(y);
  Mask8 near = Abs(det) <= distance * length;
  if (!Any(near))
  {
    return near;
  }
  // Not beside its ends: by less than four times the distance.
  const V lowest = V(Real(0)) - distance;
  near = near & (Min(a.X, b.X) <= distance) & (lowest <= Max(a.X, b.X)) &
    (Min(a.Y, b.Y) <= distance) & (lowest <= Max(a.Y, b.Y));
  // An edge along the ray has no line across it that means anything: its ends count.
  const Mask8 isPoint = length <= distance * V(Real(8));
  // Where along the ray; of an edge that is all near to it, the far end.
  const V zero = Real(0);
  const V share = Min(Max((zero - Fma(a.X, x, a.Y * y)) / Fma(x, x, y * y), zero), V(Real(1)));
  const V z = Select(isPoint, Max(a.Z, b.Z), Fma(share, b.Z - a.Z, a.Z));
  return near & (begin < z);
}

/// Where along the rays edges begin to count: a little behind the start. All rays from a point of
/// the boundary pass edges there, and are displaced by nothing that is worth it.
template <class Real>
TETRALUX_INLINE typename LanesOf<Real>::Type GetBeginOfEdges(const Rays<Real>& rays)
{
  using V = typename LanesOf<Real>::Type;
  // World units. By the sum of its coordinates, up to 1.8 times too long: their squares may be more
  // or less than single precision has numbers for.
  const V radius = Abs(rays.W[0]) + Abs(rays.W[1]) + Abs(rays.W[2]);
  V start;
  if constexpr (sizeof(Real) == sizeof(float))
  {
    start = ToFloat(rays.Start);
  }
  else
  {
    start = rays.Start;
  }
  return Fma(V(static_cast<Real>(FarthestDisplacement)), radius, V(Real(0)) - start);
}

/// Which rays pass an edge of a triangle within ProjectionRounding.
template <class Real>
TETRALUX_INLINE Mask8 AreNearEdges(const TriangleHit<Real>& t, const Corner<Real>& a,
  const Corner<Real>& b, const Corner<Real>& c, typename LanesOf<Real>::Type begin)
{
  using V = typename LanesOf<Real>::Type;
  const V distance = static_cast<Real>(ProjectionRounding<Real> * ProjectionScale);
  return IsNearEdge(b, c, t.BC, distance, begin) | IsNearEdge(c, a, t.CA, distance, begin) |
    IsNearEdge(a, b, t.AB, distance, begin);
}

/// Whether a crossing is behind one at a distance; where both are at one, by the faces' numbers, so
/// that the order is the same however faces are found.
inline bool IsBehind(const Crossing& crossing, double distance, std::int32_t entry)
{
  return crossing.Distance > distance || (crossing.Distance == distance && crossing.Entry > entry);
}

/// The attenuation at a scalar, or of the cell behind a face.
inline float FindAttenuation(const KernelInput& in, float scalar, std::int32_t cell)
{
  if (in.CellValues)
  {
    return in.CellValues[cell].Attenuation;
  }
  int first = 0;
  int last = in.NumberOfIntervals - 1;
  while (first < last)
  {
    const int middle = (first + last) / 2;
    if (in.Intervals[middle].Hi < scalar)
    {
      first = middle + 1;
    }
    else
    {
      last = middle;
    }
  }
  const IntervalTable::Interval& interval = in.Intervals[first];
  return interval.Attenuation + interval.AttenuationSlope * (scalar - interval.Reference);
}

/// Adds what the colours of rays change by if rounding moves a face of the boundary across them:
/// the face moves along a ray by its slope times that, and the attenuation begins or ends there.
/// weightB, weightC: of corners, where rays cross the face.
TETRALUX_INLINE void AddShiftErrors(const KernelInput& in, const Corner<float> (&corners)[3],
  Mask8 hit, Float8 inverseArea, Float8 weightB, Float8 weightC, std::int32_t cell,
  PacketCrossings& crossings)
{
  const Corner<float>& a = corners[0];
  const Corner<float>& b = corners[1];
  const Corner<float>& c = corners[2];
  const Float8 bz = b.Z - a.Z;
  const Float8 cz = c.Z - a.Z;
  const Float8 slopeX = (bz * (c.Y - a.Y) - cz * (b.Y - a.Y)) * inverseArea;
  const Float8 slopeY = ((b.X - a.X) * cz - (c.X - a.X) * bz) * inverseArea;
  const Mask8 displaced = MaskFromBits(crossings.Displaced);
  const Float8 factor =
    Select(displaced, Float8(DisplacementRatio * in.ShiftFactor), Float8(in.ShiftFactor));
  const Float8 most = (Abs(slopeX) + Abs(slopeY)) * factor;
  // Only what is a good part of what is allowed is worth a closer look.
  unsigned bits = Bits(AndNot(hit, most <= Float8(0.0625f * in.LargestShiftError)));
  if (bits == 0)
  {
    return;
  }
  float errors[LaneCount], scalars[LaneCount];
  Store(errors, most);
  Store(scalars, Blend(weightB, weightC, a.S, b.S, c.S));
  for (int lane = 0; bits != 0; ++lane, bits >>= 1)
  {
    const float attenuation = (bits & 1u) ? FindAttenuation(in, scalars[lane], cell) : 0.f;
    if (attenuation > 0) // and it is a number
    {
      crossings.ShiftError[lane] += errors[lane] * (attenuation / in.LargestAttenuation);
    }
  }
}

/// Adds where rays cross a face of the boundary. False where the buffer was too small; it is larger
/// then.
template <class Real>
TETRALUX_INLINE bool AddCrossings(const KernelInput& in, const Rays<Real>& rays, Mask8 active,
  typename LanesOf<Real>::Type beginOfEdges, std::int32_t entryId, CrossingBuffer& buffer,
  PacketCrossings& crossings)
{
  const WalkEntry& entry = in.Entries[entryId];
  const auto* points = static_cast<const WalkPoint<Real>*>(in.Points);
  Corner<Real> corners[3];
  for (int c = 0; c < 3; ++c)
  {
    const WalkPoint<Real>& p = points[entry.Points[c]];
    corners[c] = Project(rays, p.X, p.Y, p.Z, p.S, Int8(entry.Points[c]));
  }
  const TriangleHit<Real> t = TestTriangle(corners[0], corners[1], corners[2]);
  crossings.NearEdges |=
    Bits(AreNearEdges(t, corners[0], corners[1], corners[2], beginOfEdges) & active);
  const Mask8 hit = t.Hit & active;
  unsigned bits = Bits(hit);
  if (bits == 0)
  {
    return true;
  }
  Real z[LaneCount];
  const auto scale = typename LanesOf<Real>::Type(Real(1)) / (t.BC + t.CA + t.AB);
  const auto wb = t.CA * scale;
  const auto wc = t.AB * scale;
  Store(z, Blend(wb, wc, corners[0].Z, corners[1].Z, corners[2].Z));
  if constexpr (sizeof(Real) == sizeof(float))
  {
    if (in.ShiftFactor > 0)
    {
      AddShiftErrors(in, corners, hit, scale, wb, wc, entry.Cell, crossings);
    }
  }
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
    for (; k > 0 && IsBehind(list[k - 1], z[lane], entryId); --k)
    {
      list[k] = list[k - 1];
    }
    list[k] = { z[lane], entryId };
  }
  return true;
}

/// Finds where rays cross the boundary, by the hierarchy over it. False where the buffer was too
/// small; it is larger then.
template <class Real>
inline bool FindCrossingsByHierarchy(const KernelInput& in, const Rays<Real>& rays, Mask8 active,
  typename LanesOf<Real>::Type beginOfEdges, CrossingBuffer& buffer, PacketCrossings& crossings)
{
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
      if (!AddCrossings(in, rays, active, beginOfEdges, in.Triangles[i], buffer, crossings))
      {
        return false;
      }
    }
  }
  return true;
}

/// Faces of the boundary that a packet has to test: those of its tile with the bit of one of its
/// blocks.
struct PacketFaces
{
  const TileFace* Begin;
  const TileFace* End;
  std::uint32_t Blocks;
};

/// Finds where rays cross the boundary. False where the buffer was too small; it is larger then.
/// faces: where there are KernelInput::TileFaces.
template <class Real>
inline bool FindCrossings(const KernelInput& in, const PacketFaces& faces, const Rays<Real>& rays,
  Mask8 active, CrossingBuffer& buffer, PacketCrossings& crossings)
{
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    crossings.Count[lane] = 0;
    crossings.ShiftError[lane] = 0;
  }
  crossings.NearEdges = 0;
  if (!in.Nodes)
  {
    return true;
  }
  const auto beginOfEdges = GetBeginOfEdges(rays);
  if (!in.TileFaces)
  {
    return FindCrossingsByHierarchy(in, rays, active, beginOfEdges, buffer, crossings);
  }
  for (const TileFace* face = faces.Begin; face != faces.End; ++face)
  {
    if ((face->Blocks & faces.Blocks) != 0 &&
      !AddCrossings(in, rays, active, beginOfEdges, face->Entry, buffer, crossings))
    {
      return false;
    }
  }
  return true;
}

/// Finds where rays cross the boundary, and displaces those first that pass edges of it too
/// closely, see RayDisplacements.
template <class Real>
inline void FindClearCrossings(const KernelInput& in, const PacketFaces& faces, Rays<Real>& rays,
  Mask8 active, CrossingBuffer& buffer, PacketCrossings& crossings)
{
  using V = typename LanesOf<Real>::Type;
  const V u = rays.U[3];
  const V v = rays.V_[3];
  crossings.Displaced = 0;
  for (int next = 0;; ++next)
  {
    while (!FindCrossings(in, faces, rays, active, buffer, crossings))
    {
    }
    if (crossings.NearEdges == 0 || next == NumberOfRayDisplacements)
    {
      return;
    }
    const double unit = ProjectionRounding<Real> * ProjectionScale;
    const Mask8 near = MaskFromBits(crossings.NearEdges);
    crossings.Displaced |= crossings.NearEdges;
    rays.U[3] = Select(near, u - V(static_cast<Real>(unit * RayDisplacements[next][0])), rays.U[3]);
    rays.V_[3] =
      Select(near, v - V(static_cast<Real>(unit * RayDisplacements[next][1])), rays.V_[3]);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
