// SPDX-License-Identifier: BSD-3-Clause
// Where along a segment it first crosses a surface that is not fully transparent: the share of the
// segment that is in front of that; 2 where it crosses none.

float FindFirst(float front, float back)
{
  float value = 0.0;
  vec4 color = vec4(0.0);
  for (int index = FindCrossing(front, back, 0, value, color); index < numberOfIsosurfaces;
       index = FindCrossing(front, back, index + 1, value, color))
  {
    if (color.a > 0.0)
    {
      return (value - front) / (back - front);
    }
  }
  return 2.0;
}
