// SPDX-License-Identifier: BSD-3-Clause
// The frame of its own in which each ray sees the mesh, and exact edge tests in it: the means by
// which rays go from cell to cell, see RayCastFrame.h and RayCastKernel.inl. Needs GetRay.
//
// Why no ray is lost or counted twice, whatever a compiler makes of sums and products:
// * Across the ray, points are rounded to a grid of 2^-22 radii of the mesh, not much coarser than
//   their coordinates: whole numbers, the same whichever cell asks. Where the language has a word
//   for it (precise), it is told so; all of them are projected by the same function.
// * The determinant of two of them is exact, but for one rounding of the result, which leaves its
//   sign. It is put together from products of halves. They and their sums are whole numbers up to
//   2^24, which single precision holds, in whatever order or fusion they are computed.
// * Zero, a ray through an edge or a vertex, is decided as if the ray were displaced by
//   e (8, -3) + e^2 (0, 1), e infinitely small, see ShiftSlope in View/RayAcross.h; where two
//   points are in the same place, by their ids.
// * Faces that touch but do not share their points are rounded each on its own. Rays that pass
//   edges of the boundary within that rounding are displaced, see View/RayDisplacements.h.

#ifdef GL_ARB_gpu_shader5
#define SAME_EVERYWHERE precise
#else
#define SAME_EVERYWHERE
#endif

// Coordinates in radii, and the mapped scalar.
uniform samplerBuffer walkPoints;

// Grid points a radius. Points and rays that meet the mesh are within a radius of its centre, so
// that grid coordinates are within 2^23.
const float GridScale = 4194304.0; // 2^22
const float LargestGridCoordinate = 8388607.0; // 2^23 - 1

// Grid coordinates are HalfScale high + low, with high and low within 2^11.
const float HalfScale = 4096.0;

struct RayFrame
{
  vec4 Across[2]; // a grid coordinate is Across . (point, 1)
  vec3 Along;     // Along . point: distance from the point of the ray nearest to the centre, units
  float Start;    // distance from where the ray starts to that point, units
};

RayFrame MakeRayFrame(Ray ray)
{
  // Direction: the change for one unit along the ray.
  SAME_EVERYWHERE float squared = dot(ray.Direction, ray.Direction);
  SAME_EVERYWHERE float nearest = -dot(ray.Direction, ray.Point) / squared;
  SAME_EVERYWHERE vec3 point = ray.Point + nearest * ray.Direction;
  SAME_EVERYWHERE vec3 n = ray.Direction * inversesqrt(squared);
  // Two vectors across.
  SAME_EVERYWHERE vec3 u = GridScale * rayAxes[0];
  SAME_EVERYWHERE vec3 v = GridScale * rayAxes[1];
  if (rayAxes[0] == vec3(0.0))
  {
    // Duff et al., Building an Orthonormal Basis, Revisited, 2017.
    float side = n.z < 0.0 ? -1.0 : 1.0;
    SAME_EVERYWHERE float p = -1.0 / (side + n.z);
    SAME_EVERYWHERE float q = n.x * n.y * p;
    u = GridScale * vec3(1.0 + side * n.x * n.x * p, side * q, -side * n.x);
    v = GridScale * vec3(q, side + n.y * n.y * p, -n.y);
  }
  RayFrame frame;
  frame.Across[0] = vec4(u, -dot(u, point));
  frame.Across[1] = vec4(v, -dot(v, point));
  frame.Along = ray.Direction / squared;
  frame.Start = ray.Distance + nearest;
  return frame;
}

// Those of View/RayDisplacements.h, in units of EdgeReach, behind one that is none.
uniform vec2 displacements[NUMBER_OF_DISPLACEMENTS];

// How far across a ray an edge between two points may be off by their rounding, in grid points:
// half of one by the grid, and as much by each of the sums that project them.
const float EdgeReach = 2.0;

RayFrame DisplaceFrame(RayFrame frame, int displacement)
{
  SAME_EVERYWHERE vec2 w =
    vec2(frame.Across[0].w, frame.Across[1].w) - EdgeReach * displacements[displacement];
  RayFrame displaced = frame;
  displaced.Across[0].w = w.x;
  displaced.Across[1].w = w.y;
  return displaced;
}

// Where a point is across the ray, in whole numbers.
vec2 Project(RayFrame frame, vec3 point)
{
  SAME_EVERYWHERE float x = frame.Across[0].x * point.x + frame.Across[0].y * point.y +
    frame.Across[0].z * point.z + frame.Across[0].w;
  SAME_EVERYWHERE float y = frame.Across[1].x * point.x + frame.Across[1].y * point.y +
    frame.Across[1].z * point.z + frame.Across[1].w;
  return clamp(floor(vec2(x, y) + 0.5), -LargestGridCoordinate, LargestGridCoordinate);
}

// A whole number up to 2^24 without its last twelve bits, and in units of them; what is left is
// within 2^11.
vec2 GetHigh(vec2 x)
{
  return floor(x * (1.0 / HalfScale) + 0.5);
}

// One corner of the triangle that a ray goes through.
struct Corner
{
  vec2 High, Low; // halves of its coordinates across the ray
  float Along;
  float Scalar;
  int Id;
};

Corner LoadCorner(RayFrame frame, int id)
{
  vec4 point = texelFetch(walkPoints, id);
  vec2 across = Project(frame, point.xyz);
  vec2 high = GetHigh(across);
  return Corner(high, across - HalfScale * high, dot(frame.Along, point.xyz), point.w, id);
}

// Whether a zero det(a, b) counts as positive.
bool TieIsPositive(Corner a, Corner b)
{
  // Differences of halves and eleven times them are whole numbers that single precision holds.
  vec2 high = b.High - a.High;
  vec2 low = b.Low - a.Low;
  float height =
    HalfScale * (3.0 * high.x + 8.0 * high.y) + (3.0 * low.x + 8.0 * low.y);
  float x = HalfScale * high.x + low.x;
  return height != 0.0 ? height < 0.0 : x != 0.0 ? x > 0.0 : b.Id > a.Id;
}

// det(a, b) = a.x b.y - a.y b.x, and on which side of the edge the ray passes.
float GetDeterminant(Corner a, Corner b, out bool positive)
{
  float high = a.High.x * b.High.y - a.High.y * b.High.x;
  float middle =
    (a.High.x * b.Low.y - a.High.y * b.Low.x) + (a.Low.x * b.High.y - a.Low.y * b.High.x);
  float low = a.Low.x * b.Low.y - a.Low.y * b.Low.x;
  // What of the middle belongs to the high part is added to it: the rest is then not larger than
  // one of its units.
  float carry = floor(middle * (1.0 / HalfScale) + 0.5);
  SAME_EVERYWHERE float rest = HalfScale * (middle - HalfScale * carry) + low;
  SAME_EVERYWHERE float determinant = (HalfScale * HalfScale) * (high + carry) + rest;
  positive = determinant != 0.0 ? determinant > 0.0 : TieIsPositive(a, b);
  return determinant;
}

// Shares of the corners where the ray goes through a triangle, from the determinants across.
vec3 GetShares(vec3 weights)
{
  return weights / (weights.x + weights.y + weights.z);
}
