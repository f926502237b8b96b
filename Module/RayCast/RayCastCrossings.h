// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastCrossings_h
#define tetralux_RayCastCrossings_h

// Where the rays of a packet cross the boundary.

#include "RayCast/RayCastFrame.h"
#include "RayCast/RayCastIntervals.h"
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
  V Smallest;      ///< of those, without their signs
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
  t.Smallest = Min(Min(Abs(t.BC), Abs(t.CA)), Abs(t.AB));
  if (Any(t.Smallest <= zero))
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

/// How often rays cross the boundary, where CrossingBuffer tells; and which rays pass an edge of
/// the boundary so closely that rounding may decide on which side.
struct PacketCrossings
{
  int Count; ///< faces that any ray crosses
  Int8 Left; ///< crossings of each ray that it has not walked from or to
  unsigned NearEdges;
  unsigned Displaced = 0; ///< rays that were displaced
  Float8 ShiftError;      ///< of each ray, see KernelInput::ShiftFactor
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
  // Mostly none is, by what is no less than the longest of the three.
  const V lengths = (Abs(b.X - a.X) + Abs(b.Y - a.Y)) + (Abs(c.X - a.X) + Abs(c.Y - a.Y));
  constexpr Real Rounded = Real(1.001); // of sums of four
  if (!Any(t.Smallest <= distance * V(Rounded) * lengths))
  {
    return MaskFromBits(0);
  }
  return IsNearEdge(b, c, t.BC, distance, begin) | IsNearEdge(c, a, t.CA, distance, begin) |
    IsNearEdge(a, b, t.AB, distance, begin);
}

template <class Real>
TETRALUX_INLINE Real* GetDistances(FaceCrossing& crossing)
{
  static_assert(LaneCount * sizeof(Real) <= sizeof(crossing.Distances));
  if constexpr (sizeof(Real) == sizeof(float))
  {
    return crossing.Distances.Single;
  }
  else
  {
    return crossing.Distances.Double;
  }
}

/// The attenuation at scalars, or of the cell behind a face. Apart, since few faces need it.
TETRALUX_NOINLINE Float8 FindAttenuation(const KernelInput& in, Float8 scalar, std::int32_t cell)
{
  if (in.CellValues)
  {
    return in.CellValues[cell].Attenuation;
  }
  const Int8 interval = FindInterval(in, [&](Float8 end) { return end < scalar; });
  const IntervalLanes t = LoadInterval(in, interval);
  return Fma(t.AttenuationSlope, scalar - t.Reference, t.Attenuation);
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
  const Mask8 large = AndNot(hit, most <= Float8(0.0625f * in.LargestShiftError));
  if (!Any(large))
  {
    return;
  }
  const Float8 attenuation = FindAttenuation(in, Blend(weightB, weightC, a.S, b.S, c.S), cell);
  const Mask8 visible = large & (Float8(0.f) < attenuation); // and it is a number
  const Float8 share = attenuation * Float8(1 / in.LargestAttenuation);
  crossings.ShiftError = crossings.ShiftError + Keep(visible, most * share);
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
  if (!Any(hit))
  {
    return true;
  }
  if (crossings.Count == buffer.Capacity)
  {
    buffer.Grow(buffer);
    return false;
  }
  const auto scale = typename LanesOf<Real>::Type(Real(1)) / (t.BC + t.CA + t.AB);
  const auto wb = t.CA * scale;
  const auto wc = t.AB * scale;
  FaceCrossing& crossing = buffer.Crossings[crossings.Count++];
  Store(GetDistances<Real>(crossing), Blend(wb, wc, corners[0].Z, corners[1].Z, corners[2].Z));
  crossing.Entry = entryId;
  crossing.Lanes = Bits(hit);
  crossings.Left = crossings.Left + Ones(hit);
  if constexpr (sizeof(Real) == sizeof(float))
  {
    if (in.ShiftFactor > 0)
    {
      AddShiftErrors(in, corners, hit, scale, wb, wc, entry.Cell, crossings);
    }
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

/// The nearest crossings of rays.
template <class Real>
struct NearestCrossings
{
  typename LanesOf<Real>::Type Distance; ///< infinite where a ray has none left
  Int8 Place;                            ///< in CrossingBuffer, where there is one
  Int8 Entry;                            ///< index into KernelInput::Entries
};

/// Finds the nearest of the crossings that rays have left. Of those at one distance it takes the
/// one with the lowest number, so that the order is the same however faces were found.
template <class Real>
TETRALUX_INLINE NearestCrossings<Real> FindNearest(
  const CrossingBuffer& buffer, const PacketCrossings& crossings, unsigned lanes)
{
  using V = typename LanesOf<Real>::Type;
  NearestCrossings<Real> nearest{ V(std::numeric_limits<Real>::infinity()), Int8(0), Int8(0) };
  for (int place = 0; place < crossings.Count; ++place)
  {
    FaceCrossing& crossing = buffer.Crossings[place];
    const unsigned bits = crossing.Lanes & lanes;
    if (bits == 0)
    {
      continue;
    }
    const V z = LoadLanes(GetDistances<Real>(crossing));
    const Int8 entry = crossing.Entry;
    const Mask8 nearer = MaskFromBits(bits) &
      ((z < nearest.Distance) | ((z == nearest.Distance) & (nearest.Entry > entry)));
    nearest.Distance = Select(nearer, z, nearest.Distance);
    nearest.Place = Select(nearer, Int8(place), nearest.Place);
    nearest.Entry = Select(nearer, entry, nearest.Entry);
  }
  return nearest;
}

/// Strikes off where rays leave the mesh, of those that have several crossings left.
inline void StrikeExits(
  CrossingBuffer& buffer, const PacketCrossings& crossings, unsigned lanes, Int8 exits)
{
  for (int place = 0; place < crossings.Count && lanes != 0; ++place)
  {
    FaceCrossing& crossing = buffer.Crossings[place];
    const unsigned struck = crossing.Lanes & lanes & Bits(exits == Int8(crossing.Entry));
    crossing.Lanes &= ~struck;
    lanes &= ~struck;
  }
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
  crossings.Count = 0;
  crossings.Left = 0;
  crossings.ShiftError = 0.f;
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
