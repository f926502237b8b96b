// SPDX-License-Identifier: BSD-3-Clause
// Where a ray comes in through a boundary face, by the same signs as the walk. Needs
// RayFrameDec.glsl.
//
// DIRECTED: only faces through which rays come in count; else all that rays cross, and the points
// of each ascend.

uniform isamplerBuffer boundaryEntries; // WalkTexels::Entries

// Whether the ray comes in through a boundary face of three points, and at which distance.
bool TestFace(RayFrame frame, ivec3 ids, out float distance)
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
  distance = along;
#ifdef DIRECTED
  return p && q && r;
#else
  return p == q && q == r;
#endif
}

bool TestEntry(RayFrame frame, int entry, out float distance)
{
  return TestFace(frame, texelFetch(boundaryEntries, entry).xyz, distance);
}

// The order of crossings at one distance: by the index of the face.
int GetFaceOfEntry(int entry)
{
  return texelFetch(boundaryEntries, entry).w;
}
