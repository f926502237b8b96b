// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of constant scalar. A segment crosses one where the scalar is below its value at one end
// and not below it at the other: along a chain of segments each crossing is met once, also one at
// an end of a segment.

// Two texels for each surface, ascending in value: the value; red, green, blue, opacity.
uniform samplerBuffer isosurfaces;
uniform int numberOfIsosurfaces;

// The next surface that a segment crosses, front to back: its index in the order of the segment,
// from index on; numberOfIsosurfaces where there is none. A scalar that is not a number crosses
// nothing.
int FindCrossing(float front, float back, int index, out float value, out vec4 color)
{
  bool falling = back < front;
  for (; index < numberOfIsosurfaces; ++index)
  {
    int surface = falling ? numberOfIsosurfaces - 1 - index : index;
    value = texelFetch(isosurfaces, 2 * surface).x;
    if ((front < value) != (back < value) && !isnan(front - back))
    {
      color = texelFetch(isosurfaces, 2 * surface + 1);
      return index;
    }
  }
  return numberOfIsosurfaces;
}
