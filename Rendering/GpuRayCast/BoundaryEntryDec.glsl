// SPDX-License-Identifier: BSD-3-Clause
// Where a ray comes in through a boundary face, by the same signs as the walk. Needs
// RayFrameDec.glsl.
//
// DIRECTED: only faces through which rays come in count; else each ray asks once, and the nearest
// crossing is the right one.

uniform isamplerBuffer boundaryEntries; // WalkTexels::Entries

// Whether the ray comes in through a boundary face, and at which distance.
bool TestEntry(RayFrame frame, int entry, out float distance)
{
  ivec3 ids = texelFetch(boundaryEntries, entry).xyz;
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
