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
  RayState state = LoadState();
  if (state.Face != RayNeedsEntry)
  {
    discard;
  }
  RayFrame frame = DisplaceFrame(MakeRayFrame(GetRay(GetPixel())), state.Displacement);
  FaceTest test = TestEntry(frame, entryVSOutput);
#ifdef DISPLACES
  if (test.Near && state.Displacement == 0)
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
  int last = state.Entry;
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
