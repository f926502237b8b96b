//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// A corner of a projected cell's silhouette. What is the same for the whole cell comes with its
// first corner, the last one of each of its triangles: see ProjectedCell in CellProjection.h.

//VTK::Projection::Dec

in vec2 corner; // pixels, from the lower left of the picture
#ifdef LINEAR
in vec4 cornerValues; // InterpolatedCell: scalar and faces
in float cornerBase;
in vec2 cellOwn0;
in vec2 cellOwn1;
in vec2 cellOwn2;
in vec2 cellOwn3;
#else
in vec3 cellBase; // ProjectedCell
in vec3 cellFace0;
in vec3 cellFace1;
in vec3 cellFace2;
in vec3 cellScalar;
in vec3 cellScalars; // slope, smallest, largest
in vec3 cellPlace;   // reference, code
in vec3 cellOwn;     // CellData
#endif

#ifdef SHADED
// ProjectedGradient: on the base, its changes for a pixel, and behind the base.
in vec3 cellGradient0;
in vec3 cellGradient1;
in vec3 cellGradient2;
in vec3 cellGradient3;
#endif

//VTK::Varyings::Dec

uniform vec2 pictureSize; // pixels

#ifdef ONE_INTERVAL
uniform samplerBuffer transferIntervals; // four texels each, see TransferIntervalsDec.glsl

// Beyond all scalars.
const float LargestScalar = 1e30;
#endif

// Fragments get what they need of these as numbers of their cell: a software renderer puts each
// uniform together anew, one pixel after the other.
#if defined(PERSPECTIVE) || defined(LINEAR)
uniform vec3 rayDirection; // of the pixel in the lower left, and its change from pixel to pixel
uniform vec3 rayStepX;
uniform vec3 rayStepY;
#endif
uniform float depthUnit; // world length of rayDirection where it has length 1

void main()
{
#ifdef LINEAR
  values = cornerValues;
  depths = vec2(cornerBase,
    depthUnit * length(rayDirection + (corner.x - 0.5) * rayStepX + (corner.y - 0.5) * rayStepY));
  properties = vec4(cellOwn0, cellOwn1);
  reference = cellOwn2;
  cellData = cellOwn3;
#else
  base = vec4(cellBase, cellScalars.x);
  face0 = vec4(cellFace0, cellScalars.y);
  face1 = vec4(cellFace1, cellScalars.z);
  face2 = vec4(cellFace2, depthUnit);
  scalar = cellScalar;
  place = cellPlace;
#ifdef ONE_INTERVAL
  // What other corners than the first have here is anything.
  int intervals = textureSize(transferIntervals) / 4;
  int texel = 4 * clamp(int(clamp(cellOwn.x, 0.0, float(intervals))), 0, intervals - 1);
  intervalBounds = texelFetch(transferIntervals, texel);
  bool openAbove = cellOwn.y >= 2.0;
  bool openBelow = (openAbove ? cellOwn.y - 2.0 : cellOwn.y) >= 1.0;
  intervalBounds.x = openBelow ? -LargestScalar : intervalBounds.x;
  intervalBounds.y = openAbove ? LargestScalar : intervalBounds.y;
  intervalSlopeColor = texelFetch(transferIntervals, texel + 1);
  intervalColorSlope = texelFetch(transferIntervals, texel + 2).xyz;
#ifdef CURVED_COLORS
  intervalColorBend = texelFetch(transferIntervals, texel + 3).xyz;
#endif
#ifdef SLICES
  float slices = floor(cellOwn.z / float(SLICES));
  float index = cellOwn.z - float(SLICES) * slices;
  slice = vec2(index, index + 1.0) / slices;
#endif
#else
  cellData = cellOwn;
#endif
#ifdef PERSPECTIVE
  vec3 ray = rayDirection + (place.x - 0.5) * rayStepX + (place.y - 0.5) * rayStepY;
  rayLength = vec3(dot(ray, ray), 2.0 * dot(ray, rayStepX), 2.0 * dot(ray, rayStepY));
  rayLengthBend =
    vec3(dot(rayStepX, rayStepX), 2.0 * dot(rayStepX, rayStepY), dot(rayStepY, rayStepY));
#endif
#endif
#ifdef SHADED
  gradient0 = cellGradient0;
  gradient1 = cellGradient1;
  gradient2 = cellGradient2;
  gradient3 = cellGradient3;
#endif
#ifdef SURFACES
  // Four corners a cell, and four faces.
  faces = gl_VertexID / 4 * 4;
#endif
  gl_Position = vec4(2.0 * corner / pictureSize - 1.0, 0.0, 1.0);
}
