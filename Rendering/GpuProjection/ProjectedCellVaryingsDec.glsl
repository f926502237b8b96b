// SPDX-License-Identifier: BSD-3-Clause
// What a corner of a projected cell hands to the fragments: ProjectedCellVS.glsl and
// ProjectedCellFS.glsl declare it alike. VARYING: out for the former, in for the latter.

#ifdef LINEAR
noperspective VARYING vec4 values; // scalar and faces
noperspective VARYING vec2 depths; // on the base; world length of a unit of depth
flat VARYING vec4 properties;      // slope of the scalar, code, smallest and largest scalar
flat VARYING vec2 reference;
flat VARYING vec2 cellData;
#else
flat VARYING vec4 base;   // on the least steep face, and the slope of the scalar behind it
flat VARYING vec4 face0;  // the three others, and the smallest and largest scalar
flat VARYING vec4 face1;
flat VARYING vec4 face2;  // the last one, and the world length of a unit of depth
flat VARYING vec3 scalar;
flat VARYING vec3 place; // reference, code
#ifdef ONE_INTERVAL
flat VARYING vec4 intervalBounds; // see OneIntervalDec.glsl
flat VARYING vec4 intervalSlopeColor;
flat VARYING vec3 intervalColorSlope;
#ifdef CURVED_COLORS
flat VARYING vec3 intervalColorBend;
#endif
#ifdef SLICES
flat VARYING vec2 slice; // shares of a segment's length where it begins and ends
#endif
#else
flat VARYING vec3 cellData;
#endif
#ifdef PERSPECTIVE
// Rays' squared length at a unit of depth: at the reference, its changes for a pixel right and up,
// and those of the second degree: right twice, right and up, up twice.
flat VARYING vec3 rayLength;
flat VARYING vec3 rayLengthBend;
#endif
#endif
#ifdef SHADED
flat VARYING vec3 gradient0; // ProjectedGradient
flat VARYING vec3 gradient1;
flat VARYING vec3 gradient2;
flat VARYING vec3 gradient3;
#endif
#ifdef SURFACES
flat VARYING int faces; // the first of the cell's four in faceScalars
#endif
