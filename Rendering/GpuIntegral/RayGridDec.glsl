// SPDX-License-Identifier: BSD-3-Clause
// The rays of a picture, relative to the mesh: coordinates are those of WalkPoint, in radii from
// its centre. Affine in the position of the pixel, and made so that the numbers stay small: the ray
// of a camera far away does not begin at the camera, but where it passes the centre. Lengths along
// rays are in units of about the mesh's radius in the world, so that neither they nor their squares
// overflow, whatever unit the world has.

uniform vec2 rayMiddle;    // of the picture, pixels
uniform vec3 rayPoints[3]; // in the middle, and the changes for a pixel to the right and up
uniform vec3 rayDirections[3];
uniform vec3 rayWorldDirections[3];
uniform vec3 rayAxes[2]; // see View/RayAcross.h; zero if the rays have none in common
uniform float rayTime; // from where a ray starts to its point, in units and world directions
uniform float rayLengthUnit; // world length of a unit

struct Ray
{
  vec3 Point;
  vec3 Direction; // for a length of one unit
  float Distance; // of Point from where the ray starts, units
  float Length;   // of the world direction, which planes are met in units of
};

Ray GetRay(vec2 pixel)
{
  vec2 p = pixel - rayMiddle;
  vec3 world = rayWorldDirections[0] + p.x * rayWorldDirections[1] + p.y * rayWorldDirections[2];
  float size = length(world);
  Ray ray;
  ray.Point = rayPoints[0] + p.x * rayPoints[1] + p.y * rayPoints[2];
  ray.Direction = (rayDirections[0] + p.x * rayDirections[1] + p.y * rayDirections[2]) / size;
  ray.Distance = rayTime * size;
  ray.Length = size;
  return ray;
}

#if NUMBER_OF_PLANES > 0
// Height of a ray's point above each plane in units, affine in the position of the pixel, and how
// fast it grows along the world direction.
uniform vec3 planeHeights[NUMBER_OF_PLANES];
uniform vec3 planeSlopes[NUMBER_OF_PLANES];
#endif

// Distances from the ray's point between which the planes keep the ray, units.
vec2 LimitRay(Ray ray, vec2 pixel)
{
  vec2 limits = vec2(-3.402823e38, 3.402823e38);
#if NUMBER_OF_PLANES > 0
  vec3 p = vec3(1.0, pixel - rayMiddle);
  for (int plane = 0; plane < NUMBER_OF_PLANES; ++plane)
  {
    float height = dot(planeHeights[plane], p);
    float slope = dot(planeSlopes[plane], p);
    float distance = -height / slope * ray.Length;
    limits.x = slope > 0.0 ? max(limits.x, distance) : limits.x;
    limits.y = slope < 0.0 ? min(limits.y, distance) : limits.y;
    // Parallel to the plane: all or nothing.
    limits.y = slope == 0.0 && height < 0.0 ? -3.402823e38 : limits.y;
  }
#endif
  return limits;
}
