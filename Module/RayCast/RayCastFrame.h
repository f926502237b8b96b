// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastFrame_h
#define tetralux_RayCastFrame_h

// The frame of its own in which each ray of a packet sees the mesh, see RayCastKernel.inl.

#include "Base/Check.h"
#include "Lighting/WorldRays.h"
#include "RayCast/RayCastKernel.h"
#include "Simd/Lanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

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

/// For checks: whether the indices of these lanes are in 0..count - 1.
TETRALUX_INLINE bool AreBelow(Mask8 lanes, Int8 index, std::int32_t count)
{
  return !Any(lanes & ((Int8(0) > index) | (index > Int8(count - 1))));
}

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

TETRALUX_INLINE Float8 LoadLanes(const float* p) { return LoadFloat8(p); }
TETRALUX_INLINE Double8 LoadLanes(const double* p) { return LoadDouble8(p); }

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
  const V sizeX = Abs(c.X);
  const V sizeY = Abs(c.Y);
  if (Any(Min(sizeX, sizeY) < smallest))
  {
    c.X = Keep(smallest <= sizeX, c.X);
    c.Y = Keep(smallest <= sizeY, c.Y);
  }
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

/// Whether a zero det(a, b) counts as positive, as if the ray were displaced by
/// e (1, -ShiftSlope) + e^2 (0, 1): by the height of b above a across the first displacement, by x
/// where they are at one height, and by ids where the projections coincide.
template <class Real>
TETRALUX_INLINE Mask8 TieIsPositive(const Corner<Real>& a, const Corner<Real>& b)
{
  using V = typename LanesOf<Real>::Type;
  const V slope = static_cast<Real>(ShiftSlope);
  const V heightA = Fma(slope, a.X, a.Y);
  const V heightB = Fma(slope, b.X, b.Y);
  const Mask8 sameHeight = heightA == heightB;
  const Mask8 sameX = a.X == b.X;
  return (heightB < heightA) | (sameHeight & ((a.X < b.X) | (sameX & (b.Id > a.Id))));
}

template <class V, class Real>
TETRALUX_INLINE Mask8 IsPositive(V det, const Corner<Real>& a, const Corner<Real>& b)
{
  return (V(Real(0)) < det) | ((det == V(Real(0))) & TieIsPositive(a, b));
}

/// Interpolates three values by weights whose sum is 1; the weight of a is left out. Adds
/// differences, so that a constant stays exactly what it is, next to a step of the transfer
/// function too.
template <class V>
TETRALUX_INLINE V Blend(V wb, V wc, V a, V b, V c)
{
  return Fma(wb, b - a, Fma(wc, c - a, a));
}

/// Pixels of a packet, whose rays are cast together, one in each lane. Nearly square, so that the
/// rays stay in the same cells for long. As wide as a block, so that lanes are blocks one above the
/// other.
///@{
constexpr int PacketWidth = BlockWidth;
constexpr int PacketHeight = LaneCount / PacketWidth;
constexpr int BlocksOfPacket = PacketHeight / BlockHeight;
constexpr int LanesOfBlock = BlockWidth * BlockHeight;
///@}
static_assert(BlocksOfPacket * LanesOfBlock == LaneCount && LaneCount <= MostLanes);

/// The lanes of a block of a packet.
constexpr unsigned GetLanesOfBlock(int block)
{
  return ((1u << LanesOfBlock) - 1) << (block * LanesOfBlock);
}

/// Where a lane's pixel is in its packet: row by row.
///@{
constexpr int GetLaneColumn(int lane) { return lane % PacketWidth; }
constexpr int GetLaneRow(int lane) { return lane / PacketWidth; }
///@}

/// The rays of the packet whose first pixel is (px, py).
TETRALUX_INLINE WorldRays MakeWorldRays(const RayGrid& grid, int px, int py)
{
  double x[LaneCount], y[LaneCount];
  for (int i = 0; i < LaneCount; ++i)
  {
    x[i] = px + GetLaneColumn(i);
    y[i] = py + GetLaneRow(i);
  }
  return MakeWorldRays(grid, LoadDouble8(x), LoadDouble8(y));
}

/// The frames of rays.
template <class Real>
TETRALUX_INLINE Rays<Real> MakeRays(const KernelInput& in, const WorldRays& world)
{
  const RayGrid& grid = *in.Grid;
  const Double8(&origin)[3] = world.Origin;
  const Double8(&direction)[3] = world.Direction;

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
  // Two vectors across the ray.
  Double8 u[3], v[3];
  if (in.Axes.Common)
  {
    for (int a = 0; a < 3; ++a)
    {
      u[a] = in.Axes.First[a];
      v[a] = in.Axes.Second[a];
    }
  }
  else
  {
    // Duff et al., Building an Orthonormal Basis, Revisited, 2017.
    const Double8 one = 1.;
    const Double8 sign = Select(n[2] < Double8(0.), Double8(-1.), one);
    const Double8 p = Double8(-1.) / (sign + n[2]);
    const Double8 q = n[0] * n[1] * p;
    u[0] = one + sign * n[0] * n[0] * p;
    u[1] = sign * q;
    u[2] = Double8(0.) - sign * n[0];
    v[0] = q;
    v[1] = sign + n[1] * n[1] * p;
    v[2] = Double8(0.) - n[1];
  }

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

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
