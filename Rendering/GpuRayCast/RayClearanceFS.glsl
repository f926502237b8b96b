//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Which displacement each ray needs to pass all edges of the boundary at a distance, see
// View/RayDisplacements.h; 0: none. Where none is far enough from all edges, the last one.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::BoundaryEntry::Dec
//VTK::BoundaryNodes::Dec

out ivec4 fragOutput0; // gl_FragData[0]

// Whether the ray passes the edge between two corners within EdgeReach.
bool IsNearEdge(Corner a, Corner b)
{
  vec2 p = HalfScale * a.High + a.Low;
  vec2 q = HalfScale * b.High + b.Low;
  // The length by the sum of its coordinates: up to 1.4 times too long.
  vec2 extent = abs(q - p);
  bool unused;
  return abs(GetDeterminant(a, b, unused)) <= EdgeReach * (extent.x + extent.y) &&
    all(lessThanEqual(abs(p + q), extent + 2.0 * EdgeReach));
}

bool IsNearFace(RayFrame frame, int entry)
{
  ivec3 ids = texelFetch(boundaryEntries, entry).xyz;
  Corner a = LoadCorner(frame, ids.x);
  Corner b = LoadCorner(frame, ids.y);
  Corner c = LoadCorner(frame, ids.z);
  return IsNearEdge(a, b) || IsNearEdge(b, c) || IsNearEdge(c, a);
}

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
      if (IsNearFace(frame, entry))
      {
        return true;
      }
    }
  }
  return false;
}

void main()
{
  RayFrame frame = MakeRayFrame(GetRay(gl_FragCoord.xy));
  int displacement = 0;
  while (numberOfBoundaryNodes > 0 && displacement + 1 < NUMBER_OF_DISPLACEMENTS &&
    IsNearBoundary(DisplaceRay(frame, displacement)))
  {
    ++displacement;
  }
  fragOutput0 = ivec4(displacement);
}
