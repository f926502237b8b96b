//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// A number of steps of each ray from cell to cell (Weiler et al. 2003, section 3), front to back:
// exit face, scalar there, ray integral, blending, next cell. What a ray has come to is read from
// textures and written to others; the next pass goes on from there. Colours are added to those of
// the picture by blending, as no ray needs to read them: so there is one of them, not two.
//
// A cell is entered through the triangle a b c, whose corners surround the ray counter-clockwise.
// The cell's fourth point p replaces one of them: the signs of det(p, a), det(p, b), det(p, c) tell
// which, and thereby the face through which the ray leaves. So a step reads one point, 16 bytes,
// and one face, 8 bytes: the cell behind it and that cell's fourth point.
//
// CELL_DATA: scalars are constant in each cell. GATHER_LARGEST: the largest scalar along the ray is
// looked for; else segments are composited. IMAGINARY_CELLS: cells from numberOfCells on fill the
// space between the mesh and its hull and contribute nothing. REENTRY: a ray that left the mesh may
// come in again. PAIRED: faces have no direction in which they are crossed. The crossings of a ray
// still come in pairs, the ends of walks: a crossing is an entry where the walk from it ends behind
// it. So rays that come in again walk twice: first to tell, then to gather. ISOSURFACES: surfaces
// of constant scalar are looked for. LIT: lights shine on segments, by the gradients of cells or,
// SMOOTH_GRADIENTS, of points; of isosurfaces only where there is one. FIND_FIRST: the distance of
// the first contribution is looked for within its segment. COUNT_STEPS: cells are counted.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::BoundaryEntry::Dec
//VTK::Lighting::Dec
//VTK::RayIntegral::Dec
//VTK::FirstContribution::Dec

// Opacity that was gathered so far, or the largest scalar; and where the segment begins that
// contributed first, from the point nearest to the centre.
uniform sampler2D raySums;

uniform isampler2D nextEntries; // of rays that need one, or what RayStatesDec.glsl says

uniform isamplerBuffer walkFaces;
uniform int numberOfCells;
uniform int stepsOfPass;
uniform float maximumOpacity; // a ray that is this opaque ends

// gl_FragData[0], gl_FragData[1], gl_FragData[2], gl_FragData[3]: state and sums; then colour, and
// distance of the first contribution from where the ray starts, -1 where there is none. The last
// two, and the steps, are added to what their pictures show times their fourth number: 1 adds, 0
// begins anew.
out uvec2 fragOutput0;
out vec2 fragOutput1;
out vec4 fragOutput2;
out vec4 fragOutput3;
#ifdef COUNT_STEPS
out vec4 fragOutput4; // gl_FragData[4]
#endif

// Distance and scalar where the ray goes through a triangle. By differences: a constant stays
// exactly what it is, also next to a step of the transfer function.
void Interpolate(vec3 weights, Corner a, Corner b, Corner c, out float along, out float scalar)
{
  vec2 shares = GetShares(weights).yz;
  along = a.Along + shares.x * (b.Along - a.Along) + shares.y * (c.Along - a.Along);
  scalar = a.Scalar + shares.x * (b.Scalar - a.Scalar) + shares.y * (c.Scalar - a.Scalar);
}

#ifdef ISOSURFACES
// Next to a vertex or an edge a ray passes several faces at nearly one distance, and rounding makes
// the scalar go back and forth there. Cells are joined to a segment of at least this length, so
// that a surface through a vertex is crossed once: units, sixteen grid points across.
const float JoinedLength = 3.814697265625e-06; // 2^-18
#endif

#ifdef LIT
#ifdef SMOOTH_GRADIENTS
uniform samplerBuffer pointGradients; // in any unit

const float SmallestLength = 1e-37; // keeps what is divided by it finite

// Where the ray goes through a triangle, see Interpolate.
vec3 InterpolateGradient(vec3 weights, ivec3 ids)
{
  vec3 first = texelFetch(pointGradients, ids.x).xyz;
  vec2 shares = GetShares(weights).yz;
  return first + shares.x * (texelFetch(pointGradients, ids.y).xyz - first) +
    shares.y * (texelFetch(pointGradients, ids.z).xyz - first);
}
#else
// Of the cell that a triangle and a point make: the direction, or the opposite one, which light
// does not tell apart.
vec3 FindCellGradient(ivec3 ids, int point)
{
  vec4 origin = texelFetch(walkPoints, point);
  vec4 a = texelFetch(walkPoints, ids.x) - origin;
  vec4 b = texelFetch(walkPoints, ids.y) - origin;
  vec4 c = texelFetch(walkPoints, ids.z) - origin;
  return a.w * cross(b.xyz, c.xyz) + b.w * cross(c.xyz, a.xyz) + c.w * cross(a.xyz, b.xyz);
}
#endif
#endif

#ifdef PAIRED
// Whether the walk from an entry ended behind it, at a face of the points.
bool EndsBehind(RayFrame frame, int entry, ivec3 ids, int face)
{
  int low = min(ids.x, min(ids.y, ids.z));
  int high = max(ids.x, max(ids.y, ids.z));
  float begin = TestEntry(frame, entry).Distance;
  float end = TestFace(frame, ivec3(low, ids.x + ids.y + ids.z - low - high, high)).Distance;
  return end > begin || (end == begin && face > GetFaceOfEntry(entry));
}
#endif

// The points of a face of a cell: those that are opposite to the cell's other faces. Each is told
// by what is behind such a face: the boundary, or a cell, one face of which leads back.
ivec3 FindPoints(int face)
{
  int cell = face >> 2;
  ivec3 points = ivec3(0);
  for (int k = 1; k < 4; ++k)
  {
    ivec2 behind = texelFetch(walkFaces, 4 * cell + ((face + k) & 3)).xy;
    int point = behind.y;
    for (int m = 0; behind.x >= 0 && m < 4; ++m)
    {
      ivec2 back = texelFetch(walkFaces, 4 * behind.x + m).xy;
      point = back.x == cell ? back.y : point;
    }
    points = ivec3(points.yz, point);
  }
  return points;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  RayState state = LoadState();
  vec2 sums = texelFetch(raySums, pixel, 0).xy;
#ifdef GATHER_LARGEST
  vec4 gathered = vec4(sums.x, 0.0, 0.0, 0.0);
#else
  vec4 gathered = vec4(0.0, 0.0, 0.0, sums.x);
#endif
  // Of the first segment that contributed the distances of its ends, and the scalars there.
  vec4 first = vec4(sums.y, 0.0, 0.0, 0.0);

  Ray ray = GetRay(GetPixel());
  RayFrame frame = DisplaceFrame(MakeRayFrame(ray), state.Displacement);
  bool walking = state.Face >= 0;
  ivec3 ids = ivec3(0);
  if (walking)
  {
    ids = FindPoints(state.Face);
  }
  else if (state.Face == RayNeedsEntry)
  {
    int next = texelFetch(nextEntries, pixel, 0).x;
    if (next < NoEntry)
    {
      // As before the first pass, but for the displacement.
      fragOutput0 = PackState(RayState(RayNeedsEntry, NoEntry - next, NoEntry, 0, false));
#ifdef GATHER_LARGEST
      fragOutput1 = vec2(-LargestFloat, LargestFloat);
#else
      fragOutput1 = vec2(0.0, LargestFloat);
#endif
      fragOutput2 = vec4(0.0);
      fragOutput3 = vec4(-1.0, 0.0, 0.0, 0.0);
#ifdef COUNT_STEPS
      fragOutput4 = vec4(0.0, 0.0, 0.0, 1.0);
#endif
      return;
    }
    walking = next >= 0;
#ifdef PAIRED
    state.Tells = state.Entry >= 0; // the nearest crossing of all is an entry
#endif
    state.Entry = next;
    ivec4 entry = walking ? texelFetch(boundaryEntries, next) : ivec4(0);
    ids = entry.xyz;
    state.Face = entry.w;
  }
  bool tells = state.Tells;
  vec2 limits = GetRayPart(ray, GetPixel(), state.Part) - (frame.Start - ray.Distance);

  // The triangle. Weights of the corners are areas across, and not normalized.
  Corner a = LoadCorner(frame, ids.x);
  Corner b = LoadCorner(frame, ids.y);
  Corner c = LoadCorner(frame, ids.z);
  bool clockwise;
  bool unused;
  vec3 weights = vec3(GetDeterminant(b, c, clockwise), 0.0, 0.0);
  weights.y = GetDeterminant(c, a, unused);
  weights.z = GetDeterminant(a, b, unused);
  weights = abs(weights);
  if (!clockwise)
  {
    Corner corner = b;
    b = c;
    c = corner;
    weights = weights.xzy;
  }
  float along;
  float scalar;
  Interpolate(weights, a, b, c, along, scalar);

  // At a boundary face that is entered its own cell is meant.
  int face = max(state.Face, 0);
  ivec2 behind = texelFetch(walkFaces, face).xy;
  int cell = behind.x < 0 ? face >> 2 : behind.x;
  bool outside = false;
  int steps = 0;
  walking = walking && along <= limits.y;
  bool partEnded = !walking;

#ifdef ISOSURFACES
  bool joins = false; // the last cells to the next one
  float joinedAlong = 0.0;
  float joinedScalar = 0.0;
  for (; walking && (steps < stepsOfPass || joins); ++steps)
#else
  for (; walking && steps < stepsOfPass; ++steps)
#endif
  {
    // To the face that the fourth point makes with two of the triangle's.
    Corner p = LoadCorner(frame, behind.y);
    bool aSide;
    bool bSide;
    bool cSide;
    float pa = abs(GetDeterminant(p, a, aSide));
    float pb = abs(GetDeterminant(p, b, bSide));
    float pc = abs(GetDeterminant(p, c, cSide));
    bool dropA = bSide && !cSide;
    bool dropB = cSide && !aSide;
    bool keepC = dropA || dropB;
#ifdef LIT
    ivec3 ids0 = ivec3(a.Id, b.Id, c.Id);
    vec3 weights0 = weights;
#endif
    // The index of a face is the place of its opposite point among the cell's ascending ones.
    int dropped = dropA ? a.Id : dropB ? b.Id : c.Id;
    // det(p, x) is the weight of the corner across; the replaced corner keeps its weight for p.
    weights = vec3(dropA ? weights.x : dropB ? pc : pb, dropB ? weights.y : dropA ? pc : pa,
      keepC ? (dropA ? pb : pa) : weights.z);
    if (dropA)
    {
      a = p;
    }
    else if (dropB)
    {
      b = p;
    }
    else
    {
      c = p;
    }
    face = 4 * cell + int(dropped > a.Id) + int(dropped > b.Id) + int(dropped > c.Id);
    int cellBefore = cell;
    behind = texelFetch(walkFaces, face).xy;
    cell = behind.x;

    float along0 = along;
    float scalar0 = scalar;
    Interpolate(weights, a, b, c, along, scalar);
#ifdef IMAGINARY_CELLS
    bool real = cellBefore < numberOfCells;
    bool leaves = cell < 0 || cell >= numberOfCells;
#else
    bool real = true;
    bool leaves = cell < 0;
#endif
    real = real && !tells;
#ifdef ISOSURFACES
    along0 = joins ? joinedAlong : along0;
    scalar0 = joins ? joinedScalar : scalar0;
    joins = real && !leaves && along < limits.y && abs(along - along0) < JoinedLength;
    joinedAlong = along0;
    joinedScalar = scalar0;
    real = real && !joins;
#endif

    // An inverted cell among others is walked from its far side to its near one; it is seen as any
    // other cell. What the limits cut is left out, by shares of the cell: a slope may overflow.
    bool backward = along < along0;
    float near = min(along, along0);
    float far = max(along, along0);
    float from = max(near, limits.x);
    float to = min(far, limits.y);
    float fromScalar = backward ? scalar : scalar0;
    float toScalar = backward ? scalar0 : scalar;
    float scalarChange = (toScalar - fromScalar) / (far - near);
    toScalar = to < far ? fromScalar + (to - near) * scalarChange : toScalar;
    fromScalar = near < from ? fromScalar + (from - near) * scalarChange : fromScalar;
    if (real && from <= to)
    {
#ifdef GATHER_LARGEST
#ifdef CELL_DATA
      float largest = GetCellScalar(cellBefore);
      float largestAlong = from;
#else
      float largest =
        fromScalar + toScalar < LargestFloat ? max(fromScalar, toScalar) : -LargestFloat;
      float largestAlong = fromScalar < toScalar ? to : from;
#endif
      if (largest > gathered.r)
      {
        gathered.r = largest;
        first.x = largestAlong;
      }
#else
#ifdef CELL_DATA
      vec4 segment = IntegrateCell(cellBefore, (to - from) * rayLengthUnit);
#else
#ifdef LIT
      vec4 segment = vec4(0.0);
#ifdef ISOSURFACES
      float surface;
      vec4 surfaceColor;
      if (FindCrossing(fromScalar, toScalar, 0, surface, surfaceColor) < numberOfIsosurfaces)
#endif
      {
#ifdef SMOOTH_GRADIENTS
        vec3 nearGradient = InterpolateGradient(weights0, ids0);
        vec3 farGradient = InterpolateGradient(weights, ivec3(a.Id, b.Id, c.Id));
        if (backward)
        {
          vec3 gradient = nearGradient;
          nearGradient = farGradient;
          farGradient = gradient;
        }
        vec3 gradientChange = (farGradient - nearGradient) / max(far - near, SmallestLength);
        vec3 fromGradient = nearGradient + (from - near) * gradientChange;
        vec3 toGradient = nearGradient + (to - near) * gradientChange;
#else
        vec3 fromGradient = FindCellGradient(ids0, p.Id);
        vec3 toGradient = fromGradient;
#endif
        float nearest = frame.Start - ray.Distance;
        segment = IntegrateShadedSegment(fromScalar, toScalar, (to - from) * rayLengthUnit,
          fromGradient, toGradient, ray.Point + (nearest + from) * ray.Direction,
          ray.Point + (nearest + to) * ray.Direction, ray.Direction);
      }
#else
      vec4 segment = IntegrateSegment(fromScalar, toScalar, (to - from) * rayLengthUnit);
#endif
#endif
      gathered += (1.0 - gathered.a) * segment;
      first = from < first.x && any(greaterThan(segment, vec4(0.0)))
        ? vec4(from, to, fromScalar, toScalar)
        : first;
#endif
    }

    outside = cell < 0;
    walking = !outside && (tells || along < limits.y) && gathered.a < maximumOpacity;
  }

  // Where the part of the ray ends, the next one begins anew: by the first entry into the mesh. Up
  // to there cells may be entered that overlap with those that were walked through.
  bool passed = outside || (!tells && along >= limits.y);
#ifdef REENTRY
  bool ended = false;
#else
  bool ended = passed;
#endif
  if (gathered.a >= maximumOpacity)
  {
    state.Face = RayIsDone;
  }
  else if (partEnded || ended)
  {
    bool last = state.Part + 1 == NUMBER_OF_PARTS;
    state.Face = last ? RayIsDone : RayNeedsEntry;
    state.Part += int(!last);
    state.Entry = NoEntry;
    state.Tells = false;
  }
  else
  {
    state.Face = passed ? RayNeedsEntry : face;
#ifdef PAIRED
    if (tells && outside)
    {
      state.Tells = false;
      state.Face = EndsBehind(frame, state.Entry, ivec3(a.Id, b.Id, c.Id), face)
        ? GetFaceOfEntry(state.Entry)
        : RayNeedsEntry;
    }
#endif
  }

#ifdef GATHER_LARGEST
  bool found = gathered.r > sums.x;
  float sum = gathered.r;
  vec3 color = vec3(0.0);
#else
  bool found = first.x < sums.y;
  float sum = gathered.a;
  vec3 color = gathered.rgb;
#endif
  float distance = first.x;
#ifdef FIND_FIRST
  float share = found ? FindFirst(first.z, first.w) : 0.0;
  distance += share <= 1.0 ? share * (first.y - first.x) : 0.0;
#endif
  fragOutput0 = PackState(state);
  fragOutput1 = vec2(sum, first.x);
  fragOutput2 = vec4(color, 1.0);
  fragOutput3 = found ? vec4((frame.Start + distance) * rayLengthUnit, 0.0, 0.0, 0.0)
                      : vec4(0.0, 0.0, 0.0, 1.0);
#ifdef COUNT_STEPS
  fragOutput4 = vec4(float(steps), 0.0, 0.0, 1.0);
#endif
}
