// SPDX-License-Identifier: BSD-3-Clause
// Which parts of a ray count: between planes, in front of opaque geometry, in the regions that
// cropping keeps. Needs RayGridDec.glsl. Specialised by OPAQUE_GEOMETRY and CROPPING, and
// NUMBER_OF_PARTS is how many parts a ray may have.

// No distance is larger.
const float Farthest = 3.402823e38;

#ifdef OPAQUE_GEOMETRY
uniform sampler2D opaqueDepth;   // of the window, 0..1
uniform vec2 opaquePixels;       // of the window for one of the picture
uniform vec4 opaqueFar[3];       // homogeneous coordinates of what pixels show at depth 1: in the
                                 // middle of the picture, and the changes for a pixel right and up
uniform vec4 opaqueNearer;       // their change for a depth of one less

// Distance in units from the ray's point to the opaque geometry that its pixel shows.
float GetOpaqueDistance(Ray ray, vec2 pixel)
{
  float depth = texelFetch(opaqueDepth, ivec2(pixel * opaquePixels), 0).x;
  vec2 p = pixel - rayMiddle;
  // By the distance from depth 1, near which most depths are: there it is exact.
  vec4 farthest = opaqueFar[0] + p.x * opaqueFar[1] + p.y * opaqueFar[2];
  vec4 place = farthest + (1.0 - depth) * opaqueNearer;
  float along = dot(place.xyz / place.w - ray.Point, ray.Direction);
  return depth < 1.0 ? along / dot(ray.Direction, ray.Direction) : Farthest;
}
#endif

#ifdef CROPPING
uniform vec3 croppingPlanes[2]; // lower and upper ones, in the coordinates of the ray
uniform int croppingFlags;      // bit x + 3 y + 9 z keeps a region, as in vtkVolumeMapper

// Distances in units to where the ray crosses planes across the axes.
vec3 GetCrossings(Ray ray, vec3 planes)
{
  bvec3 parallel = equal(ray.Direction, vec3(0.0));
  vec3 safe = mix(ray.Direction, vec3(1.0), vec3(parallel));
  return mix((planes - ray.Point) / safe, vec3(Farthest), vec3(parallel));
}

// The nearest of three distances that are larger than begin; end where none is before it.
float FindNext(vec3 distances, float begin, float end)
{
  float next = distances.x > begin ? min(distances.x, end) : end;
  next = distances.y > begin ? min(distances.y, next) : next;
  return distances.z > begin ? min(distances.z, next) : next;
}

bool IsRegionKept(vec3 point)
{
  ivec3 steps = ivec3(greaterThanEqual(point, croppingPlanes[0])) +
    ivec3(greaterThanEqual(point, croppingPlanes[1]));
  return ((croppingFlags >> (steps.x + 3 * steps.y + 9 * steps.z)) & 1) != 0;
}

// The part of that number of those that are left of the limits; an empty one where there are fewer.
vec2 CropRay(Ray ray, vec2 limits, int part)
{
  // A ray is cut into seven at most. Beyond Far there is no mesh.
  const int MostCuts = 7;
  const float Far = 1e18;
  vec3 lower = GetCrossings(ray, croppingPlanes[0]);
  vec3 upper = GetCrossings(ray, croppingPlanes[1]);
  vec2 kept = vec2(Farthest, -Farthest);
  int found = -1;
  bool open = false;
  float begin = limits.x;
  for (int cut = 0; cut < MostCuts && begin < limits.y; ++cut)
  {
    float end = FindNext(upper, begin, FindNext(lower, begin, limits.y));
    float middle = 0.5 * clamp(begin, -Far, Far) + 0.5 * clamp(end, -Far, Far);
    bool keeps = IsRegionKept(ray.Point + middle * ray.Direction);
    found += keeps && !open ? 1 : 0;
    if (keeps && found == part)
    {
      kept = vec2(min(kept.x, begin), end);
    }
    open = keeps;
    begin = end;
  }
  return kept;
}
#endif

// Distances in units from the ray's point between which a part of it is, 0..NUMBER_OF_PARTS - 1,
// front to back; the first is larger than the second where there is none.
vec2 GetRayPart(Ray ray, vec2 pixel, int part)
{
  vec2 limits = LimitRay(ray, pixel);
#ifdef OPAQUE_GEOMETRY
  limits.y = min(limits.y, GetOpaqueDistance(ray, pixel));
#endif
#ifdef CROPPING
  limits = CropRay(ray, limits, part);
#endif
  return limits;
}
