// SPDX-License-Identifier: BSD-3-Clause
// Lit surfaces that a segment crosses, composited front to back: each by the light where it is
// crossed. Needs LightingDec.glsl and IsosurfacesDec.glsl.

vec4 IntegrateShadedSegment(float front, float back, float len, vec3 frontGradient,
  vec3 backGradient, vec3 frontPoint, vec3 backPoint, vec3 direction)
{
  vec4 gathered = vec4(0.0);
  float value = 0.0;
  vec4 color = vec4(0.0);
  for (int index = FindCrossing(front, back, 0, value, color); index < numberOfIsosurfaces;
       index = FindCrossing(front, back, index + 1, value, color))
  {
    float share = (value - front) / (back - front);
    LightFactors light = FindLight(
      mix(frontPoint, backPoint, share), mix(frontGradient, backGradient, share), direction);
    vec3 lit = clamp(color.rgb * light.Scale + light.Add, 0.0, 1.0);
    gathered += (1.0 - gathered.a) * color.a * vec4(lit, 1.0);
  }
  return gathered;
}
