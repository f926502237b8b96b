// SPDX-License-Identifier: BSD-3-Clause
// Rounding to 8 bits up or down at random, as often up as the rest asks for (Kraus et al. 2004,
// section 4.2): so that what is too thin for 8 bits still counts, on the average.

// Random in 0..1: evenly spread over neighbouring pixels (interleaved gradient noise, Jimenez, Next
// Generation Post Processing in Call of Duty: Advanced Warfare, 2014), and over the keys of cells
// by the golden ratio. The same in each frame.
float GetRandomNumber(vec2 pixel, float key)
{
  float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
  return fract(noise + fract(0.618033989 * key));
}

vec4 DitherAlpha(vec4 color, float random)
{
  float steps = 255.0 * color.a;
  float rounded = floor(steps);
  rounded += steps - rounded > random ? 1.0 : 0.0;
  return color.a > 0.0 ? color * (rounded / steps) : color;
}

// Of what is only added up: each channel, by a random number of its own.
vec4 DitherColor(vec4 color, float random)
{
  vec3 steps = 255.0 * color.rgb;
  vec3 rounded = floor(steps);
  vec3 randoms = fract(random + vec3(0.0, 1.0, 2.0) / 3.0);
  rounded += vec3(greaterThan(steps - rounded, randoms));
  return vec4(rounded / 255.0, color.a);
}
