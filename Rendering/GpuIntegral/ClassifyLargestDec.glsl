// SPDX-License-Identifier: BSD-3-Clause
// Premultiplied colour and opacity of the largest scalar along a ray; at a step the value from
// larger scalars. Nothing where the ray met none: below -LargestScalar, or not a number.

vec4 ClassifyLargest(float largest)
{
  if (isnan(largest) || largest < -LargestScalar)
  {
    return vec4(0.0);
  }
  largest = BoundScalar(largest);
  int interval = GetFirstInterval(transferBuckets, largest);
  vec4 bounds = texelFetch(transferIntervals, 4 * interval);
  while (bounds.y <= largest)
  {
    bounds = texelFetch(transferIntervals, 4 * ++interval);
  }
  vec4 slopeColor = texelFetch(transferIntervals, 4 * interval + 1);
  vec3 colorSlope = texelFetch(transferIntervals, 4 * interval + 2).xyz;
  float x = largest - bounds.z;
  float opacity = clamp(bounds.w + slopeColor.x * x, 0.0, 1.0);
  return opacity * vec4(slopeColor.yzw + colorSlope * x, 1.0);
}
