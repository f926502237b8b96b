//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// What one cell adds to one ray: where the ray enters and leaves the cell, with which scalars, and
// the integral between them. See CellProjection.h, which this follows word by word.
//
// Defines:
//   PERSPECTIVE       z is 1 / depth and what is interpolated is divided by it; else z is -depth
//   LIMITED           rays do not go through all of the mesh:
//   NUMBER_OF_LIMITS    kept on the positive side of so many planes
//   OPAQUE              not behind opaque geometry
//   CROPPED             in some of 27 regions only
//   LINEAR            a perspective, but without PERSPECTIVE: what is linear comes interpolated,
//                     and what limits rays has 1 / depth
//   GATHER            of vec4 before and added, two parts of a ray in the same cell: what both add;
//                     where CROPPED
//   NOTHING           what adds nothing to that
//   KEYS              each cell's code has a key with it
//   SURFACES          of constant scalar
//   SHADED            lit: gradients are interpolated, too
//   ONE_INTERVAL      of the transfer function, see OneIntervalDec.glsl
//   FIRST             the distance of the first contribution instead of what is contributed

//VTK::Projection::Dec

out vec4 fragOutput0; // gl_FragData[0]

//VTK::Varyings::Dec

//VTK::Segment::Dec

// No face is farther.
const float Beyond = 1e38;

// A linear function of the pixel.
float At(vec3 f, vec2 d)
{
  return f.x + f.y * d.x + f.z * d.y;
}

#ifdef SURFACES
uniform samplerBuffer faceScalars; // FaceScalar, three texels each

// The scalar where the ray goes through one of the cell's faces, the base first: by the same
// operations for each of them, so that it is what the cell on the other side finds.
float FindFaceScalar(int face)
{
  int texel = 3 * (faces + face);
  vec4 first = texelFetch(faceScalars, texel);
  vec4 second = texelFetch(faceScalars, texel + 1);
  vec2 d = gl_FragCoord.xy - second.xy;
  float share = At(first.xyz, d);
#ifdef PERSPECTIVE
  share /= At(texelFetch(faceScalars, texel + 2).xyz, d);
#endif
  return min(first.w + clamp(share, 0.0, 1.0) * (second.z - first.w), second.z);
}
#endif

#ifdef LIMITED
// Between z and what limits are linear in.
#ifdef LINEAR
float Exchange(float z)
{
  return -1.0 / z;
}
#else
float Exchange(float z)
{
  return z;
}
#endif

uniform vec2 pictureMiddle; // in the coordinates of gl_FragCoord
#if NUMBER_OF_LIMITS > 0
uniform vec4 limitPlanes[NUMBER_OF_LIMITS]; // ScreenPlane
#endif
#ifdef OPAQUE
uniform sampler2D opaqueDepth; // of the window, 0..1
// Depth of what pixels show, the first over the second: at depth 1 of the window in the middle of
// the picture, the changes for a pixel right and up, and the change for a depth of one less.
uniform vec2 opaquePlaces[4];
#endif
#ifdef CROPPED
uniform vec4 croppingPlanes[6]; // ScreenPlane, of xmin, xmax, ymin, ymax, zmin, zmax
uniform int croppingFlags;

// Whether the region is kept that a ray is in at z.
bool IsKept(vec2 m, float z)
{
  vec4 point = vec4(m, 1.0, Exchange(z));
  int region = 0;
  int weight = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    region += dot(croppingPlanes[2 * axis], point) >= 0.0 ? weight : 0;
    region += dot(croppingPlanes[2 * axis + 1], point) >= 0.0 ? weight : 0;
    weight *= 3;
  }
  return ((croppingFlags >> region) & 1) != 0;
}

// The nearest plane between z and end, which is farther; end where there is none.
float FindCut(vec2 m, float z, float end)
{
  float next = end;
  for (int p = 0; p < 6; ++p)
  {
    vec4 plane = croppingPlanes[p];
    float cut = Exchange(-dot(plane.xyz, vec3(m, 1.0)) / plane.w);
    next = cut < z && cut > next ? cut : next;
  }
  return next;
}
#endif

// z where rays begin and end to count.
vec2 FindLimits(vec2 m)
{
#if defined(PERSPECTIVE) || defined(LINEAR)
  vec2 limits = vec2(Beyond, 1.0 / Beyond);
#else
  vec2 limits = vec2(Beyond, -Beyond);
#endif
#if NUMBER_OF_LIMITS > 0
  for (int p = 0; p < NUMBER_OF_LIMITS; ++p)
  {
    vec4 plane = limitPlanes[p];
    float side = dot(plane.xyz, vec3(m, 1.0));
    float z = -side / plane.w;
    limits.x = plane.w < 0.0 ? min(limits.x, z) : limits.x;
    limits.y = plane.w > 0.0 ? max(limits.y, z) : limits.y;
    // Parallel to the plane: all or nothing.
    limits.x = plane.w == 0.0 && side < 0.0 ? -Beyond : limits.x;
  }
#endif
#ifdef OPAQUE
  float nearer = 1.0 - texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).x;
  vec2 opaque = opaquePlaces[0] + m.x * opaquePlaces[1] + m.y * opaquePlaces[2] +
    nearer * opaquePlaces[3];
#if defined(PERSPECTIVE) || defined(LINEAR)
  float zOpaque = opaque.y / opaque.x;
#else
  float zOpaque = -opaque.x / opaque.y;
#endif
  limits.y = nearer > 0.0 ? max(limits.y, zOpaque) : limits.y;
#endif
  return vec2(Exchange(limits.x), Exchange(limits.y));
}
#endif

// How the cell is seen by the ray.
struct View
{
  float Sign;      // 1 where the base is a front face, -1 where it is a back face
  float Z;         // on the base
  float Scalar;    // on the base, times Z in a perspective
  float ScalarSlope;
  vec2 ScalarRange;
  float RayLength; // world length of a unit of depth
#ifdef SHADED
  vec3 Gradient; // as Scalar
#endif
#ifdef SURFACES
  float Near; // differences of the faces' z to the base
  float Far;
  float ScalarNear; // on these faces
  float ScalarFar;
#endif
};

#ifdef FIRST
// The distance of a point of a segment that begins at a distance.
float GetDistance(float begin, float share, float len)
{
  return begin + share * len;
}
#endif

// The part of a ray from near to far, differences of z to the base.
vec4 AddPart(View view, float near, float far)
{
  float len = (near - far) * view.RayLength;
  float sNear = view.Scalar + view.ScalarSlope * near;
  float sFar = view.Scalar + view.ScalarSlope * far;
#ifdef PERSPECTIVE
  // Kraus et al. 2004, section 2.1: what was interpolated is divided by 1 / depth.
  float zNear = view.Z + view.Sign * near;
  float zFar = view.Z + view.Sign * far;
  float inverse = 1.0 / (zNear * zFar);
  len *= inverse;
  sNear *= zFar * inverse;
  sFar *= zNear * inverse;
#endif
  sNear = clamp(sNear, view.ScalarRange.x, view.ScalarRange.y);
  sFar = clamp(sFar, view.ScalarRange.x, view.ScalarRange.y);
#ifdef SURFACES
#ifdef LIMITED
  sNear = near == view.Near ? view.ScalarNear : sNear;
  sFar = far == view.Far ? view.ScalarFar : sFar;
#else
  sNear = view.ScalarNear;
  sFar = view.ScalarFar;
#endif
#endif
  float front = view.Sign > 0.0 ? sNear : sFar;
  float back = view.Sign > 0.0 ? sFar : sNear;
#ifdef SHADED
  vec3 gNear = view.Gradient + near * gradient3;
  vec3 gFar = view.Gradient + far * gradient3;
#ifdef PERSPECTIVE
  gNear /= zNear;
  gFar /= zFar;
#endif
  vec3 frontGradient = view.Sign > 0.0 ? gNear : gFar;
  vec3 backGradient = view.Sign > 0.0 ? gFar : gNear;
#endif
#if defined(FIRST) || defined(SHADED)
  float z = view.Z + view.Sign * (view.Sign > 0.0 ? near : far);
#ifdef PERSPECTIVE
  float begin = view.RayLength / z;
#else
  float begin = -view.RayLength * z;
#endif
#endif
  //VTK::Segment::Impl
}

#ifdef CROPPED
vec4 Gather(vec4 before, vec4 added)
{
  return GATHER;
}
#endif

void main()
{
  // Differences of faces to the base: only they count for the thickness, however thin the cell is.
  View view;
#ifdef LINEAR
  vec2 d = gl_FragCoord.xy - reference;
  float code = properties.y;
  float e0 = values.y;
  float e1 = values.z;
  float e2 = values.w;
  view.Z = depths.x;
  view.Scalar = values.x;
  view.ScalarSlope = properties.x;
  view.ScalarRange = properties.zw;
  view.RayLength = depths.y;
#else
  vec2 d = gl_FragCoord.xy - place.xy;
  float code = place.z;
  float e0 = At(face0.xyz, d);
  float e1 = At(face1.xyz, d);
  float e2 = At(face2.xyz, d);
  view.Z = At(base.xyz, d);
  view.Scalar = At(scalar, d);
  view.ScalarSlope = base.w;
  view.ScalarRange = vec2(face0.w, face1.w);
  view.RayLength = face2.w;
#endif
#ifdef PERSPECTIVE
  view.RayLength *= sqrt(rayLength.x +
    d.x * (rayLength.y + d.x * rayLengthBend.x + d.y * rayLengthBend.y) +
    d.y * (rayLength.z + d.y * rayLengthBend.z));
#endif
#ifdef KEYS
  float key = floor(code / 8.0);
  code -= 8.0 * key;
#endif
  float entries = code >= 4.0 ? code - 4.0 : code;
  view.Sign = code >= 4.0 ? -1.0 : 1.0;
#ifdef SHADED
  view.Gradient = gradient0 + d.x * gradient1 + d.y * gradient2;
#endif
  float near = min(min(0.0, entries > 0.5 ? e0 : Beyond),
    min(entries > 1.5 ? e1 : Beyond, entries > 2.5 ? e2 : Beyond));
  float far = max(entries > 0.5 ? -Beyond : e0,
    max(entries > 1.5 ? -Beyond : e1, entries > 2.5 ? -Beyond : e2));
#ifdef SURFACES
  int nearFace = entries > 0.5 && e0 == near ? 1 : 0;
  nearFace = entries > 1.5 && e1 == near ? 2 : nearFace;
  nearFace = entries > 2.5 && e2 == near ? 3 : nearFace;
  int farFace = entries < 1.5 && e1 == far ? 2 : 3;
  farFace = entries < 0.5 && e0 == far ? 1 : farFace;
  view.Near = near;
  view.Far = far;
  view.ScalarNear = FindFaceScalar(nearFace);
  view.ScalarFar = FindFaceScalar(farFace);
#endif

#ifdef LIMITED
  vec2 m = gl_FragCoord.xy - pictureMiddle;
  vec2 limits = FindLimits(m);
  vec2 ends = view.Sign * (limits - view.Z);
  near = min(near, view.Sign > 0.0 ? ends.x : ends.y);
  far = max(far, view.Sign > 0.0 ? ends.y : ends.x);
#endif
  if (!(near > far))
  {
    discard;
  }

#ifdef CROPPED
  // From the front end to the back end, from plane to plane.
  vec4 color = vec4(NOTHING);
  float front = view.Sign > 0.0 ? near : far;
  float back = view.Sign > 0.0 ? far : near;
  float begin = view.Z + view.Sign * front;
  float end = view.Z + view.Sign * back;
  float z = begin;
  const int LargestNumberOfParts = 7;
  for (int part = 0; part < LargestNumberOfParts && z > end; ++part)
  {
    float next = FindCut(m, z, end);
    if (IsKept(m, 0.5 * (z + next)))
    {
      float first = z == begin ? front : clamp(view.Sign * (z - view.Z), far, near);
      float second = next == end ? back : clamp(view.Sign * (next - view.Z), far, near);
      color = Gather(color, AddPart(view, max(first, second), min(first, second)));
    }
    z = next;
  }
#else
  vec4 color = AddPart(view, near, far);
#endif
  //VTK::Dither::Impl
  fragOutput0 = color;
}
