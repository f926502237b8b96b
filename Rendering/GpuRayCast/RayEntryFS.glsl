//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Where rays that are outside of the mesh come in next: the boundary face whose crossing is the
// nearest one behind that of the last entry, by the hierarchy over the boundary, the nearer box
// first.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::BoundaryEntry::Dec
//VTK::BoundaryNodes::Dec

uniform isampler2D rayStates;
uniform isampler2D rayEntries;

out ivec4 fragOutput0; // gl_FragData[0]

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int next = -1;
  if (numberOfBoundaryNodes > 0 && texelFetch(rayStates, pixel, 0).w == RayNeedsEntry)
  {
    RayFrame frame = FindRayFrame(GetRay(gl_FragCoord.xy), pixel);
    int last = texelFetch(rayEntries, pixel, 0).x;
    float lastDistance = -LargestFloat;
    if (last >= 0)
    {
      TestEntry(frame, last, lastDistance);
    }
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
          float distance;
          // In the order of distances, and of faces where they are the same.
          if (TestEntry(frame, entry, distance) && entry != last &&
            (distance > lastDistance ||
              (distance == lastDistance && GetFaceOfEntry(entry) > GetFaceOfEntry(last))) &&
            (distance < nearest ||
              (distance == nearest && GetFaceOfEntry(entry) < GetFaceOfEntry(next))))
          {
            nearest = distance;
            next = entry;
          }
        }
      }
    }
  }
  fragOutput0 = ivec4(next);
}
