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
  bool Near;    // whether it passes an edge of the face within EdgeReach
  float Distance;
};

// Whether the ray passes the edge between two corners within EdgeReach, by their determinant.
bool IsNearEdge(Corner a, Corner b, float determinant)
{
  vec2 p = HalfScale * a.High + a.Low;
  vec2 q = HalfScale * b.High + b.Low;
  // The length by the sum of its coordinates: up to 1.4 times too long.
  vec2 extent = abs(q - p);
  return abs(determinant) <= EdgeReach * (extent.x + extent.y) &&
    all(lessThanEqual(abs(p + q), extent + 2.0 * EdgeReach));
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
  test.Near = IsNearEdge(b, c, weights.x) || IsNearEdge(c, a, weights.y) ||
    IsNearEdge(a, b, weights.z);
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
