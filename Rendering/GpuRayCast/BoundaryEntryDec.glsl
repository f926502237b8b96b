// SPDX-License-Identifier: BSD-3-Clause
// Where a ray comes in through a boundary face, by the same signs as the walk. Needs
// RayFrameDec.glsl.
//
// DIRECTED: only faces through which rays come in count; else all that rays cross, and the points
// of each ascend.

uniform isamplerBuffer boundaryEntries; // WalkTexels::Entries

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

// See FaceTest::Near; by the determinants of the corners.
bool IsNear(vec2 a, vec2 b, vec2 c, vec3 determinants)
{
  // Lengths of edges by the sums of their coordinates: up to 1.4 times too long.
  vec2 ab = abs(b - a);
  vec2 bc = abs(c - b);
  vec2 ca = abs(a - c);
  vec3 lengths = vec3(bc.x + bc.y, ca.x + ca.y, ab.x + ab.y);
  return any(lessThanEqual(abs(determinants), EdgeReach * lengths)) &&
    all(lessThanEqual(min(a, min(b, c)), vec2(EdgeReach))) &&
    all(greaterThanEqual(max(a, max(b, c)), vec2(-EdgeReach)));
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
  test.Near = IsNear(GetAcross(a), GetAcross(b), GetAcross(c), weights);
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
