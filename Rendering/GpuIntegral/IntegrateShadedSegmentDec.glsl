// SPDX-License-Identifier: BSD-3-Clause
// Emission and absorption of a segment that is lit alike all along it. Needs LightingDec.glsl, and
// IntegrateSegment.

vec4 IntegrateShadedSegment(float front, float back, float len, vec3 frontGradient,
  vec3 backGradient, vec3 frontPoint, vec3 backPoint, vec3 direction)
{
  vec4 segment = IntegrateSegment(front, back, len);
  LightFactors light = FindLight(
    0.5 * (frontPoint + backPoint), 0.5 * (frontGradient + backGradient), direction);
  return vec4(segment.rgb * light.Scale + segment.a * light.Add, segment.a);
}
