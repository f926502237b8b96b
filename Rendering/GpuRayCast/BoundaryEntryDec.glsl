// SPDX-License-Identifier: BSD-3-Clause
// Where a ray comes in through a boundary face, by the same signs as the walk. Needs
// RayFrameDec.glsl.
//
// DIRECTED: only faces through which rays come in count; else all that rays cross, and the points
// of each ascend.

uniform isamplerBuffer boundaryEntries; // WalkTexels::Entries

// View/RayDisplacements.h
const float FarthestDisplacement = 3.814697265625e-06;

struct FaceTest
{
  bool Crossed; // whether the ray comes in through the face
  bool Near;    // whether it passes an edge, or the line of one beside the face, within EdgeReach
  float Distance;
};

vec2 GetAcross(Corner corner)
{
  return HalfScale * corner.High + corner.Low;
}

// Whether a ray passes the line of an edge within EdgeReach, by the determinant of its ends, behind
// the begin of edges: all rays from a point of the boundary pass edges there.
bool IsNearLine(vec2 a, vec2 b, float alongA, float alongB, float determinant, float begin)
{
  vec2 edge = b - a;
  // The length by the sum of its coordinates: up to 1.4 times too long.
  float size = abs(edge.x) + abs(edge.y);
  if (abs(determinant) > EdgeReach * size)
  {
    return false;
  }
  // An edge along the ray has no line across it that means anything: its ends count, the far one.
  if (size <= 8.0 * EdgeReach)
  {
    return all(lessThanEqual(abs(a), vec2(EdgeReach + size))) && max(alongA, alongB) > begin;
  }
  // Where along the ray.
  float share = clamp(-dot(a, edge) / dot(edge, edge), 0.0, 1.0);
  return mix(alongA, alongB, share) > begin;
}

// See FaceTest::Near; by the determinants of the corners.
bool IsNear(vec2 a, vec2 b, vec2 c, vec3 along, vec3 determinants, float begin)
{
  return all(lessThanEqual(min(a, min(b, c)), vec2(EdgeReach))) &&
    all(greaterThanEqual(max(a, max(b, c)), vec2(-EdgeReach))) &&
    (IsNearLine(b, c, along.y, along.z, determinants.x, begin) ||
      IsNearLine(c, a, along.z, along.x, determinants.y, begin) ||
      IsNearLine(a, b, along.x, along.y, determinants.z, begin));
}

// A boundary face of three points.
FaceTest TestFace(RayFrame frame, ivec3 ids)
{
  Corner a = LoadCorner(frame, ids.x);
  Corner b = LoadCorner(frame, ids.y);
  Corner c = LoadCorner(frame, ids.z);
  bool p;
  bool q;
  bool r;
  vec3 weights =
    vec3(GetDeterminant(b, c, p), GetDeterminant(c, a, q), GetDeterminant(a, b, r));
  SAME_EVERYWHERE vec3 shares = GetShares(weights);
  SAME_EVERYWHERE float along = shares.x * a.Along + shares.y * b.Along + shares.z * c.Along;
  FaceTest test;
  test.Distance = along;
  test.Near = IsNear(GetAcross(a), GetAcross(b), GetAcross(c), vec3(a.Along, b.Along, c.Along),
    weights, FarthestDisplacement * length(frame.Along) - frame.Start);
#ifdef DIRECTED
  test.Crossed = p && q && r;
#else
  test.Crossed = p == q && q == r;
#endif
  return test;
}

FaceTest TestEntry(RayFrame frame, int entry)
{
  return TestFace(frame, texelFetch(boundaryEntries, entry).xyz);
}

// The order of crossings at one distance: by the index of the face.
int GetFaceOfEntry(int entry)
{
  return texelFetch(boundaryEntries, entry).w;
}
