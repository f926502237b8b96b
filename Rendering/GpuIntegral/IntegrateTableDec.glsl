// SPDX-License-Identifier: BSD-3-Clause
// Emission and absorption of a segment by a lookup in a pre-integration table, interpolated as
// PreIntegrationTable::Lookup defines it. Specialised by UNIFORM_AXIS, LOGARITHMIC_LENGTHS and
// HARDWARE_FILTERING. Needs ScalarBucketsDec.glsl.

uniform sampler3D segmentTable; // over front scalar, back scalar, length
uniform vec3 tableSize;         // texels
uniform vec3 tableInverseSize;
uniform float tableInverseDelta;

#ifdef LOGARITHMIC_LENGTHS
uniform float tableStepsPerDoubling;
#endif

// Intervals of ScalarAxisMap: Lo, Hi, Coordinate, Slope.
#ifdef UNIFORM_AXIS
uniform vec4 tableAxis;
#else
uniform samplerBuffer tableAxis;
uniform isamplerBuffer tableBuckets;
#endif

float GetScalarCoordinate(float scalar)
{
#ifdef UNIFORM_AXIS
  vec4 interval = tableAxis;
#else
  // The first one that ends above the scalar, or else the last one.
  int last = textureSize(tableAxis) - 1;
  int index = GetFirstInterval(tableBuckets, scalar);
  vec4 interval;
  for (;; ++index)
  {
    interval = texelFetch(tableAxis, index);
    if (scalar < interval.y || index == last)
    {
      break;
    }
  }
#endif
  float inside = clamp(scalar, interval.x, interval.y);
  return interval.z + interval.w * (inside - interval.x);
}

float GetLengthCoordinate(float len)
{
  float y = len * tableInverseDelta;
#ifdef LOGARITHMIC_LENGTHS
  // The exponent counts doublings, the mantissa is the way through one. Logarithm and power may be
  // off by their last bits.
  float above = max(y, 1.0);
  float exponent = floor(log2(above));
  float mantissa = above * exp2(-exponent);
  y = tableStepsPerDoubling * (min(y, 1.0) + exponent + (mantissa - 1.0));
#endif
  return min(y, tableSize.z);
}

// Coordinates beyond the last texel are that texel's.
vec4 LookUpTable(vec3 coordinate)
{
#ifdef HARDWARE_FILTERING
  return texture(segmentTable, (coordinate + 0.5) * tableInverseSize);
#else
  // Weights of graphics cards have eight bits.
  vec3 inside = min(coordinate, tableSize - 1.0);
  vec3 corner = min(floor(inside), tableSize - 2.0);
  vec3 share = inside - corner;
  ivec3 i = ivec3(corner);
  vec4 slices[2];
  for (int k = 0; k < 2; ++k)
  {
    vec4 a = texelFetch(segmentTable, i + ivec3(0, 0, k), 0);
    vec4 b = texelFetch(segmentTable, i + ivec3(1, 0, k), 0);
    vec4 c = texelFetch(segmentTable, i + ivec3(0, 1, k), 0);
    vec4 d = texelFetch(segmentTable, i + ivec3(1, 1, k), 0);
    vec4 row0 = a + share.x * (b - a);
    vec4 row1 = c + share.x * (d - c);
    slices[k] = row0 + share.y * (row1 - row0);
  }
  return slices[0] + share.z * (slices[1] - slices[0]);
#endif
}

vec4 IntegrateSegment(float front, float back, float len)
{
  // No early return: branches cost more than lookups that are not needed.
  bool counts = len > 0.0 && !isnan(front - back);
  vec3 segment = counts ? vec3(front, back, len) : vec3(0.0);
  vec4 found = LookUpTable(vec3(GetScalarCoordinate(segment.x), GetScalarCoordinate(segment.y),
    GetLengthCoordinate(segment.z)));
  return counts ? found : vec4(0.0);
}
