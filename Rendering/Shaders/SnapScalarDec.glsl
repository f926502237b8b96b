// SPDX-License-Identifier: BSD-3-Clause
// Scalars that are a surface's value but for rounding are that value: where a whole region has it, the
// cells on both sides of a face would else find themselves on different sides of the surface.

// Mapped scalars are within -1..1 and found with an error of some 2^-23.
const float SnapDistance = 4.76837158203125e-07; // 2^-21

float SnapScalar(float scalar)
{
  for (int surface = 0; surface < numberOfIsosurfaces; ++surface)
  {
    float value = texelFetch(isosurfaces, 2 * surface).x;
    scalar = abs(scalar - value) <= SnapDistance ? value : scalar;
  }
  return scalar;
}
