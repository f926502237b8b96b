// SPDX-License-Identifier: BSD-3-Clause
// The hierarchy over the boundary, as BoundaryBvh. Needs BoundaryEntryDec.glsl.

uniform samplerBuffer boundaryBoxes;    // WalkTexels::Boxes
uniform isamplerBuffer boundaryLinks;   // WalkTexels::Links
uniform int numberOfBoundaryNodes;

// Boxes are grown by what distances along the ray may be rounded by, as the hierarchy's margin is
// for those across: radii.
const float AlongMargin = 1.9073486328125e-06; // 2^-19

// BoundaryBvh::MaximumDepth + 1: one box waits for each level.
const int StackSize = 73;

// Whether a ray meets the box of a node, and from which distance on.
bool TestBox(RayFrame frame, int node, out float begin, out float end)
{
  vec4 box0 = texelFetch(boundaryBoxes, 2 * node);
  vec2 box1 = texelFetch(boundaryBoxes, 2 * node + 1).xy;
  vec3 halfEdges = vec3(box0.w, box1);
  // The box projected to the bounds of its shadow, and its extent along the ray.
  vec4 middle = vec4(box0.xyz, 1.0);
  vec2 across = vec2(dot(frame.Across[0], middle), dot(frame.Across[1], middle));
  vec2 reach = vec2(
    dot(abs(frame.Across[0].xyz), halfEdges), dot(abs(frame.Across[1].xyz), halfEdges));
  float along = dot(frame.Along, box0.xyz);
  float alongReach = dot(abs(frame.Along), halfEdges + AlongMargin);
  begin = along - alongReach;
  end = along + alongReach;
  return all(lessThanEqual(abs(across), reach));
}

// Whether a ray passes any edge of the boundary within EdgeReach.
bool IsNearBoundary(RayFrame frame)
{
  int nodes[StackSize];
  nodes[0] = 0;
  int size = 1;
  while (size > 0)
  {
    --size;
    int node = nodes[size];
    float begin;
    float end;
    if (!TestBox(frame, node, begin, end))
    {
      continue;
    }
    ivec2 link = texelFetch(boundaryLinks, node).xy;
    if (link.y == 0)
    {
      nodes[size] = link.x;
      nodes[size + 1] = node + 1;
      size += 2;
    }
    for (int entry = link.y >> 3; entry < (link.y >> 3) + (link.y & 7); ++entry)
    {
      if (TestEntry(frame, entry).Near)
      {
        return true;
      }
    }
  }
  return false;
}

// What a ray that passes edges of the boundary too closely asks for instead of an entry: to start
// anew, with the first displacement by which it passes none, or the last one of all.
int AskForDisplacement(RayFrame frame)
{
  int displacement = 1;
  while (displacement + 1 < NUMBER_OF_DISPLACEMENTS &&
    IsNearBoundary(DisplaceFrame(frame, displacement)))
  {
    ++displacement;
  }
  return NoEntry - displacement;
}
