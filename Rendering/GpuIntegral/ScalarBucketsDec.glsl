// SPDX-License-Identifier: BSD-3-Clause
// Finds the interval of a sorted list that a mapped scalar is in, at once: by buckets of equal
// width over -1..1, and one for all scalars below and one for those above, see ScalarBuckets.h.

// An interval that begins at or below the scalar; mostly the right one, else one of the next.
int GetFirstInterval(isamplerBuffer buckets, float scalar)
{
  float last = float(textureSize(buckets) - 1);
  float place = floor((scalar + 1.0) * 0.5 * (last - 1.0)) + 1.0;
  return texelFetch(buckets, int(clamp(place, 0.0, last))).x;
}
