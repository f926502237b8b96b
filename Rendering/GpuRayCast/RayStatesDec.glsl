// SPDX-License-Identifier: BSD-3-Clause
// What a ray has come to between passes: eight bytes, beside the sums that RayWalkFS.glsl keeps.
//
// Of the triangle through which a ray goes on only the face is kept: its points follow from the
// mesh. RayTargets.h knows the bits, too.

// Instead of the index of a face.
const int RayIsDone = -1;
const int RayNeedsEntry = -2; // it has not come into the mesh yet, or left it

// Instead of a boundary entry: there is none; or, below, which displacement the ray is to start
// anew with, see View/RayDisplacements.h.
const int NoEntry = -1;

struct RayState
{
  int Face;         // that is crossed next, or one of the above: less than 2^28 - 2
  int Displacement; // 0..15
  int Entry;        // the last one, or NoEntry: less than 2^29 - 1
  int Part;         // of the ray, 0..3
  bool Tells;       // whether its walk is to tell only, see PAIRED in RayWalkFS.glsl
};

uvec2 PackState(RayState state)
{
  return uvec2(uint(state.Face - RayNeedsEntry) << 4 | uint(state.Displacement),
    uint(state.Entry - NoEntry) << 3 | uint(state.Part) << 1 | uint(state.Tells));
}

RayState UnpackState(uvec2 bits)
{
  return RayState(int(bits.x >> 4) + RayNeedsEntry, int(bits.x & 15u),
    int(bits.y >> 3) + NoEntry, int(bits.y >> 1 & 3u), (bits.y & 1u) != 0u);
}

uniform usampler2D rayStates;

RayState LoadState()
{
  return UnpackState(texelFetch(rayStates, ivec2(gl_FragCoord.xy), 0).xy);
}

uniform float firstRow; // of the band in the picture

// Of the picture, not of the band of it that is drawn.
vec2 GetPixel()
{
  return gl_FragCoord.xy + vec2(0.0, firstRow);
}

const float LargestFloat = 3.402823e38;
