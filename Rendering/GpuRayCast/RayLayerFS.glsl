//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// A layer of the boundary: where rays that are outside of the mesh come in next, of all faces that
// are drawn the nearest one by the depth test, behind the last entry (depth peeling).
//
// DISPLACES: rays that pass an edge of the boundary too closely ask for a displacement.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::BoundaryEntry::Dec
//VTK::BoundaryNodes::Dec

uniform isampler2D rayStates;
uniform isampler2D rayEntries;

flat in int entryVSOutput;

out ivec4 fragOutput0; // gl_FragData[0]

// Distances from the point nearest to the centre in depths: within a radius of it, with a reserve.
float FindDepth(RayFrame frame, float distance)
{
  SAME_EVERYWHERE float depth = 0.5 + 0.25 * distance / length(frame.Along);
  return depth;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (texelFetch(rayStates, pixel, 0).w != RayNeedsEntry)
  {
    discard;
  }
  ivec4 lastEntry = texelFetch(rayEntries, pixel, 0);
  int displacement = GetDisplacement(lastEntry.w);
  RayFrame frame = DisplaceFrame(MakeRayFrame(GetRay(gl_FragCoord.xy)), displacement);
  FaceTest test = TestEntry(frame, entryVSOutput);
#ifdef DISPLACES
  if (test.Near && displacement == 0)
  {
    gl_FragDepth = 0.0; // in front of all entries
    fragOutput0 = ivec4(AskForDisplacement(frame));
    return;
  }
#endif
  if (!test.Crossed)
  {
    discard;
  }
  float depth = FindDepth(frame, test.Distance);
  int last = lastEntry.x;
  if (last >= 0)
  {
    // In the order of depths, and of faces, which are drawn in their order, where they are the
    // same.
    float lastDepth = FindDepth(frame, TestEntry(frame, last).Distance);
    if (depth < lastDepth || (depth == lastDepth && entryVSOutput <= last))
    {
      discard;
    }
  }
  gl_FragDepth = depth;
  fragOutput0 = ivec4(entryVSOutput);
}
