//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Covers the pixels whose rays are done, so that the depth test keeps them out of later passes
// (Weiler et al. 2003, section 5.2), and finishes their colours: opacity is kept beside them while
// rays go on.
//
// GATHER_LARGEST: the colour is that of the largest scalar; else only opacity is written.

//VTK::RayStates::Dec
//VTK::RayIntegral::Dec

uniform sampler2D raySums;
uniform isampler2D nextEntries;

out vec4 fragOutput0; // gl_FragData[0]

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  RayState state = LoadState();
  bool noEntry = state.Part + 1 == NUMBER_OF_PARTS && state.Face == RayNeedsEntry &&
    texelFetch(nextEntries, pixel, 0).x == NoEntry;
  if (state.Face != RayIsDone && !noEntry)
  {
    discard;
  }
  gl_FragDepth = 0.0;
  float sum = texelFetch(raySums, pixel, 0).x;
#ifdef GATHER_LARGEST
  fragOutput0 = sum > -LargestFloat ? ClassifyLargest(sum) : vec4(0.0);
#else
  fragOutput0 = vec4(0.0, 0.0, 0.0, sum);
#endif
}
