//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Where rays that are outside of the mesh come in next: the boundary face whose crossing is the
// nearest one behind that of the last entry, by the hierarchy over the boundary, the nearer box
// first.
//
// DISPLACES: rays that pass an edge of the boundary too closely ask for a displacement.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::BoundaryEntry::Dec
//VTK::BoundaryNodes::Dec

out ivec4 fragOutput0; // gl_FragData[0]

void main()
{
  RayState state = LoadState();
  int next = NoEntry;
  if (numberOfBoundaryNodes > 0 && state.Face == RayNeedsEntry)
  {
    RayFrame frame = DisplaceFrame(MakeRayFrame(GetRay(GetPixel())), state.Displacement);
    int last = state.Entry;
    float lastDistance = last >= 0 ? TestEntry(frame, last).Distance : -LargestFloat;
    bool near = false;
    float nearest = LargestFloat;
    int nodes[StackSize];
    float begins[StackSize];
    int size = 0;
    float begin;
    float end;
    if (TestBox(frame, 0, begin, end))
    {
      nodes[0] = 0;
      begins[0] = begin;
      size = 1;
    }
    while (size > 0)
    {
      --size;
      int node = nodes[size];
      if (begins[size] > nearest)
      {
        continue;
      }
      ivec2 link = texelFetch(boundaryLinks, node).xy;
      if (link.y == 0)
      {
        int first = node + 1;
        int second = link.x;
        float begin0, end0, begin1, end1;
        bool meets0 =
          TestBox(frame, first, begin0, end0) && end0 >= lastDistance && begin0 <= nearest;
        bool meets1 =
          TestBox(frame, second, begin1, end1) && end1 >= lastDistance && begin1 <= nearest;
        bool swapped = begin1 < begin0;
        // The farther one first, so that the nearer one is looked at before it.
        bool farMeets = swapped ? meets0 : meets1;
        bool nearMeets = swapped ? meets1 : meets0;
        if (farMeets)
        {
          nodes[size] = swapped ? first : second;
          begins[size] = swapped ? begin0 : begin1;
          ++size;
        }
        if (nearMeets)
        {
          nodes[size] = swapped ? second : first;
          begins[size] = swapped ? begin1 : begin0;
          ++size;
        }
      }
      else
      {
        for (int entry = link.y >> 3; entry < (link.y >> 3) + (link.y & 7); ++entry)
        {
          FaceTest test = TestEntry(frame, entry);
          near = near || test.Near;
          // In the order of distances, and of faces where they are the same.
          if (test.Crossed && entry != last &&
            (test.Distance > lastDistance ||
              (test.Distance == lastDistance && GetFaceOfEntry(entry) > GetFaceOfEntry(last))) &&
            (test.Distance < nearest ||
              (test.Distance == nearest && GetFaceOfEntry(entry) < GetFaceOfEntry(next))))
          {
            nearest = test.Distance;
            next = entry;
          }
        }
      }
    }
#ifdef DISPLACES
    if (near && state.Displacement == 0)
    {
      next = AskForDisplacement(frame);
    }
#endif
  }
  fragOutput0 = ivec4(next);
}
