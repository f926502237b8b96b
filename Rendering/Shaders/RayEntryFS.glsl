//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Where rays that are outside of the mesh come in next: the boundary face whose crossing is the
// nearest one behind that of the last entry, by the hierarchy over the boundary, without a stack.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::BoundaryEntry::Dec

uniform isampler2D rayStates;
uniform isampler2D rayEntries;

uniform samplerBuffer boundaryBoxes;    // WalkTexels::Boxes
uniform isamplerBuffer boundaryLinks;   // WalkTexels::Links
uniform int numberOfBoundaryNodes;

out ivec4 fragOutput0; // gl_FragData[0]

// Boxes are grown by what distances along the ray may be rounded by, as the hierarchy's margin is for
// those across: radii.
const float AlongMargin = 1.9073486328125e-06; // 2^-19

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int next = -1;
  if (texelFetch(rayStates, pixel, 0).w == RayNeedsEntry)
  {
    RayFrame frame = MakeRayFrame(GetRay(gl_FragCoord.xy));
    int last = texelFetch(rayEntries, pixel, 0).x;
    float lastDistance = -LargestFloat;
    if (last >= 0)
    {
      TestEntry(frame, last, lastDistance);
    }
    float nearest = LargestFloat;
    for (int node = 0; node < numberOfBoundaryNodes;)
    {
      vec4 box0 = texelFetch(boundaryBoxes, 2 * node);
      vec2 box1 = texelFetch(boundaryBoxes, 2 * node + 1).xy;
      ivec2 link = texelFetch(boundaryLinks, node).xy;
      vec3 halfEdges = vec3(box0.w, box1);
      // The box projected to the bounds of its shadow, and its extent along the ray.
      vec4 middle = vec4(box0.xyz, 1.0);
      vec2 across = vec2(dot(frame.Across[0], middle), dot(frame.Across[1], middle));
      vec2 reach = vec2(
        dot(abs(frame.Across[0].xyz), halfEdges), dot(abs(frame.Across[1].xyz), halfEdges));
      float along = dot(frame.Along, box0.xyz);
      float alongReach = dot(abs(frame.Along), halfEdges + AlongMargin);
      bool near = all(lessThanEqual(abs(across), reach)) && along - alongReach <= nearest &&
        along + alongReach >= lastDistance;
      if (near && link.y > 0)
      {
        for (int entry = link.y >> 3; entry < (link.y >> 3) + (link.y & 7); ++entry)
        {
          float distance;
          // In the order of distances, and of entries where they are the same.
          if (TestEntry(frame, entry, distance) && entry != last &&
            (distance > lastDistance || (distance == lastDistance && entry > last)) &&
            distance < nearest)
          {
            nearest = distance;
            next = entry;
          }
        }
      }
      node = near && link.y == 0 ? node + 1 : link.x;
    }
  }
  fragOutput0 = ivec4(next);
}
