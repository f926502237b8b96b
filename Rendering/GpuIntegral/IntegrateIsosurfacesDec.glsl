// SPDX-License-Identifier: BSD-3-Clause
// Flat surfaces that a segment crosses, composited front to back: premultiplied colour and opacity.

vec4 IntegrateSegment(float front, float back, float len)
{
  vec4 gathered = vec4(0.0);
  float value = 0.0;
  vec4 color = vec4(0.0);
  for (int index = FindCrossing(front, back, 0, value, color); index < numberOfIsosurfaces;
       index = FindCrossing(front, back, index + 1, value, color))
  {
    gathered += (1.0 - gathered.a) * color.a * vec4(color.rgb, 1.0);
  }
  return gathered;
}
