//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// A boundary face as two triangles, six vertices: the bounds of its pixels and one pixel around
// them, so that no rounding of a rasteriser loses a pixel; which of them are in the face is decided
// exactly.

uniform samplerBuffer walkPoints;
uniform isamplerBuffer boundaryEntries;
// Homogeneous position in pixels of a point in the coordinates of rays.
uniform vec4 pixelFromRay[3];
uniform vec2 bandSize;  // of the band of the picture that is drawn, pixels
uniform float firstRow; // of the band in the picture

flat out int entryVSOutput;

vec2 FindPixel(int id)
{
  vec4 point = vec4(texelFetch(walkPoints, id).xyz, 1.0);
  vec2 homogeneous = vec2(dot(pixelFromRay[0], point), dot(pixelFromRay[1], point));
  return homogeneous / dot(pixelFromRay[2], point);
}

void main()
{
  entryVSOutput = gl_VertexID / 6;
  ivec3 ids = texelFetch(boundaryEntries, entryVSOutput).xyz;
  vec2 a = FindPixel(ids.x);
  vec2 b = FindPixel(ids.y);
  vec2 c = FindPixel(ids.z);
  vec2 lower = min(a, min(b, c)) - 1.0;
  vec2 upper = max(a, max(b, c)) + 1.0;
  int corner = gl_VertexID % 6;
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool top = corner == 2 || corner == 4 || corner == 5;
  vec2 pixel = vec2(right ? upper.x : lower.x, (top ? upper.y : lower.y) - firstRow);
  pixel = clamp(pixel, vec2(-2.0), bandSize + 2.0);
  gl_Position = vec4(2.0 * pixel / bandSize - 1.0, 0.0, 1.0);
}
