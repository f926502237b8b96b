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

#ifdef LINEAR
uniform vec3 rayDirection; // of the pixel in the lower left, and its change from pixel to pixel
uniform vec3 rayStepX;
uniform vec3 rayStepY;
uniform float depthUnit; // world length of rayDirection where it has length 1
#endif

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
  face2 = cellFace2;
  scalar = cellScalar;
  place = cellPlace;
  cellData = cellOwn;
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
